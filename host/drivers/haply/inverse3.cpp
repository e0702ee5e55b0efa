// SPDX-License-Identifier: MIT
// A device driver for Haply's Inverse3 and VerseGrip, through the service of its maker: WebSocket and JSON, one answer for each message. Written from the
// public description of the messages; no device has been tried. See docs/known_devices.md.
#include "inverse3.hpp"
#include "inverse3_messages.hpp"

#include <host/drivers/websocket/service_driver.hpp>

#include <chrono>
#include <deque>
#include <memory>
#include <string>
#include <utility>

namespace tactus::host
{

namespace
{
using Clock = Exchange::Clock;
using namespace std::chrono_literals;

constexpr auto until_probe = 5ms;   // after an answer without a new force; longer than a tick, so a probe never comes between two forces
constexpr auto until_driven = 50ms;
constexpr std::size_t most_waiting = 64;

/// The connection to the service. A force lasts for one tick of the service: when nothing comes, the arm idles.
class Inverse3 final : Exchange::Partner
{
public:
    struct Settings
    {
        ServiceAddress address;
        Inverse3Messages messages;
    };

    static constexpr Exchange::Promises promises { 20ms, 100ms };

    static Result<Settings> read (const std::string& port, const Json& description)
    {
        Settings settings;
        const auto address = ServiceAddress::read (port, usual_inverse3_service);
        auto wrong = settings.messages.configure (description);
        if (! address) wrong = "\"port\" is written as 10001 or localhost:10001, with a port from 1 to 65535";
        if (! wrong.empty()) return Message::error ("haply/wrong", {}, wrong);
        settings.address = *address;
        return settings;
    }

    Inverse3 (Settings s, const Exchange::Promises& p)
        : address (std::move (s.address)), messages (std::move (s.messages)), exchange (*this, "the service", Exchange::Answer::message, p)
    {
    }

    std::string open (tactus_device_about& about)
    {
        std::string inventory;
        if (auto why = exchange.open (address, "/", &inventory, Inverse3Messages::question); ! why.empty()) return why;
        if (auto why = messages.readInventory (inventory); ! why.empty()) return why;
        if (auto why = exchange.claim (messages.arm()); ! why.empty()) return why;   // the service adds up the forces of all programs
        if (auto why = hear (inventory); ! why.empty()) return why;
        about.tool = TACTUS_DEVICE_POSITION | TACTUS_DEVICE_FORCE | (messages.hasGrip() ? TACTUS_DEVICE_ROTATION : 0);
        about.about = "An Inverse3 of Haply, through its service.";
        if (messages.hasGrip())
        {
            about.buttons = Inverse3Messages::buttons.data();
            about.button_count = Inverse3Messages::buttons.size();
        }
        // Guesses, as for the Tactus board: weak, because the arm has not been measured. The service gives neither number nor time.
        about.guard = R"({"max_force": "2 N", "max_slew": "500 N/s", "max_speed": "2 m/s", "max_impulse": "15 N*s", "impulse_window": "10 s",
            "max_energy": "200 mJ", "energy_window": "1 s", "max_still": "1 s", "still_force": "0.5 N", "watchdog": "20 ms"})";
        about.device_watchdog_s = 0.05;   // a command lasts for one tick of the service
        exchange.begin();
        return {};
    }

    int32_t next (Clock::time_point until, tactus_reading& to, tactus_device_stamp& stamp, std::string& why)
    {
        Inverse3State state;
        bool is_driven = true;
        const auto got = exchange.wait (until, [&] {
            if (states.empty()) return false;
            state = states.front();
            states.pop_front();
            const auto now = Clock::now();
            if (! state.is_idle || force.isZero (0.0)) idle_since = now;
            is_driven = now - idle_since <= until_driven;
            return true;
        });
        if (got == Exchange::Got::nothing) return TACTUS_DEVICE_NONE;
        if (got == Exchange::Got::gone)
        {
            why = exchange.trouble();
            return TACTUS_DEVICE_GONE;
        }
        Vec3::Map (to.position) = state.position;
        Vec3::Map (to.rotation) = state.rotation;
        to.buttons = state.buttons;
        to.valid = 1;
        if (! is_driven) stamp.fault = TACTUS_DEVICE_NOT_DRIVEN;
        return TACTUS_DEVICE_OK;
    }

    std::string take (const tactus_effort& effort)
    {
        return exchange.offer ([&] {
            force = Vec3 { effort.force };
            is_new = true;
        });
    }

    void rest() { exchange.rest(); }

private:
    std::string hear (const std::string& message) override
    {
        Inverse3State state;
        if (auto wrong = messages.read (message, state); ! wrong.empty()) return wrong;
        const std::lock_guard lock (exchange.mutex);
        if (states.size() == most_waiting) states.pop_front();
        states.push_back (state);
        return {};
    }

    void takeAnswer() override { answered_at = Clock::now(); }

    /// The newest force; if there is none, asks where the arm is after a while.
    Exchange::Turn speak (Clock::time_point now) override
    {
        if (! is_new && now < answered_at + until_probe) return { answered_at + until_probe };
        return { now, std::exchange (is_new, false) ? messages.push (force) : messages.probe() };
    }

    void askForRest() override
    {
        force.setZero();
        is_new = true;
    }

    bool hasAskedForRest() const override { return ! is_new; }

    const ServiceAddress address;
    Inverse3Messages messages;

    // Protected by the mutex of the exchange:
    std::deque<Inverse3State> states;
    Vec3 force = Vec3::Zero();
    bool is_new = false;                                                      // the force has not been sent
    Clock::time_point answered_at = Clock::now(), idle_since = answered_at;   // the arm is idle although it is pushed

    Exchange exchange;   // last: it calls this
};

constexpr const char* keys[] { "port", "device_id", "grip", "spelling" };
constexpr auto about_it = "Haply Inverse3 and VerseGrip, through the service of their maker.";
}   // namespace

const tactus_device_driver haply_driver = serviceDriver<Inverse3, 1> ("haply", about_it, keys);
const tactus_device_driver patient_haply_driver = serviceDriver<Inverse3, 300> ("haply", about_it, keys);

}   // namespace tactus::host
