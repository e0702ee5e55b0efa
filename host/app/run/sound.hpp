// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/audio/card_keeper.hpp>
#include <host/devices/audio/high_pass.hpp>
#include <host/devices/audio/stream.hpp>
#include <tactus/text/result.hpp>

#include <atomic>
#include <memory>

namespace tactus::host
{

/// Plays the force on the tool through the sound card, from 20 Hz up, so that what the hand feels can be heard. Independent of the
/// ports that a session plays (audio::AudioRig).
class Sound final : private audio::CardUser
{
public:
    static constexpr double newton_at_full_scale = 5.0;
    static constexpr double lowest_hz = 20.0;
    static constexpr int channels = 2;   ///< plays on the first channels of the card, at most this many

    explicit Sound (audio::CardSystem& = audio::soundCards());
    ~Sound() override { stop(); }

    /// Opens the sound card. [main thread]
    Result<> start();
    void stop();
    bool isOn() const noexcept { return on.load (std::memory_order_relaxed); }
    void poll() { keeper.poll(); }   ///< call many times a second; reopens a card that was lost [main thread]

    void setTickRate (double hz);                                     ///< call only while nothing ticks [main thread]
    void push (double newton) noexcept;                               ///< [tick thread]
    audio::StreamReport report() const { return stream->report(); }   ///< [main thread]

private:
    void begin (const audio::OpenedFormat&) override;
    void block (const float* const*, int, float* const* out, int outs, int frames) noexcept override;
    Result<> open();

    std::atomic<bool> on = false;
    double tick_rate = 4000.0;
    audio::HighPass high_pass { lowest_hz, tick_rate };
    std::unique_ptr<audio::OutStream> stream;
    int longest_block = 0;
    audio::CardKeeper keeper;   // declared last: the card calls the functions of this object
};

}   // namespace tactus::host
