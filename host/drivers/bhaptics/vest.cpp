// SPDX-License-Identifier: MIT
// A device driver for vests that are driven through bHaptics Player (version 2): WebSocket and JSON. Written from the public description of the messages; no
// vest and no Player has been tried. See docs/known_devices.md.
#include "vest.hpp"
#include "vest_messages.hpp"

#include <host/drivers/websocket/service_driver.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>

namespace tactus::host
{

namespace
{
using Clock = Exchange::Clock;
using namespace std::chrono_literals;

constexpr auto between_asks = 20ms;   // while no message is due
constexpr auto path = "/v2/feedbacks?app_id=tactus&app_name=Tactus";
constexpr int most_answers = 64;

/// The connection to the Player. A message lasts for 100 ms, so a vest falls silent when nothing comes.
class Vest final : Exchange::Partner
{
public:
    struct Settings
    {
        ServiceAddress address;
        VestSettings vest;
    };

    static constexpr Exchange::Promises promises { 100ms, 500ms };

    static Result<Settings> read (const std::string& port, const Json& description)
    {
        const auto address = ServiceAddress::read (port, usual_player);
        if (! address) return Message::error ("bhaptics/wrong", {}, "\"port\" is written as 15881 or localhost:15881, with a port from 1 to 65535");
        auto vest = VestSettings::read (description);
        if (! vest) return std::move (vest).error();
        return Settings { *address, std::move (*vest) };
    }

    Vest (Settings s, const Exchange::Promises& p)
        : address (std::move (s.address)), dots (std::move (s.vest.dots)),
          period (std::chrono::duration_cast<Clock::duration> (std::chrono::duration<double> (1.0 / s.vest.rate_hz))),
          exchange (*this, "the Player", Exchange::Answer::pong, p)
    {
    }

    std::string open (tactus_device_about& about)
    {
        if (auto why = exchange.open (address, path, nullptr); ! why.empty()) return why;
        if (auto why = exchange.claim ({}); ! why.empty()) return why;
        about.tool = TACTUS_DEVICE_FORCE;
        about.signal_outputs = static_cast<int32_t> (dots.channels());
        about.about = "A vest of bHaptics, through bHaptics Player.";
        // Vibrations: 1 is the full intensity, and the force is one only by name.
        guard = Json { { "max_signal", 1.0 }, { "max_force", dots.fullForce() }, { "watchdog", "100 ms" } }.dump();
        about.guard = guard.c_str();
        about.device_watchdog_s = 1e-3 * Dots::duration_ms;
        exchange.begin();
        return {};
    }

    /// Waits for an answer of the Player.
    int32_t next (Clock::time_point until, tactus_reading& to, tactus_device_stamp& stamp, std::string& why)
    {
        bool has_vest = true;
        const auto got = exchange.wait (until, [&] {
            has_vest = is_worn;
            if (answers == 0) return false;
            --answers;
            return true;
        });
        if (got == Exchange::Got::nothing) return TACTUS_DEVICE_NONE;
        if (got == Exchange::Got::gone)
        {
            why = exchange.trouble();
            return TACTUS_DEVICE_GONE;
        }
        to.valid = 1;
        if (! has_vest) stamp.fault = TACTUS_DEVICE_NOT_DRIVEN;
        return TACTUS_DEVICE_OK;
    }

    std::string take (const tactus_effort& effort)
    {
        const bool knows_guard = effort.size >= offsetof (tactus_effort, is_withheld) + sizeof effort.is_withheld;
        const bool is_withheld = knows_guard && effort.is_withheld != 0;
        const auto signals = std::span (effort.signals).first (std::min<std::size_t> (effort.signal_count, std::size (effort.signals)));
        const Vec3 force { effort.force };
        return exchange.offer ([&] {
            if (knows_guard) dots.limit (effort.max_signal);
            if (is_withheld) dots.forget();
            dots.take (signals, force);
            is_new = true;
            // The end of a stop does not wait until a message is due.
            const bool rests = force.isZero (0.0) && std::ranges::all_of (signals, [] (double v) { return v == 0.0; });
            has_to_rest = has_to_rest || (is_withheld && rests && dots.isShowing());
        });
    }

    void rest() { exchange.rest(); }

private:
    std::string hear (const std::string& message) override
    {
        const auto vest = hasVest (message);
        if (! vest) return "the Player sent something that is not JSON";
        const std::lock_guard lock (exchange.mutex);
        is_worn = *vest;
        return {};
    }

    void takeAnswer() override { answers = std::min (answers + 1, most_answers); }

    /// Sends the newest values as soon as the period of the last ones is over. Meanwhile, asks whether the Player is there.
    Exchange::Turn speak (Clock::time_point now) override
    {
        const auto due = std::min (asked + between_asks, is_new ? shown + period : Clock::time_point::max());
        if (! has_to_rest && now < due) return { due };
        asked = now;
        if (! has_to_rest && (! is_new || now < shown + period)) return { now };
        shown = now;
        is_new = false;
        return { now, std::exchange (has_to_rest, false) ? dots.silence() : dots.message() };
    }

    void askForRest() override { has_to_rest = true; }
    bool hasAskedForRest() const override { return ! has_to_rest; }

    const ServiceAddress address;
    std::string guard;

    // Protected by the mutex of the exchange:
    Dots dots;
    const Clock::duration period;   // of messages
    int answers = 0;                // received and not yet read
    bool is_new = false, has_to_rest = false;
    bool is_worn = true;   // as far as the Player says
    Clock::time_point asked, shown;

    Exchange exchange;   // last: it calls this
};

constexpr const char* keys[] { "port", "channels", "full_force", "rate" };
constexpr auto about_it = "Vests of bHaptics, through bHaptics Player.";
}   // namespace

const tactus_device_driver bhaptics_driver = serviceDriver<Vest, 1> ("bhaptics", about_it, keys);
const tactus_device_driver patient_bhaptics_driver = serviceDriver<Vest, 300> ("bhaptics", about_it, keys);

}   // namespace tactus::host
