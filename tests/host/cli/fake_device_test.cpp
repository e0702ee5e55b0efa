// SPDX-License-Identifier: GPL-3.0-or-later
// Whole programs: one plays a device, and another one plays a graph on it.

#include "program.hpp"
#include "running.hpp"

#include <host/devices/hid/hex.hpp>
#include <host/devices/hid_link/capture.hpp>
#include <host/devices/osc/osc_port.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

using namespace tactus;
using test::playOn;
using test::Running;
using test::runProgram;
using test::runTactus;
using test::soon;

namespace
{
constexpr auto pushing = R"({ "format": "tactus-graph", "version": 2, "name": "push", "rate_hz": 1000,
  "nodes": { "half": { "type": "signal.constant", "params": { "value": 0.5 } }, "motor": { "type": "device.force", "role": "stylus" } },
  "wires": ["half.out -> motor.force.z"] })";

/// The lines of the log that begin like this after the step, such as "< 54 01 01".
std::vector<std::string> linesOf (const std::string& log, const std::string& what)
{
    std::ifstream file (log);
    std::vector<std::string> found;
    for (std::string line; std::getline (file, line);)
        if (const auto at = line.find (' '); at != line.npos && line.compare (at + 1, what.size(), what) == 0) found.push_back (line.substr (at + 1));
    return found;
}

const std::string dry_wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";

const std::string drives = "< 54 01 01 00", rests = "< 54 01 00 00";

/// The device of a profile, played by the program, and what another program opens.
struct Fake
{
    explicit Fake (const std::string& wire, const std::string& profile = "tactus_board")
        : log (scratch.path ("log")), program (wire == "serial" ? TACTUS_PROGRAM : test::testedProgram(), words (wire, profile)),
          is_there (soon ([this] { return program.out().find ('\n') != std::string::npos; }))
    {
        const auto told = program.out();
        const auto at = told.find ("ROLE=");
        device = at == told.npos ? std::string() : told.substr (at + 5, told.find ('\n', at) - at - 5);
        if (const auto link = device.find (line.link); link != device.npos) device.replace (link, line.link.size(), line.name);
    }

    std::vector<std::string> words (const std::string& wire, const std::string& profile) const
    {
        std::vector<std::string> all { "fake-device", profile, "--wire", wire, "--log", log };
        all.insert (all.end(), { "--hand", scratch.write ("hand.json", R"({ "driver": "sim", "mass": "1000 kg" })") });   // it does not move away
        if (wire == "serial") all.insert (all.end(), { "--link", line.link });
        return all;
    }

    const test::Scratch scratch;
    const test::SerialLine line = test::serialLine (scratch);
    const std::string log;
    Running program;
    const bool is_there;
    std::string device;
};
}   // namespace

TEST_CASE ("a program that is killed while it pushes leaves the device on a wire at rest", "[cli][wires][safety]")
{
    const auto wire = GENERATE (as<std::string> {}, "serial", "udp");
    Fake fake { wire };
    REQUIRE (fake.is_there);
    const auto graph = fake.scratch.write ("push.json", pushing);
    Running play { playOn (fake.device, graph) };
    REQUIRE (play.says ("Ctrl-C stops"));
    // 0.5 N are 500000 uN, 0007a120.
    REQUIRE (soon (
        [&] { return linesOf (fake.log, drives).size() > 100 && linesOf (fake.log, drives).back().find (" 20 a1 07 00 ") != std::string::npos; }));
    play.signal (SIGKILL);
    CHECK (soon ([&] { return ! linesOf (fake.log, "< ").empty() && linesOf (fake.log, "< ").back().starts_with (rests); }));
    if (wire == "udp") CHECK (soon ([&] { return linesOf (fake.log, rests).size() >= 3; }));   // a datagram may be lost
    const auto ran = fake.program.stop();
    CHECK (ran.status == 0);
    CHECK (ran.out.find (" 0 refused") != std::string::npos);
}

TEST_CASE ("a second program cannot drive a device over UDP that a first one drives, by no name of its address", "[cli][wires][safety]")
{
    Fake fake { "udp" };
    REQUIRE (fake.is_there);
    const auto graph = fake.scratch.write ("push.json", pushing);
    Running first { playOn (fake.device, graph) };
    REQUIRE (first.says ("Ctrl-C stops"));
    REQUIRE (soon ([&] { return linesOf (fake.log, drives).size() > 100; }));
    const auto port = fake.device.substr (fake.device.rfind (':'));
    for (const auto* name : { "127.0.0.1", "0.0.0.0", "127.1.2.3", "[::ffff:127.0.0.1]" })
    {
        const auto second = runTactus (playOn ("udp:tactus_board@" + (name + port), graph, { "--duration", "0.1" }));
        INFO (name << ": " << second.err);
        CHECK (second.status != 0);
        CHECK (second.err.find ("another role or another instance of Tactus is using it") != std::string::npos);
    }
    CHECK (first.stop().status == 0);
    const auto next = runTactus (playOn (fake.device, graph, { "--duration", "0.1" }));
    INFO (next.err);
    CHECK (next.status == 0);
}

TEST_CASE ("with a board on UDP, a message changes its force only with the token, which programs of the same user find", "[cli][wires][osc][safety]")
{
    Fake fake { "udp" };
    REQUIRE (fake.is_there);
    Running play { { "play", fake.scratch.write ("push.json", pushing), "--device", "stylus=" + fake.device, "--session", "off", "--osc", "0" } };
    REQUIRE (play.says ("Ctrl-C stops"));
    const auto said = play.err();
    const std::string before = "OSC on 127.0.0.1:";
    const auto port = std::stoi (said.substr (said.find (before) + before.size()));
    const auto pushes = [&] (const std::string& force) {
        return soon ([&] { const auto lines = linesOf (fake.log, drives); return ! lines.empty() && lines.back().find (force) != std::string::npos; });
    };
    REQUIRE (pushes (" 20 a1 07 00 "));

    const auto stranger = std::move (*host::OscPort::open (0));
    for (const auto& message : { juce::OSCMessage ("/tactus/param", juce::String ("half.value"), 1.0f, stranger->number()),
                                 juce::OSCMessage ("/tactus/hello", juce::String ("guess1"), stranger->number()),
                                 juce::OSCMessage ("/tactus/param", juce::String ("half.value"), 1.0f, stranger->number()) })
    {
        stranger->send (port, message);
        const auto answer = stranger->next (std::chrono::seconds (30));
        REQUIRE (answer);
        REQUIRE (answer->getAddressPattern().toString() == "/tactus/error");
        CHECK ((*answer)[2].getString() == "osc/token");
    }
    const auto folder = "XDG_RUNTIME_DIR=" + fake.scratch.path ("");
    const auto other = runProgram ("/usr/bin/env", { folder, TACTUS_PROGRAM, "set", "half.value=1", "--osc", std::to_string (port) });
    CHECK (other.status != 0);   // another user's folder
    CHECK (other.err.find ("[osc/token]") != std::string::npos);
    CHECK (runTactus ({ "probe", "half.out", "--duration", "0.01", "--osc", std::to_string (port) }).out.find (",0.5\n") != std::string::npos);

    const auto own = runTactus ({ "set", "half.value=0.25", "--osc", std::to_string (port) });
    INFO (own.err);
    CHECK (own.status == 0);
    CHECK (pushes (" 90 d0 03 00 "));   // 250000 uN
    CHECK (play.stop().status == 0);
}

TEST_CASE ("a program that is killed while it pushes an arm without a watchdog leaves it at rest", "[cli][wires][safety]")
{
    struct Arm
    {
        const char *profile, *force, *zeros;
    };
    const auto arm = GENERATE (Arm { "haply_2diy", "< 02 05", " 00 00 00 00 00 00 00 00" },
                               Arm { "dualpanto", "< 90 01 00", " 00 00 00 00 00 00 00 00 00 00 00 00" });
    Fake fake { "serial", arm.profile };
    REQUIRE (fake.is_there);
    auto sideways = std::string (pushing);
    sideways.replace (sideways.find ("force.z"), 7, "force.x");
    const auto graph = fake.scratch.write ("push.json", sideways);
    Running play { playOn (fake.device, graph) };
    REQUIRE (play.says ("Ctrl-C stops"));
    const auto at_rest = std::string (arm.force) + arm.zeros;
    const auto isPushed = [&] {
        const auto heard = linesOf (fake.log, arm.force);
        return heard.size() > 100 && heard.back() != at_rest;
    };
    REQUIRE (soon (isPushed));
    play.signal (SIGKILL);
    CHECK (soon ([&] { return linesOf (fake.log, arm.force).back() == at_rest; }));
    CHECK (fake.program.stop().status == 0);
}

TEST_CASE ("a program that is frozen while it pushes leaves the device on a wire at rest", "[cli][wires][safety]")
{
    const auto wire = GENERATE (as<std::string> {}, "serial", "udp");
    Fake fake { wire };
    REQUIRE (fake.is_there);
    const auto graph = fake.scratch.write ("push.json", pushing);
    Running play { playOn (fake.device, graph) };
    REQUIRE (play.says ("Ctrl-C stops"));
    REQUIRE (soon ([&] { return linesOf (fake.log, drives).size() > 100; }));
    play.signal (SIGSTOP);
    CHECK (soon ([&] { return linesOf (fake.log, "< ").back().starts_with (rests); }));
    play.signal (SIGCONT);
    play.stop();
    fake.program.stop();
}

TEST_CASE ("play on a wire accounts for its reports, and ends with the device at rest", "[cli][wires]")
{
    const auto wire = GENERATE (as<std::string> {}, "serial", "udp");
    Fake fake { wire };
    REQUIRE (fake.is_there);
    const auto ran = runTactus (playOn (fake.device, "dry_wood", { "--duration", "1" }));
    INFO (ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.err.find (" taken") != std::string::npos);
    CHECK (soon ([&] { return linesOf (fake.log, "< ").back().starts_with (rests); }));
    CHECK (linesOf (fake.log, drives).size() > 100);
    fake.program.stop();
}

TEST_CASE ("the usual hand of fake-device gives way, and a run without a fault ends without a warning", "[cli][wires]")
{
    const test::Scratch scratch;
    const auto line = test::serialLine (scratch);
    const auto device = "serial:tactus_board@" + line.name;
    Running fake { TACTUS_PROGRAM, { "fake-device", "tactus_board", "--link", line.link } };
    REQUIRE (soon ([&] { return fake.out().find ("ROLE=") != std::string::npos; }));
    const auto ran = runTactus (playOn (device, dry_wood, { "--duration", "2", "--out", scratch.path ("out.csv"), "--record", "drag.force" }));
    INFO (ran.out + ran.err);
    CHECK (ran.status == 0);
    const std::string age = "readings up to ";
    REQUIRE (ran.err.find (age) != std::string::npos);
    const double oldest_ms = std::stod (ran.err.substr (ran.err.find (age) + age.size()));
    if (ran.err.find ("the run paused") == std::string::npos && oldest_ms < 20.0)   // after stale_input of 20 ms, a busy computer has a fault
        CHECK (ran.err.find ("no valid reading") == std::string::npos);             // what every run on a device begins with

    // A device that never answers: its stop at the start is the news.
    fake.stop();
    Running mute { TACTUS_PROGRAM, { "fake-device", "tactus_board", "--link", line.link, "--fault", "stall" } };
    REQUIRE (soon ([&] { return mute.out().find ("ROLE=") != std::string::npos; }));
    const auto waited = runTactus (playOn (device, dry_wood, { "--duration", "0.5" }));
    INFO (waited.out + waited.err);
    CHECK (waited.err.find ("stylus: warning: the guard withheld the force: ") != std::string::npos);
}

TEST_CASE ("a profile that cannot be used is told from one that does not exist", "[cli][wires]")
{
    const test::Scratch scratch;
    const auto said = [&] (const std::string& folder, const std::vector<std::string>& words) {
        setenv ("TACTUS_PROFILES", folder.c_str(), 1);
        const auto ran = runTactus (words);
        unsetenv ("TACTUS_PROFILES");
        CHECK (ran.status == 1);
        return ran.err;
    };
    const auto own = scratch.write ("twig.json", "{\n\"format\": \"tactus-profile\",,\n}");
    const auto folder = std::filesystem::path (own).parent_path().string();
    const std::vector<std::string> fake { "fake-device", "twig" },
        play { "play", dry_wood, "--device", "stylus=serial:twig@/dev/null", "--session", "off", "--osc", "off", "--duration", "0.1" };
    CHECK (said (folder, fake).find ("twig.json:2:") != std::string::npos);
    CHECK (said (folder, play).find ("twig.json: a key in double quotes should follow the comma") != std::string::npos);
    for (const auto& words : { fake, play })
        CHECK (said (folder + "/none", words).find ("there is no such folder, although TACTUS_PROFILES names it") != std::string::npos);
}

TEST_CASE ("a role gets one device", "[cli][wires]")
{
    const auto ran = runTactus ({ "play", dry_wood, "--device", "stylus=sim", "--device", "stylus=gesture:press", "--session", "off", "--osc", "off",
                                  "--duration", "0.1" });
    CHECK (ran.status == 1);
    CHECK (ran.err.find ("the role 'stylus' already has a device") != std::string::npos);
}

TEST_CASE ("a line that carries only garbage is told from one that carries nothing", "[cli][wires]")
{
    const test::Scratch scratch;
    const auto line = test::serialLine (scratch);
    const auto device = "serial:tactus_board@" + line.name;
    Running fake { TACTUS_PROGRAM, { "fake-device", "tactus_board", "--link", line.link, "--fault", "garbage" } };
    REQUIRE (soon ([&] { return fake.out().find ("ROLE=") != std::string::npos; }));
    const std::string told = " bytes arrived, but no frame: check baud, framing and CRC";
    const auto captured = runTactus ({ "devices", "--capture", scratch.path ("board.jsonl"), "--device", device, "--duration", "1" });
    INFO (captured.out + captured.err);
    CHECK (captured.out.find (told) != std::string::npos);
    const auto ran = runTactus (playOn (device, "dry_wood", { "--duration", "1" }));
    INFO (ran.err);
    CHECK (ran.err.find ("stylus: warning: ") != std::string::npos);
    CHECK (ran.err.find ("[device/no_frame]") != std::string::npos);
    CHECK (ran.err.find ("0 refused, ") != std::string::npos);   // the account at the end
    const auto probed = runTactus ({ "devices", "--probe", "--device", device, "--duration", "1" });
    INFO (probed.out + probed.err);
    CHECK (probed.out.find (told) != std::string::npos);
}

TEST_CASE ("a board whose rate is not that of its profile is told, with the speed of the graph", "[cli][wires]")
{
    const test::Scratch profiles;
    auto slow = *readTextFile (TACTUS_SOURCE_DIR "/host/devices/profiles/tactus_board.json");
    const auto change = [&] (const std::string& from, const std::string& to) {
        REQUIRE (slow.find (from) != std::string::npos);
        slow.replace (slow.find (from), from.size(), to);
    };
    change (R"("id": "tactus_board")", R"("id": "slow_board")");
    change (R"("rate": 1000,)", R"("rate": 500,)");
    change (R"("vid": "0x16c0")", R"("vid": "0x1234")");
    profiles.write ("slow_board.json", slow);
    setenv ("TACTUS_PROFILES", profiles.path ("").c_str(), 1);
    Fake fake { "serial", "slow_board" };
    unsetenv ("TACTUS_PROFILES");
    INFO (fake.program.err());
    REQUIRE (fake.is_there);
    auto device = fake.device;
    device.replace (device.find ("slow_board"), 10, "tactus_board");
    // Longer than two spans of 2 s.
    const auto ran = runTactus (playOn (device, "dry_wood", { "--duration", "9" }));
    INFO (ran.err);
    CHECK (ran.err.find (" reports/s, its profile says 1000: the graph runs at ") != std::string::npos);
    CHECK (ran.err.find ("[device/rate]") != std::string::npos);
}

TEST_CASE ("what fake-device cannot play is refused with a remedy", "[cli][wires]")
{
    const auto refused = [] (const std::vector<std::string>& more, const std::string& id) {
        std::vector<std::string> words { "fake-device" };
        words.insert (words.end(), more.begin(), more.end());
        const auto ran = runTactus (words);
        INFO (ran.err);
        return ran.status != 0 && ran.err.find (id) != std::string::npos;
    };
    CHECK (refused ({ "tactus_bord" }, "hid/unknown_profile"));
    CHECK (refused ({ "woodenhaptics_usb", "--wire", "serial" }, "fake/wire"));
    CHECK (refused ({ "tactus_board", "--fault", "smoke" }, "fake/fault"));
    CHECK (refused ({ "tactus_board", "--fault", "stall@soon" }, "fake/fault"));
    CHECK (refused ({ "tactus_board", "--hand", "gesture:wave" }, "device/unknown_gesture"));
    CHECK (refused ({ "tactus_board", "--hand", "hid:auto" }, "device/real"));
    CHECK (refused ({ "tactus_board", "--wire", "udp", "--link", "board" }, "--link"));
    CHECK (refused ({ "tactus_board", "--wire", "hid", "--link", "board" }, "--link"));
    CHECK (refused ({ "tactus_board", "--wire", "udp", "--fault", "missed_byte@1:1" }, "only a serial line has this fault"));
    CHECK (refused ({ "haply_2diy", "--wire", "hid" }, "describes no HID device"));
    const test::Scratch scratch;
    const auto file = scratch.write ("file", "mine"), link = scratch.path ("link");
    CHECK (refused ({ "tactus_board", "--link", file }, "fake/link"));
    std::filesystem::create_symlink (file, link);
    CHECK (refused ({ "tactus_board", "--link", link }, "fake/link"));
    CHECK (std::filesystem::read_symlink (link) == file);
    const Fake taken { "udp" };
    REQUIRE (taken.is_there);
    CHECK (refused ({ "tactus_board", "--wire", "udp", "--port", taken.device.substr (taken.device.rfind (':') + 1) }, "choose another port"));
}

TEST_CASE ("tactus devices --capture records what a device on a wire has sent, byte for byte", "[cli][wires][capture]")
{
    const auto wire = GENERATE (as<std::string> {}, "serial", "udp");
    Fake fake { wire };
    REQUIRE (fake.is_there);
    const auto file = fake.scratch.path ("board.jsonl");
    const auto ran = runTactus ({ "devices", "--capture", file, "--device", fake.device, "--duration", "1" });
    INFO (ran.out + ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.out.find ("wrote ") != std::string::npos);
    const auto capture = host::hid::readCapture (*readTextFile (file));
    REQUIRE (capture);
    CHECK (capture->profile == "tactus_board");

    // Each report that came is one that the fake says it has sent, in the same order. A busy computer may have dropped some.
    const auto sent = linesOf (fake.log, "> ");
    auto next = sent.begin();
    std::size_t in = 0, unknown = 0;
    for (const auto& line : capture->lines)
    {
        if (line.what != host::hid::Capture::Line::What::in) continue;
        ++in;
        const auto at = std::find (next, sent.end(), "> " + host::hid::hexOf (line.bytes));
        if (at == sent.end())
            ++unknown;
        else
            next = at + 1;
    }
    CHECK (in > 10);   // of a thousand, of which a busy computer takes few
    CHECK (unknown == 0);
    CHECK (linesOf (fake.log, drives).empty());   // nothing was driven
    fake.program.stop();
}

TEST_CASE ("tactus devices --probe shows the readings of a board on a wire", "[cli][wires]")
{
    const auto wire = GENERATE (as<std::string> {}, "serial", "udp");
    Fake fake { wire };
    REQUIRE (fake.is_there);
    const auto ran = runTactus ({ "devices", "--probe", "--device", fake.device, "--duration", "1" });
    INFO (ran.out + ran.err);
    CHECK (ran.status == 0);
    CHECK (ran.out.find ("(tactus_board): ") != std::string::npos);
    CHECK (ran.out.find ("position ") != std::string::npos);
    CHECK (ran.out.find (" 0 refused") != std::string::npos);
    CHECK (ran.out.find ("No HID device") == std::string::npos);
    const auto json = runTactus ({ "devices", "--probe", "--json", "--device", fake.device, "--duration", "0.5" });
    INFO (json.out + json.err);
    CHECK (Json::parse (json.out)[0]["probe"]["taken"].get<int>() > 10);
    CHECK (Json::parse (json.out)[0]["probe"]["valid"] == true);
    CHECK (linesOf (fake.log, drives).empty());   // nothing was driven
}

TEST_CASE ("tactus devices --capture reads no serial port that a run drives", "[cli][wires][capture][safety]")
{
    Fake fake { "serial" };
    REQUIRE (fake.is_there);
    Running play { playOn (fake.device, dry_wood) };
    REQUIRE (play.says ("Ctrl-C stops"));
    REQUIRE (soon ([&] { return linesOf (fake.log, drives).size() > 100; }));
    const auto other = test::isOfWindows() ? fake.line.name : std::filesystem::canonical (fake.line.link).string();
    for (const auto& port : { fake.line.name, other })
    {
        const auto ran = runTactus ({ "devices", "--capture", fake.scratch.path ("taken.jsonl"), "--device", port, "--duration", "0.1" });
        INFO (ran.out + ran.err);
        CHECK (ran.status == 1);
        CHECK (ran.err.find ("another role or another instance of Tactus is using it") != std::string::npos);
    }
    const auto ran = play.stop();
    CHECK (ran.status == 0);
    CHECK (ran.err.find (" 0 lost") != std::string::npos);
}

TEST_CASE ("tactus devices --capture records a serial port without a profile, and says why it cannot record", "[cli][wires][capture]")
{
    Fake fake { "serial" };
    REQUIRE (fake.is_there);
    const auto file = fake.scratch.path ("bytes.jsonl");
    const auto ran = runTactus ({ "devices", "--capture", file, "--device", fake.line.name, "--duration", "0.5" });
    INFO (ran.out + ran.err);
    CHECK (ran.status == 0);
    const auto capture = host::hid::readCapture (*readTextFile (file));
    REQUIRE (capture);
    CHECK (capture->profile.empty());
    CHECK (capture->lines.size() > 10);
    CHECK (linesOf (fake.log, "< ").empty());   // nothing was sent to it

    const auto refused = [&] (const std::vector<std::string>& more, const std::string& id) {
        std::vector<std::string> words { "devices", "--capture", fake.scratch.path ("none.jsonl") };
        words.insert (words.end(), more.begin(), more.end());
        const auto wrong = runTactus (words);
        INFO (wrong.err);
        return wrong.status != 0 && wrong.err.find (id) != std::string::npos;
    };
    CHECK (refused ({ "--device", "sim" }, "capture/device"));
    CHECK (refused ({ "--device", "serial:tactus_bord@/dev/null" }, "did you mean 'tactus_board'?"));
    CHECK (refused ({ "--device", fake.scratch.path ("nothing") }, "there is no such device"));
    CHECK_FALSE (refused ({ "--device", "nothing" }, "ROLE"));
    CHECK (refused ({ "--device", "nothing" }, "there is no such device"));
    if (! test::isOfWindows()) CHECK (refused ({ "--device", "/dev/null" }, "name a serial port"));   // in wine, it is a file
    CHECK (refused ({ "--probe" }, "--probe"));
    CHECK (runTactus ({ "devices", "--duration", "1" }).status == 2);
    CHECK (runTactus ({ "devices", "--device", fake.device }).status == 2);
    const auto unwritable = runTactus ({ "devices", "--capture", "/nowhere/at/all.jsonl", "--device", fake.device });
    CHECK (unwritable.status == 1);
    CHECK (unwritable.err.find ("output/unwritable") != std::string::npos);
    fake.program.stop();
}
