// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/device/make_device.hpp>
#include <tactus/run/run.hpp>
#include <tactus/run/tick_clock.hpp>

namespace tactus::host
{

/// The sound cards of a run, as a session uses them. host/devices/audio implements them. A session without them refuses roles with the driver "audio".
/// Life cycle: open roles; begin or seal; ticks; end. [main thread, except the functions of RunListener]
class RunSound : public RunListener
{
public:
    /// Opens the device of a role with the driver "audio". `where` in the messages is relative to the description.
    virtual MadeDevice open (const Json& description, const std::string& role, const Plan&) = 0;

    virtual TickClock& tickBy (double tick_rate_hz) = 0;   ///< the blocks of the card tick the run. Call it before begin()
    virtual TickClock* clock() const noexcept = 0;         ///< null if another clock ticks the run

    virtual bool isNeeded() const noexcept = 0;   ///< true if anything is played, recorded or ticked

    /// Opens the card. The roles must have their limits, and the plan the ports that are played. The engine provides the emergency stop.
    virtual Messages begin (const Plan&, double tick_rate_hz, const Engine*) = 0;
    virtual void seal() noexcept = 0;   ///< instead of begin(), if isNeeded() is false

    virtual Result<> poll() = 0;   ///< call it many times a second
    virtual Result<> end() = 0;    ///< closes the card. Call it when the run no longer ticks
};

}   // namespace tactus::host
