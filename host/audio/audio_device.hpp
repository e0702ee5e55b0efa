// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "audio_settings.hpp"
#include "high_pass.hpp"

#include <framework/device.hpp>

#include <atomic>
#include <functional>
#include <span>
#include <vector>

namespace tactus::host::audio
{

/// What a role hears and says through the run's sound card: between the guard and the streams. A reading is not valid while
/// the card is away, so that the guard holds at zero, and afterwards raises by its ramp.
class AudioDevice final : public Device
{
public:
    /// The flag says whether the card plays, and outlives this. Says when it goes.
    AudioDevice (AudioRole r, const std::atomic<bool>& plays, std::function<void (const AudioDevice&)> goes) : role (std::move (r)), card_plays (plays), on_end (std::move (goes)) {}
    ~AudioDevice() override { on_end (*this); }
    AudioDevice (const AudioDevice&) = delete;
    AudioDevice& operator= (const AudioDevice&) = delete;

    void prepare (double dt_s) override;
    Reading read() noexcept override;
    void write (const Effort& guarded) noexcept override;
    DeviceLayout layout() const override { return { .signal_inputs = static_cast<int> (role.inputs.size()), .signal_outputs = static_cast<int> (role.outputs.size()) }; }

    const AudioRole& uses() const noexcept { return role; }

    /// What came from the card at this tick, by channel. Before read. [tick thread]
    void hear (std::span<const float> channels) noexcept;

    /// Adds what was written to the samples of the channels. After write. [tick thread]
    void addTo (std::span<double> channels) const noexcept;

private:
    AudioRole role;
    const std::atomic<bool>& card_plays;
    const std::function<void (const AudioDevice&)> on_end;
    std::vector<HighPass> filters;
    Channels heard, samples;
};

}   // namespace tactus::host::audio
