// SPDX-License-Identifier: MIT
// Programs that play on a fake arm of Force Dimension, and what the arm feels when they end, freeze or are killed.

#include "../outlived.hpp"
#include "lab.hpp"

#include "support/temporary_folder.hpp"

#include <host/cli/program.hpp>
#include <host/cli/running.hpp>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

using namespace tactus;
using namespace std::chrono_literals;
using test::eventually;
using test::Lab;
using test::Running;
using test::runTactus;

namespace
{
constexpr auto wall = R"({ "format": "tactus-graph", "version": 2, "name": "wall", "rate_hz": 1000,
  "nodes": { "hand": { "type": "device.position", "role": "stylus" },
             "wall": { "type": "deform.plane", "params": { "stiffness": 500 } },
             "motor": { "type": "device.force", "role": "stylus" } },
  "wires": ["hand.position -> wall.position", "wall.force -> motor.force"] })";

/// The program plays the wall, and the hand presses.
struct Played
{
    Played()
    {
        lab.arm().target[2] = -0.006;
        lab.folder.write ("wall.json", wall);
    }

    bool pushes (const Running& program)
    {
        const bool does = test::soon ([&] { return lab.acting() > 0.5; });
        if (! does) WARN (program.err());
        return does;
    }

    bool rests()
    {
        return eventually ([&] { return lab.acting() == 0.0; });
    }

    Lab lab;
    const std::vector<std::string> play { "play", (lab.folder / "wall.json").string(), "--device", "stylus=forcedimension:0" };
};
}   // namespace

TEST_CASE ("a program that is killed, frozen or ended leaves an arm of Force Dimension without a force", "[forcedimension][safety]")
{
    Played played;
    auto& arm = played.lab.arm();
    Running program (played.play);
    REQUIRE (played.pushes (program));

    SECTION ("killed: the watchdog of the arm ends the last force")
    {
        program.signal (SIGKILL);
        static_cast<void> (program.finish());
        CHECK (played.rests());
        CHECK (arm.stops == 0);
    }
    SECTION ("frozen, and then not: the force stays away")
    {
        const auto enabled = arm.enables.load();   // on a busy computer, the arm may have been opened twice
        program.signal (SIGSTOP);
        CHECK (eventually ([&] {
            const auto last = arm.commanded_at.load();
            test::letPass (60ms);
            return arm.commanded_at == last;
        }));
        CHECK (played.lab.acting() == 0.0);
        arm.ignores_silence = 0;
        program.signal (SIGCONT);
        CHECK (test::soon ([&] { return arm.cause == 3; }));
        arm.ignores_silence = 1;
        const auto forces = arm.forces.load();
        CHECK (test::soon ([&] { return arm.forces > forces + 100; }));
        CHECK (played.lab.acting() == 0.0);
        CHECK (arm.enables == enabled);
        static_cast<void> (program.stop());
        CHECK (arm.stopped_before_close == 1);
    }
    SECTION ("ended with Ctrl-C")
    {
        const auto ran = program.stop();
        INFO (ran.err);
        CHECK (ran.status == 0);
        CHECK (arm.force[2] == 0.0);
        CHECK (arm.stopped_before_close == 1);
        CHECK (arm.closes == 1);
        CHECK (arm.calls_after_close == 0);
    }
}

TEST_CASE ("how long a force on an arm of Force Dimension outlives its program, measured at the fake", "[forcedimension][promise][safety]")
{
    Played played;
    auto& arm = played.lab.arm();
    const auto closes = [&] { arm.is_open = 0; };   // the system does, when the program is dead
    const test::End ends[] { { "kill -9", 33.0, SIGKILL, closes },
                             { "frozen", 33.0, SIGSTOP },
                             { "emergency stop", 10.0, SIGUSR1 },
                             { "unplugged", 33.0, 0, [&] { arm.is_unplugged = 1; } } };
    for (const auto& end : ends)
    {
        CHECK (test::keepsPromise (
            played.play, end,
            [&] {
                arm.is_unplugged = 0;
                return played.lab.acting() > 0.5;
            },
            [&] (std::int64_t) {
                const std::int64_t by_watchdog = end.signal == SIGUSR1 ? 0 : arm.commanded_at + 31'875'000;
                return played.lab.acting() > 0.0 ? 0 : std::max (arm.zero_at.load(), by_watchdog);
            }));
    }
}

TEST_CASE ("tactus devices lists what a driver finds when it is named, and only names the others", "[forcedimension]")
{
    Lab lab;
    lab.arms->count = 2;
    lab.arm (1).type = 63;
    const auto plain = runTactus ({ "devices" });
    INFO (plain.out << plain.err);
    CHECK (plain.out.find ("drivers in plugins: ") != std::string::npos);
    CHECK (plain.out.find ("forcedimension") != std::string::npos);
    CHECK (lab.arm().closes == 0);
    const auto asked = runTactus ({ "devices", "--device", "forcedimension" });
    CHECK (asked.out == "omega.3 of Force Dimension, number 0\n    --device ROLE=forcedimension:sn=10001\n"
                        "delta.3 of Force Dimension, number 1\n    --device ROLE=forcedimension:sn=10002\n");
    CHECK (asked.status == 0);
    const auto json = Json::tryParse (runTactus ({ "devices", "--device", "forcedimension", "--json" }).out);
    REQUIRE (json);
    CHECK (json->at (1)["port"] == Json ("sn=10002"));
    const auto cannot = runTactus ({ "devices", "--device", "haply" });
    CHECK (cannot.status == 1);
    CHECK (cannot.err.find ("device/cannot_find") != std::string::npos);
    CHECK (runTactus ({ "devices", "--device", "nosuch" }).err.find ("--device requires --probe or --capture") != std::string::npos);
}

TEST_CASE ("a trial at the terminal ends with the answers, lets nothing push afterwards, and its numbers enter check", "[forcedimension][trial]")
{
    Played played;
    const auto report = (played.lab.folder / "report.json").string();
    const auto run = [&] (const std::string& answers, const std::string& more) {
        const auto command = "printf '" + answers + "' | '" TACTUS_PROGRAM "' devices --try forcedimension:0 --out '" + report + "'" + more;
        Running shell ("/bin/sh", { "-c", command });
        return shell.finish();
    };
    const auto ran = run ("\\n\\n", "");
    INFO (ran.out << ran.err);
    CHECK (ran.out.find ("homing: as expected") != std::string::npos);
    CHECK (ran.out.find ("end: not tried") != std::string::npos);
    CHECK (played.lab.arm().stopped_before_close == 1);
    CHECK (played.lab.acting() == 0.0);
    const auto text = Json::tryParse (played.lab.folder.textOf ("report.json"));
    REQUIRE (text);
    CHECK ((*text)["tried"]["driver"] == Json ("forcedimension"));
    const auto again = run ("", "");
    CHECK (again.err.find ("output/exists") != std::string::npos);

    const auto checked = runTactus ({ "check", (played.lab.folder / "wall.json").string(), "--device", "stylus=" + report });
    INFO (checked.out << checked.err);
    CHECK (checked.err.find ("trial/format") == std::string::npos);
    CHECK (checked.err.find ("device/") == std::string::npos);
    CHECK (runTactus ({ "devices", "--try", "nosuch:1" }).err.find ("device/address") != std::string::npos);
}

TEST_CASE ("check-plugin finds no fault in the driver of Force Dimension's arms", "[forcedimension]")
{
    Lab lab;
    const auto plugin = std::filesystem::path (TACTUS_PROGRAM).parent_path().parent_path() / "lib/tactus/plugins/forcedimension.tactus-device";
    const auto ran = runTactus ({ "check-plugin", plugin.string(), "--open", "{}" });
    INFO (ran.out << ran.err);
    CHECK (ran.status == 0);
    CHECK (lab.arm().calls_after_close == 0);
    CHECK (lab.arm().closes > 1);
    CHECK (lab.arm().calibrations == 0);
}

TEST_CASE ("a program plays on the arm of Force Dimension that fake-device offers", "[forcedimension]")
{
    const TemporaryFolder folder;
    folder.write ("push.json", R"({ "format": "tactus-graph", "version": 2, "name": "push", "rate_hz": 1000,
        "nodes": { "half": { "type": "signal.constant", "params": { "value": 0.5 } }, "motor": { "type": "device.force", "role": "stylus" } },
        "wires": ["half.out -> motor.force.z"] })");
    Running fake ({ "fake-device", "forcedimension" });
    REQUIRE (test::soon ([&] { return fake.out().find ("--device ROLE=forcedimension\n") != std::string::npos; }));
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
    const auto played = runTactus ({ "play", (folder / "push.json").string(), "--device", "stylus=forcedimension", "--duration", "1" });
    for (const auto& name : names)
        ::unsetenv (name.c_str());
    INFO (played.out << played.err);
    CHECK (played.status == 0);
    const auto ran = fake.stop();
    INFO (ran.out << ran.err);
    CHECK (ran.out.find (" forces heard, of at most 0.5 N") != std::string::npos);
}
