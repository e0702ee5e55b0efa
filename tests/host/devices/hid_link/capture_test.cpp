// SPDX-License-Identifier: MIT
// Captures of devices: what is recorded, and what it gives when it is replayed.

#include "fake_board.hpp"
#include "wire_bench.hpp"

#include "support/corpus.hpp"
#include "support/temporary_folder.hpp"

#include <fuzz/capture_target.hpp>
#include <host/devices/hid_link/capture.hpp>
#include <host/devices/hid_link/profile_library.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <map>

using namespace tactus;
using namespace tactus::host::hid;
using namespace tactus::test::wires;
using What = Capture::Line::What;

namespace
{
/// Plays the reports of a capture to a port with this profile, and calls back after each one.
template <typename F>
std::unique_ptr<HidDevice> replay (test::FakeBoard& far_end, const Capture& capture, const std::shared_ptr<const Profile>& profile, F&& each)
{
    far_end.virtual_ns = 1'000'000'000;
    far_end.can_read_until = false;
    auto opened = HidPort::open (far_end, far_end.what, profile, { .look_again = 5ms, .real_time = false });
    REQUIRE (opened);
    auto device = std::make_unique<HidDevice> (std::move (*opened));
    device->prepare (1e-3);
    std::uint64_t sent = 0;
    for (const auto& line : capture.lines)
    {
        if (line.what != What::in) continue;
        far_end.virtual_ns = 1'000'000'000 + static_cast<std::int64_t> (1e9 * line.t);
        far_end.send (line.bytes);
        ++sent;
        REQUIRE (eventually ([&] { return device->port().counts().reports == sent; }));
        each (*device, device->read());
        device->write ({});   // a device rests before its readings count
    }
    return device;
}

std::vector<Bytes> bytesOf (const Capture& capture, What what, std::size_t without = 0)
{
    std::vector<Bytes> all;
    for (const auto& line : capture.lines)
        if (line.what == what) all.emplace_back (line.bytes.begin() + static_cast<std::ptrdiff_t> (without), line.bytes.end());
    return all;
}

Result<Capture> captureIn (const TemporaryFolder& folder, const std::string& name) { return readCapture (folder.textOf (name)); }
}   // namespace

TEST_CASE ("a capture of a device on a wire has all its reports, and replays to the same readings", "[capture][wires][hid]")
{
    const auto wire = GENERATE (Wire::serial, Wire::udp);
    const TemporaryFolder folder;
    const auto profile = board();
    std::map<double, Reading> live;   // by the number of the report
    std::vector<Bytes> sent, heard;
    {
        ConnectedDevice where;
        where.wire = wire;
        const auto file = CaptureFile::create ((folder / "board.jsonl").string(), where, profile->id, {});
        REQUIRE (file);
        auto hand = makeDevice ({ { "driver", "gesture" }, { "path", "stroke" } }, {});
        REQUIRE (hand.device);
        Bench bench { wire, profile, std::move (hand.device), {}, file->get() };
        for (int k = 0; k < 300; ++k)
        {
            Reading reading;
            REQUIRE (bench.step (reading));
            live[bench.device->model().sample().axes[bench.sequence]] = reading;
            bench.device->write ({ .force = { 0.0, 0.0, reading.valid ? 0.001 * k : 0.0 } });
            REQUIRE (eventually ([&] { return bench.heard.size() > static_cast<std::size_t> (k) || bench.fake->hear (fromNow (10ms)); }));
        }
        sent = bench.sent;
        heard = bench.heard;
        CHECK ((*file)->isGood());
    }
    const auto capture = captureIn (folder, "board.jsonl");
    INFO ((capture ? std::string() : capture.error().text));
    REQUIRE (capture);
    CHECK (capture->profile == "tactus_board");
    CHECK (capture->wire == wire);
    CHECK (std::ranges::is_sorted (capture->lines, {}, &Capture::Line::t));

    // What came and went, byte for byte. Before the port was open, the board has sent more.
    const auto in = bytesOf (*capture, What::in), out = bytesOf (*capture, What::out, 1);
    REQUIRE (in.size() >= 300);
    REQUIRE (in.size() <= sent.size());
    CHECK (std::equal (in.end() - 300, in.end(), sent.end() - 300));
    REQUIRE (out.size() >= heard.size());
    CHECK (std::equal (heard.begin(), heard.end(), out.begin()));

    test::FakeBoard far_end;
    std::size_t compared = 0, different = 0;
    const HidModel model (profile);
    const auto sequence = static_cast<std::size_t> (std::ranges::find (model.axisNames(), "sequence") - model.axisNames().begin());
    const auto device = replay (far_end, *capture, profile, [&] (const HidDevice& d, const Reading& reading) {
        const auto then = live.find (d.model().sample().axes[sequence]);
        if (then == live.end()) return;
        ++compared;
        const auto& was = then->second;
        const bool same = reading.position == was.position && reading.rotation == was.rotation && reading.pressure == was.pressure
                          && reading.buttons == was.buttons && std::ranges::equal (reading.axes, was.axes);
        different += same ? 0 : 1;
    });
    CHECK (compared == 300);
    CHECK (different == 0);
    CHECK (device->counts().lost == 0);
    CHECK (live.rbegin()->second.position != live.begin()->second.position);
}

TEST_CASE ("a capture of a HID device has its steps, its features and its end", "[capture][hid]")
{
    const TemporaryFolder folder;
    test::FakeBoard board;
    const auto file = CaptureFile::create ((folder / "board.jsonl").string(), board.what, "board", { 0x06, 0xab });
    REQUIRE (file);
    CapturingSystem system { board, **file };
    {
        const auto profile = test::BoardProfile {}.make();
        auto opened = HidPort::open (system, system.connected().front(), profile, { .look_again = 5ms, .real_time = false });
        REQUIRE (opened);
        HidDevice device { std::move (*opened) };
        device.prepare (1e-3);
        board.send (test::boardReport (1, 1000));
        REQUIRE (eventually ([&] { return device.port().counts().reports == 1; }));
        board.plug (false);
        REQUIRE (eventually ([&] { return ! device.port().isConnected(); }));
    }
    const auto text = folder.textOf ("board.jsonl");
    CHECK (text.find (R"("vid":4617)") != std::string::npos);
    CHECK (text.find (R"("descriptor":"06 ab")") != std::string::npos);
    CHECK (text.find ("S1") == std::string::npos);   // the serial number belongs to its owner
    const auto capture = captureIn (folder, "board.jsonl");
    REQUIRE (capture);
    CHECK (bytesOf (*capture, What::out).front() == Bytes { 0x00, 0xaa, 0x01 });
    CHECK (bytesOf (*capture, What::feature_out) == std::vector<Bytes> { { 0x00, 0xaa, 0x02 } });
    CHECK (bytesOf (*capture, What::in) == std::vector<Bytes> { test::boardReport (1, 1000) });
    CHECK (bytesOf (*capture, What::gone).size() == 1);
    CHECK ((*file)->lines() == capture->lines.size());
}

TEST_CASE ("a capture that cannot be written or read says why", "[capture][hid]")
{
    CHECK (CaptureFile::create ("/nowhere/at/all.jsonl", {}, "board", {}).error().id == "output/unwritable");

    const std::string head = R"({"format":"tactus-capture","version":1,"wire":"hid","profile":"board"})";
    const auto [text, id, line] = GENERATE_COPY (table<std::string, std::string, int> ({
        { "", "file/syntax", 1 },
        { "[]\n", "capture/format", 1 },
        { R"({"format":"tactus-session"})"
          "\n",
          "capture/format", 1 },
        { R"({"format":"tactus-capture","version":2,"wire":"hid"})"
          "\n",
          "capture/version", 1 },
        { R"({"format":"tactus-capture","version":1,"wire":"string"})"
          "\n",
          "capture/format", 1 },
        { head + "\n{\n", "capture/line", 2 },
        { head + "\n[]\n", "capture/line", 2 },
        { head + "\n\n"
                 R"({"in":"54"})"
                 "\n",
          "capture/line", 3 },
        { head + "\n"
                 R"({"t":"now","in":"54"})"
                 "\n",
          "capture/line", 2 },
        { head + "\n"
                 R"({"t":1,"up":"54"})"
                 "\n",
          "capture/line", 2 },
        { head + "\n"
                 R"({"t":1,"in":"5x"})"
                 "\n",
          "capture/line", 2 },
        { head + "\n"
                 R"({"t":1,"in":54})"
                 "\n",
          "capture/line", 2 },
    }));
    const auto read = readCapture (text);
    INFO (text);
    REQUIRE_FALSE (read);
    CHECK (read.error().id == id);
    CHECK (read.error().line == line);
    CHECK_FALSE (read.error().remedy.empty());

    // A killed program leaves half a line.
    const auto killed = readCapture (head + "\n"
                                            R"({"t":1,"in":"54"})"
                                            "\n"
                                            R"({"t":2,"in":"5)");
    REQUIRE (killed);
    CHECK (killed->lines == std::vector<Capture::Line> { { What::in, 1.0, { 0x54 } } });
}

TEST_CASE ("every text of the capture corpus is read or refused", "[capture]") { CHECK (test::replay ("capture", fuzz::tryCapture) > 10); }

TEST_CASE ("every capture that somebody has sent us replays through its profile", "[capture][hid]")
{
    const auto profiles = loadProfiles (test::profile_folder);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator (TACTUS_SOURCE_DIR "/tests/host/devices/hid_link/captures"))
    {
        INFO (entry.path().string());
        const auto text = readTextFile (entry.path());
        REQUIRE (text);
        const auto capture = readCapture (*text);
        INFO ((capture ? std::string() : capture.error().text));
        REQUIRE (capture);
        if (! capture->driver.empty()) continue;   // service_capture_test.cpp replays it through its driver
        const auto profile = profileNamed (profiles, capture->profile);
        REQUIRE (profile);
        test::FakeBoard far_end;
        std::size_t valid = 0;
        const auto device = replay (far_end, *capture, profile, [&] (const HidDevice&, const Reading& reading) { valid += reading.valid ? 1 : 0; });
        for (const auto refused : device->counts().refused)
            CHECK (refused == 0);
        CHECK (device->counts().taken > 0);
        CHECK (valid > 0);
        ++files;
    }
    CHECK (files > 0);
}
