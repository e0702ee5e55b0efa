// SPDX-License-Identifier: MIT
// Devices whose readings are wrong but look good. Each is detected within the time that docs/hazards.md states.
#include <tactus/run/device/guard_limits.hpp>
#include <tactus/run/device/sim.hpp>
#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

using namespace tactus;

namespace
{
constexpr double dt = 1e-3;

Guard guardWith (const GuardLimits& limits)
{
    Guard guard;
    guard.prepare (limits, dt);
    return guard;
}

/// A hand that holds still: 20 um at 10 Hz, in quanta of 1 um.
Reading trembling (int k) { return { .position = { 1e-6 * std::round (20.0 * std::sin (2.0 * std::numbers::pi * 10.0 * k * dt)), 0.0, 0.0 } }; }

const Effort push { .force = { 0.0, 0.0, 2.0 } };
const GuardLimits still { .max_still = 0.5, .still_force = 0.5 };

/// The number of ticks until the force is 0.
template <typename Tick>
int ticksToZero (int most, Tick tick)
{
    for (int k = 1; k <= most; ++k)
        if (tick() == 0.0) return k;
    return most + 1;
}
}   // namespace

TEST_CASE ("when a sensor freezes while the hand is pushed, the force is removed after max_still, until the sensor moves again", "[framework][guard][safety]")
{
    auto guard = guardWith (still);
    for (int k = 0; k < 3000; ++k)
        CHECK (guard (push, trembling (k)).force == push.force);

    const auto frozen = trembling (3000);
    CHECK (ticksToZero (1000, [&] { return guard (push, frozen).force.norm(); }) <= 500 + 5 + 2);
    CHECK (guard.stop() == Guard::Stop::stale);
    CHECK (guard.latest().fault == ReadingFault::frozen);
    const auto words = describe (guard.latest());
    CHECK (words.starts_with ("the position has not changed for 0.5"));
    CHECK (words.ends_with (" s while a force of 2 N pushes the hand"));

    for (int k = 0; k < 3000; ++k)   // without a force nothing pushes the hand, but the stop stays
        CHECK (guard (push, frozen).force.isZero (0.0));
    CHECK (guard.events() == 1);
    CHECK (guard (push, trembling (3001)).force == push.force);
    CHECK (guard.stop() == Guard::Stop::none);
}

TEST_CASE ("one coordinate that freezes while the others move takes the force along it away, until it moves again", "[framework][guard][safety]")
{
    auto guard = guardWith (still);
    const auto at = [] (int k) {   // the hand strokes along x while it holds against z
        auto reading = trembling (k);
        reading.position.z() = reading.position.x();
        reading.position.x() = 1e-5 * k;
        return reading;
    };
    for (int k = 0; k < 3000; ++k)
        CHECK (guard (push, at (k)).force == push.force);

    int k = 3000;
    const auto frozen = [&] {
        auto reading = at (k++);
        reading.position.z() = at (3000).position.z();
        return reading;
    };
    CHECK (ticksToZero (1000, [&] { return guard (push, frozen()).force.norm(); }) <= 500 + 5 + 2);
    CHECK (guard.stop() == Guard::Stop::stale);
    CHECK (guard.latest().fault == ReadingFault::frozen);
    const auto words = describe (guard.latest());
    CHECK (words.starts_with ("the position along z has not changed for 0.5"));
    CHECK (words.ends_with (" s while a force of 2 N pushes the hand"));

    for (int i = 0; i < 1000; ++i)
        CHECK (guard (push, frozen()).force.isZero (0.0));
    CHECK (guard.events() == 1);
    CHECK (guard (push, at (3001)).force == push.force);
    CHECK (guard.stop() == Guard::Stop::none);
}

TEST_CASE ("a coordinate that nothing pushes may stay the same, and so may one that the device does not measure", "[framework][guard][safety]")
{
    auto straight = guardWith (still), plane = guardWith (still);
    for (int k = 0; k < 5000; ++k)
    {
        auto reading = trembling (k);
        if (k > 10) reading.position.y() = 1e-3;   // has changed once, and is not pushed
        straight ({ .force = { 2.0, 0.4, 0.0 } }, reading);
        plane ({ .force = { 1.0, 0.0, 2.0 } }, trembling (k));   // z is always 0
        REQUIRE (straight.stop() == Guard::Stop::none);
        REQUIRE (plane.stop() == Guard::Stop::none);
    }
}

TEST_CASE ("a rotation that freezes while the hand is turned takes everything away after max_still, until it turns again", "[framework][guard][safety]")
{
    const Effort twist { .force = { 0.0, 0.0, 0.3 }, .torque = { 0.0, 0.04, 0.0 } };
    auto limits = still;
    limits.still_torque = 0.02;
    auto guard = guardWith (limits), without = guardWith (still);
    const auto turning = [] (int k) {
        auto reading = trembling (k);
        reading.rotation.y() = 1e2 * trembling (k).position.x();
        return reading;
    };
    for (int k = 0; k < 3000; ++k)
        CHECK (guard (twist, turning (k)).torque == twist.torque);

    int k = 3000;
    const auto frozen = [&] {
        auto reading = turning (k++);
        reading.rotation = turning (3000).rotation;
        return reading;
    };
    CHECK (ticksToZero (1000, [&] { return guard (twist, frozen()).torque.norm(); }) <= 500 + 5 + 2);
    CHECK (guard (twist, frozen()).force.isZero (0.0));
    CHECK (guard.stop() == Guard::Stop::stale);
    const auto words = describe (guard.latest());
    CHECK (words.starts_with ("the rotation has not changed for 0.5"));
    CHECK (words.ends_with (" s while a torque of 0.04 N*m turns the hand"));

    CHECK (guard (twist, turning (3001)).torque == twist.torque);
    for (int i = 0; i < 1000; ++i)
        REQUIRE (without (twist, frozen()).torque == twist.torque);
}

TEST_CASE ("a tool that rests is not frozen: without a force, with a small one, between two reports, and without the limit", "[framework][guard][safety]")
{
    const Reading resting {};
    auto none = guardWith (still), small = guardWith (still), slow = guardWith (still), unlimited = guardWith ({});
    for (int k = 0; k < 5000; ++k)
    {
        none ({}, resting);
        small ({ .force = { 0.4, 0.0, 0.0 } }, resting);
        slow (push, trembling (k - k % 30));
        unlimited (push, resting);
        for (const auto* guard : { &none, &small, &slow, &unlimited })
            REQUIRE (guard->stop() == Guard::Stop::none);
    }
}

TEST_CASE ("max_still requires the force or torque from which it counts, and the stricter of two values holds", "[framework][guard][safety]")
{
    Messages messages;
    readGuardLimits (Json::parse (R"({"max_still": "0.5 s"})"), "/guard", messages);
    REQUIRE (messages.size() == 1);
    CHECK (messages.front().id == "device/missing");
    messages.clear();
    const auto read = readGuardLimits (Json::parse (R"({"max_still": "0.5 s", "still_force": "0.5 N"})"), "/guard", messages);
    CHECK (messages.empty());
    CHECK (read == still);
    CHECK (tightest (read, {}) == read);
    CHECK (tightest (read, { .max_still = 1.0, .still_force = 0.2 }) == GuardLimits { .max_still = 0.5, .still_force = 0.2 });
    const auto turns = readGuardLimits (Json::parse (R"({"max_still": "0.5 s", "still_force": "0.5 N", "still_torque": "20 mN*m"})"), "/guard", messages);
    CHECK (messages.empty());
    CHECK (turns.still_torque == 0.02);
    CHECK (tightest (read, turns).still_torque == 0.02);
    const auto wheel = readGuardLimits (Json::parse (R"({"max_still": "0.5 s", "still_torque": "20 mN*m"})"), "/guard", messages);
    CHECK (messages.empty());
    CHECK (wheel == GuardLimits { .max_still = 0.5, .still_torque = 0.02 });
}

TEST_CASE ("a position that jumps stops the guard on the same tick, so the force that the jump causes is never applied", "[framework][guard][safety]")
{
    auto guard = guardWith ({ .max_speed = 1.0 });
    const auto wall = [&] (const Reading& reading) {   // 1000 N/m above z = -1 mm
        return guard ({ .force = { 0.0, 0.0, -1000.0 * (reading.position.z() + 1e-3) } }, reading).force.norm();
    };
    for (int k = 0; k < 100; ++k)
        CHECK (wall (trembling (k)) == Approx (1.0));
    auto jumped = trembling (100);
    jumped.position.z() += 0.01;   // 10 mm: 11 N
    CHECK (wall (jumped) < 1.0);
    CHECK (guard.stop() == Guard::Stop::speed);
    CHECK (describe (guard.latest()).starts_with ("the tool moves at 1.66"));
    CHECK (ticksToZero (10, [&] { return wall (jumped); }) <= 5);
}

TEST_CASE ("a sensor whose sign flips pushes the tool away, until it is too fast", "[framework][guard][safety]")
{
    const auto flippedAt = [] (double position, int& stopped_at, double& most) {
        SimulatedDevice tool ({ .mass = 0.1, .damping = 2.0, .position = { position, 0.0, 0.0 } });
        tool.prepare (dt);
        auto guard = guardWith ({ .max_force = 3.3, .max_speed = 0.5 });
        Effort applied;
        for (int k = 0; k < 400; ++k)
        {
            auto reading = tool.read();
            if (k >= 50) reading.position = -reading.position;
            applied = guard ({ .force = { -1000.0 * std::max (0.0, reading.position.x()), 0.0, 0.0 } }, reading);   // a wall at 0
            tool.write (applied);
            most = std::max (most, applied.force.norm());
            if (stopped_at < 0 && guard.stop() != Guard::Stop::none) stopped_at = k - 50;
        }
        CHECK (guard.stop() == Guard::Stop::speed);
        CHECK (applied.force.isZero (0.0));
    };

    int stopped_at = -1;
    double most = 0.0;
    flippedAt (-5e-3, stopped_at, most);   // far from the wall the flip is a jump of 10 mm
    CHECK (stopped_at == 0);
    CHECK (most == 0.0);

    stopped_at = -1;
    flippedAt (-1e-4, stopped_at, most);   // near the wall the tool runs away with up to max_force
    CHECK (stopped_at > 0);
    CHECK (stopped_at < 200);
    CHECK (most <= 3.3);
}

TEST_CASE ("the reason that a driver gives for a bad reading reaches the words of the stop", "[framework][guard][safety]")
{
    const auto wordsOf = [] (const Reading& reading) {
        auto guard = guardWith ({ .watchdog = 0.02 });
        guard (push, {});
        guard (push, reading);
        CHECK (guard.stop() == Guard::Stop::stale);
        CHECK (guard.latest().fault == reading.fault);
        return describe (guard.latest());
    };
    CHECK (wordsOf ({ .valid = false }) == "the device has no valid reading");
    CHECK (wordsOf ({ .fault = ReadingFault::too_hot, .valid = false }) == "the device reports that a motor is too hot");
    CHECK (wordsOf ({ .fault = ReadingFault::repeated, .age = 0.021 })
           == "the device repeats the same report: the last reading is 21 ms old; the watchdog allows 20 ms");
    CHECK (wordsOf ({ .fault = ReadingFault::frozen, .valid = false }) == "one of the encoders that measure the position does not change while the tool moves");
    CHECK (wordsOf ({ .age = 0.021 }) == "the last reading is 21 ms old; the watchdog allows 20 ms");
    CHECK (wordsOf ({ .fault = static_cast<ReadingFault> (1000), .valid = false }) == "the device has no valid reading");
}

TEST_CASE ("while a reading stays bad, the stop names the reason that holds now, and remains one stop", "[framework][guard][safety]")
{
    auto guard = guardWith ({});
    guard (push, { .fault = ReadingFault::no_report, .valid = false });
    CHECK (describe (guard.latest()) == "the device has sent no report yet");
    guard (push, { .fault = ReadingFault::too_hot, .valid = false });
    CHECK (describe (guard.latest()) == "the device reports that a motor is too hot");
    guard (push, { .valid = false });   // no reason is known, so the last one stays
    CHECK (describe (guard.latest()) == "the device reports that a motor is too hot");
    CHECK (guard.events() == 1);
    guard (push, {});
    CHECK (guard.stop() == Guard::Stop::none);
    CHECK (guard.latest().fault == ReadingFault::too_hot);
}

TEST_CASE ("every fault of a reading has its own id and words", "[framework][guard][safety]")
{
    std::set<std::string_view> ids, words;
    for (const auto& fault : reading_faults)
    {
        ids.insert (fault.id);
        words.insert (fault.words);
    }
    CHECK (ids.size() == reading_faults.size());
    CHECK (words.size() == reading_faults.size());
    CHECK (reading_faults[static_cast<std::size_t> (ReadingFault::lost)].id == "lost");
    CHECK (reading_faults[static_cast<std::size_t> (ReadingFault::impossible_pose)].id == "impossible_pose");
}
