// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/runtime/ring_index.hpp>

#include <atomic>
#include <vector>

#include <juce_audio_devices/juce_audio_devices.h>

namespace tactus::host
{

/// The force on the tool, heard: as a hand feels it from 20 Hz up, through the sound card. Ticks and samples have clocks of
/// their own; how fast the sound is played follows how much of it waits, by 1 % at most.
class Sound final : private juce::AudioIODeviceCallback
{
public:
    static constexpr double newton_at_full_scale = 4.0;
    static constexpr double lag_s = 0.03;   ///< how much waits, so that neither clock runs into the other

    Sound();
    ~Sound() override;

    /// Opens the sound card, or says why it cannot be. [main thread]
    juce::String start();
    void stop();
    void listenWithoutCard() noexcept { on = true; }   ///< for who calls render() himself
    bool isOn() const noexcept { return on; }

    void setTickRate (double hz) noexcept { tick_rate = hz; }                                   ///< [main thread]
    void setVolume (float v) noexcept { volume = v; }                                           ///< 0…1
    void push (double newton) noexcept;                                                         ///< [tick thread]
    std::uint64_t underruns() const noexcept { return dry.load (std::memory_order_relaxed); }   ///< samples for which nothing waited

    /// What a sound card would be given; public for those who have none. [audio thread]
    void render (float* samples, int count, double sample_rate) noexcept;

private:
    void audioDeviceIOCallbackWithContext (const float* const*, int, float* const* outputs, int channels, int count, const juce::AudioIODeviceCallbackContext&) override;
    void audioDeviceAboutToStart (juce::AudioIODevice*) override;
    void audioDeviceStopped() override {}

    static constexpr std::size_t capacity = 16384;

    juce::AudioDeviceManager manager;
    std::atomic<bool> on = false;
    std::atomic<double> tick_rate = 4000.0;
    std::atomic<float> volume = 0.8f;
    std::atomic<std::uint64_t> dry = 0;
    RingIndex index { capacity };
    std::vector<float> ring = std::vector<float> (capacity);

    // Of the audio thread.
    double rate = 48000.0, filtered_for = 0.0;
    std::vector<float> waiting;
    bool flowing = false;
    juce::LagrangeInterpolator interpolator;
    juce::IIRFilter high_pass;
};

}   // namespace tactus::host
