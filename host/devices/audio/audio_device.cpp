// SPDX-License-Identifier: MIT
#include "audio_device.hpp"

#include <algorithm>
#include <utility>

namespace tactus::host::audio
{

void AudioDevice::prepare (double dt_s)
{
    constexpr double open_s = 0.2;
    shuts = dt_s / Guard::fade_s;
    opens = dt_s / open_s;
    gate = 1.0;
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

/// Without the gate, a steady signal that the filter has removed would come back as a push while the guard fades it out. So on a stop,
/// the gate fades the last sample to zero, and the filter is reset. Once the gate starts to close, it closes completely.
void AudioDevice::write (const Effort& guarded) noexcept
{
    const double before = gate;
    is_shutting = std::exchange (is_withheld, false) || (is_shutting && before > 0.0);
    gate = is_shutting ? std::max (0.0, before - shuts) : std::min (1.0, before + opens);
    for (std::size_t i = 0; i < filters.size(); ++i)
    {
        const auto& use = role.outputs[i];
        const auto at = static_cast<int> (i);
        const double sample = use.gain * guarded.signals[at] / use.full_scale.value;
        if (! filters[i].isOn())
            samples.set (at, sample);
        else if (is_shutting)
        {
            filters[i].reset();
            samples.set (at, before > 0.0 ? samples[at] * (gate / before) : 0.0);
        }
        else
            samples.set (at, gate * filters[i](sample));
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
