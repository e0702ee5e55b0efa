// SPDX-License-Identifier: MIT
// A device on a serial line that speaks only when it is spoken to: Haply's 2DIY, played from the outside by a fake.

#include "wire_bench.hpp"

#include "host/devices/hid/hid.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/hid_link/wires.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/engine.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::hid;
using namespace tactus::test::wires;
using namespace std::chrono_literals;

namespace
{
Json armJson() { return readJson (*readTextFile (test::profile_folder / "haply_2diy.json")).root; }

/// The arm upright, so that a hand can press down with it, and with a watchdog that a busy machine does not trigger.
std::shared_ptr<const Profile> arm()
{
    auto json = armJson();
    json["axes"] = Json::array ({ "-x", "-z", "-y" });
    json["limits"]["stale_input"] = "10 s";
    json["outputs"][0]["max_rate"] = 20000;
    auto loaded = readProfile (json);
    INFO (test::text (loaded.messages));
    REQUIRE (loaded.profile);
    return loaded.profile;
}

const Bytes rest { 2, 5, 0, 0, 0, 0, 0, 0, 0, 0 };
constexpr double watchdog = 0.02;   // s; that of the profile, counted in ticks of 1 ms

/// A fake arm and the port that is open on it. Time passes only in ticks of 1 ms.
struct ArmBench
{
    explicit ArmBench (std::unique_ptr<Device> hand = stillHand(), const std::string& link = {}) : profile (arm())
    {
        auto made = FakeDevice::make (profile, std::move (hand), { .wire = Wire::serial, .link = link, .faults = {} });
        INFO ((made ? std::string() : made.error().text));
        REQUIRE (made);
        fake = std::move (*made);
        fake->on_line = [this] (const FakeDevice::Line& line) {
            if (line.what == FakeDevice::Line::What::sent) sent.emplace_back (line.bytes.begin(), line.bytes.end());
            if (line.what != FakeDevice::Line::What::heard) return;
            const bool is_step = line.bytes.front() != 2;
            (is_step ? steps : heard).emplace_back (line.bytes.begin(), line.bytes.end());
            if (is_step) set_up_at = heard.size();
        };
        where.wire = Wire::serial;
        where.path = link.empty() ? fake->place() : link;
        where.product = "fake arm";
        auto opened = HidPort::open (system, where, profile, { .look_again = 5ms, .real_time = false });
        INFO ((opened ? std::string() : opened.error().text));
        REQUIRE (opened);
        device = std::make_unique<HidDevice> (std::move (*opened));
        device->prepare (1e-3);

        // One neutral report and its answer: now the device has rested, and each report gets the next answer.
        reading = device->read();
        device->write ({});
        REQUIRE (hears (1));
        REQUIRE (takes (1));
        CHECK (heard.front() == rest);
        CHECK (steps.size() == profile->init.size());
    }

    /// Waits until the fake has heard so many reports in all.
    bool hears (std::size_t reports)
    {
        return eventually ([&] {
            if (heard.size() < reports) fake->hear (fromNow (10ms));
            return heard.size() >= reports;
        });
    }

    /// Reads until so many answers have been taken in all.
    bool takes (std::uint64_t answers)
    {
        return eventually ([&] {
            reading = device->read();
            return device->counts().taken >= answers;
        });
    }

    /// A tick of a run that nobody waits for: the fake takes a step, too. An old reading is not pushed on, as in the guard of a run.
    void tick (double newtons)
    {
        system.ns += 1'000'000;
        fake->step();
        reading = device->read();
        Effort effort;
        if (reading.valid && reading.age < watchdog) effort.force.z() = newtons;
        device->write (effort);
        test::letPass (200us);   // gives way to the threads of the port
    }

    bool pushes()
    {
        return eventually ([&] {
            tick (1.0);
            return fake->effort().force.norm() > 0.9;
        });
    }

    std::shared_ptr<const Profile> profile;
    NoHid system;
    ConnectedDevice where;
    std::unique_ptr<FakeDevice> fake;
    std::unique_ptr<HidDevice> device;   // ends before the fake
    std::vector<Bytes> sent, heard, steps;
    std::size_t set_up_at = 0;   // how many reports had been heard before the last step
    Reading reading;
};

/// The arm of a bench in a run: each tick is one report and the answer to it.
struct OnTheBench final : Device
{
    explicit OnTheBench (ArmBench& b) : bench (b), first (b.sent.size() - 1), asked (b.device->counts().taken) {}

    void prepare (double) override {}

    Reading read() noexcept override
    {
        works = works && bench.takes (asked);
        return bench.reading;
    }

    void write (const Effort& guarded) noexcept override
    {
        const auto before = bench.heard.size();
        bench.system.ns += 1'000'000;
        bench.device->write (guarded);
        works = works && bench.hears (before + 1);
        bench.fake->step();
        ++asked;
    }

    DeviceLayout layout() const override { return bench.device->layout(); }

    ArmBench& bench;
    const std::optional<std::size_t> first;   // of the answers that the run sees
    std::uint64_t asked;
    bool works = true;
};
}   // namespace

TEST_CASE ("dry wood on an arm that only answers: each torque at its far end is that of the offline run after encoding, bit for bit", "[wires][hid]")
{
    const auto graph = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
    const auto compiled = compile (graph, catalogue(), { .rate_hz = 1000.0 });
    INFO (test::text (compiled.messages));
    REQUIRE (compiled.plan);
    auto hand = makeDevice (*graph.device ("stylus"), {});
    REQUIRE (hand.device);
    ArmBench bench { std::move (hand.device) };
    OnTheBench there { bench };
    REQUIRE (checkForces (bench, there, compiled.plan, true, [] (const Bytes& heard) { return heard != rest; }));
}

TEST_CASE ("a report that pushes waits for the answer to the one before, and one that brings to rest does not", "[wires][hid][safety]")
{
    ArmBench bench;
    REQUIRE (bench.pushes());
    bench.fake->fail (DeviceFault::Kind::stall, 1.0);   // the arm is busy: it hears nothing, and answers nothing
    const auto before = bench.heard.size();
    const auto writes = bench.device->port().counts().writes;
    const auto offer = [&] (double newtons) {
        bench.system.ns += 1'000'000;   // not so much that an answer is late
        bench.reading = bench.device->read();
        Effort effort;
        effort.force.z() = newtons;
        bench.device->write (effort);
        test::letPass (1ms);   // gives way to the threads of the port
    };
    for (int k = 0; k < 8; ++k)
        offer (0.1 * k);
    CHECK (bench.device->port().counts().writes <= writes + 1);
    for (int k = 0; k < 8; ++k)   // as fast as the motors may change
        offer (0.0);
    CHECK (eventually ([&] { return bench.device->port().counts().writes > writes; }));
    const auto end = bench.fake->time() + 1.1;
    while (bench.fake->time() < end)
        bench.fake->step();
    CHECK (eventually ([&] {
        bench.fake->hear (fromNow (1ms));
        return bench.heard.size() > before && bench.heard.back() == rest;
    }));
    CHECK (bench.heard.size() <= before + 3);
    CHECK (bench.device->port().counts().write_errors == 0);
}

TEST_CASE ("an arm that has missed a byte gets fillers until it answers, and keeps what it has counted", "[wires][hid][safety]")
{
    auto hand = makeDevice ({ { "driver", "sim" }, { "position", Json::array ({ "1 cm", 0, "2 cm" }) }, { "mass", "1000 kg" } }, {});
    REQUIRE (hand.device);
    ArmBench bench { std::move (hand.device) };
    REQUIRE (bench.pushes());
    const auto position = bench.reading.position;
    const auto set_up = bench.steps.size();
    bench.fake->fail (DeviceFault::Kind::missed, 2e-3);
    const auto taken = bench.device->counts().taken;
    CHECK (eventually ([&] {
        bench.tick (0.0);   // as the guard does when the reading gets old
        return bench.device->counts().taken >= taken + 20 && bench.heard.back() == rest;
    }));
    CHECK (bench.fake->effort().force.isZero (0.0));
    CHECK ((bench.reading.position - position).norm() < 1e-4);
    CHECK (bench.steps.size() == set_up);   // else its angles would begin at 0 again
    CHECK (bench.device->port().counts().departures == 0);
    CHECK (bench.pushes());

    // The unfinished message and the filler, which makes a number of almost 0 of the last torque. No other message is torn.
    for (const auto& report : bench.heard)
        for (const std::size_t at : { 2u, 6u })
        {
            float torque = 0.0f;
            std::memcpy (&torque, report.data() + at, sizeof torque);
            CHECK (std::abs (torque) <= 0.12f);
        }
}

TEST_CASE ("garbage, half answers, lost bytes and silence make no wrong reading of an arm that only answers, and it is found again", "[wires][hid][safety]")
{
    using Kind = DeviceFault::Kind;
    const auto kind = GENERATE (Kind::garbage, Kind::half, Kind::lost_byte, Kind::stall);
    ArmBench bench;
    REQUIRE (bench.pushes());
    const auto taken = bench.device->counts().taken;
    const auto set_up = bench.steps.size();
    bench.fake->fail (kind, 0.2);
    auto before = taken;
    int since = 0;   // ticks without an answer; on a busy computer, those that were on their way come late
    for (int k = 0; k < 199; ++k)
    {
        bench.tick (0.0);
        const auto now = bench.device->counts().taken;
        since = now == before ? since + 1 : 0;
        before = now;
    }
    CHECK (bench.device->counts().taken <= taken + 2);   // those that were on their way
    CHECK (bench.reading.age >= 1e-3 * since - 1e-9);
    CHECK (eventually ([&] {
        bench.tick (0.0);
        return bench.device->counts().taken > taken + 20 && bench.reading.valid;
    }));
    CHECK (bench.steps.size() == set_up);
    CHECK (bench.device->port().counts().departures == 0);
    CHECK (bench.pushes());
}

TEST_CASE ("an arm that is reset is set up again, and its force starts from zero", "[wires][hid][safety]")
{
    ArmBench bench;
    REQUIRE (bench.pushes());
    const auto set_up = bench.steps.size();
    bench.fake->fail (DeviceFault::Kind::reset, 5e-3);
    bench.tick (1.0);
    CHECK (bench.fake->effort().force.isZero (0.0));
    CHECK (eventually ([&] {
        bench.tick (1.0);
        return bench.device->port().counts().departures == 1;
    }));
    CHECK (eventually ([&] {
        bench.tick (1.0);
        return bench.steps.size() >= set_up + bench.profile->init.size() && bench.heard.size() > bench.set_up_at;
    }));
    CHECK (bench.heard.at (bench.set_up_at) == rest);
    CHECK (bench.pushes());
}

TEST_CASE ("an arm that only answers is unplugged and comes back under another name", "[wires][hid][safety]")
{
    const TemporaryFolder folder;
    ArmBench bench { stillHand(), (folder / "arm").string() };
    REQUIRE (bench.pushes());
    const auto name = bench.fake->place();
    bench.fake->fail (DeviceFault::Kind::away, 1e-3);
    bench.fake->step();
    CHECK (bench.fake->effort().force.isZero (0.0));
    CHECK (eventually ([&] { return ! bench.device->port().isConnected(); }));
    CHECK (bench.device->read().fault == ReadingFault::unplugged);
    const auto before = bench.heard.size();
    CHECK (eventually ([&] {
        bench.tick (0.0);
        return bench.reading.valid;
    }));
    CHECK (bench.fake->place() != name);
    CHECK (std::all_of (bench.heard.begin() + static_cast<std::ptrdiff_t> (before), bench.heard.end(), [] (const auto& report) { return report == rest; }));
    CHECK (bench.pushes());
}

TEST_CASE ("an arm that nobody drives is asked where it is by the neutral report, and what nobody has asked for is dropped", "[wires][hid]")
{
    ArmBench bench;
    const auto before = bench.heard.size();
    for (int k = 1; k <= 5; ++k)
    {
        bench.system.ns += 100'000'000;
        REQUIRE (bench.hears (before + static_cast<std::size_t> (k)));
        REQUIRE (bench.takes (static_cast<std::uint64_t> (k) + 1));
    }
    CHECK (std::all_of (bench.heard.begin(), bench.heard.end(), [] (const auto& report) { return report == rest; }));

    std::string name;
    auto line = WireFile::makeTerminal (name);
    REQUIRE (line);
    ConnectedDevice there;
    there.wire = Wire::serial;
    there.path = name;
    NoHid system;
    auto wire = openWire (there, *bench.profile, system);
    REQUIRE (wire);
    Bytes answer { 5, 0, 0, 0, 0, 0, 0, 0, 0 }, got (64);
    REQUIRE (line->write (answer).size == answer.size());
    CHECK (*(*wire)->read (got, 50ms) == 0);
    REQUIRE ((*wire)->write (rest));
    CHECK ((*wire)->awaitsAnswer());
    REQUIRE (line->write (answer).size == answer.size());
    CHECK (*(*wire)->read (got, 10s) == answer.size());
    CHECK_FALSE ((*wire)->awaitsAnswer());
    wire->reset();   // only one driver uses the line

    // Recording changes nothing of this.
    const TemporaryFolder folder;
    auto file = CaptureFile::create ((folder / "arm.jsonl").string(), there, bench.profile->id, {});
    REQUIRE (file);
    CapturingSystem capturing { system, **file };
    auto recorded = capturing.reach (there, *bench.profile);
    REQUIRE (recorded);
    REQUIRE ((*recorded)->write (rest));
    CHECK ((*recorded)->awaitsAnswer());
}

TEST_CASE ("a profile of a device that only answers has one report each way, and no rate", "[wires][hid]")
{
    const auto problemOf = [] (const std::function<void (Json&)>& edit) {
        auto json = armJson();
        edit (json);
        const auto loaded = readProfile (json);
        return loaded.messages.empty() ? std::string() : loaded.messages.front().id;
    };
    CHECK (problemOf ([] (Json&) {}).empty());
    CHECK (problemOf ([] (Json& p) { p["wires"]["serial"].erase ("filler"); }).empty());
    CHECK (problemOf ([] (Json& p) { p["wires"]["serial"]["framing"] = "cobs"; }) == "profile/wire");
    CHECK (problemOf ([] (Json& p) { p["wires"]["serial"]["filler"] = 256; }) == "profile/kind");
    CHECK (problemOf ([] (Json& p) { p["rate"] = 1000; }) == "profile/wire");
    CHECK (problemOf ([] (Json& p) { p["outputs"][0]["keepalive"] = "1 s"; }) == "profile/wire");
    CHECK (problemOf ([] (Json& p) { p["inputs"][0]["longest"] = 20; }) == "profile/wire");
    CHECK (problemOf ([] (Json& p) {
               auto second = p["outputs"][0];
               second["name"] = "more";
               second["id"] = 3;
               second["neutral"] = "03 05 00*8";
               p["outputs"].push_back (second);
           })
           == "profile/wire");
}
