// SPDX-License-Identifier: MIT
// A trial of simulated devices, in virtual time, with a person who follows a script.
#include <host/devices/trial/trial.hpp>

#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <string>
#include <thread>

using namespace tactus;
using namespace tactus::host;
using tactus::test::eventually;

namespace
{
/// A clock whose ticks have no deadlines, and that leaves the processor to the person.
struct FreeClock final : TickClock
{
    void drive (Ticked& ticked) noexcept override
    {
        while (ticked.tick (0.0))
            std::this_thread::yield();
    }
    bool isRealTime() const noexcept override { return false; }
};

/// A tool on the spring of a hand.
struct SpringDevice final : Device
{
    void prepare (double) override {}

    Reading read() noexcept override
    {
        ++reads;
        Reading reading;
        Vec3 place;
        for (int i = 0; i < 3; ++i)
            place[i] = target[static_cast<std::size_t> (i)] + force[i] / 500.0;
        reading.position = is_swapped ? Vec3 (place.y(), place.x(), place.z()) : place;
        reading.buttons = buttons;
        reading.valid = is_homed;
        reading.fault = is_homed ? ReadingFault::none : ReadingFault::not_homed;
        return reading;
    }

    void write (const Effort& effort) noexcept override
    {
        force = effort.force;
        if (force.norm() > largest) largest = force.norm();
        if (! force.isZero (0.0)) pushed_at = reads.load();
        is_pushing = ! force.isZero (0.0);
        while (holds && is_pushing)   // until the person has noticed the push
            std::this_thread::yield();
        for (int i = 0; i < 3; ++i)
            if (std::abs (force[i]) > 0.1) felt = 2 * i + (force[i] > 0.0 ? 0 : 1);
    }

    DeviceLayout layout() const override { return { .buttons = { "front", "back" }, .mechanics = { .mass = 0.1, .damping = damping } }; }

    std::array<std::atomic<double>, 3> target {};
    std::atomic<std::uint32_t> buttons = 0;
    std::atomic<bool> is_homed = true, is_pushing = false, holds = false;
    std::atomic<std::uint64_t> reads = 0, pushed_at = 0;
    std::atomic<int> felt = -1;   // 0: right, 1: left, 2: away, …
    std::atomic<double> largest = 0.0;
    bool is_swapped = false;
    double damping = 0.0;
    Vec3 force = Vec3::Zero();   // [tick thread]
};

bool contains (const std::string& text, const char* part) { return text.find (part) != std::string::npos; }

/// A person who does what the trial asks.
struct Script : TrialPerson
{
    explicit Script (SpringDevice& d) : device (d) {}

    void tell (const std::string&) override {}

    std::optional<std::string> ask (const std::string& question) override
    {
        ++questions;
        if (questions == ends_at) return std::nullopt;
        if (contains (question, "does not know its position")) device.is_homed = homes.load();
        if (contains (question, "near the middle")) move ({ 0.0, 0.0, 0.0 });
        if (contains (question, "5 cm to the right")) move ({ 0.05, 0.001, 0.0 });
        if (contains (question, "5 cm away")) move ({ 0.0, 0.05, 0.001 });
        if (contains (question, "5 cm up")) move ({ 0.001, 0.0, 0.05 });
        if (contains (question, "Press each button"))
        {
            device.buttons = 1;
            pass();
            device.buttons = 0;
        }
        if (contains (question, "middle of its space, and"))
        {
            move (Vec3::Zero());
            presses = true;
        }
        if (contains (question, "buzz")) return "no";
        const std::array words { "right", "left", "away", "towards", "up", "down", "none" };
        if (contains (question, "Which way")) return words[device.felt < 0 ? 6u : static_cast<std::size_t> (device.felt)];
        if (contains (question, "It pushes up now") && ! is_powerless) REQUIRE (eventually ([&] { return device.is_pushing.load(); }));
        if (contains (question, "Has the push ended")) return device.is_pushing ? "no" : "yes";
        if (contains (question, "before it came back")) return "yes";
        return "";
    }

    bool wantsStop() override
    {
        if (presses.exchange (false)) device.target[2] = -0.006;
        if (! stops_pushes || ! device.is_pushing) return false;
        device.holds = false;
        return true;
    }

    void move (const Vec3& to)
    {
        for (int i = 0; i < 3; ++i)
            device.target[static_cast<std::size_t> (i)] = to[i];
        pass();
    }

    /// Some ticks read the device.
    void pass()
    {
        const auto before = device.reads.load();
        REQUIRE (eventually ([&] { return device.reads > before + 5; }));
    }

    SpringDevice& device;
    int questions = 0, ends_at = 0;
    bool stops_pushes = false, is_powerless = false;
    std::atomic<bool> presses = false, homes = true;
};

TrialSetting setting()
{
    TrialSetting s;
    s.run.clock = [] { return std::make_unique<FreeClock>(); };
    return s;
}

std::string verdict (const Json& report, const std::string& step)
{
    for (const auto& each : report.at ("steps"))
        if (each.value ("step", std::string()) == step) return each.value ("verdict", std::string());
    return "no such step";
}
}   // namespace

TEST_CASE ("a trial of an honest device finds everything as expected, and its capture replays", "[trial]")
{
    SpringDevice device;
    device.damping = GENERATE (0.0, 2.0);
    Script person (device);
    auto asked = setting();
    bool was_signalled = false;
    asked.ways.push_back ({ "a signal", [&] (TrialRun& run) {
                               was_signalled = true;
                               run.emergencyStop();
                           } });
    const auto report = tryDevice (device, { .max_force = 3.0 }, asked, person);
    INFO (trialText (report));
    CHECK (contains (trialText (report), "the reading moved by +0.60, +0.00, +0.00 mm"));   // 0.3 N at a hand of 500 N/m
    for (const auto* step : { "homing", "direction right", "direction away", "direction up", "push right", "push left", "push away", "push towards", "push up",
                              "push down", "stop by Enter", "stop by a signal", "stop by the end of the run" })
    {
        CAPTURE (step);
        CHECK (verdict (report, step) == "as expected");
    }
    CHECK (was_signalled);
    CHECK (contains (trialText (report), "pressed: front; not seen: back"));
    CHECK (verdict (report, "stop by silence") == "not tried");   // this device has no driver that would tell
    CHECK (verdict (report, "kill -9, a frozen computer, a pulled cable") == "not tried");
    if (device.damping == 0.0)
    {
        CHECK (verdict (report, "walls") == "not tried");
        CHECK (device.largest <= trial_push);
        CHECK (report.at ("capture").size() == 6);
    }
    else
    {
        // 2 B / T without a delay, by hand.
        CHECK (verdict (report, "wall of 1e+03 N/m") == "as expected");
        CHECK (verdict (report, "wall of 4e+03 N/m") == "as expected");
        CHECK (device.largest > 0.5);
        CHECK (device.largest <= trial_wall);
        CHECK (report.at ("capture").size() == 9);
    }
    const auto replayed = replayTrial (*Json::tryParse (report.dump()));
    REQUIRE (replayed);
    CHECK (*replayed == 0.0);
}

TEST_CASE ("a trial names what differs: swapped axes, a push that is not felt, a force that the guard withholds", "[trial]")
{
    SpringDevice device;
    Script person (device);
    SECTION ("swapped axes")
    {
        device.is_swapped = true;
        const auto report = tryDevice (device, {}, setting(), person);
        CHECK (verdict (report, "direction right") == "differs");
        CHECK (verdict (report, "direction away") == "differs");
        CHECK (verdict (report, "direction up") == "as expected");
    }
    SECTION ("no force reaches the device")
    {
        person.is_powerless = true;
        const auto report = tryDevice (device, { .max_force = 0.0 }, setting(), person);
        CHECK (verdict (report, "push up") == "differs");
        CHECK (verdict (report, "stop by the end of the run") == "differs");   // nothing was pushed, so nothing was stopped
        CHECK (device.largest == 0.0);
    }
}

TEST_CASE ("a trial stops what pushes when the person wants it, and ends when the person does", "[trial][safety]")
{
    SpringDevice device;
    Script person (device);
    SECTION ("a stop")
    {
        person.stops_pushes = device.holds = true;
        const auto report = tryDevice (device, {}, setting(), person);
        CHECK (verdict (report, "push right") == "not tried");
        CHECK_FALSE (device.is_pushing);
        CHECK (device.largest <= trial_push);
    }
    SECTION ("the end, at any question")
    {
        person.ends_at = GENERATE (1, 2, 5, 8, 9, 12, 20, 22);
        const auto report = tryDevice (device, {}, setting(), person);
        CHECK (verdict (report, "end") == "not tried");
        CHECK_FALSE (device.is_pushing);
        REQUIRE (replayTrial (report));
    }
}

TEST_CASE ("a trial of a device that does not know its position asks for homing, and pushes nothing before", "[trial][safety]")
{
    SpringDevice device;
    device.is_homed = false;
    Script person (device);
    SECTION ("the person homes it")
    {
        const auto report = tryDevice (device, {}, setting(), person);
        CHECK (verdict (report, "homing") == "as expected");
        CHECK (contains (trialText (report), "after a person had homed it"));
    }
    SECTION ("the person does not home it")
    {
        person.homes = false;
        const auto report = tryDevice (device, {}, setting(), person);
        CHECK (verdict (report, "homing") == "differs");
        CHECK (verdict (report, "end") == "not tried");
        CHECK (device.largest == 0.0);
    }
}

TEST_CASE ("check gets the quantum and the delay that a trial has measured, rounded up to ticks", "[trial]")
{
    const auto numbers = [] (const char* text, double rate_hz) {
        return trialNumbers (Json { { "format", "tactus-trial" }, { "numbers", *Json::tryParse (text) } }, rate_hz);
    };
    const auto both = numbers (R"({"quantum": 1e-5, "delay_s": 0.0007})", 1000.0);
    REQUIRE (both);
    CHECK (both->quantum->value == 1e-5);
    CHECK (both->delay->value == 1.0);
    CHECK_FALSE (both->quantum->guess);
    CHECK_FALSE (both->damping);
    CHECK (numbers (R"({"delay_s": 0.0007})", 4000.0)->delay->value == 3.0);
    CHECK_FALSE (numbers (R"({"delay_s": 0.0007})", 4000.0)->quantum);
    for (const auto* wrong : { R"({"delay_s": -1})", R"({"delay_s": 2})", R"({"quantum": "1 um"})", "[]" })
        CHECK (numbers (wrong, 1000.0).error().id == "trial/format");
    CHECK (trialNumbers (Json(), 1000.0).error().id == "trial/format");
}

TEST_CASE ("the report of a trial that was changed does not replay, and what is no report is refused", "[trial]")
{
    SpringDevice device;
    device.damping = 2.0;
    Script person (device);
    auto report = tryDevice (device, {}, setting(), person);
    auto& rows = report["capture"][8]["rows"];
    std::size_t pressed = 0;
    while (pressed < rows.size() && rows[pressed][6] == Json (0.0))
        ++pressed;
    REQUIRE (pressed < rows.size());
    rows[pressed][2] = rows[pressed][2].get<double>() - 1e-3;
    CHECK (*replayTrial (report) == Approx (4.0).epsilon (0.01));   // N: 4000 N/m, 1 mm
    rows[pressed] = Json::array();
    CHECK (replayTrial (report).error().id == "trial/format");
    CHECK (replayTrial (Json()).error().id == "trial/format");
    CHECK (replayTrial ({ { "format", "tactus-trial" } }).error().id == "trial/format");
    CHECK (replayTrial ({ { "format", "tactus-trial" }, { "capture", { 1, 2 } } }).error().id == "trial/format");
    CHECK (replayTrial ({ { "format", "tactus-trial" }, { "capture", Json::array ({ { { "graph", "x" }, { "rows", 1 } } }) } }).error().id == "trial/format");
}
