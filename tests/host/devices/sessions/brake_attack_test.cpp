// SPDX-License-Identifier: MIT
// Attempts to get more damping than the limits allow, a damping below 0, one that is not a number, or a step of the damping to a device: by the
// graph and its knobs, by files, by sessions and by the C API.

#include "framework/capi/c_handles.hpp"
#include "host/devices/hid_link/fake_board.hpp"
#include "support/sketch.hpp"

#include <expert/hands.hpp>
#include <host/devices/sessions/binding.hpp>
#include <support/property.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/device/guard_limits.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/run.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::test;

namespace
{
constexpr double dt = 1e-3;

/// Two brakes of one role, with knobs that reach everything.
std::string braking (const std::string& devices = "")
{
    return R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000, )" + devices + R"( "nodes": {
        "a": { "type": "signal.constant", "params": { "value": 1 } }, "b": { "type": "signal.gain", "params": { "gain": 1 } },
        "k": { "type": "signal.constant", "params": { "value": 1 } },
        "one": { "type": "device.brake", "role": "tip" }, "two": { "type": "device.brake", "role": "tip" } },
        "wires": [ "a.out -> b.in", "b.out -> one.damping", "b.out -> two.damping", "k.out -> two.stiffness" ] })";
}

graph::Graph parsed (const std::string& text)
{
    auto read = readGraph (text);
    INFO (test::text (read.messages));
    REQUIRE_FALSE (hasErrors (read.messages));
    return std::move (read.graph);
}

constexpr const char* knobs[] { "a.value", "b.gain", "k.value" };
constexpr double wild[] { 0.0, -0.0, -1.0, -1e308, 1e308, 1.0, 3.0, 1e3, 5e-324 };

/// Records what a guard lets through to a brake of 5 N s/m.
class Leash final : public Device
{
public:
    explicit Leash (std::vector<double>& to) : brakes (to) {}
    void prepare (double) override {}
    Reading read() noexcept override { return {}; }
    void write (const Effort& e) noexcept override { brakes.push_back (e.brake); }
    DeviceLayout layout() const override { return { .brake = 5.0 }; }

private:
    std::vector<double>& brakes;
};

GraphHandle handle (const std::string& text, const MessageList& m)
{
    GraphHandle g { tactus_graph_parse (text.c_str(), text.size(), nullptr, m.get()) };
    INFO (said (m));
    REQUIRE (g);
    return g;
}
}   // namespace

TEST_CASE ("brake attacked by graph and C API: knobs of any value, late ticks and lost readings", "[sessions][c_api][brake][safety]")
{
    property ("the damping stays between 0 and the limit, and changes no faster than its slew limit", [] (unsigned seed) {
        Dice dice { seed };
        const MessageList m { tactus_messages_create() };
        const auto g = handle (braking(), m);
        const RunHandle run { tactus_run_create (g.get(), nullptr, m.get()) };
        RC_ASSERT (static_cast<bool> (run));
        tactus_device_options device = TACTUS_DEVICE_OPTIONS;
        device.brake = 5.0;
        const double limit = dice.uniform (0.0, 1.0) < 0.5 ? 5.0 : 2.0, slew = dice.size (20.0, 2000.0);
        const auto guard = R"({ "max_brake": )" + std::to_string (limit == 5.0 ? 100.0 : limit) + R"(, "max_brake_slew": )" + std::to_string (slew)
                           + R"(, "ramp": "10 ms" })";
        device.guard = guard.c_str();
        const auto made = tactus_run_pushed_device (run.get(), "tip", &device, m.get());
        if (slew < (limit == 5.0 ? 200.0 : 4.0))   // a stop would take more than 0.5 s
        {
            RC_ASSERT (made == TACTUS_FAILED);
            return;
        }
        RC_ASSERT (made == TACTUS_OK);
        RC_ASSERT (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
        double before = 0.0, most = 0.0;
        for (int k = 0; k < 600; ++k)
        {
            tactus_reading reading = TACTUS_READING;
            reading.valid = dice.uniform (0.0, 1.0) < 0.99;
            if (k % 200 < 130) RC_ASSERT (tactus_run_push (run.get(), "tip", &reading) == TACTUS_OK);
            if (k % 7 == 0) (void)tactus_run_set (run.get(), dice.of (knobs), k % 5 == 0 ? 1.0 : dice.of (wild), nullptr);
            if (k % 50 == 0) (void)tactus_run_set (run.get(), "a.value", std::nan (""), nullptr);
            const double passed = k % 11 == 0 ? 5.0 * dt : dt;
            RC_ASSERT (tactus_run_tick_after (run.get(), passed) == TACTUS_OK);
            tactus_effort effort = TACTUS_EFFORT;
            RC_ASSERT (tactus_run_take (run.get(), "tip", &effort) == TACTUS_OK);
            RC_ASSERT (effort.brake >= 0.0);
            RC_ASSERT (effort.brake <= limit);
            RC_ASSERT (std::abs (effort.brake - before) <= slew * passed * (1.0 + 1e-6));
            before = effort.brake;
            most = std::max (most, before);
        }
        RC_ASSERT (most > 0.0);
    });
}

TEST_CASE ("brake attacked by C API: a largest damping below 0, infinite or not a number is refused, and an old caller has no brake", "[c_api][brake]")
{
    const MessageList m { tactus_messages_create() };
    const auto g = handle (braking(), m);
    for (const double wrong : { -1.0, std::nan (""), inf })
    {
        const MessageList why { tactus_messages_create() };
        const RunHandle run { tactus_run_create (g.get(), nullptr, m.get()) };
        tactus_device_options device = TACTUS_DEVICE_OPTIONS;
        device.brake = wrong;
        CHECK (tactus_run_pushed_device (run.get(), "tip", &device, why.get()) == TACTUS_FAILED);
        CHECK (said (why).find ("api/value") != std::string::npos);
    }

    const RunHandle run { tactus_run_create (g.get(), nullptr, m.get()) };
    tactus_device_options device = TACTUS_DEVICE_OPTIONS;
    device.size = offsetof (tactus_device_options, brake);   // that of a program that was compiled before there was a brake
    device.brake = 5.0;
    REQUIRE (tactus_run_pushed_device (run.get(), "tip", &device, m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    tactus_reading reading = TACTUS_READING;
    reading.valid = 1;
    REQUIRE (tactus_run_push (run.get(), "tip", &reading) == TACTUS_OK);
    REQUIRE (tactus_run_tick (run.get()) == TACTUS_OK);
    tactus_effort effort = TACTUS_EFFORT;
    effort.size = offsetof (tactus_effort, brake);
    effort.brake = 7.0;
    REQUIRE (tactus_run_take (run.get(), "tip", &effort) == TACTUS_OK);
    CHECK (effort.brake == 7.0);   // it is beyond the struct that this caller has
    effort.size = sizeof effort;
    REQUIRE (tactus_run_take (run.get(), "tip", &effort) == TACTUS_OK);
    CHECK (effort.brake == 0.0);
}

TEST_CASE ("brake attacked by files: what is no damping is refused, in devices and guards", "[framework][devices][brake][safety]")
{
    const auto value = GENERATE (as<std::string> {}, "-1", "1e999", R"("nan")", R"("5 N")", R"("-2 N*s/m")", "null", "[5]", "true");
    CAPTURE (value);
    for (const std::string key : { "brake", "brake_time" })
    {
        const auto json = Json::tryParse (R"({ "driver": "sim", "brake": 1, ")" + key + "\": " + value + " }");
        if (json) CHECK (hasErrors (makeDevice (*json, {}).messages));
    }
    for (const std::string key : { "max_brake", "max_brake_slew", "brake_at_stop" })
    {
        Messages found;
        const auto json = Json::tryParse ("{ \"" + key + "\": " + value + " }");
        if (json) (void)readGuardLimits (*json, "/guard", found);
        CHECK ((! json || hasErrors (found)));
    }
}

TEST_CASE ("brake attacked by a graph's own guard, and by edits: they only tighten, and nothing steps", "[framework][guard][brake][safety]")
{
    const std::string greedy = R"("devices": { "tip": { "driver": "sim", "guard": { "max_brake": 100, "brake_at_stop": 100 } } },)";
    const std::string modest = R"("devices": { "tip": { "driver": "sim", "guard": { "max_brake": 2 } } },)";
    std::vector<double> brakes;
    Run run { catalogue(), {}, [&] (const std::string&, const auto&...) -> Run::RoleDevice {
                 return { std::make_unique<Leash> (brakes), GuardLimits { .max_brake = 4.0, .max_brake_slew = 100.0 } };
             } };
    const auto greedy_graph = parsed (braking (greedy));
    Messages found = run.load (greedy_graph);
    REQUIRE_FALSE (hasErrors (found));
    run.openDevices (greedy_graph, found);
    INFO (test::text (found));
    REQUIRE_FALSE (hasErrors (found));
    REQUIRE (run.hasEngine());
    const auto play = [&] (int ticks) {
        for (int k = 0; k < ticks; ++k)
            run.tick();
        return brakes.back();
    };
    const auto edit = [&] (std::string text, const std::string& value) {
        text.replace (text.find ("\"value\": 1"), 10, "\"value\": " + value);
        const auto next = parsed (text);
        auto e = run.edit (next);
        if (e.plan() == nullptr) return;
        e.openDevices();
        e.commit();
    };
    CHECK (play (50) == Approx (2.0 + 0.5e-3));   // 1 N s/m from each of two, and 1 N/m T/2
    edit (braking (greedy), "1e300");
    CHECK (play (50) == 4.0);
    edit (braking (modest), "1e300");
    CHECK (play (50) == 2.0);
    edit (braking (greedy), "1e300");
    CHECK (play (50) == 2.0);   // what loosens waits for the next run
    edit (braking (greedy), "-1e300");
    CHECK (play (50) == Approx (0.5e-3));   // of the stiffness
    run.engine().emergencyStop();
    CHECK (play (50) == 0.0);   // not the 100 for which the graph asked
    double before = 0.0;
    for (const double now : brakes)
    {
        CHECK (now >= 0.0);
        CHECK (now <= 4.0);
        CHECK (std::abs (now - before) <= 100.0 * dt * (1.0 + 1e-9));
        before = now;
    }
}

TEST_CASE ("brake attacked by a session: at any workspace and guard, the tool loses no more speed than its own brake can take", "[sessions][brake][safety]")
{
    property ("a simulated tool of 0.1 kg with a brake of 5 N s/m, without a force", [] (unsigned seed) {
        Dice dice { seed };
        Json description { { "driver", "sim" }, { "mass", 0.1 }, { "damping", 0.0 }, { "brake", 5.0 } };
        description["velocity"] = { 0.5, 0.0, 0.0 };
        description["guard"] = { { "max_brake", dice.size (1.0, 1e6) }, { "brake_at_stop", dice.size (1e-3, 1e6) } };
        description["workspace"] = { { "scale", dice.size (1e-3, 1e3) } };
        LoadedSession session { {}, "session.json" };
        session.session.bind ("tip", description);
        FakeBoard board;
        const auto open = [] (const Json& d, const std::filesystem::path& from) { return makeDevice (d, from); };
        auto bound = openBound (session, "tip", *bindingOf (session, "tip"), open, board, {}, Absence::refuses);
        RC_ASSERT (bound.device != nullptr);
        Guard guard;
        guard.prepare (bound.limits, dt, bound.device->layout());
        bound.device->prepare (dt);
        for (int k = 0; k < 200; ++k)
        {
            const double v = bound.driver->read().true_velocity.x();
            const Effort wanted { .brake = dice.of (wild) };
            if (k % 40 == 20) guard.halt();
            if (k % 40 == 30) guard.resume();
            bound.device->write (guard (wanted, bound.device->read()));
            const double now = bound.driver->read().true_velocity.x();
            RC_ASSERT (now <= v);
            RC_ASSERT (now >= v * std::exp (-5.0 * dt / 0.1) * (1.0 - 1e-12));
        }
    });
}
