// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
constexpr double lowest_hz = 20.0, most_correction = 0.01;
}

Sound::Sound() { waiting.reserve (2 * capacity); }

Sound::~Sound() { stop(); }

juce::String Sound::start()
{
    if (on) return {};
    if (const auto problem = manager.initialiseWithDefaultDevices (0, 2); problem.isNotEmpty()) return problem;
    if (manager.getCurrentAudioDevice() == nullptr) return "there is no sound card";
    on = true;
    manager.addAudioCallback (this);
    return {};
}

void Sound::stop()
{
    if (! on) return;
    on = false;
    manager.removeAudioCallback (this);
    manager.closeAudioDevice();
}

void Sound::push (double newton) noexcept
{
    if (! on.load (std::memory_order_relaxed)) return;
    const auto slot = index.next();
    if (! slot) return;
    ring[*slot] = std::isfinite (newton) ? static_cast<float> (newton / newton_at_full_scale) : 0.0f;
    index.push();
}

void Sound::audioDeviceAboutToStart (juce::AudioIODevice* device) { rate = device->getCurrentSampleRate(); }

void Sound::audioDeviceIOCallbackWithContext (const float* const*, int, float* const* outputs, int channels, int count, const juce::AudioIODeviceCallbackContext&)
{
    if (channels == 0) return;
    render (outputs[0], count, rate);
    for (int c = 1; c < channels; ++c)
        std::copy_n (outputs[0], count, outputs[c]);
}

void Sound::render (float* samples, int count, double sample_rate) noexcept
{
    if (filtered_for != sample_rate)
    {
        filtered_for = sample_rate;
        high_pass.setCoefficients (juce::IIRCoefficients::makeHighPass (sample_rate, lowest_hz));
    }
    index.drain ([this] (std::size_t slot)
                 {
        if (waiting.size() < waiting.capacity()) waiting.push_back (ring[slot]); });

    const double ticks = tick_rate.load (std::memory_order_relaxed), lag = lag_s * ticks;
    const auto there = static_cast<double> (waiting.size());
    const double ratio = ticks / sample_rate * (1.0 + most_correction * std::clamp ((there - lag) / lag, -1.0, 1.0));
    const double needed = ratio * count + 8.0;   // the interpolator looks ahead
    flowing = there >= (flowing ? needed : std::max (needed, lag));
    if (! flowing)
    {
        std::fill_n (samples, count, 0.0f);
        dry.fetch_add (static_cast<std::uint64_t> (count), std::memory_order_relaxed);
        return;
    }
    const int used = interpolator.process (ratio, waiting.data(), samples, count);
    waiting.erase (waiting.begin(), waiting.begin() + std::min (used, static_cast<int> (waiting.size())));
    // Of what piled up while nobody listened, the latest is played.
    if (static_cast<double> (waiting.size()) > 4.0 * lag + needed) waiting.erase (waiting.begin(), waiting.end() - static_cast<std::ptrdiff_t> (lag));
    high_pass.processSamples (samples, count);
    const float gain = volume.load (std::memory_order_relaxed);
    for (int i = 0; i < count; ++i)
        samples[i] = std::tanh (gain * samples[i]);
}

}   // namespace tactus::host
