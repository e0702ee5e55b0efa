// SPDX-License-Identifier: MIT
// The DualPanto at a serial line, played from the outside: by the fake of its profile, and by a far end that connects as its board does.

#include "wire_bench.hpp"

#include "support/temporary_folder.hpp"

#include <host/devices/hid_link/open_device.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/engine.hpp>

#include <algorithm>
#include <functional>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::hid;
using namespace tactus::test::wires;
using namespace std::chrono_literals;

namespace
{
/// The handles upright, so that a hand can press down with one, and with a watchdog that a busy machine does not trigger.
std::shared_ptr<const Profile> panto()
{
    auto json = readJson (*readTextFile (test::profile_folder / "dualpanto.json")).root;
    json["axes"] = Json::array ({ "x", "-z", "y" });
    json["limits"]["stale_input"] = "10 s";
    json["outputs"][0]["max_rate"] = 20000;
    auto loaded = readProfile (json);
    INFO (test::text (loaded.messages));
    REQUIRE (loaded.profile);
    return loaded.profile;
}

const Bytes panto_rest { 0x90, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0 };

std::unique_ptr<HidDevice> openedAt (host::hid::HidSystem& system, const std::string& place, const std::shared_ptr<const Profile>& profile)
{
    ConnectedDevice where;
    where.wire = Wire::serial;
    where.path = place;
    where.product = "fake DualPanto";
    auto opened = HidPort::open (system, where, profile, { .look_again = 5ms, .real_time = false });
    INFO ((opened ? std::string() : opened.error().text));
    REQUIRE (opened);
    auto device = std::make_unique<HidDevice> (std::move (*opened));
    device->prepare (1e-3);
    return device;
}

/// A fake DualPanto and the port that is open on it.
struct PantoBench
{
    explicit PantoBench (std::unique_ptr<Device> hand = stillHand(), const std::string& link = {}) : profile (panto())
    {
        auto made = FakeDevice::make (profile, std::move (hand), { .wire = Wire::serial, .link = link, .faults = {} });
        INFO ((made ? std::string() : made.error().text));
        REQUIRE (made);
        fake = std::move (*made);
        fake->on_line = [this] (const FakeDevice::Line& line) {
            if (line.what == FakeDevice::Line::What::sent) sent.emplace_back (line.bytes.begin(), line.bytes.end());
            if (line.what != FakeDevice::Line::What::heard) return;
            auto& list = line.bytes[0] == 0x90 && line.bytes[2] == 0 ? heard : others;
            list.emplace_back (line.bytes.begin(), line.bytes.end());
        };
        device = openedAt (system, link.empty() ? fake->place() : link, profile);
    }

    /// One step of the fake, and reads until its report is there. False if it does not come.
    bool step (Reading& reading)
    {
        const auto taken = device->counts().taken;
        fake->step();
        system.ns += 1'000'000;
        return eventually ([&] {
            reading = device->read();
            return device->counts().taken > taken;
        });
    }

    /// Hands an effort to the device, and waits until the fake has heard of it.
    bool answer (const Effort& effort)
    {
        const auto before = heard.size();
        device->write (effort);
        return eventually ([&] {
            fake->hear (fromNow (10ms));
            return heard.size() > before;
        });
    }

    bool pushes()
    {
        return eventually ([&] {
            Reading reading;
            if (! step (reading)) return false;
            return answer ({ .force = { 0.0, 0.0, reading.valid ? 1.0 : 0.0 } }) && fake->effort().force.z() > 0.9;
        });
    }

    std::shared_ptr<const Profile> profile;
    NoHid system;
    std::unique_ptr<FakeDevice> fake;
    std::unique_ptr<HidDevice> device;   // ends before the fake
    std::vector<Bytes> sent, heard, others;
};

/// A bench in a run: each tick is one report and its answer.
struct OnThePanto final : Device
{
    explicit OnThePanto (PantoBench& b) : bench (b) {}

    void prepare (double) override {}
    Reading read() noexcept override
    {
        Reading reading;
        works = works && bench.step (reading);
        return reading;
    }
    void write (const Effort& guarded) noexcept override { works = works && bench.answer (guarded); }
    DeviceLayout layout() const override { return bench.device->layout(); }

    PantoBench& bench;
    bool works = true;
};

/// Returns false if the computer stood still for so long that the port took it for suspended.
bool pantoKeepsItsForces (const graph::Graph& graph, const std::shared_ptr<Plan>& plan)
{
    constexpr std::size_t ticks = 3000;
    auto hand = makeDevice (*graph.device ("stylus"), {});
    REQUIRE (hand.device);
    PantoBench bench { std::move (hand.device) };
    const auto limits = limitsOf (*bench.profile, {});
    OnThePanto there { bench };
    Engine engine { plan };
    engine.attach ("stylus", there, limits);
    for (std::size_t k = 0; k < ticks && there.works; ++k)
        engine.tick();
    const auto trouble = bench.device->port().trouble();
    if (! there.works && trouble.find ("suspended") != std::string::npos) return false;
    INFO (bench.heard.size() << " answers, trouble: " << trouble);
    REQUIRE (there.works);

    OffTheWire offline { bench.profile, bench.sent };
    Engine again { plan };
    again.attach ("stylus", offline, limits);
    for (std::size_t k = 0; k < ticks; ++k)
        again.tick();
    CHECK (bench.heard == offline.answers);
    CHECK (static_cast<std::size_t> (std::ranges::count (bench.heard, panto_rest)) < 3 * ticks / 4);
    CHECK (bench.fake->counts().refused == 0);
    CHECK (bench.fake->counts().stray == 0);
    CHECK (bench.device->port().counts().write_errors == 0);
    CHECK (bench.device->counts().refused == std::array<std::uint64_t, refusals> {});
    return true;
}

/// The board's side of the connection: it asks to be connected, sends positions while it is, and gives signs of life. Its time is the number of steps.
struct FarPanto
{
    FarPanto() : lines (Framing::dualpanto, outputShapes (*test::profileOf ("dualpanto")))
    {
        auto made = WireFile::makeTerminal (place);
        REQUIRE (made);
        wire.emplace (std::move (*made));
    }

    void send (const Bytes& report)
    {
        Bytes bytes (longestFrame (Framing::dualpanto, report.size()));
        bytes.resize (writeFrame (Framing::dualpanto, report, bytes));
        static_cast<void> (wire->write (bytes));
    }

    void step()
    {
        Bytes report (longest_report);
        for (;;)
        {
            const auto got = lines.read (*wire, report, {});
            if (got.what != WireFile::Outcome::Kind::report) break;
            if (report[0] == 0x80) is_connected = true;
            if (report[0] == 0x81) ++answered;
        }
        if (! is_connected) return send ({ 0, 0, 0, 0, revision });
        Bytes position (41);
        position[0] = 0x10;
        position[4] = static_cast<std::uint8_t> (++number);   // the last byte of x
        send (position);
    }

    std::string place;
    std::optional<WireFile> wire;
    LineReader lines;
    bool is_connected = false;
    std::uint8_t revision = 5, number = 0;
    int answered = 0;   // signs of life
};
}   // namespace

TEST_CASE ("dry wood on a DualPanto: each force at its far end is that of the offline run after encoding, bit for bit", "[wires][hid][dualpanto]")
{
    const auto graph = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
    const auto compiled = compile (graph, catalogue(), { .rate_hz = 1000.0 });
    INFO (test::text (compiled.messages));
    REQUIRE (compiled.plan);
    bool kept = false;
    for (int tries = 0; tries < 10 && ! kept; ++tries)
        kept = pantoKeepsItsForces (graph, compiled.plan);
    CHECK (kept);
}

TEST_CASE ("the fake of a board without a watchdog keeps its force when the program falls silent", "[wires][hid][dualpanto]")
{
    const bool has_watchdog = GENERATE (false, true);
    auto json = readJson (*readTextFile (test::profile_folder / "dualpanto.json")).root;
    if (has_watchdog) json["limits"]["device_watchdog"] = "20 ms";
    const auto profile = readProfile (json).profile;
    REQUIRE (profile);
    auto made = FakeDevice::make (profile, stillHand(), { .wire = Wire::serial, .link = {}, .faults = {} });
    REQUIRE (made);
    auto& fake = **made;
    auto line = WireFile::openSerial (fake.place(), 115200);
    REQUIRE (line);
    auto pushing = panto_rest;
    pushing[6] = 0x3f;   // 0.5 along x
    Bytes frame (longestFrame (Framing::dualpanto, pushing.size()));
    frame.resize (writeFrame (Framing::dualpanto, pushing, frame));
    REQUIRE (line->write (frame).size == frame.size());
    REQUIRE (eventually ([&] { return fake.hear (fromNow (10ms)); }));
    REQUIRE_FALSE (fake.effort().force.isZero (0.0));
    for (int step = 0; step < 1000; ++step)
        fake.step();
    CHECK (fake.effort().force.isZero (0.0) == has_watchdog);
    CHECK (fake.counts().released == (has_watchdog ? 1 : 0));
}

TEST_CASE ("the other handle of a DualPanto is read and pushed by name", "[wires][hid][dualpanto]")
{
    PantoBench bench;
    REQUIRE (bench.pushes());
    const auto layout = bench.device->layout();
    CHECK (layout.efforts == std::vector<std::string> { "other_x", "other_y" });
    CHECK (indexOf (layout.axes, "other_x") >= 0);
    Reading reading;
    CHECK (eventually ([&] {
        return bench.step (reading) && bench.answer ({ .force = { 0.0, 0.0, 1.0 }, .axes = { 0.5, -0.25 } }) && ! bench.others.empty()
               && bench.others.back() == test::bytes ("90 01 01 3f 00 00 00 be 80 00 00 00 00 00 00");
    }));
    CHECK (bench.fake->effort().force.z() == Approx (1.0));   // of the first handle
}

TEST_CASE ("a DualPanto that is unplugged comes back, with another name, and its force starts from zero", "[wires][hid][dualpanto][safety]")
{
    const TemporaryFolder folder;
    PantoBench bench { stillHand(), (folder / "panto").string() };
    REQUIRE (bench.pushes());
    const auto name = bench.fake->place();
    bench.fake->fail (DeviceFault::Kind::away, 1e-3);
    bench.fake->step();
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
    CHECK (bench.fake->place() != name);
    CHECK (eventually ([&] { return bench.fake->hear (fromNow (10ms)) || bench.heard.size() > before; }));
    CHECK (std::all_of (bench.heard.begin() + static_cast<std::ptrdiff_t> (before), bench.heard.end(), [] (const auto& r) { return r == panto_rest; }));
    CHECK (bench.pushes());
}

TEST_CASE ("noise, half messages, lost bytes and stalls of a DualPanto end, and then it is read again", "[wires][hid][dualpanto][safety]")
{
    using Kind = DeviceFault::Kind;
    const auto kind = GENERATE (Kind::garbage, Kind::half, Kind::lost_byte, Kind::stall);
    PantoBench bench;
    REQUIRE (bench.pushes());
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
    // There is no CRC, so two halves that come together can be taken for one message.
    if (kind == Kind::garbage || kind == Kind::stall)
    {
        CHECK (bench.device->counts().taken == taken);
        CHECK (reading.age > 0.1);
    }
    for (int k = 0; k < 60; ++k)
        bench.fake->step();
    CHECK (eventually ([&] { return bench.step (reading) && reading.valid && reading.age == 0.0; }));
    CHECK (bench.device->port().isConnected());
}

TEST_CASE ("a DualPanto is connected when it asks, and again after a reset, and its signs of life are answered", "[wires][hid][dualpanto]")
{
    FarPanto far;
    NoHid system;
    const auto device = openedAt (system, far.place, panto());
    Reading reading;
    const auto ticksUntil = [&] (const std::function<bool()>& so) {
        return eventually ([&] {
            far.step();
            system.ns += 1'000'000;
            reading = device->read();
            device->write ({});
            return so();
        });
    };
    CHECK (ticksUntil ([&] { return reading.valid; }));
    CHECK (far.is_connected);
    for (int life = 0; life < 2; ++life)
    {
        const auto before = far.answered;
        far.send ({ 1 });
        CHECK (ticksUntil ([&] { return far.answered > before; }));
    }
    far.send ({ 0x20, 'h', 'i' });
    far.send ({ 2 });
    far.send ({ 3 });

    far.is_connected = false;   // a reset
    const auto taken = device->counts().taken;
    CHECK (ticksUntil ([&] { return far.is_connected; }));
    CHECK (ticksUntil ([&] { return reading.valid && device->counts().taken > taken; }));
    CHECK (device->counts().refused == std::array<std::uint64_t, refusals> {});

    far.revision = 4;
    far.send ({ 0, 0, 0, 0, far.revision });
    CHECK (ticksUntil ([&] { return device->counts().refused[static_cast<std::size_t> (Refusal::wrong_mark)] == 1; }));
}
