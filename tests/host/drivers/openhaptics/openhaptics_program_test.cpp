// SPDX-License-Identifier: MIT
// Programs that play on a fake Touch, and what the arm feels when they end, freeze or are killed.

#include "../outlived.hpp"
#include "support/sketch.hpp"
#include "touch_lab.hpp"

#include "support/temporary_folder.hpp"

#include <host/cli/program.hpp>
#include <host/cli/running.hpp>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

using namespace tactus;
using namespace std::chrono_literals;
using test::eventually;
using test::Running;
using test::runTactus;
using test::TouchLab;

namespace
{
constexpr auto wall = R"({ "format": "tactus-graph", "version": 2, "name": "wall", "rate_hz": 1000,
  "nodes": { "hand": { "type": "device.position", "role": "stylus" },
             "wall": { "type": "deform.plane", "params": { "stiffness": 300 } },
             "motor": { "type": "device.force", "role": "stylus" } },
  "wires": ["hand.position -> wall.position", "wall.force -> motor.force"] })";
}   // namespace

TEST_CASE ("a program that is killed, frozen or ended leaves a Touch without a force", "[openhaptics][safety]")
{
    TouchLab lab;
    auto& arm = lab.arm();
    arm.target[1] = -6.0;
    lab.folder.write ("wall.json", wall);
    Running program ({ "play", (lab.folder / "wall.json").string(), "--device", "stylus=openhaptics" });
    const bool pushes = test::soon ([&] { return arm.force[1] > 0.5; });
    if (! pushes) WARN (program.err());
    REQUIRE (pushes);

    SECTION ("killed: the helper sends zeros, and ends")
    {
        program.signal (SIGKILL);
        static_cast<void> (program.finish());
        CHECK (eventually ([&] { return arm.force[1] == 0.0 && arm.disables == 1; }));
        CHECK (eventually ([&] { return ::kill (lab.arms->process, 0) != 0; }));
        CHECK (lab.arms->stops == 1);
    }
    SECTION ("frozen: the helper sends zeros, and the program stays stopped when it goes on")
    {
        program.signal (SIGSTOP);
        CHECK (eventually ([&] { return arm.force[1] == 0.0; }));
        const auto frames = arm.frames.load();
        CHECK (eventually ([&] { return arm.frames > frames + 200; }));
        CHECK (arm.force[1] == 0.0);
        program.signal (SIGCONT);
        static_cast<void> (program.stop());
        CHECK (arm.force[1] == 0.0);
    }
    SECTION ("the helper is killed: the program says so")
    {
        const auto process = lab.arms->process.load();
        arm.is_open = 0;   // the system closes it
        ::kill (process, SIGKILL);
        CHECK (test::soon ([&] { return lab.arms->process != process; }));   // it is opened again
        const auto ran = program.stop();
        INFO (ran.out << ran.err);
        CHECK (ran.status == 0);
        CHECK ((ran.out + ran.err).find ("the device was gone once") != std::string::npos);
        CHECK ((ran.out + ran.err).find ("run/frozen") == std::string::npos);
    }
    SECTION ("ended with Ctrl-C")
    {
        const auto ran = program.stop();
        INFO (ran.err);
        CHECK (ran.status == 0);
        CHECK (arm.force[1] == 0.0);
        CHECK (arm.disables == 1);
    }
}

TEST_CASE ("how long a force on a Touch outlives its program, measured at the fake", "[openhaptics][promise][safety]")
{
    TouchLab lab;
    auto& arm = lab.arm();
    arm.target[1] = -6.0;
    lab.folder.write ("wall.json", wall);
    for (const auto& end : { test::End { "kill -9", 5.0, SIGKILL }, test::End { "frozen", 22.0, SIGSTOP }, test::End { "emergency stop", 10.0, SIGUSR1 } })
        CHECK (test::keepsPromise (
            { "play", (lab.folder / "wall.json").string(), "--device", "stylus=openhaptics" }, end, [&] { return arm.force[1] > 0.5; },
            [&] (std::int64_t) { return arm.zero_at.load(); }));
}

TEST_CASE ("check-plugin finds no fault in the driver of 3D Systems' arms", "[openhaptics]")
{
    TouchLab lab;
    const auto plugin = std::filesystem::path (TACTUS_PROGRAM).parent_path().parent_path() / "lib/tactus/plugins/openhaptics.tactus-device";
    const auto ran = runTactus ({ "check-plugin", plugin.string(), "--open", "{}" });
    INFO (ran.out << ran.err);
    const auto said = ran.out + ran.err;
    // On a busy computer, the servo loop of the fake is slower than it says.
    const bool is_slow = said.find ("but its rate is") != said.npos && said.find ("\n1 failed") != said.npos;
    CHECK ((ran.status == 0 || is_slow));
    CHECK (lab.arms->frame_errors == 0);
    CHECK (lab.arms->calls_after_unschedule == 0);
}

TEST_CASE ("a program plays on the Touch that fake-device offers", "[openhaptics]")
{
    const TemporaryFolder folder;
    folder.write ("push.json", R"({ "format": "tactus-graph", "version": 2, "name": "push", "rate_hz": 1000,
        "nodes": { "half": { "type": "signal.constant", "params": { "value": 0.5 } }, "motor": { "type": "device.force", "role": "stylus" } },
        "wires": ["half.out -> motor.force.z"] })");
    Running fake ({ "fake-device", "openhaptics" });
    REQUIRE (test::soon ([&] { return fake.out().find ("--device ROLE=openhaptics\n") != std::string::npos; }));
    // The second line is what a person would type: VARIABLE='VALUE' VARIABLE='VALUE' tactus play …
    std::vector<std::string> names;
    auto line = fake.out().substr (fake.out().find ('\n') + 1);
    for (auto equals = line.find ("='"); equals != std::string::npos; equals = line.find ("='"))
    {
        const auto end = line.find ('\'', equals + 2);
        names.push_back (line.substr (0, equals));
        ::setenv (names.back().c_str(), line.substr (equals + 2, end - equals - 2).c_str(), 1);
        line = line.substr (end + 2);
    }
    CHECK (names.size() == 2);
    const auto played = runTactus ({ "play", (folder / "push.json").string(), "--device", "stylus=openhaptics", "--duration", "1" });
    for (const auto& name : names)
        ::unsetenv (name.c_str());
    INFO (played.out << played.err);
    CHECK (played.status == 0);
    const auto ran = fake.stop();
    INFO (ran.out << ran.err);
    CHECK (ran.out.find (" forces heard, of at most 0.5 N") != std::string::npos);
}
