// SPDX-License-Identifier: MIT
// The driver of event devices in a run, against devices in memory. tests/guest has devices of the kernel.

#include "fake_events.hpp"
#include "support/sketch.hpp"
#include "support/waiting.hpp"

#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/device_plugins/plugin_device.hpp>
#include <host/drivers/evdev/driver.hpp>

#include <tactus/graph/graph.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <string>

using namespace tactus;
using namespace std::chrono_literals;
using test::eventually;
using test::FakeEvents;

namespace
{
constexpr double full = 2.5;   // N m
const Json calibration { { "full_force", "2.5 N*m" }, { "travel", { { "x", "900 deg" } } } };

/// The driver with a wheel at /nowhere/event5.
struct Wheel
{
    Wheel()
    {
        host::evdev::setSystem (events);
        auto made = host::DeviceDriver::within (host::evdev::driver);
        REQUIRE (made);
        driver = std::move (*made);
    }
    ~Wheel()
    {
        events.change (on, on.is_there);   // nothing hangs any more
        opened = {};
        host::evdev::setSystem (host::evdev::thisComputer());
    }
    Wheel (const Wheel&) = delete;
    Wheel& operator= (const Wheel&) = delete;

    void open (const std::string& port = "/nowhere/event5", const Json& of = calibration)
    {
        Messages found;
        Json description { { "driver", "evdev" }, { "port", port } };
        if (! of.is_null()) description["calibration"] = of;
        auto device_of = driver->open (description, found);
        messages = found;
        INFO (test::text (found));
        REQUIRE (device_of);
        limits = device_of->about().limits;
        // Long enough that a busy computer does not count as silent; no failsafe, as the path is that of no file.
        const host::PluginDevice::Options options { .silence_s = 5.0, .look_again = 2ms, .patience = 500ms, .real_time = false };
        opened = std::make_unique<host::PluginDevice> (std::move (device_of), std::nullopt, options);
        opened->prepare (1e-3);
    }

    std::string problem (const Json& description) const
    {
        Messages found;
        const auto device_of = driver->open (description, found);
        return test::text (found);
    }

    /// One tick with a torque if the reading is valid; true if it is.
    bool tick (double newton_metres)
    {
        reading = opened->read();
        Effort effort;
        if (reading.valid) effort.torque.y() = newton_metres;
        opened->write (effort);
        return reading.valid;
    }

    bool pushes (double newton_metres, const FakeEvents::Device& d)
    {
        const auto level = -static_cast<int> (std::lround (newton_metres / full * 32767.0));
        return eventually ([&] {
            tick (newton_metres);
            return events.acting (d) == level;
        });
    }
    bool pushes (double newton_metres) { return pushes (newton_metres, on); }

    FakeEvents events;
    FakeEvents::Device& on = events.add (FakeEvents::wheel());
    std::shared_ptr<const host::DeviceDriver> driver;
    std::unique_ptr<host::PluginDevice> opened;
    Messages messages;
    GuardLimits limits;
    Reading reading;
};
}   // namespace

TEST_CASE ("a wheel at an event device is turned and pushed by a run, and rests at its end", "[evdev]")
{
    Wheel w;
    w.open();
    CHECK (w.messages.empty());
    CHECK (w.limits.max_torque == full);
    CHECK_FALSE (w.tick (1.0));   // nothing has come from it yet
    CHECK (w.reading.fault == ReadingFault::no_report);
    w.events.move (w.on, 65535);
    REQUIRE (w.pushes (1.0));
    CHECK (w.reading.rotation.y() == Approx (2.5 * 3.14159265).epsilon (1e-4));
    REQUIRE (w.pushes (-2.0));
    CHECK (w.opened->about().layout.buttons == std::vector<std::string> { "trigger", "thumb" });
    CHECK (eventually ([&] {   // it says how often a new force reaches the wheel
        w.tick (w.tick (1.0) ? 1.1 : 1.0);
        return w.opened->counts().reached_hz > 0.0;
    }));
    w.opened.reset();
    const auto told = w.events.told (w.on);
    const auto last = std::find_if (told.rbegin(), told.rend(), [] (const FakeEvents::Told& t) { return t.what == "upload"; });
    REQUIRE (last != told.rend());
    CHECK (last->level == 0);
    CHECK (w.events.acting (w.on) == 0);
    CHECK_FALSE (w.events.with ([&] { return w.on.is_open; }));
}

TEST_CASE ("a wheel without a calibration is weak, and the person is told", "[evdev][safety]")
{
    Wheel w;
    w.open ("/nowhere/event5", {});
    REQUIRE (w.messages.size() == 1);
    CHECK (w.messages[0].id == "device/remark");
    CHECK (w.messages[0].severity == Message::Severity::warning);
    CHECK (w.messages[0].text.find ("does not report its strength") != std::string::npos);
    CHECK (w.limits.max_force == 1.0);
    w.events.move (w.on, 1);
    REQUIRE (eventually ([&] { return w.tick (0.0); }));
    Effort effort;
    effort.force.x() = 1000.0;
    CHECK (eventually ([&] {
        w.opened->read();
        w.opened->write (effort);
        return w.events.acting (w.on) == -3277;
    }));
}

TEST_CASE ("an update that does not return holds up no tick, and the newest force counts afterwards", "[evdev][safety]")
{
    Wheel w;
    w.open();
    w.events.move (w.on, 1);
    REQUIRE (w.pushes (1.0));
    w.events.change (w.on, true, true);
    for (int i = 0; i < 1000; ++i)   // if one of them waited, they would never end
        w.tick (0.5);
    const auto before = w.events.told (w.on).size();
    w.events.change (w.on, true, false);
    REQUIRE (w.pushes (0.25));
    const auto told = w.events.told (w.on);
    int late = 0;   // of the thousand efforts of before, only the one that hung and the newest may come
    for (auto i = before; i < told.size(); ++i)
        if (told[i].what == "upload" && told[i].level == -static_cast<int> (std::lround (0.5 / full * 32767.0))) ++late;
    CHECK (late <= 2);
}

TEST_CASE ("a wheel that is unplugged is found again under another number, and no other device takes its place", "[evdev][safety]")
{
    Wheel w;
    w.open();
    w.events.move (w.on, 1);
    REQUIRE (w.pushes (1.0));
    w.events.change (w.on, false);
    REQUIRE (eventually ([&] {
        w.tick (1.0);
        return ! w.opened->isConnected() && w.reading.fault != ReadingFault::none;
    }));

    // Another device is now at the same number. The calibration is not meant for it.
    auto other = FakeEvents::wheel();
    other.name = "Another wheel";
    auto& stranger = w.events.add (other);
    REQUIRE (eventually ([&] { return w.opened->trouble().find ("which was at this port, is gone") != std::string::npos; }));
    CHECK (w.events.told (stranger).empty());

    auto moved = FakeEvents::wheel();
    moved.path = "/dev/null";   // the guardian must be able to open it
    auto& again = w.events.add (moved);
    const bool is_back = eventually ([&] { return w.opened->isConnected(); });
    INFO (w.opened->trouble());
    REQUIRE (is_back);
    CHECK_FALSE (w.tick (1.0));   // it has said nothing yet
    w.events.move (again, 65535);
    REQUIRE (w.pushes (1.0, again));
    CHECK (w.events.told (stranger).empty());
    CHECK (w.opened->counts().departures == 1);
    w.opened.reset();
    CHECK (w.events.acting (again) == 0);
}

TEST_CASE ("one of two identical wheels that is plugged in again is found, although the other one is in use", "[evdev]")
{
    const bool has_places = GENERATE (true, false);
    Wheel w;
    auto twin = FakeEvents::wheel();
    twin.path = "/nowhere/event6";
    if (has_places) w.on.info.place = "usb-1/input0", twin.place = "usb-2/input0";
    auto& second = w.events.add (twin);
    w.open();
    Messages found;
    auto in_use = w.driver->open ({ { "driver", "evdev" }, { "port", "/nowhere/event6" }, { "calibration", calibration } }, found);
    REQUIRE (in_use);
    w.events.move (w.on, 1);
    REQUIRE (w.pushes (1.0));
    w.events.change (w.on, false);
    REQUIRE (eventually ([&] {
        w.tick (1.0);
        return ! w.opened->isConnected();
    }));
    auto back = w.on.info;
    back.path = "/dev/null";   // the guardian must be able to open it
    auto& again = w.events.add (back);
    const bool is_back = eventually ([&] { return w.opened->isConnected(); });
    INFO (w.opened->trouble());
    REQUIRE (is_back);
    w.events.move (again, 65535);
    CHECK (w.pushes (1.0, again));
    CHECK (w.events.acting (second) == 0);

    // Both go, and the other one comes first.
    w.events.change (second, false);
    w.events.change (again, false);
    REQUIRE (eventually ([&] {
        w.tick (1.0);
        return ! w.opened->isConnected();
    }));
    tactus_reading reading;
    tactus_device_stamp stamp;
    host::DriverReport why;
    REQUIRE (in_use->read (1ms, reading, stamp, why) == TACTUS_DEVICE_GONE);
    in_use.reset();
    if (! has_places) return;   // nothing tells them apart
    twin.path = "/dev/zero";
    back.path = "/dev/full";
    auto& other = w.events.add (twin);
    REQUIRE (eventually ([&] { return w.opened->trouble().find ("which was at this port, is gone") != std::string::npos; }));
    CHECK (w.events.told (other).empty());
    auto& own = w.events.add (back);
    REQUIRE (eventually ([&] { return w.opened->isConnected(); }));
    w.events.move (own, 65535);
    CHECK (w.pushes (1.0, own));
    CHECK (w.events.told (other).empty());
}

TEST_CASE ("a wheel gets its gain and its centring spring back, and the person is told of what the kernel does not tell", "[evdev]")
{
    Wheel w;
    w.open();
    CHECK (w.messages.empty());
    w.events.move (w.on, 1);
    REQUIRE (w.pushes (1.0));
    w.opened.reset();
    const auto last = [&] (const char* what) {
        int level = -1;
        for (const auto& t : w.events.told (w.on))
            if (t.what == what) level = t.level;
        return level;
    };
    CHECK (last ("gain") == 0x9000);
    CHECK (last ("autocenter") == 0x4000);
    int before = 0, largest = 0;   // the spring comes back in steps
    for (const auto& t : w.events.told (w.on))
        if (t.what == "autocenter") largest = std::max (largest, t.level - std::exchange (before, t.level));
    CHECK (largest <= 0x4000 / 10);
    CHECK (w.events.acting (w.on) == 0);

    w.events.with ([&] {
        w.on.info.gain.reset();
        w.on.info.autocenter.reset();
    });
    w.open();
    REQUIRE (w.messages.size() == 1);
    CHECK (w.messages[0].id == "device/remark");
    CHECK (w.messages[0].text.find ("the kernel does not tell the gain and the centring spring of Test wheel") != std::string::npos);
    CHECK (w.messages[0].text.find ("so after the program ends, the gain stays full and the spring stays off") != std::string::npos);
    w.opened.reset();
    CHECK (last ("gain") == 0xffff);
    CHECK (last ("autocenter") == 0);
}

TEST_CASE ("a wheel that only a write finds to be gone is remembered, too, so that no other device takes its place", "[evdev][safety]")
{
    Wheel w;
    w.open();
    w.events.move (w.on, 1);
    REQUIRE (w.pushes (1.0));
    auto other = FakeEvents::wheel();
    other.name = "Another wheel";
    auto& stranger = w.events.add (other);
    w.events.with ([&] { w.on.is_there = w.on.is_read = false; });
    double push = 0.0;
    REQUIRE (eventually ([&] {
        w.tick (push = 0.5 - push);
        return w.opened->counts().departures > 0 && ! w.opened->trouble().starts_with ("the device is gone");
    }));
    CHECK (w.opened->trouble().find ("which was at this port, is gone") != std::string::npos);
    CHECK_FALSE (w.opened->isConnected());
    CHECK (w.events.told (stranger).empty());
}

TEST_CASE ("a graph that brakes a stick along an axis without a motor hides no energy from the guard", "[evdev][safety]")
{
    Wheel stick;
    stick.on.info.axes.push_back ({ .code = ABS_Y, .name = "y", .minimum = 0, .maximum = 65535, .value = 32768 });
    stick.open ("/nowhere/event5", { { "full_force", "4 N" }, { "travel", { { "x", "12 cm" }, { "y", "12 cm" } } } });
    auto limits = stick.limits;
    CHECK (limits.max_energy == Approx (0.24));
    limits.watchdog = GuardLimits::none;   // a busy computer does not end this run
    Guard guard;
    guard.prepare (limits, 1e-3);
    constexpr double radius = 0.03, turns_per_s = 2.0, damping = 20.0;
    const auto count = [] (double x) { return static_cast<int> (std::lround (65535.0 * (0.5 + x / 0.12))); };
    double given = 0.0;   // to the hand by the motor, in J
    int k = 0;
    Vec3 asked = Vec3::Zero();
    for (; k < 2500 && guard.stop() != Guard::Stop::energy; ++k)
    {
        // The hand moves in a circle. The graph pushes with it along x, and as much against it along y.
        const double angle = 2.0 * 3.14159265358979 * turns_per_s * 1e-3 * k, speed = 2.0 * 3.14159265358979 * turns_per_s * radius;
        const Vec3 at { radius * std::cos (angle), radius * std::sin (angle), 0.0 }, velocity { -speed * std::sin (angle), speed * std::cos (angle), 0.0 };
        stick.events.send (stick.on, { { EV_ABS, ABS_X, count (at.x()), 0.0 }, { EV_ABS, ABS_Y, count (-at.y()), 0.0 }, { EV_SYN, SYN_REPORT, 0, 0.0 } });
        auto& reading = stick.reading;
        REQUIRE (eventually ([&] {
            reading = stick.opened->read();
            return (reading.position - at).norm() < 4e-6;
        }));
        reading.age = 0.0;
        asked = guard ({ .force = { damping * velocity.x(), -damping * velocity.y(), 0.0 } }, reading).force;
        given += asked.x() * velocity.x() * 1e-3;
        stick.opened->write ({ .force = asked });
        // The force along x is there, as fast as the slew allows by the wall clock, and all of that along y is said to be missing.
        REQUIRE (eventually ([&] { return (stick.opened->read().unrendered_force - Vec3 (0.0, asked.y(), 0.0)).norm() < 1e-12; }));
    }
    CHECK (guard.stop() == Guard::Stop::energy);
    CHECK (given < limits.max_energy * (1.0 + 1e-3 * k / limits.energy_window) + 0.01);
    CHECK (given > 0.5 * limits.max_energy);
}

TEST_CASE ("an event device is chosen by its path, its name or a part of it, and what is wrong is said", "[evdev]")
{
    Wheel w;
    w.open ("Test wheel");
    w.opened.reset();
    w.open ("wheel");
    w.opened.reset();
    const auto of = [&] (const char* port) { return w.problem ({ { "driver", "evdev" }, { "port", port }, { "calibration", calibration } }); };
    CHECK (of ("/nowhere/event7").find ("No such file") != std::string::npos);
    CHECK (of ("Lawn mower").find ("no device with force feedback is called 'Lawn mower'") != std::string::npos);
    CHECK (w.problem ({ { "driver", "evdev" } }).find ("name the device") != std::string::npos);
    auto second = FakeEvents::wheel();
    second.path = "/nowhere/event8";
    auto& other = w.events.add (second);
    CHECK (of ("wheel").find ("2 devices are called 'wheel'") != std::string::npos);
    other.is_there = false;

    w.on.is_denied = true;
    CHECK (of ("wheel").find (R"(ATTRS{id/product}=="c24f")") != std::string::npos);
    w.on.is_denied = false;
    w.on.upload_fails = ENOSPC;
    CHECK (of ("wheel").find ("no room for another effect") != std::string::npos);
    w.on.upload_fails = 0;
    w.on.info.has_constant = false;
    CHECK (of ("/nowhere/event5").find ("has no force feedback") != std::string::npos);
    w.on.info.has_constant = true;

    const auto with = [&] (const char* key, const Json& value) {
        Json d { { "driver", "evdev" }, { "port", "wheel" } };
        d[key] = value;
        return w.problem (d);
    };
    CHECK (with ("calibration", { { "travel", { { "x", "900 deg" } } } }).find ("900 deg") != std::string::npos);   // an angle without a torque
    CHECK (with ("calibration", { { "travel", { { "x", "10 cm" } } } }).find ("full_force") != std::string::npos);
    CHECK (with ("calibration", { { "full_force", "4 N" }, { "travel", { { "w", "10 cm" } } } }).find ("no axis 'w'") != std::string::npos);
    CHECK (with ("max_rate", 5000).find ("max_rate") != std::string::npos);
    CHECK (with ("colour", "red").find ("colour") != std::string::npos);
    CHECK_FALSE (w.events.with ([&] { return w.on.is_open; }));   // nothing stays open after an error
}

TEST_CASE ("event devices attacked by a graph: it opens none, calibrates none, and its guard only tightens", "[evdev][safety]")
{
    Wheel w;
    const Json wanted { { "driver", "evdev" },
                        { "port", "/nowhere/event5" },
                        { "max_rate", 1000 },
                        { "calibration", { { "full_force", "1000 N*m" }, { "travel", { { "x", "900 deg" } } } } } };
    CHECK_FALSE (isSimulated (wanted));
    Messages said;
    const auto used = describedByGraph (&wanted, "stylus", said);
    const auto made = makeDevice (used, {});
    CHECK_FALSE (made.device);
    CHECK (hasErrors (made.messages));
    CHECK (w.events.told (w.on).empty());
    CHECK_FALSE (w.events.with ([&] { return w.on.is_open; }));

    // The person has chosen and calibrated the wheel. A guard, from wherever, cannot raise what follows from that.
    const auto made_for_person = host::openPluginDevice (*w.driver, { { "driver", "evdev" },
                                                                      { "port", "wheel" },
                                                                      { "calibration", calibration },
                                                                      { "guard", { { "max_torque", "1000 N*m" }, { "max_angular_speed", "5 rad/s" } } } });
    CHECK (made_for_person.limits.max_torque == full);
    CHECK (made_for_person.limits.max_torque_slew == 250.0 * full);
    CHECK (made_for_person.limits.max_angular_speed == 5.0);
    CHECK (tightened (made_for_person.limits, { .max_torque = 1000.0, .max_torque_slew = 1e9 }).max_torque == full);
}
