// SPDX-License-Identifier: MIT
#pragma once

#include "channel_limit.hpp"
#include "high_pass.hpp"
#include <host/devices/sessions/audio_settings.hpp>

#include <tactus/node/device.hpp>
#include <tactus/run/guard.hpp>

#include <atomic>
#include <functional>
#include <span>
#include <vector>

namespace tactus::host::audio
{

/// The signal inputs and outputs of a role on the run's sound card, between the guard and the streams. While the card is
/// away, readings are not valid, so the guard holds the signals at zero; when the card is back, they ramp up.
/// An output with a high-pass filter has a gate behind the filter. It shuts within Guard::fade_s when the guard stops, and reopens within 0.2 s.
class AudioDevice final : public Device
{
public:
    /// The flag is true while the card plays; it must outlive the device. `goes` is called on destruction.
    AudioDevice (AudioRole r, const std::atomic<bool>& plays, std::function<void (const AudioDevice&)> goes)
        : role (std::move (r)), card_plays (plays), on_end (std::move (goes))
    {
    }
    ~AudioDevice() override { on_end (*this); }
    AudioDevice (const AudioDevice&) = delete;
    AudioDevice& operator= (const AudioDevice&) = delete;

    void prepare (double dt_s) override;
    void limitSignals (double max, double max_slew) override;
    Reading read() noexcept override;
    void write (const Effort& guarded) noexcept override;
    void withhold() noexcept override { is_withheld = true; }
    DeviceLayout layout() const override
    {
        return { .signal_inputs = static_cast<int> (role.inputs.size()), .signal_outputs = static_cast<int> (role.outputs.size()) };
    }

    const AudioRole& uses() const noexcept { return role; }

    /// Adds the limits of the role to those of the channels that its outputs drive, now and whenever they are tightened. Call after limitSignals().
    /// The channels must outlive the device. [main thread]
    void tighten (std::span<ChannelLimit> channels) noexcept;

    /// Stores the input samples of this tick, by channel. Call before read(). [tick thread]
    void hear (std::span<const float> channels) noexcept;

    /// Adds the written signals to the output samples, by channel. Call after write(). [tick thread]
    void addTo (std::span<double> channels) const noexcept;

private:
    AudioRole role;
    const std::atomic<bool>& card_plays;
    const std::function<void (const AudioDevice&)> on_end;
    std::vector<HighPass> filters;
    Channels heard, samples;
    double shuts = 0.0, opens = 0.0;   // change of the gate's gain per tick
    double gate = 1.0;                 // of outputs with a filter
    bool is_withheld = false, is_shutting = false;
    std::span<ChannelLimit> limited;   // the channels of the card, once it is chosen   [main thread]
    double max_signal = GuardLimits::none, max_signal_slew = GuardLimits::none;
};

}   // namespace tactus::host::audio
