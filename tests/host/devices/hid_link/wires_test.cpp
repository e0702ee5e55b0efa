// SPDX-License-Identifier: MIT
// A profile's device on a serial line and over UDP, played from the outside by a fake.

#include "wire_bench.hpp"

#include "host/devices/hid/hid.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/base/platform/peer_lock.hpp>
#include <host/devices/hid_link/fake_device.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/hid_link/stale_datagrams.hpp>
#include <host/devices/hid_link/wires.hpp>

#include <support/property.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/engine.hpp>
#include <tactus/text/json_text.hpp>

#include <catch2/catch.hpp>

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <future>
#include <optional>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::hid;
using namespace tactus::test::wires;
using namespace std::chrono_literals;

namespace
{
/// The device of a bench in a run: each tick is one report and its answer.
struct OnTheBench final : Device
{
    explicit OnTheBench (Bench& b) : bench (b) {}

    void prepare (double) override {}

    Reading read() noexcept override
    {
        Reading reading;
        const auto before = bench.sent.size();
        works = works && bench.step (reading);
        if (! first) first = before;
        return reading;
    }

    void write (const Effort& guarded) noexcept override
    {
        const auto before = bench.heard.size();
        bench.device->write (guarded);
        works = works && eventually (0ms, [&] { return bench.heard.size() > before || (bench.fake->hear (fromNow (10ms)), false); });
    }

    DeviceLayout layout() const override { return bench.device->layout(); }

    Bench& bench;
    bool works = true;
    std::optional<std::size_t> first;   // of the reports that the run has seen
};

struct Way
{
    Wire wire;
    const char* framing;
};
}   // namespace

TEST_CASE ("dry wood over a wire: each force at its far end is that of the offline run after encoding, bit for bit", "[wires][hid]")
{
    const auto graph = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
    const auto compiled = compile (graph, catalogue(), { .rate_hz = 1000.0 });
    INFO (test::text (compiled.messages));
    REQUIRE (compiled.plan);
    const auto way = GENERATE (Way { Wire::serial, "cobs" }, Way { Wire::serial, "length" }, Way { Wire::serial, "none" }, Way { Wire::udp, "cobs" });
    INFO ("wire " << static_cast<int> (way.wire) << ", framing " << way.framing);
    const auto isPush = [] (const Bytes& heard) { return numberAt (heard, 8) != 0 || numberAt (heard, 12) != 0 || numberAt (heard, 16) != 0; };
    bool has_run = false;
    for (int tries = 0; tries < 3 && ! has_run; ++tries)   // over UDP, a board that is silent for a second of wall time is gone
    {
        auto hand = makeDevice (*graph.device ("stylus"), {});
        REQUIRE (hand.device);
        Bench bench { way.wire, board (way.framing), std::move (hand.device) };
        OnTheBench there { bench };
        has_run = checkForces (bench, there, compiled.plan, false, isPush);
        CHECK ((! has_run || bench.device->counts().lost == 0));
    }
    CHECK (has_run);
}

TEST_CASE ("a device on a wire that is unplugged comes back, with another name, and its force starts from zero", "[wires][hid][safety]")
{
    const auto wire = GENERATE (Wire::serial, Wire::udp);
    const TemporaryFolder folder;
    const auto link = wire == Wire::serial ? (folder / "board").string() : std::string();
    Bench bench { wire, board(), stillHand(), link };
    while (bench.fake->effort().force.z() < 0.5)
        REQUIRE (bench.push (1.0));
    const auto name = bench.fake->place();
    bench.fake->fail (DeviceFault::Kind::away, 1e-3);
    bench.fake->step();
    CHECK (bench.fake->effort().force.isZero (0.0));
    CHECK (eventually ([&] { return ! bench.device->port().isConnected(); }));
    Reading reading = bench.device->read();
    CHECK_FALSE (reading.valid);
    CHECK (reading.fault == ReadingFault::unplugged);

    const auto before = bench.heard.size();
    CHECK (eventually ([&] {
        bench.fake->step();
        bench.system.ns += 1'000'000;
        reading = bench.device->read();
        bench.device->write ({});
        return reading.valid;
    }));
    if (wire == Wire::serial) CHECK (bench.fake->place() != name);
    CHECK (bench.device->port().counts().departures == 1);
    CHECK (eventually ([&] { return bench.fake->hear (fromNow (10ms)) || bench.heard.size() > before; }));
    for (std::size_t k = before; k < bench.heard.size(); ++k)
        CHECK (numberAt (bench.heard[k], 16) == 0);
    while (bench.fake->effort().force.z() < 0.5)
        REQUIRE (bench.push (1.0));
}

TEST_CASE ("noise, half reports and lost bytes on a wire make no reading, and the wire recovers", "[wires][hid][safety]")
{
    using Kind = DeviceFault::Kind;
    const auto kind = GENERATE (Kind::garbage, Kind::half, Kind::lost_byte);
    const auto framing = GENERATE ("cobs", "length", "none");
    Bench bench { Wire::serial, board (framing) };
    while (bench.fake->effort().force.z() < 0.5)
        REQUIRE (bench.push (1.0));
    const auto taken = bench.device->counts().taken;
    bench.fake->fail (kind, 0.2);
    Reading reading;
    for (int k = 0; k < 150; ++k)
    {
        bench.fake->step();
        bench.system.ns += 1'000'000;
        reading = bench.device->read();
        bench.device->write ({});
    }
    // Without a CRC, a report with wrong values may have the marks of a right one; with one, none passes, and the reading gets old.
    if (std::string_view (framing) != "none")
    {
        CHECK (bench.device->counts().taken == taken);
        CHECK (reading.age > 0.1);
    }
    for (int k = 0; k < 60; ++k)
        bench.fake->step();
    CHECK (eventually ([&] { return bench.step (reading) && reading.valid && reading.age == 0.0; }));
    CHECK (bench.device->port().isConnected());
}

TEST_CASE ("a device that stalls, or repeats old reports, makes no new reading", "[wires][hid][safety]")
{
    const auto wire = GENERATE (Wire::serial, Wire::udp);
    Bench bench { wire };
    Reading reading;
    const auto tick = [&] {
        const bool has_come = bench.step (reading);
        bench.device->write ({});
        return has_come;
    };
    for (int k = 0; k < 40; ++k)
        REQUIRE (tick());
    bench.fake->fail (DeviceFault::Kind::stall, 0.05);
    for (int k = 0; k < 40; ++k)
    {
        bench.fake->step();
        bench.system.ns += 1'000'000;
        reading = bench.device->read();
    }
    CHECK (reading.age >= 0.04);
    for (int k = 0; k < 20; ++k)
        bench.fake->step();
    REQUIRE (eventually ([&] { return tick() && reading.valid; }));

    // The network delivers an old datagram after each new one: they are dropped. On a line, which does not do that, the device has restarted.
    bench.fake->fail (DeviceFault::Kind::late, 0.1);
    const auto restarts = bench.device->counts().restarts;
    if (wire == Wire::udp)
    {
        for (int k = 0; k < 40; ++k)
            REQUIRE (tick());
        CHECK (reading.valid);
        CHECK (bench.device->counts().restarts == restarts);
        return;
    }
    CHECK (eventually ([&] {
        bench.fake->step();
        reading = bench.device->read();
        return bench.device->counts().restarts > restarts + 5 && ! reading.valid;
    }));
}

TEST_CASE ("a line whose device takes nothing refuses reports instead of holding back the program", "[wires][hid][safety]")
{
    Bench bench { Wire::serial };
    for (int k = 0; k < 5; ++k)
        REQUIRE (bench.push (1.0));
    bench.fake->fail (DeviceFault::Kind::stall, 1e9);
    CHECK (eventually ([&] {
        bench.fake->step();
        bench.system.ns += 1'000'000;
        bench.device->read();
        bench.device->write ({});
        return bench.device->port().counts().write_errors > 10;
    }));
    CHECK (bench.device->port().isConnected());
    CHECK (bench.fake->effort().force.isZero (0.0));   // its watchdog
}

TEST_CASE ("a socket takes datagrams only from the address that it was opened for", "[wires][hid]")
{
    int port = 0, other_port = 0;
    auto device = WireFile::listenUdp (port);
    REQUIRE (device);
    auto host = WireFile::connectUdp ("127.0.0.1:" + std::to_string (port));
    REQUIRE (host);
    CHECK (host->write (Bytes { 1 }).size == 1);
    Bytes got (8);
    REQUIRE (device->read (got, fromNow (60s)).size == 1);

    sockaddr_in here {};
    socklen_t size = sizeof here;
    REQUIRE (::getsockname (host->descriptor(), reinterpret_cast<sockaddr*> (&here), &size) == 0);
    auto stranger = WireFile::connectUdp ("127.0.0.1:" + std::to_string (ntohs (here.sin_port)));
    REQUIRE (stranger);
    static_cast<void> (stranger->write (Bytes { 66 }));   // the system refuses it, now or when it arrives
    CHECK (device->write (Bytes { 2 }).size == 1);
    REQUIRE (host->read (got, fromNow (60s)).size == 1);
    CHECK (got[0] == 2);
    CHECK (host->read (got, {}).what == WireFile::Outcome::Kind::nothing);
    CHECK (WireFile::listenUdp (other_port));
    CHECK_FALSE (WireFile::listenUdp (port));   // it is taken
}

TEST_CASE ("a UDP device that only answers when it is asked gives no reading, so a force does not pulse", "[wires][hid][safety]")
{
    // The reports of a fake board, which this test sends when it likes.
    const auto profile = board();
    auto source = FakeDevice::make (profile, stillHand(), { .wire = Wire::udp, .link = {}, .faults = {} });
    REQUIRE (source);
    Bytes next;
    (*source)->on_line = [&] (const FakeDevice::Line& line) {
        if (line.what == FakeDevice::Line::What::sent) next.assign (line.bytes.begin(), line.bytes.end());
    };
    const int own = ::socket (AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    sockaddr_in here {}, host {};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl (INADDR_LOOPBACK);
    socklen_t size = sizeof here;
    REQUIRE (::bind (own, reinterpret_cast<sockaddr*> (&here), size) == 0);
    REQUIRE (::getsockname (own, reinterpret_cast<sockaddr*> (&here), &size) == 0);
    const auto isAsked = [&] {   // by a datagram without bytes
        std::array<char, 256> bytes {};
        return ::recvfrom (own, bytes.data(), bytes.size(), 0, reinterpret_cast<sockaddr*> (&host), &size) == 0;
    };
    const auto tell = [&] {
        (*source)->step();
        return ::sendto (own, next.data(), next.size(), 0, reinterpret_cast<sockaddr*> (&host), size) == static_cast<ssize_t> (next.size());
    };

    NoHid system;
    ConnectedDevice where;
    where.wire = Wire::udp;
    where.path = "127.0.0.1:" + std::to_string (ntohs (here.sin_port));
    auto opening = std::async (std::launch::async, [&] { return HidPort::open (system, where, profile, { .look_again = 5ms, .real_time = false }); });
    while (opening.wait_for (1ms) != std::future_status::ready)
        if (isAsked()) CHECK (tell());
    auto opened = opening.get();
    REQUIRE (opened);
    HidDevice device { std::move (*opened) };
    device.prepare (1e-3);
    const auto tick = [&] {
        const auto reading = device.read();
        device.write ({});
        return reading.valid;
    };

    bool was_valid = false;
    int answers = 0;
    REQUIRE (eventually ([&] {
        was_valid = tick() || was_valid;
        if (isAsked() && tell()) ++answers;
        return answers == 8;
    }));
    CHECK_FALSE (was_valid);
    CHECK (device.port().counts().reports == 0);
    CHECK (device.port().isConnected());

    // When it sends by itself, its reports count.
    CHECK (eventually ([&] {
        system.ns += 1'000'000;
        return tell() && tick();
    }));
    ::close (own);
}

TEST_CASE ("a UDP device is driven by one role, and not kept by the child of a fork", "[wires][hid][safety]")
{
    Bench bench { Wire::udp };
    const auto refused = openWire (bench.where, *bench.profile, bench.system);
    REQUIRE_FALSE (refused);
    CHECK (refused.error().text == "another role or another instance of Tactus is using it");

    int port = 0, other_port = 0;
    auto one = WireFile::listenUdp (port), two = WireFile::listenUdp (other_port);
    REQUIRE ((one && two));
    const auto near = WireFile::connectUdp ("127.0.0.1:" + std::to_string (port)), other = WireFile::connectUdp ("127.0.0.1:" + std::to_string (other_port)),
               by_six = WireFile::connectUdp ("[::1]:" + std::to_string (port));
    REQUIRE ((near && other));
    auto held = PeerLock::take (near->descriptor());
    REQUIRE (held);
    const auto second = PeerLock::take (near->descriptor());
    CHECK_FALSE (second);
    CHECK (second.why == "another role or another instance of Tactus is using it");
    if (by_six) CHECK_FALSE (PeerLock::take (by_six->descriptor()));   // not every computer has IPv6
    CHECK (PeerLock::take (other->descriptor()));
    CHECK (PeerLock::take (near->descriptor(), "another arm"));

    std::array<int, 2> ready {}, ends {};
    REQUIRE ((::pipe (ready.data()) == 0 && ::pipe (ends.data()) == 0));
    const auto child = ::fork();
    if (child == 0)
    {
        char end = 0;
        ::close (ends[1]);
        ::_exit (::write (ready[1], &end, 1) == 1 && ::read (ends[0], &end, 1) == 0 ? 0 : 1);
    }
    REQUIRE (child > 0);
    char told = 0;
    REQUIRE (::read (ready[0], &told, 1) == 1);   // the child has given up what it got
    held.lock.reset();
    CHECK (PeerLock::take (near->descriptor()));
    for (const int end : { ends[1], ends[0], ready[1], ready[0] })
        ::close (end);
    ::waitpid (child, nullptr, 0);
}

TEST_CASE ("a serial port is remembered by a name that it keeps", "[wires][hid]")
{
    const TemporaryFolder folder;
    const auto by_id = folder / "by-id", tty = folder / "ttyACM0", other = folder / "ttyACM1";
    std::filesystem::create_directory (by_id);
    std::ofstream (tty) << "";
    std::ofstream (other) << "";
    std::filesystem::create_symlink ("../ttyACM0", by_id / "usb-Board_B7-if00");
    std::filesystem::create_symlink ("../gone", by_id / "usb-Gone");
    CHECK (lastingNameOf (tty.string(), by_id.string()) == (by_id / "usb-Board_B7-if00").string());
    CHECK (lastingNameOf (other.string(), by_id.string()) == other.string());
    CHECK (lastingNameOf ("/dev/no such port", by_id.string()) == "/dev/no such port");
    CHECK (lastingNameOf (tty.string(), (folder / "none").string()) == tty.string());
}

TEST_CASE ("a program that is opened on a place where nothing is says so, and the wire of another profile is refused", "[wires][hid]")
{
    const auto all = LoadedProfiles { { board(), test::profileOf ("woodenhaptics_usb") }, {} };
    NoHid system;
    const auto problemOf = [&] (const Json& description) {
        const auto made = openDevice (description, {}, system, all);
        REQUIRE_FALSE (made.messages.empty());
        CHECK_FALSE (made.messages.front().remedy.empty());
        return made.messages.front().id;
    };
    const auto serial = [] (const char* profile, const char* port) { return Json { { "driver", "serial" }, { "profile", profile }, { "port", port } }; };
    const auto udp = [] (const char* port) { return Json { { "driver", "udp" }, { "profile", "tactus_board" }, { "port", port } }; };
    CHECK (problemOf (serial ("tactus_board", "/dev/no such port")) == "hid/not_connected");
    CHECK (problemOf (serial ("tactus_board", "/dev/null")) == "hid/not_opened");
    CHECK (problemOf (serial ("woodenhaptics_usb", "/dev/null")) == "hid/wire");
    CHECK (problemOf (serial ("tactus_bord", "/dev/null")) == "hid/unknown_profile");
    CHECK (problemOf ({ { "driver", "serial" }, { "profile", "tactus_board" } }) == "device/missing");
    CHECK (problemOf ({ { "driver", "serial" }, { "port", "/dev/null" } }) == "device/missing");
    CHECK (problemOf (udp ("127.0.0.1:9")) == "hid/not_opened");
    for (const auto* wrong : { "localhost:9750", "127.0.0.1", "127.0.0.1:0", "127.0.0.1:65536", "127.0.0.1:65537", "127.0.0.1:4294967305", "127.0.0.1:-1",
                               "127.0.0.1:9 ", "127.0.0.1:x", ":9", "[::1:9" })   // names are not looked up
    {
        INFO (wrong);
        CHECK (problemOf (udp (wrong)) == "hid/address");
        const auto told = checkDevice (udp (wrong), {}, all);
        REQUIRE (told.size() == 1);
        CHECK (told.front().where == "/port");
        CHECK (told.front().text.find (wrong) != std::string::npos);
    }
    CHECK (checkDevice (udp ("127.0.0.1:9"), {}, all).empty());   // as far as that is known without the device
    CHECK (checkDevice (serial ("woodenhaptics_usb", "/dev/null"), {}, all).front().id == "hid/wire");

    // A graph chooses no wire.
    CHECK (makeDevice (udp ("127.0.0.1:9"), {}).messages.front().id == "device/real");
    const std::vector<std::pair<std::string, Json>> none;
    const auto parsed = parseDeviceOption ("pen=serial:tactus_board@/dev/ttyACM0", none, {});
    REQUIRE (parsed);
    CHECK (parsed->description == serial ("tactus_board", "/dev/ttyACM0"));
    CHECK (parseDeviceOption ("pen=udp:tactus_board@127.0.0.1:9", none, {})->description == udp ("127.0.0.1:9"));
    for (const auto* wrong : { "pen=serial:tactus_board", "pen=serial:@/dev/null", "pen=udp:tactus_board@" })
        CHECK (parseDeviceOption (wrong, none, {}).error().id == "device/option");
}

TEST_CASE ("a profile cannot name a wire that its reports do not fit", "[wires][hid]")
{
    const auto problemOf = [] (const std::function<void (Json&)>& edit) {
        auto json = readJson (*readTextFile (test::profile_folder / "tactus_board.json")).root;
        edit (json);
        const auto loaded = readProfile (json);
        return loaded.messages.empty() ? std::string() : loaded.messages.front().id;
    };
    CHECK (problemOf ([] (Json&) {}).empty());
    CHECK (problemOf ([] (Json& p) { p.erase ("match"); }).empty());
    CHECK (problemOf ([] (Json& p) { p["wires"]["serial"]["framing"] = "none"; }).empty());
    CHECK (problemOf ([] (Json& p) { p["wires"]["serial"]["framing"] = "slip"; }) == "profile/kind");
    CHECK (problemOf ([] (Json& p) { p["wires"]["serial"].erase ("framing"); }) == "profile/missing");
    CHECK (problemOf ([] (Json& p) { p["wires"] = Json::object(); }) == "profile/missing");
    CHECK (problemOf ([] (Json& p) { p["wires"]["smoke"] = Json::object(); }) == "profile/unknown_key");
    CHECK (problemOf ([] (Json& p) { p["outputs"][0]["kind"] = "feature"; }) == "profile/wire");
    CHECK (problemOf ([] (Json& p) {
               p["wires"]["serial"]["framing"] = "none";
               p["inputs"][0]["longest"] = 65;
           })
           == "profile/wire");
}

TEST_CASE ("a datagram that comes late or twice is dropped, and a device that has restarted is not", "[wires][hid][property]")
{
    const auto profile = board();
    const auto report = [] (std::uint32_t number) {
        Bytes bytes (64);
        std::memcpy (bytes.data() + 4, &number, sizeof number);
        return bytes;
    };
    test::property ("numbers in any order within a window", [&] {
        StaleDatagrams stale (*profile);
        const auto first = *rc::gen::arbitrary<std::uint32_t>();
        std::uint32_t newest = first;
        RC_ASSERT_FALSE (stale.isStale (report (first)));
        int in_a_row = 0;
        for (int i = 0; i < 100; ++i)
        {
            const auto number = newest + static_cast<std::uint32_t> (*rc::gen::inRange (-8, 9));
            const bool is_new = number != newest && number - newest < 0x80000000u;
            in_a_row = is_new ? 0 : in_a_row + 1;
            if (in_a_row > StaleDatagrams::most_in_a_row) break;
            RC_ASSERT (stale.isStale (report (number)) == ! is_new);
            if (is_new) newest = number;
        }
    });
    StaleDatagrams stale (*profile);
    CHECK_FALSE (stale.isStale (report (100'000)));
    int dropped = 0;
    std::uint32_t number = 1;
    while (stale.isStale (report (number)))
    {
        ++dropped;
        ++number;
    }
    CHECK (dropped == StaleDatagrams::most_in_a_row);
    CHECK_FALSE (stale.isStale (report (number + 1)));
    CHECK_FALSE (stale.isStale (Bytes (3)));   // the decoder refuses it
}
