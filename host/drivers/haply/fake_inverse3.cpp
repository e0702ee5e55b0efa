// SPDX-License-Identifier: MIT
#include "fake_inverse3.hpp"

#include <host/drivers/websocket/fake_service.hpp>
#include <host/drivers/websocket/member.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <utility>

namespace tactus::host
{
namespace
{
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto tick = 1ms;

Json jsonOf (const Vec3& v) { return { { "x", v.x() }, { "y", v.y() }, { "z", v.z() } }; }

/// The quaternion of a rotation vector.
Json orientationOf (const Vec3& rotation)
{
    const double angle = rotation.norm();
    const Vec3 v = rotation * (angle > 0.0 ? std::sin (0.5 * angle) / angle : 0.5);
    return { { "x", v.x() }, { "y", v.y() }, { "z", v.z() }, { "w", std::cos (0.5 * angle) } };
}

std::optional<Vec3> vectorIn (const Json& command)
{
    for (const auto* key : { "values", "vector" })
        if (const auto at = command.find (key); at != command.end() && at->is_object())
        {
            Vec3 v;
            const char* names[] { "x", "y", "z" };
            for (int i = 0; i < 3; ++i)
            {
                const auto number = at->find (names[i]);
                if (number == at->end() || ! number->is_number()) return std::nullopt;
                v[i] = number->get<double>();
            }
            return v;
        }
    return std::nullopt;
}

class Service final : public FakeService<FakeInverse3>
{
public:
    Service (int p, std::unique_ptr<Device> h, int delay) : FakeService (p), hand (std::move (h)), delay_ms (delay)
    {
        hand->prepare (1e-3);
        begin ("the fake service");
    }

    ~Service() override { end(); }

    Vec3 force() const override
    {
        const std::lock_guard lock (mutex);
        return Clock::now() - commanded_at < tick ? commanded : Vec3 (Vec3::Zero());
    }

private:
    void serve (WebServer::Client& client, const std::stop_token& stop) override
    {
        bool is_first = true;
        if (fault() != Fault::shy) send (client, std::exchange (is_first, false));
        auto pushed = Clock::now();
        while (! mustEnd (stop))
        {
            if (fault() == Fault::push && Clock::now() - pushed >= 2ms)
            {
                pushed = Clock::now();
                send (client, false);
            }
            if (! client.says (look_ms)) continue;
            hear (client.hear());
            if (fault() == Fault::silent || fault() == Fault::push) continue;
            // A message that comes before the answer has gone out was sent without waiting for it.
            if (client.says (delay_ms)) count ([] (Counts& n) { ++n.together; });
            send (client, std::exchange (is_first, false));
            count ([] (Counts& n) { ++n.answered; });
        }
    }

    std::string id() const { return fault() == Fault::rename ? "1F2E" : "04BA"; }

    void hear (const std::string& text)
    {
        move();
        const std::lock_guard lock (mutex);
        ++tally.heard;
        is_pushed = false;
        const auto read = readJson (text);
        const auto* arms = member (read.root, "inverse3");
        if (arms == nullptr && member (member (read.root, "session"), "force_render_full_state") != nullptr) return;
        if (! read.messages.empty() || arms == nullptr || ! arms->is_array())
        {
            ++tally.refused;
            return;
        }
        for (const auto& arm : *arms)
        {
            const auto* commands = member (arm, "commands");
            if (textAt (arm, "device_id") != id() || commands == nullptr || ! commands->is_object())
            {
                ++tally.refused;
                continue;
            }
            if (commands->contains ("probe_position")) ++tally.probes;
            const auto push = commands->find ("set_cursor_force");
            if (push == commands->end()) continue;
            const auto force = push->is_object() && fault() != Fault::deaf ? vectorIn (*push) : std::nullopt;
            if (! force)
            {
                ++tally.refused;
                continue;
            }
            ++tally.forces;
            tally.pushes += force->isZero (0.0) ? 0 : 1;
            tally.largest = std::max (tally.largest, force->norm());
            is_pushed = true;
            commanded = *force;
            commanded_at = Clock::now();
        }
    }

    /// Moves the hand up to now. Only the first tick after a command has its force.
    void move()
    {
        const std::lock_guard lock (mutex);
        const auto now = Clock::now();
        if (now - moved_to > 100ms) moved_to = now - 100ms;   // there was no message for a while
        while (moved_to + tick <= now)
        {
            moved_to += tick;
            Effort effort;
            if (moved_to - commanded_at <= tick && moved_to >= commanded_at) effort.force = commanded;
            hand->write (effort);
            reading = hand->read();
        }
    }

    void send (WebServer::Client& client, bool is_full)
    {
        if (fault() == Fault::garbage && ! is_full)
        {
            client.say ("{\"inverse3\": [");
            return;
        }
        move();
        const auto isDown = [&] (int bit) { return (reading.buttons >> bit & 1u) != 0; };
        Json state { { "cursor_position", jsonOf (reading.position) },
                     { "cursor_velocity", jsonOf (Vec3 (Vec3::Zero())) },
                     { "current_cursor_force", jsonOf (force()) },
                     { "control_domain", "cartesian" },
                     { "control_mode", is_pushed ? "cursor_force" : "idle" } };
        Json arm { { "device_id", id() }, { "state", std::move (state) } };
        Json grip { { "device_id", "A7C1" },
                    { "state",
                      { { "orientation", orientationOf (reading.rotation) },
                        { "buttons", { { "a", isDown (0) }, { "b", isDown (1) }, { "c", isDown (2) }, { "home", isDown (3) } } },
                        { "hall", 0 },
                        { "battery_level", 0.9 } } } };
        if (is_full)
        {
            arm["config"] = { { "type", "inverse3" }, { "handedness", "right" } };
            arm["status"] = { { "calibrated", true }, { "in_use", false }, { "power_supply", true }, { "ready", true }, { "started", true } };
            grip["status"] = { { "connected", true }, { "awake", true }, { "ready", true }, { "error", false } };
        }
        const Json message { { "session_id", 1 },
                             { "inverse3", Json::array ({ arm }) },
                             { "verse_grip", Json::array() },
                             { "custom_verse_grip", Json::array() },
                             { "wireless_verse_grip", Json::array ({ grip }) } };
        client.say (message.dump());
    }

    const std::unique_ptr<Device> hand;   // moves with `mutex` held
    const int delay_ms;
    Reading reading;
    Vec3 commanded = Vec3::Zero();
    bool is_pushed = false;   // by the last message   [service thread]
    Clock::time_point commanded_at, moved_to = Clock::now();
};
}   // namespace

Result<std::unique_ptr<FakeInverse3>> FakeInverse3::make (int port, std::unique_ptr<Device> hand, int answer_after_ms)
{
    return madeService<FakeInverse3> (port, [&] { return std::make_unique<Service> (port, std::move (hand), answer_after_ms); });
}

}   // namespace tactus::host
