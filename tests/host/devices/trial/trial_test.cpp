// SPDX-License-Identifier: MIT
// A trial of simulated devices, in virtual time, with a person who follows a script.
#include <host/devices/trial/free_motion.hpp>
#include <host/devices/trial/trial.hpp>

#include "support/waiting.hpp"

#include <tactus/file/text_file.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <string>
#include <thread>

using namespace tactus;
using namespace tactus::host;
using tactus::test::eventually;

namespace
{
/// A clock whose ticks are 1 ms apart and have no deadlines, and that leaves the processor to the person.
struct FreeClock final : TickClock
{
    void drive (Ticked& ticked) noexcept override
    {
        while (ticked.tick (0.0))
        {
            ++ticks;
            std::this_thread::yield();
        }
    }
    bool isRealTime() const noexcept override { return false; }
    double now() const noexcept override { return 1e-3 * ticks; }

    int ticks = 0;
};

/// A tool that nothing but itself holds: mass, damping, Coulomb friction, and perhaps a spring to where it was let go, in small steps of time.
struct FreeTool
{
    double mass = 0.2, damping = 2.0, friction = 0.05, spring = 0.0, quantum = 1e-5;
    double place = 0.0, speed = 0.0;

    /// Its place after 1 ms with this force.
    double after (double force)
    {
        constexpr double step_s = 1e-5;
        for (int i = 0; i < 100; ++i)
        {
            const double pull = force - damping * speed - spring * place;
            if (speed == 0.0 && std::abs (pull) <= friction) continue;
            const double way = speed != 0.0 ? speed : pull;
            const double faster = speed + step_s * (pull - std::copysign (friction, way)) / mass;
            speed = faster * way < 0.0 ? 0.0 : faster;
            place += step_s * speed;
        }
        return quantum * std::round (place / quantum);
    }
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
        if (is_free) place = { tool.after (force.x()), 0.0, 0.0 };
        reading.position = is_swapped ? Vec3 (place.y(), place.x(), place.z()) : place;
        reading.buttons = buttons;
        reading.valid = is_homed && ! is_away;
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
    FreeTool tool;   // while nothing holds it   [tick thread]
    std::atomic<bool> is_free = false, is_away = false;
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
        if (contains (question, "Can you let go")) return lets_go ? "yes" : "no";
        device.is_free = contains (question, "let go of it") && ! is_sticky;
        if (contains (question, "the cable: the tool")) return pulls ? "yes" : "no";
        if (contains (question, "buzz")) return "no";
        const std::array words { "right", "left", "away", "towards", "up", "down", "none" };
        if (contains (question, "Which way")) return words[device.felt < 0 ? 6u : static_cast<std::size_t> (device.felt)];
        if (contains (question, "It pushes up now") && ! is_powerless) REQUIRE (eventually ([&] { return device.is_pushing.load(); }));
        if (contains (question, "Pull the cable")) device.is_away = true;
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
    bool stops_pushes = false, is_powerless = false, lets_go = false, is_sticky = false, pulls = false;
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
    CHECK (verdict (report, "kill -9, a frozen computer") == "not tried");
    CHECK (verdict (report, "a pulled cable") == "not tried");
    CHECK (verdict (report, "damping") == "not tried");
    if (device.damping == 0.0)
    {
        CHECK (verdict (report, "walls") == "not tried");
        CHECK (device.largest <= trial_push);
        CHECK (report.at ("capture").size() == 6);
    }
    else
    {
        // 2 B / T without a delay, by hand.
        CHECK (verdict (report, "wall of 1000 N/m") == "as expected");
        CHECK (verdict (report, "wall of 4000 N/m") == "as expected");
        CHECK (device.largest > 0.5);
        CHECK (device.largest <= trial_wall);
        CHECK (report.at ("capture").size() == 9);
    }
    const auto replayed = replayTrial (*Json::tryParse (report.dump()));
    REQUIRE (replayed);
    CHECK (*replayed == 0.0);
}

namespace
{
/// Four pushes of a tool by 0.3 N, as a trial does them, without a run: the force rises in 0.2 s, and is gone 1 cm later.
std::vector<FreePush> pushesOf (FreeTool tool, int late_ticks = 0)
{
    std::vector<FreePush> all;
    for (int i = 0; i < free_pushes; ++i)
    {
        FreePush push;
        push.direction = Vec3 (i % 2 == 0 ? 1.0 : -1.0, 0.0, 0.0);
        std::vector<double> forces (static_cast<std::size_t> (late_ticks), 0.0);
        double first = 0.0;
        bool has_ended = false;
        for (int k = 0; k < 1500; ++k)
        {
            TrialRow row;
            row.position = { tool.after (k == 0 ? 0.0 : forces[static_cast<std::size_t> (k - 1)]), 0.0, 0.0 };
            row.tick_s = 5.0 + 1e-3 * k;
            row.is_valid = true;
            if (k == 0) first = row.position.x();
            has_ended = has_ended || std::abs (row.position.x() - first) > 0.01;
            const double force = has_ended ? 0.0 : push.direction.x() * trial_push * std::min (1.0, k / 200.0);
            row.acting = { force, 0.0, 0.0 };
            forces.push_back (force);
            push.rows.push_back (row);
        }
        all.push_back (push);
    }
    return all;
}
}   // namespace

TEST_CASE ("the mechanics of a tool that is pushed are within their intervals, which are narrow", "[trial]")
{
    const auto tool = GENERATE (FreeTool { 0.2, 2.0, 0.05 }, FreeTool { 0.1, 0.5, 0.0 }, FreeTool { 0.4, 1.0, 0.1 }, FreeTool { 0.05, 3.0, 0.02 },
                                FreeTool { 1.0, 0.3, 0.02 }, FreeTool { 0.2, 0.0, 0.04 });
    auto rounded = tool;
    rounded.quantum = GENERATE (1e-6, 1e-5, 4e-5);
    const int late = GENERATE (0, 1, 3);
    std::string why;
    const auto found = mechanicsOf (pushesOf (rounded, late), 1e-3 * std::max (1, late), why);
    CAPTURE (tool.mass, tool.damping, tool.friction, rounded.quantum, late, why);
    if (! found && rounded.quantum > 2e-5)   // steps of 40 um may look like a spring to a tool that is light: then it says nothing
    {
        CHECK (why == "something like a spring pulls it");
        return;
    }
    REQUIRE (found);
    CAPTURE (found->mass.least, found->mass.most, found->damping.least, found->damping.most, found->friction.least, found->friction.most);
    const auto holds = [] (const Between& range, double truth) { return range.least <= truth && truth <= range.most; };
    CHECK (holds (found->damping, tool.damping));
    CHECK (holds (found->mass, tool.mass));
    CHECK (holds (found->friction, tool.friction));
    CHECK (found->damping.most - found->damping.least < (0.2 + 0.1 * tool.damping) * std::max (1, late));   // what a late force leaves open
}

TEST_CASE ("the smallest damping of a tool is not above the real one if its readings are newer than they say", "[trial]")
{
    const FreeTool tool { 0.2, 2.0, GENERATE (0.0, 0.02, 0.05) };
    auto pushes = pushesOf (tool);
    for (auto& push : pushes)
        for (auto& row : push.rows)
            row.age = 2e-3;
    std::string why;
    const auto found = mechanicsOf (pushes, 1e-3, why);
    CAPTURE (tool.friction, why);
    REQUIRE (found);
    CHECK (found->damping.least <= tool.damping);
}

TEST_CASE ("the mechanics of a tool are not told if something else moves it, or nothing does", "[trial]")
{
    std::string why;
    FreeTool tool;
    SECTION ("a spring pulls it back")
    {
        tool.spring = GENERATE (4.0, 15.0);
        CHECK_FALSE (mechanicsOf (pushesOf (tool), 1e-3, why));
        CHECK (why == "something like a spring pulls it");
    }
    SECTION ("its friction is too large")
    {
        tool.friction = 0.35;
        CHECK_FALSE (mechanicsOf (pushesOf (tool), 1e-3, why));
        CHECK (why == "it moved by less than 5 mm");
    }
    SECTION ("a reading is missing")
    {
        auto pushes = pushesOf (tool);
        pushes[2].rows[300].is_valid = false;
        CHECK_FALSE (mechanicsOf (pushes, 1e-3, why));
        CHECK (why == "a reading could not be used");
    }
    SECTION ("it meets a stop")
    {
        auto pushes = pushesOf (tool);
        for (auto& row : pushes[0].rows)
            row.position.x() = std::min (row.position.x(), 0.012);
        pushes[0].rows.resize (900);
        for (std::size_t i = 400; i < 900; ++i)   // and slides along it
            pushes[0].rows[i].position.x() += 1e-5 * static_cast<double> (i - 400);
        CHECK_FALSE (mechanicsOf (pushes, 1e-3, why));
    }
    SECTION ("its readings are newer than they can be by their ages")
    {
        tool.friction = 0.0;
        auto pushes = pushesOf (tool);
        for (auto& push : pushes)
            for (std::size_t k = 0; k + 1 < push.rows.size(); ++k)
                push.rows[k].position = push.rows[k + 1].position;
        CHECK_FALSE (mechanicsOf (pushes, 1e-3, why));
        CHECK (why == "its readings came at other times than they say, as on a busy computer");
    }
    SECTION ("a push is missing")
    {
        auto pushes = pushesOf (tool);
        pushes.pop_back();
        CHECK_FALSE (mechanicsOf (pushes, 1e-3, why));
    }
}

TEST_CASE ("a trial measures the damping of a tool that is let go, tries walls with the smallest one, and ends with the cable", "[trial]")
{
    SpringDevice device;
    Script person (device);
    person.lets_go = person.pulls = true;
    SECTION ("it is free")
    {
        const auto report = tryDevice (device, {}, setting(), person);
        INFO (trialText (report));
        REQUIRE (verdict (report, "damping") == "measured");
        const auto numbers = trialNumbers (report, 1000.0);
        REQUIRE (numbers);
        CHECK (numbers->damping->value <= device.tool.damping);
        CHECK (numbers->damping->value > 0.8 * device.tool.damping);
        // By hand: 2 B / T, without a delay.
        const auto& capture = report.at ("capture");
        REQUIRE (capture.size() == 9);
        CHECK (capture[8].at ("graph").at ("nodes").at ("wall").at ("params").at ("stiffness").get<double>() == Approx (2.0 * numbers->damping->value / 1e-3));
        CHECK (contains (trialText (report), "no buzz, at 100 % of the stiffest passive wall"));
        CHECK (verdict (report, "a pulled cable") == "as expected");
        CHECK (*replayTrial (report) == 0.0);
    }
    SECTION ("a hand still holds it")
    {
        person.is_sticky = true;
        const auto report = tryDevice (device, {}, setting(), person);
        INFO (trialText (report));
        CHECK (verdict (report, "damping") == "not tried");
        CHECK (contains (trialText (report), "it moved by less than 5 mm"));
        CHECK (verdict (report, "walls") == "not tried");
        CHECK_FALSE (report.at ("numbers").contains ("damping"));
        CHECK (device.largest <= trial_push);
    }
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

TEST_CASE ("the quantum of a trial is the smallest step in space, where an encoder moves the tool along several axes", "[trial]")
{
    // Two legs, at right angles to each other and almost along x and y, whose encoders count 50 um.
    struct Legs final : Device
    {
        void prepare (double) override {}
        Reading read() noexcept override
        {
            constexpr double count = 50e-6, angle = 1e-3;
            ++reads;
            const double along = count * (reads / 2 % 2), aside = count * (reads / 3 % 3);
            Reading reading;
            reading.position = { along * std::cos (angle) - aside * std::sin (angle), along * std::sin (angle) + aside * std::cos (angle), 0.0 };
            reading.valid = true;
            return reading;
        }
        void write (const Effort&) noexcept override {}
        int reads = 0;
    };
    Legs legs;
    SpringDevice unused;
    Script person (unused);
    person.ends_at = 2;
    const auto report = tryDevice (legs, {}, setting(), person);
    CHECK (report.at ("numbers").at ("quantum").get<double>() == Approx (50e-6));
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
    CHECK (numbers (R"({"mass": 0.2, "damping": 1.9, "coulomb": 0.05})", 1000.0)->damping->value == 1.9);
    CHECK_FALSE (both->damping);
    CHECK (numbers (R"({"delay_s": 0.0007})", 4000.0)->delay->value == 3.0);
    CHECK_FALSE (numbers (R"({"delay_s": 0.0007})", 4000.0)->quantum);
    for (const auto* wrong : { R"({"delay_s": -1})", R"({"delay_s": 2})", R"({"quantum": "1 um"})", R"({"mass": 0})", R"({"damping": -1})", "[]" })
        CHECK (numbers (wrong, 1000.0).error().id == "trial/format");
    CHECK (trialNumbers (Json(), 1000.0).error().id == "trial/format");
}

TEST_CASE ("every report of a trial that somebody has sent us replays, bit for bit", "[trial]")
{
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator (TACTUS_SOURCE_DIR "/tests/host/devices/trial/reports"))
    {
        INFO (entry.path().string());
        const auto text = readTextFile (entry.path());
        REQUIRE (text);
        const auto report = Json::tryParse (*text);
        REQUIRE (report);
        std::size_t rows = 0;
        for (const auto& part : report->at ("capture"))
            rows += part.at ("rows").size();
        CHECK (rows > 0);
        const auto replayed = replayTrial (*report);
        REQUIRE (replayed);
        CHECK (*replayed == 0.0);
        CHECK (trialNumbers (*report, 1000.0));
        ++files;
    }
    CHECK (files > 0);
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
