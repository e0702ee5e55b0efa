// SPDX-License-Identifier: MIT
// A driver that lies, hangs, spins or loses its device: what the run reads, and what reaches the device.
#include "fake_driver.hpp"
#include "support/waiting.hpp"

#include <support/temporary_folder.hpp>
#include <support/tick_thread_locks.hpp>

#include <tactus/run/guard.hpp>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

using namespace tactus;
using namespace std::chrono_literals;
using host::PluginDevice;
using test::eventually;
using test::FakeDriver;
using test::good;

namespace
{
constexpr double watchdog = 0.2;   // of the guard, in s

/// A device under a run of 1 kHz that pushes with 1 N.
struct Pushed
{
    explicit Pushed (FakeDriver& f, PluginDevice::Options options = FakeDriver::usual()) : fake (f), device (f.open (options))
    {
        guard.prepare ({ .max_force = 2.0, .ramp = 0.005, .watchdog = watchdog }, 1e-3);
    }

    double tick()
    {
        reading = device->read();
        const auto& applied = guard ({ { 1.0, 0.0, 0.0 }, Vec3::Zero() }, reading);
        device->write (applied);
        test::letPass (1ms);
        return applied.force.x();
    }

    /// Ticks with good readings until the force is there.
    void push()
    {
        REQUIRE (eventually ([&] {
            fake.send (1e-6 * ++k);
            return tick() == 1.0;
        }));
    }

    /// Ticks, with something before each tick, until the guard withholds the force. False if it never does.
    template <typename F>
    bool stopsWhile (F&& each)
    {
        return eventually ([&] {
            each();
            return tick() == 0.0 && guard.stop() == Guard::Stop::stale;
        });
    }

    std::string why() const { return describe (guard.latest()); }

    FakeDriver& fake;
    std::unique_ptr<PluginDevice> device;
    Guard guard;
    Reading reading;
    int k = 0;
};

std::string contentOf (const std::string& file)
{
    std::ifstream in (file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}
}   // namespace

TEST_CASE ("a device of a driver: readings arrive, efforts reach it, and it is at rest first and last", "[plugins][safety]")
{
    FakeDriver fake;
    fake.axes = { "twist" };
    fake.buttons = { "grip", "" };
    {
        Pushed run (fake);
        CHECK (fake.lastTold() == "rest");
        CHECK (run.device->layout().axes == std::vector<std::string> { "twist" });
        run.device->read();
        run.device->write ({});   // the guard is at zero

        auto sent = good (7);
        sent.reading.position[1] = 0.01;
        sent.reading.axis_count = 1;
        sent.reading.axes[0] = 0.3;
        sent.reading.buttons = 0xff;
        const auto reading = readingOf (*run.device, fake, sent);
        CHECK (reading.valid);
        CHECK (reading.position == Vec3 (0.0, 0.01, 0.0));
        CHECK (reading.axes[0] == 0.3);
        CHECK (reading.buttons == 3u);   // of the others it has no names
        CHECK (run.device->read().age > 0.0);
    }
    const auto all = fake.told();
    REQUIRE (all.size() >= 4);
    CHECK (all[0].what == "open");
    CHECK (all[1].what == "rest");
    CHECK (all[all.size() - 2].what == "rest");
    CHECK (all.back().what == "close");
}

TEST_CASE ("the force of a driver rises along the ramp of its guard, and never before the guard was at zero", "[plugins][safety]")
{
    FakeDriver fake;
    Pushed run (fake);
    run.device->read();
    run.device->write ({ .force = { 1.0, 0.0, 0.0 } });   // as if the guard were not at zero
    REQUIRE (eventually ([&] { return fake.count ("force") > 0; }));
    CHECK (fake.lastEffort().force[0] == 0.0);
    run.push();
    REQUIRE (eventually ([&] { return fake.lastEffort().force[0] == 1.0; }));
    CHECK (std::ranges::is_sorted (fake.told(), {}, &FakeDriver::Told::force));
}

TEST_CASE ("a driver that reports something that is not a number, too little or too much", "[plugins][safety]")
{
    FakeDriver fake;
    fake.axes = { "twist", "squeeze" };
    fake.signal_inputs = 1;
    fake.rate_hz = 0.0;   // on a busy computer, the test sends them late
    fake.stamps = 0;
    fake.tool = TACTUS_DEVICE_POSITION | TACTUS_DEVICE_ROTATION | TACTUS_DEVICE_PRESSURE;
    const auto device = fake.open();
    device->read();
    device->write ({});

    auto whole = good();
    whole.reading.axis_count = 2;
    whole.reading.signal_count = 1;
    CHECK (readingOf (*device, fake, whole).valid);

    const auto isRefused = [&] (auto change) {
        auto bad = whole;
        change (bad.reading);
        const auto reading = readingOf (*device, fake, bad);
        return ! reading.valid && reading.fault == ReadingFault::malformed;
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
    CHECK (isRefused ([] (tactus_reading& r) { r.position[2] = nan; }));
    CHECK (isRefused ([] (tactus_reading& r) { r.rotation[0] = inf; }));
    CHECK (isRefused ([] (tactus_reading& r) { r.pressure = -inf; }));
    CHECK (isRefused ([] (tactus_reading& r) { r.age_s = nan; }));
    CHECK (isRefused ([] (tactus_reading& r) { r.axes[1] = nan; }));
    CHECK (isRefused ([] (tactus_reading& r) { r.signals[0] = nan; }));
    CHECK (isRefused ([] (tactus_reading& r) { r.axis_count = 1; }));
    CHECK (isRefused ([] (tactus_reading& r) { r.signal_count = 0; }));
    CHECK (isRefused ([] (tactus_reading& r) { r.age_s = -1.0; }));   // from the future: it would count as fresh for too long
    CHECK (device->counts().refused == 9);

    auto more = whole;
    more.reading.axis_count = 4'000'000'000u;
    more.reading.axes[2] = nan;
    const auto cut = readingOf (*device, fake, more);
    CHECK (cut.valid);
    CHECK (cut.axes.size() == 2);
}

TEST_CASE ("what a driver has not named, it does not have", "[plugins]")
{
    FakeDriver fake;
    fake.tool = TACTUS_DEVICE_ROTATION;
    const auto device = fake.open();
    auto sent = good();
    sent.reading.position[0] = 1.0;
    sent.reading.rotation[0] = 0.5;
    sent.reading.pressure = 3.0;
    sent.reading.buttons = 1;
    const auto reading = readingOf (*device, fake, sent);
    CHECK (reading.position == Vec3 (Vec3::Zero()));
    CHECK (reading.rotation.x() == 0.5);
    CHECK (reading.pressure == 0.0);
    CHECK (reading.buttons == 0u);
}

TEST_CASE ("a device that reports a fault itself loses the force, and the stop names it", "[plugins][safety]")
{
    FakeDriver fake;
    Pushed run (fake);
    run.push();
    auto hot = good();
    hot.fault = TACTUS_DEVICE_TOO_HOT;
    hot.number = 1'000'000;
    CHECK (run.stopsWhile ([&] {
        ++hot.number;
        fake.send (hot);
    }));
    CHECK (run.guard.latest().fault == ReadingFault::too_hot);
    hot.fault = 999;
    REQUIRE (eventually ([&] {
        ++hot.number;
        fake.send (hot);
        run.tick();
        return run.reading.fault == ReadingFault::failed;
    }));
}

TEST_CASE ("a driver that repeats a reading loses the force like a silent one", "[plugins][safety]")
{
    FakeDriver fake;
    Pushed run (fake);
    run.push();
    const auto again = good (static_cast<std::uint64_t> (run.k));
    CHECK (run.stopsWhile ([&] { fake.send (again); }));
    CHECK (run.why().starts_with ("the device repeats the same report"));
    run.push();
}

TEST_CASE ("a driver that falls silent loses the force, and the age of the reading is real", "[plugins][safety]")
{
    FakeDriver fake;
    Pushed run (fake);
    const test::Stopwatch watch;
    run.push();
    CHECK (run.stopsWhile ([] {}));
    CHECK (run.reading.age > watchdog);
    CHECK (run.reading.age <= watch.s());
    run.push();
}

TEST_CASE ("a read that never returns stops the force, and the device is at rest when the run ends without it", "[plugins][safety]")
{
    FakeDriver fake;
    {
        Pushed run (fake);
        run.push();
        fake.read_hangs = true;
        CHECK (run.stopsWhile ([] {}));
        REQUIRE (eventually ([&] {
            run.tick();
            return run.reading.fault == ReadingFault::stuck;
        }));
        CHECK_FALSE (run.reading.valid);
        CHECK (run.device->trouble().starts_with ("the driver has not returned from `read` for 0."));
    }
    CHECK (fake.lastTold() == "rest");   // not closed: `read` still uses it
    CHECK (fake.count ("close") == 0);
    fake.letGo();
    CHECK (eventually ([&] { return fake.lastTold() == "close"; }));   // then the thread closes it
}

TEST_CASE ("a close that never returns does not keep the program", "[plugins][safety]")
{
    FakeDriver fake;
    {
        Pushed run (fake);
        run.push();
        fake.close_hangs = true;
    }
    CHECK (fake.lastTold() == "rest");
    fake.letGo();
    CHECK (eventually ([&] { return fake.lastTold() == "close"; }));
}

TEST_CASE ("a write that never returns stops the force, and the guardian takes the device", "[plugins][safety]")
{
    const TemporaryFolder folder;
    FakeDriver fake;
    fake.rest_file = (folder / "device").string();
    std::ofstream { fake.rest_file }.close();
    const auto alarms = host::Failsafe::alarms();
    {
        auto options = FakeDriver::usual();
        options.silence_s = 0.3;
        Pushed run (fake, options);
        CHECK (contentOf (fake.rest_file).empty());
        run.push();
        fake.write_hangs = true;
        REQUIRE (eventually ([&] {
            fake.send (1e-6 * ++run.k);
            run.tick();
            return run.reading.fault == ReadingFault::stuck;
        }));
        CHECK_FALSE (run.reading.valid);
        CHECK (run.device->trouble().starts_with ("the driver has not returned from `write`"));
        CHECK (eventually ([&] { return contentOf (fake.rest_file).starts_with ("rest!"); }));
        CHECK (host::Failsafe::alarms() > alarms);   // all forces of the run go to zero until someone rearms
        CHECK (host::Failsafe::alarm().id == "run/frozen");

        fake.letGo();   // then it is opened again, because the guardian has it
        CHECK (eventually ([&] { return fake.count ("open") >= 2; }));
        CHECK (eventually ([&] {
            run.tick();
            return run.reading.fault != ReadingFault::stuck;
        }));
    }
    CHECK (fake.lastTold() == "close");
}

TEST_CASE ("if no effort is offered any more, the device is brought to rest, again and again until it is", "[plugins][safety]")
{
    FakeDriver fake;
    auto options = FakeDriver::usual();
    options.silence_s = 0.2;
    Pushed run (fake, options);
    run.push();
    fake.rest_fails = true;
    const auto before = run.device->counts().silences;
    const auto rests = fake.count ("rest");
    REQUIRE (eventually ([&] { return fake.count ("rest") > rests + 3; }));   // the run does not tick
    CHECK (run.device->isDriven());
    CHECK (run.device->trouble() == "the device does not come to rest: it is stuck");
    fake.rest_fails = false;
    REQUIRE (eventually ([&] { return ! run.device->isDriven(); }));
    CHECK (run.device->counts().silences == before + 1);

    fake.send (1e-6 * ++run.k);
    run.tick();
    CHECK_FALSE (run.reading.valid);   // from zero again
    run.push();
}

TEST_CASE ("a device that did not come to rest gets no effort before it has, although the run goes on, and then starts from zero", "[plugins][safety]")
{
    FakeDriver fake;
    auto options = FakeDriver::usual();
    options.silence_s = 0.2;
    Pushed run (fake, options);
    run.push();
    fake.rest_fails = true;
    const auto rests = fake.count ("rest");
    REQUIRE (eventually ([&] { return fake.count ("rest") > rests; }));   // the run does not tick
    const auto forces = fake.count ("force");
    for (int k = 0; k < 500; ++k)
    {
        fake.send (1e-6 * ++run.k);
        run.tick();
    }
    CHECK (fake.count ("force") == forces);
    CHECK (run.device->isDriven());
    CHECK (run.device->trouble() == "the device does not come to rest: it is stuck");
    fake.rest_fails = false;
    REQUIRE (eventually ([&] { return ! run.device->isDriven(); }));
    fake.send (1e-6 * ++run.k);
    run.tick();
    CHECK_FALSE (run.reading.valid);
    run.push();
    CHECK (fake.count ("force") > forces);
}

TEST_CASE ("a driver whose writes take long is named", "[plugins]")
{
    FakeDriver fake;
    Pushed run (fake);
    run.push();
    fake.write_takes_ms = 40;
    REQUIRE (eventually ([&] {
        fake.send (1e-6 * ++run.k);
        run.tick();
        return run.device->trouble().find ("`write` of the driver takes longer than 20 ms") == 0;
    }));
    fake.write_takes_ms = 0;
}

TEST_CASE ("a driver that cannot write any more brings the device to rest, and if it cannot, the guardian does", "[plugins][safety]")
{
    const TemporaryFolder folder;
    FakeDriver fake;
    fake.rest_file = (folder / "device").string();
    std::ofstream { fake.rest_file }.close();
    auto options = FakeDriver::usual();
    options.silence_s = 0.2;
    Pushed run (fake, options);
    const auto tickUntil = [&] (auto so) {
        return eventually ([&] {
            fake.send (1e-6 * ++run.k);
            run.tick();
            return so();
        });
    };
    run.push();
    auto rests = fake.count ("rest");
    fake.write_answer = TACTUS_DEVICE_FAILED;
    REQUIRE (tickUntil ([&] { return fake.count ("rest") > rests; }));
    CHECK (run.device->counts().write_errors > 0);
    fake.write_answer = TACTUS_DEVICE_OK;
    run.push();

    rests = fake.count ("rest");
    fake.write_answer = TACTUS_DEVICE_FAILED;
    fake.rest_fails = true;
    REQUIRE (tickUntil ([&] { return contentOf (fake.rest_file).starts_with ("rest!"); }));
    CHECK (fake.count ("rest") > rests);
    fake.write_answer = TACTUS_DEVICE_OK;
    fake.rest_fails = false;
    REQUIRE (tickUntil ([&] { return fake.count ("open") >= 2; }));   // because the guardian has it
    run.push();
}

TEST_CASE ("a device that comes back is not driven while its failsafe cannot be armed", "[plugins][safety]")
{
    const TemporaryFolder folder;
    FakeDriver fake;
    fake.rest_file = (folder / "device").string();
    std::ofstream { fake.rest_file }.close();
    Pushed run (fake);
    run.push();
    std::filesystem::remove (fake.rest_file);
    const auto opened = fake.count ("open");
    fake.is_gone = true;
    REQUIRE (eventually ([&] { return fake.count ("open") > opened; }));
    fake.is_gone = false;
    REQUIRE (eventually ([&] { return run.device->trouble().starts_with ("if this program dies, nothing brings the device to rest"); }));
    CHECK_FALSE (run.device->isConnected());
    std::ofstream { fake.rest_file }.close();
    REQUIRE (eventually ([&] { return run.device->isConnected(); }));
    CHECK (run.device->trouble().empty());
    run.push();
}

TEST_CASE ("a device that does not come to rest at the end is left to the guardian", "[plugins][safety]")
{
    const TemporaryFolder folder;
    FakeDriver fake;
    fake.rest_file = (folder / "device").string();
    std::ofstream { fake.rest_file }.close();
    {
        Pushed run (fake);
        do
            run.push();
        while (! run.device->isDriven());   // on a busy computer, the guardian may have taken it meanwhile
        fake.rest_fails = true;
    }
    CHECK (fake.count ("rest") > 3);
    CHECK (fake.lastTold() == "close");
    CHECK (eventually ([&] { return contentOf (fake.rest_file).starts_with ("rest!"); }));
}

TEST_CASE ("a device that is gone is closed and opened again, and pushes from zero", "[plugins][safety]")
{
    FakeDriver fake;
    Pushed run (fake);
    run.push();
    fake.opens = false;
    fake.is_gone = true;
    CHECK (run.stopsWhile ([] {}));
    REQUIRE (eventually ([&] {
        run.tick();
        return run.reading.fault == ReadingFault::unplugged;
    }));
    CHECK_FALSE (run.reading.valid);
    REQUIRE (eventually ([&] { return fake.count ("close") == 1; }));
    REQUIRE (eventually ([&] { return run.device->trouble().find ("nobody is there") != std::string::npos; }));
    CHECK_FALSE (run.device->isConnected());
    const auto before = fake.told().size();
    fake.is_gone = false;
    fake.opens = true;
    REQUIRE (eventually ([&] { return run.device->isConnected(); }));
    CHECK (run.device->counts().departures == 1);
    run.tick();
    REQUIRE (eventually ([&] { return fake.told().size() >= before + 3; }));
    const auto all = fake.told();
    CHECK (all[before].what == "open");
    CHECK (all[before + 1].what == "rest");
    CHECK (all[before + 2].what == "force");
    CHECK (all[before + 2].force == 0.0);
    run.push();
}

TEST_CASE ("a write that says that the device is gone counts, too", "[plugins][safety]")
{
    FakeDriver fake;
    Pushed run (fake);
    run.push();
    fake.write_answer = TACTUS_DEVICE_GONE;
    REQUIRE (eventually ([&] {
        run.tick();
        return fake.count ("open") >= 2;
    }));
    fake.write_answer = TACTUS_DEVICE_OK;
    run.push();
}

TEST_CASE ("another device in the place of the one that is gone is not driven", "[plugins][safety]")
{
    FakeDriver fake;
    Pushed run (fake);
    run.push();
    fake.guard = R"({"max_force": "20 N", "ramp": "10 ms", "watchdog": "50 ms"})";
    fake.is_gone = true;
    REQUIRE (eventually ([&] { return fake.count ("open") >= 2; }));
    fake.is_gone = false;
    REQUIRE (eventually ([&] { return run.device->trouble().find ("other parts or limits") != std::string::npos; }));
    CHECK_FALSE (run.device->isConnected());
    CHECK (run.stopsWhile ([] {}));
}

TEST_CASE ("a driver that returns at once, again and again, is called more slowly", "[plugins][safety]")
{
    FakeDriver fake;
    fake.spins = true;
    const auto device = fake.open();
    const test::Stopwatch watch;
    const auto before = fake.reads();
    test::letPass (200ms);
    const auto reads = fake.reads() - before;
    CHECK (reads < 20e3 * watch.s() + 100.0);
    CHECK (device->counts().held_up > 0);
}

TEST_CASE ("a driver whose reads fail says why, and its reading gets old", "[plugins][safety]")
{
    FakeDriver fake;
    Pushed run (fake);
    run.push();
    FakeDriver::Sent broken;
    broken.answer = TACTUS_DEVICE_FAILED;
    CHECK (run.stopsWhile ([&] { fake.send (broken); }));
    CHECK (run.device->counts().read_errors > 0);
    CHECK (run.device->trouble() == "the driver cannot read: it is broken");
    broken.answer = 77;   // no driver may answer this
    const auto errors = run.device->counts().read_errors;
    fake.send (broken);
    CHECK (eventually ([&] { return run.device->counts().read_errors > errors; }));
}

TEST_CASE ("ticks of a device of a driver lock and allocate nothing", "[plugins]")
{
    FakeDriver fake;
    fake.axes = { "twist" };
    const auto device = fake.open();
    AbsoluteTimer clock { 1e-3 };
    test::checkThatTicksLockNothing (clock, device.get(), 200, [&] {
        auto sent = good();
        sent.reading.axis_count = 1;
        fake.send (sent);
        test::letPass (1ms);
    });
    CHECK (device->counts().readings > 0);
    CHECK (device->counts().writes > 0);
}
