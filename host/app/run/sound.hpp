// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/audio/card_keeper.hpp>
#include <host/audio/high_pass.hpp>
#include <host/audio/stream.hpp>

#include <atomic>
#include <memory>
#include <optional>

namespace tactus::host
{

/// The force on the tool, heard: as a hand feels it from 20 Hz up, through the sound card. What a session plays of a graph is
/// another matter (audio::AudioRig).
class Sound final : private audio::CardUser
{
public:
    static constexpr double newton_at_full_scale = 4.0;
    static constexpr double lowest_hz = 20.0;

    explicit Sound (audio::CardSystem& = audio::soundCards());
    ~Sound() override { stop(); }

    /// Opens the sound card, or says why it cannot be. [main thread]
    std::optional<Message> start();
    void stop();
    bool isOn() const noexcept { return on.load (std::memory_order_relaxed); }
    void attend() { keeper.attend(); }   ///< many times a second: takes a card again that went away [main thread]

    void setTickRate (double hz);                                     ///< while nothing ticks [main thread]
    void setVolume (float v) noexcept { volume = v; }                 ///< 0…1
    void push (double newton) noexcept;                               ///< [tick thread]
    audio::StreamReport report() const { return stream->report(); }   ///< [main thread]

private:
    void begin (const audio::OpenedFormat&) override;
    void block (const float* const*, int, float* const* out, int outs, int frames) noexcept override;
    std::optional<Message> open();

    std::atomic<bool> on = false;
    std::atomic<float> volume = 0.8f;
    double tick_rate = 4000.0;
    audio::HighPass high_pass { lowest_hz, tick_rate };
    std::unique_ptr<audio::OutStream> stream;
    int longest_block = 0;
    audio::CardKeeper keeper;   // last: its card calls this
};

}   // namespace tactus::host
