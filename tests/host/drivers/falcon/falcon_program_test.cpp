// SPDX-License-Identifier: MIT
// Programs that play on a fake Falcon, and the packets that it gets when they end or are killed.

#include "../outlived.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/cli/program.hpp>
#include <host/cli/running.hpp>
#include <host/drivers/falcon/fake_falcon.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string>

using namespace tactus;
using host::FakeFalcon;
using test::eventually;
using test::Running;

namespace
{
constexpr auto wall = R"({ "format": "tactus-graph", "version": 2, "name": "wall", "rate_hz": 1000,
        "nodes": { "hand": { "type": "device.position", "role": "stylus" },
                   "wall": { "type": "deform.plane", "params": { "stiffness": 500 } },
                   "motor": { "type": "device.force", "role": "stylus" } },
        "wires": ["hand.position -> wall.position", "wall.force -> motor.force"] })";

/// A computer with libftdi, which finds this Falcon.
struct Ftdi
{
    explicit Ftdi (const FakeFalcon& falcon)
    {
        ::setenv ("LD_LIBRARY_PATH", (std::string (TACTUS_FAKE_LIBRARIES) + "/ftdi").c_str(), 1);
        ::setenv ("TACTUS_FAKE_FTDI", falcon.port().c_str(), 1);
    }
    ~Ftdi()
    {
        ::unsetenv ("LD_LIBRARY_PATH");
        ::unsetenv ("TACTUS_FAKE_FTDI");
        ::unsetenv ("TACTUS_FAKE_FTDI_PROCESS");
    }
    Ftdi (const Ftdi&) = delete;
    Ftdi& operator= (const Ftdi&) = delete;
};
}   // namespace

TEST_CASE ("a program that is killed, frozen or ended leaves a Falcon without a force", "[falcon][safety]")
{
    const TemporaryFolder folder;
    folder.write ("wall.json", wall);
    FakeFalcon falcon;
    const Ftdi ftdi (falcon);
    const bool is_usb = GENERATE (false, true);
    const auto address = is_usb ? std::string ("usb") : falcon.port();
    falcon.target[1] = -0.006;
    falcon.tremor = 2e-4;   // a position that stays the same would count as frozen
    const int end = GENERATE (SIGKILL, SIGSTOP, SIGINT);
    Running program ({ "play", (folder / "wall.json").string(), "--device", "stylus=falcon:" + address });
    const bool pushes = test::soon ([&] { return falcon.pushes > 100 && ! falcon.isAtRest(); });
    INFO (program.err());
    REQUIRE (pushes);
    program.signal (end);
    CHECK (eventually ([&] { return falcon.isAtRest(); }));
    CHECK ((falcon.bits & 1u) == 1u);
    if (end == SIGSTOP)
    {
        // A busy computer has no force now and then, so this may not be the rest of the guardian. The driver gives up a force after 100 ms.
        test::letPass (std::chrono::milliseconds (200));
        const auto pushes = falcon.pushes.load(), packets = falcon.packets.load();
        program.signal (SIGCONT);
        CHECK (eventually ([&] { return falcon.packets > packets + 5; }));
        // The force from before does not come back. The program may have been frozen between its last look at the clock and its write, so one packet may.
        CHECK (falcon.pushes <= pushes + 1);
        static_cast<void> (program.stop());
    }
    else
        static_cast<void> (program.finish());
    CHECK (falcon.isAtRest());
    CHECK (falcon.without_homing == 0);
}

TEST_CASE ("if the process between a Falcon and its program is killed, the program notices it, starts another one, and takes the force off", "[falcon][safety]")
{
    const TemporaryFolder folder;
    folder.write ("wall.json", wall);
    FakeFalcon falcon;
    const Ftdi ftdi (falcon);
    ::setenv ("TACTUS_FAKE_FTDI_PROCESS", (folder / "process").c_str(), 1);
    falcon.target[1] = -0.006;
    falcon.tremor = 2e-4;
    Running program ({ "play", (folder / "wall.json").string(), "--device", "stylus=falcon:usb" });
    const bool pushes = test::soon ([&] { return falcon.pushes > 100 && ! falcon.isAtRest(); });
    INFO (program.err());
    REQUIRE (pushes);
    const auto first = folder.textOf ("process");
    REQUIRE (::kill (static_cast<pid_t> (std::stol (first)), SIGKILL) == 0);
    CHECK (test::soon ([&] { return falcon.isAtRest(); }));
    CHECK (test::soon ([&] { return folder.textOf ("process") != first; }));
    static_cast<void> (program.stop());
    CHECK (falcon.isAtRest());
}

TEST_CASE ("a computer that shuts down, and so ends all programs at once, leaves a Falcon without a force", "[falcon][safety]")
{
    const TemporaryFolder folder;
    folder.write ("wall.json", wall);
    FakeFalcon falcon;
    const Ftdi ftdi (falcon);
    ::setenv ("TACTUS_FAKE_FTDI_PROCESS", (folder / "process").c_str(), 1);
    falcon.target[1] = -0.006;
    falcon.tremor = 2e-4;
    const int end = GENERATE (SIGTERM, SIGHUP);
    Running program ({ "play", (folder / "wall.json").string(), "--device", "stylus=falcon:usb" });
    const bool pushes = test::soon ([&] { return falcon.pushes > 100 && ! falcon.isAtRest(); });
    INFO (program.err());
    REQUIRE (pushes);
    REQUIRE (::kill (static_cast<pid_t> (std::stol (folder.textOf ("process"))), end) == 0);   // first the process that still has to take the force off
    program.signal (end);
    static_cast<void> (program.finish());
    CHECK (falcon.isAtRest());
}

TEST_CASE ("how long a force on a Falcon outlives its program, measured at the fake", "[falcon][promise][safety]")
{
    const TemporaryFolder folder;
    folder.write ("wall.json", wall);
    FakeFalcon falcon;
    falcon.target[1] = -0.006;
    falcon.tremor = 2e-4;
    const Ftdi ftdi (falcon);
    const bool is_usb = GENERATE (false, true);
    const auto address = is_usb ? std::string ("usb") : falcon.port();
    for (const auto& end : { test::End { "kill -9", 100.0, SIGKILL }, test::End { "frozen", 120.0, SIGSTOP },
                             test::End { "emergency stop", 12.0, SIGUSR1 } })
        CHECK (test::keepsPromise (
            { "play", (folder / "wall.json").string(), "--device", "stylus=falcon:" + address }, end,
            [&] { return falcon.pushes > 100 && ! falcon.isAtRest(); },
            [&] (std::int64_t begin) -> std::int64_t {
                if (! falcon.isAtRest()) return 0;
                const auto at = falcon.zero_at.load();
                return at > begin ? at : -1;
            }));
}

TEST_CASE ("a program plays on the Falcon that fake-device offers", "[falcon]")
{
    const TemporaryFolder folder;
    folder.write ("push.json", R"({ "format": "tactus-graph", "version": 2, "name": "push", "rate_hz": 1000,
        "nodes": { "half": { "type": "signal.constant", "params": { "value": 0.5 } }, "motor": { "type": "device.force", "role": "stylus" } },
        "wires": ["half.out -> motor.force.z"] })");
    folder.write ("hand.json", R"({ "driver": "sim", "mass": "1000 kg" })");   // it does not move away
    Running fake ({ "fake-device", "falcon", "--hand", (folder / "hand.json").string() });
    REQUIRE (test::soon ([&] { return fake.out().find ('\n') != std::string::npos; }));
    const auto told = fake.out();
    const auto at = told.find ("ROLE=") + 5;
    const auto ran = test::runTactus ({ "play", (folder / "push.json").string(), "--device", "stylus=" + told.substr (at, told.find ('\n', at) - at),
                                        "--duration", "0.3", "--session", "off", "--osc", "off" });
    INFO (ran.out << ran.err);
    CHECK (ran.status == 0);
    const auto ended = fake.stop();
    INFO (ended.out << ended.err);
    CHECK (ended.status == 0);
    const auto most = ended.out.find ("at most ");
    REQUIRE (most != std::string::npos);
    CHECK (std::stod (ended.out.substr (most + 8)) == Approx (0.5).epsilon (0.01));
    CHECK (ended.out.find (" 0 bytes outside packets") != std::string::npos);

    const auto wrong = test::runTactus ({ "fake-device", "falcon", "--fault", "away@1:1" });
    CHECK (wrong.status != 0);
    CHECK (wrong.err.find ("choose stall, garbage, half, lost_byte, late, lie or reset") != std::string::npos);
}

TEST_CASE ("devices --probe shows the place and the buttons of a Falcon, and pushes nothing", "[falcon]")
{
    FakeFalcon falcon;
    falcon.hold ({ 0.01, 0.005, 0.13 }, 9);
    Running program ({ "devices", "--probe", "--device", "falcon:" + falcon.port() });
    const bool is_asked = test::soon ([&] { return program.out().find ("pressed: plus minus") != std::string::npos; });
    const auto ended = program.stop();
    INFO (ended.out << ended.err);
    CHECK (is_asked);
    CHECK (ended.status == 0);
    const std::string before = "position";
    const auto at = ended.out.rfind (before);
    REQUIRE (at != std::string::npos);
    std::istringstream numbers (ended.out.substr (at + before.size()));
    std::array<double, 3> mm {};
    numbers >> mm[0] >> mm[1] >> mm[2];
    CHECK (mm[0] == Approx (10.0).margin (0.1));   // a count is about 0.04 mm
    CHECK (mm[1] == Approx (20.0).margin (0.1));
    CHECK (mm[2] == Approx (5.0).margin (0.1));
    CHECK (falcon.pushes == 0);
}

TEST_CASE ("check-plugin finds no fault in the driver of the Falcon", "[falcon]")
{
    FakeFalcon falcon;
    const auto plugin = std::filesystem::path (TACTUS_PROGRAM).parent_path().parent_path() / "lib/tactus/plugins/falcon.tactus-device";
    const auto ran = test::runTactus ({ "check-plugin", plugin.string(), "--open", R"({"port": ")" + falcon.port() + R"("})" });
    INFO (ran.out << ran.err);
    CHECK (ran.status == 0);
}
