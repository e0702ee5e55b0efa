// SPDX-License-Identifier: MIT
// The OpenFFBoard: standard force feedback along two axes, and its own channel for torques and the emergency stop.

#include "far_board.hpp"
#include "support/waiting.hpp"
#include "wire_bench.hpp"

#include <host/devices/hid/board_stop.hpp>
#include <host/devices/hid_link/force_feedback.hpp>
#include <host/devices/live/live_session.hpp>
#include <support/property.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>

#include <fuzz/report_target.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::hid;
using namespace tactus::test::ffboard;
using namespace tactus::test::wires;
using namespace std::chrono_literals;

namespace
{
const Json two_motors { { "driver", "hid" },
                        { "profile", "pid" },
                        { "calibration", { { "full_force", "4 N" }, { "full_force_y", "2 N" }, { "travel", { { "x", "12 cm" }, { "y", "6 cm" } } } } } };

/// The board's profile, with a watchdog that a busy machine does not trigger, and open on it.
struct OpenBoard
{
    OpenBoard()
    {
        Messages messages;
        auto made = profileOf (board, board.what, readCalibration (two_motors, messages), messages);
        INFO (test::text (messages));
        REQUIRE (made);
        auto patient = *made;
        patient.limits.guard.watchdog = 10.0;
        profile = std::make_shared<const Profile> (std::move (patient));
        auto opened = HidPort::open (board, board.what, profile, { .look_again = 5ms, .real_time = false });
        INFO ((opened ? std::string() : opened.error().text));
        REQUIRE (opened);
        device = std::make_unique<HidDevice> (std::move (*opened));
        device->heed (guard);
        guard.prepare ({}, tick_s);
        device->prepare (tick_s);
        board.moveTo (0, 0);
        REQUIRE (eventually ([&] {
            tick (Vec3::Zero());
            return reading.valid;
        }));
    }

    static constexpr double tick_s = 1e-5;   // a rearm takes many ticks, so that the threads of the port have time to send it

    void tick (const Vec3& newtons)
    {
        board.ns += 20'000'000;   // within this time, any force can follow any other
        reading = device->read();
        guard ({}, reading);
        device->write ({ .force = newtons });
        test::letPass (200us);   // gives way to the threads of the port
    }

    double axis (const char* name) const { return reading.axes[indexOf (device->layout().axes, name)]; }

    FarBoard board;
    std::shared_ptr<const Profile> profile;
    Guard guard;
    std::unique_ptr<HidDevice> device;
    Reading reading;
};

/// The command that writes the emergency stop.
Bytes stopCommand (std::uint8_t on)
{
    Bytes bytes (25);
    bytes[0] = 0xa1;
    bytes[2] = 1;
    bytes[5] = 0xa;
    bytes[9] = on;
    return bytes;
}
}   // namespace

TEST_CASE ("two motors of an OpenFFBoard get their forces, each that of the offline encoding, bit for bit", "[hid][ffboard]")
{
    OpenBoard run;
    CHECK (run.profile->limits.guard.max_force == 2.0);   // the weaker motor's, so that the direction of a force is kept
    run.board.moveTo (32767, -16384);
    REQUIRE (eventually ([&] {
        run.tick (Vec3::Zero());
        return std::abs (run.reading.position.x() - 0.06) < 1e-12;
    }));
    CHECK (run.reading.position.y() == Approx (0.015).epsilon (1e-3));   // the y of a stick increases towards the person

    // Each push gives one report for each motor, and nothing else. The first one may still follow reports of the ticks before.
    HidModel offline (run.profile);
    offline.decode (run.board.position());   // no force before a position is known
    std::uint32_t seed = 1;
    const auto random = [&] { return static_cast<double> ((seed = seed * 1664525u + 1013904223u) >> 8) / (1u << 24) * 4.0 - 2.0; };
    for (int k = 0; k < 100; ++k)
    {
        const Vec3 push { random(), random(), 0.0 };
        const auto before = run.board.seen().forces.size();
        run.tick (push);
        const auto values = offline.drive ({ push, Vec3::Zero(), offline.restEfforts() }, 0.02);
        std::vector<Bytes> expected;
        for (std::size_t i = 0; i < 2; ++i)
        {
            const auto bytes = offline.encodeValues (i, values);
            expected.emplace_back (bytes.begin(), bytes.end());
            expected.back()[1] = static_cast<std::uint8_t> (7 + i);   // the blocks that the board assigned
        }
        std::vector<Bytes> heard;
        REQUIRE (eventually ([&] {
            heard = run.board.seen().forces;
            heard.erase (heard.begin(), heard.begin() + static_cast<std::ptrdiff_t> (before));
            return heard.size() >= 2 && std::ranges::count (heard, expected[0]) > 0 && std::ranges::count (heard, expected[1]) > 0;
        }));
        if (k > 0) CHECK (heard.size() == 2);
        const auto at = [&] (double newtons, double full) { return static_cast<int> (std::floor (newtons / (full / 32767.0) + 0.5)); };
        CHECK (s16At (expected[0], 2) == at (-push.x(), 4.0));   // a push to the right comes from the right
        CHECK (s16At (expected[1], 2) == at (-push.y(), 2.0));
    }
    CHECK (run.board.seen().unknown == 0);
    REQUIRE (eventually ([&] {   // to the right and away from the person
        run.tick ({ 1.1, 0.9, 0.0 });
        return run.board.torque() == std::array { 9011, -14745 };
    }));
    run.device.reset();
    CHECK (run.board.seen().torque == std::array { 0, 0 });
}

TEST_CASE ("the torques that an OpenFFBoard reports are axes of the device", "[hid][ffboard]")
{
    OpenBoard run;
    run.board.answers_by_ack = GENERATE (false, true);
    const auto torqueIs = [&] (int x, int y) {
        return eventually ([&] {
            run.tick ({ 1.0, -0.9, 0.0 });
            return run.axis ("torque_x") == x * (1.0 / 0x7fff) && run.axis ("torque_y") == y * (1.0 / 0x7fff);
        });
    };
    CHECK (torqueIs (8192, 14745));
    CHECK (run.device->counts().refused == std::array<std::uint64_t, refusals> {});
    run.board.press (true);   // its motors are off, and it says so
    CHECK (torqueIs (0, 0));
    CHECK (eventually ([&] {
        run.tick (Vec3::Zero());
        return run.axis ("board_stopped") == 1.0 && ! run.reading.valid && run.reading.fault == ReadingFault::stopped;
    }));
}

TEST_CASE ("the emergency stop of Tactus is that of an OpenFFBoard, after its force is zero, and a rearm ends it", "[hid][ffboard][safety]")
{
    OpenBoard run;
    const Vec3 push { 0.0, 0.9, 0.0 };
    REQUIRE (eventually ([&] {
        run.tick (push);
        return run.board.torque()[1] == -14745;
    }));
    run.guard.emergencyStop();
    for (int k = 0; k < 50; ++k)
        run.tick (push);   // the fade of the guard has not ended
    CHECK (run.board.seen().commands.empty());
    REQUIRE (eventually ([&] {
        run.tick (Vec3::Zero());
        return run.board.seen().commands.size() > 2;   // again and again, in case that one is lost
    }));
    CHECK (std::ranges::all_of (run.board.seen().commands, [] (const auto& c) { return c == stopCommand (1); }));
    CHECK (run.board.seen().stopped);
    REQUIRE (eventually ([&] {
        run.tick (Vec3::Zero());
        return run.reading.fault == ReadingFault::stopped && ! run.reading.valid;
    }));

    run.guard.rearm();
    REQUIRE (eventually ([&] {
        run.tick (Vec3::Zero());
        return run.reading.valid;
    }));
    CHECK_FALSE (run.board.seen().stopped);
    CHECK (run.board.seen().commands.back() == stopCommand (0));
    CHECK (eventually ([&] {
        run.tick (push);
        return run.board.torque()[1] == -14745;
    }));
}

TEST_CASE ("a rearm does not end an emergency stop that was pressed at the board", "[hid][ffboard][safety]")
{
    OpenBoard run;
    run.board.press (true);
    const auto ticksWhile = [&] (auto so) {
        return eventually ([&] {
            run.tick (Vec3::Zero());
            return so();
        });
    };
    REQUIRE (ticksWhile ([&] { return run.reading.fault == ReadingFault::stopped; }));
    run.guard.emergencyStop();
    for (int k = 0; k < 300; ++k)
        run.tick (Vec3::Zero());
    run.guard.rearm();
    for (int k = 0; k < 300; ++k)
        run.tick (Vec3::Zero());
    CHECK (run.board.seen().commands.empty());
    CHECK (run.board.seen().stopped);
    run.board.press (false);
    CHECK (ticksWhile ([&] { return run.reading.valid; }));
}

TEST_CASE ("a board is stopped only at rest, and rearmed only for a while and after a stop of Tactus", "[hid][ffboard][safety]")
{
    using Says = BoardStop::Says;
    using Cause = BoardStop::Cause;
    constexpr double dt = 0.125;   // s
    BoardStop stop;
    const auto step = [&] (bool emergency, bool rests, bool is_stopped) {
        return stop (emergency ? Cause::emergency : Cause::none, rests, is_stopped, dt);
    };
    CHECK (step (false, true, false) == Says::nothing);
    CHECK (step (true, false, false) == Says::nothing);
    CHECK (step (true, true, false) == Says::stop);
    CHECK (step (true, true, true) == Says::stop);
    CHECK (step (false, true, true) == Says::rearm);
    CHECK (step (true, true, true) == Says::stop);   // again, before the board has said that it is rearmed
    CHECK (step (false, false, true) == Says::rearm);
    CHECK (step (false, false, true) == Says::rearm);   // 0.2 s are two steps
    CHECK (step (false, false, true) == Says::nothing);

    CHECK (step (true, true, true) == Says::nothing);   // the board was stopped by its button
    CHECK (step (false, true, true) == Says::nothing);
    CHECK (step (true, true, true) == Says::nothing);
    CHECK (step (true, true, false) == Says::stop);   // the button is released during the stop
    CHECK (step (true, true, true) == Says::stop);
    CHECK (step (false, true, true) == Says::rearm);

    CHECK (step (false, true, false) == Says::nothing);   // it says that it is rearmed
    CHECK (step (false, true, true) == Says::nothing);    // and then its button is pressed: that is not undone
    CHECK (step (true, true, true) == Says::nothing);
    CHECK (step (false, true, true) == Says::nothing);

    CHECK (step (false, true, false) == Says::nothing);
    CHECK (step (true, true, false) == Says::stop);
    CHECK (step (false, true, false) == Says::rearm);   // it has not said yet that it has stopped
    CHECK (step (false, true, true) == Says::rearm);
}

TEST_CASE ("a limit that is exceeded stops a board only when the board had the time to say that its button is pressed", "[hid][ffboard][safety]")
{
    using Says = BoardStop::Says;
    using Cause = BoardStop::Cause;
    constexpr double dt = 0.03125;   // s; the board has 0.1 s, which are four steps
    const auto after = [] (BoardStop& stop, Cause cause, int steps, bool rests, bool is_stopped) {
        auto last = Says::nothing;
        for (int k = 0; k < steps; ++k)
            last = stop (cause, rests, is_stopped, dt);
        return last;
    };
    {
        BoardStop stop;
        CHECK (after (stop, Cause::limit, 3, true, false) == Says::nothing);
        CHECK (after (stop, Cause::limit, 1, true, false) == Says::stop);
        CHECK (after (stop, Cause::limit, 3, true, true) == Says::stop);
        CHECK (after (stop, Cause::none, 1, true, true) == Says::rearm);
        CHECK (after (stop, Cause::limit, 1, true, true) == Says::stop);   // again, before the board has said that it is rearmed: it is known whose stop it is
    }
    {
        BoardStop stop;   // the button is pressed, the tool is let go and becomes too fast, and only then the board says so
        CHECK (after (stop, Cause::limit, 2, true, false) == Says::nothing);
        CHECK (after (stop, Cause::limit, 40, true, true) == Says::nothing);
        CHECK (after (stop, Cause::none, 20, true, true) == Says::nothing);
        CHECK (after (stop, Cause::none, 20, true, false) == Says::nothing);
    }
    {
        BoardStop stop;   // a force that does not fade
        CHECK (after (stop, Cause::limit, 40, false, false) == Says::nothing);
        CHECK (after (stop, Cause::limit, 1, true, false) == Says::stop);
    }
    {
        BoardStop stop;   // a rearm before the board was told
        CHECK (after (stop, Cause::limit, 2, true, false) == Says::nothing);
        CHECK (after (stop, Cause::none, 20, true, false) == Says::nothing);
    }
    {
        BoardStop stop;   // someone presses the emergency stop meanwhile
        CHECK (after (stop, Cause::limit, 1, true, false) == Says::nothing);
        CHECK (after (stop, Cause::emergency, 1, true, false) == Says::stop);
        CHECK (after (stop, Cause::none, 1, true, false) == Says::rearm);
    }
}

TEST_CASE ("a session records the torque of an OpenFFBoard, STOP reaches the board, and REARM lets it go", "[hid][ffboard][live][safety]")
{
    FarBoard board;
    const LoadedProfiles none;
    StopSwitch stops;
    LiveSession::Options options;
    options.queries = Run::Queries::within_tick;
    options.devices.given = { { "stylus", two_motors, {} } };
    options.compile.records = { "torque.axis" };
    options.stops = &stops;
    LiveSession session { catalogue(), Hardware { board, [&]() -> const LoadedProfiles& { return none; }, nullptr }, std::move (options) };
    const auto read = readGraph (R"({ "format": "tactus-graph", "version": 2, "rate_hz": 20000,
        "nodes": { "one": { "type": "signal.constant", "params": { "value": 1 } }, "motor": { "type": "device.force", "role": "stylus" },
                   "torque": { "type": "device.axis", "role": "stylus", "settings": { "axis": "torque_x" } } },
        "wires": ["one.out -> motor.force.x"] })");
    REQUIRE_FALSE (hasErrors (read.messages));
    REQUIRE_FALSE (hasErrors (session.load (read.graph)));
    REQUIRE_FALSE (hasErrors (session.openDevices()));
    int ticks = 0, torn = 0;
    const auto ticksUntil = [&] (auto so) {
        return eventually ([&] {
            board.moveTo (torn + ++ticks % 2, 0);   // a sensor that trembles is not frozen
            board.ns += 50'000;
            session.run().tick();
            test::letPass (200us);
            return so();
        });
    };
    CHECK (ticksUntil ([&] { return *session.engine().plan().taps().front().value == 8192 * (1.0 / 0x7fff); }));
    stops.emergencyStop (By::person);
    REQUIRE (ticksUntil ([&] { return board.isStopped(); }));
    CHECK (board.seen().commands.back() == stopCommand (1));
    CHECK (session.rearm (test::fromNow (StopSwitch::pause)));
    CHECK (ticksUntil ([&] { return ! board.isStopped(); }));
    CHECK (board.seen().commands.back() == stopCommand (0));
    CHECK (ticksUntil ([&] { return board.torque()[0] == 8192; }));

    // A limit that latches its stop: the tool is torn away. The board hears of it after its force is zero.
    CHECK (ticksUntil ([&] { return session.engine().guardOf ("stylus").stop() == Guard::Stop::none; }));
    const auto commands = board.seen().commands.size();
    torn = 30000;
    REQUIRE (ticksUntil ([&] { return board.isStopped(); }));
    CHECK (session.engine().guardOf ("stylus").isLatched());
    CHECK_FALSE (session.engine().isEmergency());
    CHECK (board.seen().commands[commands] == stopCommand (1));
    CHECK (ticksUntil ([&] { return bool (session.rearm (test::fromNow (StopSwitch::pause))); }));
    CHECK (ticksUntil ([&] { return ! board.isStopped(); }));
    CHECK (board.seen().commands.back() == stopCommand (0));
    CHECK (ticksUntil ([&] { return board.torque()[0] == 8192; }));
}

TEST_CASE ("whatever comes on the channel of an OpenFFBoard, its values are finite, and other answers change none", "[hid][ffboard][property]")
{
    FarBoard board;
    Messages messages;
    const auto profile = profileOf (board, board.what, readCalibration (two_motors, messages), messages);
    REQUIRE (profile);
    test::property ("any bytes", [&] {
        auto bytes = *rc::gen::container<std::string> (rc::gen::arbitrary<char>());
        if (*rc::gen::arbitrary<bool>()) bytes.insert (0, 1, '\xa1');
        fuzz::tryReport (profile, bytes);
    });
    HidModel model (profile);
    auto torque = test::bytes ("a1 01 01 0a 01 0d 00 00 00 ff 7f 00 00 00 00 00 00 00 00 00 00 00 00 00 00");
    const auto now = [&] { return model.sample().axes[static_cast<std::size_t> (indexOf (model.axisNames(), "torque_y"))]; };
    CHECK (model.decode (torque).refusal == Refusal::none);
    CHECK (now() == Approx (1.0));
    // Not found; another class, axis, command.
    for (const auto& [at, value] : { std::pair<std::size_t, std::uint8_t> { 1, 13 }, { 2, 2 }, { 4, 7 }, { 5, 0xe } })
    {
        auto other = torque;
        other[at] = value;
        other[9] = 0;
        CHECK (model.decode (other).refusal == Refusal::none);
        CHECK (now() == Approx (1.0));
    }
}

TEST_CASE ("a second motor is driven only if it is there and calibrated, and a board without its own channel is driven without it", "[hid][ffboard]")
{
    const auto made = [] (FarBoard& board, const Json& calibration) {
        Messages messages;
        const Json description { { "driver", "hid" }, { "profile", "pid" }, { "calibration", calibration } };
        auto profile = profileOf (board, board.what, readCalibration (description, messages), messages);
        return std::pair { profile, messages.empty() ? std::string() : messages.front().id };
    };
    FarBoard board;
    const auto one = made (board, { { "full_force", "4 N" }, { "travel", { { "x", "12 cm" } } } });
    REQUIRE (one.first);
    CHECK (one.first->force == std::array<std::string, 3> { "force", "", "" });
    CHECK (one.first->init.size() == 7);
    CHECK (made (board, { { "full_force", "4 N" }, { "full_force_y", "4 N" }, { "travel", { { "x", "12 cm" } } } }).second == "pid/no_travel");
    CHECK (made (board, { { "full_force", "4 N*m" }, { "full_force_y", "4 N" } }).second == "device/kind");
    CHECK (made (board, { { "full_force", "4 N" }, { "full_force_y", -1 } }).second == "device/out_of_range");

    FarBoard plain;
    plain.descriptor = boardDescriptor (false);
    const auto without = made (plain, { { "full_force", "4 N" }, { "travel", { { "x", "12 cm" } } } });
    REQUIRE (without.first);
    CHECK (without.first->alarms.empty());
    CHECK (without.first->inputs.size() == 1);

    FarBoard wheel;   // one axis
    const auto two = test::bytes ("09 30 09 31 15 00 25 01 75 01 95 02"), single = test::bytes ("09 30 09 00 15 00 25 01 75 01 95 02");
    const auto at = std::search (wheel.descriptor.begin(), wheel.descriptor.end(), two.begin(), two.end());
    REQUIRE (at != wheel.descriptor.end());
    std::ranges::copy (single, at);
    CHECK (made (wheel, { { "full_force", "4 N" }, { "full_force_y", "4 N" }, { "travel", { { "x", "12 cm" }, { "y", "12 cm" } } } }).second == "pid/no_axis");
    const auto x_only = made (wheel, { { "full_force", "4 N" }, { "travel", { { "x", "12 cm" } } } });
    REQUIRE (x_only.first);
    CHECK (std::ranges::none_of (x_only.first->outputs, [] (const auto& o) { return o.name == "ask_torque_y"; }));
}
