// SPDX-License-Identifier: MIT
#include "audio_device.hpp"

namespace tactus::host::audio
{

void AudioDevice::prepare (double dt_s)
{
    filters.clear();
    for (const auto& use : role.outputs)
        filters.emplace_back (use.high_pass_hz, 1.0 / dt_s);
}

Reading AudioDevice::read() noexcept
{
    Reading reading;
    reading.valid = card_plays.load (std::memory_order_relaxed);
    reading.signals = heard;
    return reading;
}

void AudioDevice::write (const Effort& guarded) noexcept
{
    for (std::size_t i = 0; i < filters.size(); ++i)
    {
        const auto& use = role.outputs[i];
        const auto at = static_cast<int> (i);
        samples.set (at, filters[i](use.gain * guarded.signals[at] / use.full_scale.value));
    }
}

void AudioDevice::limitSignals (double max, double max_slew)
{
    max_signal = max;
    max_signal_slew = max_slew;
    tighten (limited);
}

void AudioDevice::tighten (std::span<ChannelLimit> channels) noexcept
{
    limited = channels;
    if (max_signal == GuardLimits::none) return;
    for (const auto& use : role.outputs)
        if (const auto at = static_cast<std::size_t> (use.channel - 1); at < channels.size())
            channels[at].tighten (max_signal / use.full_scale.value, max_signal_slew / use.full_scale.value);
}

void AudioDevice::hear (std::span<const float> channels) noexcept
{
    for (std::size_t i = 0; i < role.inputs.size(); ++i)
    {
        const auto& use = role.inputs[i];
        const auto at = static_cast<std::size_t> (use.channel - 1);
        heard.set (static_cast<int> (i), at < channels.size() ? use.gain * use.full_scale.value * static_cast<double> (channels[at]) : 0.0);
    }
}

void AudioDevice::addTo (std::span<double> channels) const noexcept
{
    for (std::size_t i = 0; i < filters.size(); ++i)
        if (const auto at = static_cast<std::size_t> (role.outputs[i].channel - 1); at < channels.size()) channels[at] += samples[static_cast<int> (i)];
}

}   // namespace tactus::host::audio
