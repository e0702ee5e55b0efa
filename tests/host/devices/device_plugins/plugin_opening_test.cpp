// SPDX-License-Identifier: MIT
// What a driver says of its device when it is opened: what is believed, what is tightened, and what is refused.
#include "fake_driver.hpp"
#include "support/waiting.hpp"

using namespace tactus;
using namespace std::chrono_literals;
using test::FakeDriver;

namespace
{
std::string idOf (const Messages& messages) { return messages.empty() ? std::string() : messages.front().id; }
}   // namespace

TEST_CASE ("a session tightens the limits of a driver, and never loosens them", "[plugins][safety]")
{
    FakeDriver fake;
    fake.guard = R"({"max_force": "2 N", "max_slew": "500 N/s", "max_speed": "1 m/s"})";
    const auto made = [&] (const char* guard) { return host::openPluginDevice (*fake.driver, { { "driver", "fake" }, { "guard", Json::parse (guard) } }); };
    const auto loose = made (R"({"max_force": "50 N", "max_speed": "9 m/s", "ramp": "1 ms", "watchdog": "9 s"})");
    REQUIRE (loose.device);
    CHECK (loose.limits.max_force == 2.0);
    CHECK (loose.limits.max_slew == 500.0);
    CHECK (loose.limits.max_speed == 1.0);
    CHECK (loose.limits.ramp == 0.2);
    CHECK (loose.limits.watchdog == GuardLimits::default_watchdog);
    const auto tight = made (R"({"max_force": "0.5 N", "watchdog": "10 ms"})");
    REQUIRE (tight.device);
    CHECK (tight.limits.max_force == 0.5);
    CHECK (tight.limits.watchdog == 0.01);
    CHECK (idOf (made (R"({"max_farce": 1})").messages) == "device/unknown_key");
}

TEST_CASE ("a description that the driver refuses opens nothing", "[plugins]")
{
    FakeDriver fake;
    const auto idFor = [&] (const Json& description) {
        Messages messages;
        const auto opened = fake.driver->open (description, messages);
        CHECK_FALSE (opened);
        return idOf (messages);
    };
    CHECK (idFor ({ { "driver", "fake" }, { "port", "wrong" } }) == "device/refused");
    CHECK (idFor ({ { "driver", "fake" }, { "prot", "a" } }) == "device/unknown_key");
    CHECK (idFor ({ { "driver", "fake" }, { "port", 3 } }) == "device/kind");
    CHECK (fake.told().empty());
    fake.opens = false;
    CHECK (idFor ({ { "driver", "fake" }, { "port", "a" } }) == "device/not_opened");
    fake.opens = true;
    fake.rest_fails = true;
    CHECK (idFor ({ { "driver", "fake" }, { "port", "a" } }) == "device/not_opened");
    CHECK (fake.lastTold() == "close");
}

TEST_CASE ("a driver that describes its device wrongly is refused, and its device closed", "[plugins][safety]")
{
    const auto idFor = [] (auto change) {
        FakeDriver fake;
        change (fake);
        Messages messages;
        const auto opened = fake.driver->open ({ { "driver", "fake" }, { "port", "a" } }, messages);
        CHECK_FALSE (opened);
        CHECK (fake.lastTold() == "close");
        return idOf (messages);
    };
    CHECK (idFor ([] (FakeDriver& f) { f.guard = "{}"; }) == "device/no_limits");
    CHECK (idFor ([] (FakeDriver& f) { f.guard = ""; }) == "device/no_limits");
    CHECK (idFor ([] (FakeDriver& f) { f.guard = "2 N"; }) == "device/bad_driver");
    CHECK (idFor ([] (FakeDriver& f) { f.guard = R"({"max_force": "2 m"})"; }) == "device/unit");
    CHECK (idFor ([] (FakeDriver& f) { f.guard = R"({"max_force": 2, "max_slew": 1})"; }) == "device/slow_stop");
    CHECK (idFor ([] (FakeDriver& f) { f.tool = TACTUS_DEVICE_TORQUE; }) == "device/no_limits");
    CHECK (idFor ([] (FakeDriver& f) { f.efforts = { "squeeze" }; }) == "device/no_limits");
    CHECK (idFor ([] (FakeDriver& f) { f.signal_outputs = 2; }) == "device/no_limits");
    CHECK (idFor ([] (FakeDriver& f) { f.tool = 1u << 20 | TACTUS_DEVICE_FORCE; }) == "device/bad_driver");
    CHECK (idFor ([] (FakeDriver& f) { f.changes = [] (tactus_device_about& a) { a.unrendered = 64; }; }) == "device/bad_driver");
    CHECK (idFor ([] (FakeDriver& f) { f.axes = { "a", "a" }; }) == "device/bad_driver");
    CHECK (idFor ([] (FakeDriver& f) { f.axes = { "A b" }; }) == "device/bad_driver");
    CHECK (idFor ([] (FakeDriver& f) { f.axes = { nullptr }; }) == "device/bad_driver");
    CHECK (idFor ([] (FakeDriver& f) { f.axes.assign (33, "a"); }) == "device/bad_driver");
    CHECK (idFor ([] (FakeDriver& f) { f.signal_inputs = -1; }) == "device/bad_driver");
    CHECK (idFor ([] (FakeDriver& f) { f.rate_hz = std::nan (""); }) == "device/bad_driver");
    CHECK (idFor ([] (FakeDriver& f) { f.mass = -1.0; }) == "device/bad_driver");
    CHECK (idFor ([] (FakeDriver& f) { f.rest_file = "tty"; }) == "device/bad_driver");
    CHECK (idFor ([] (FakeDriver& f) { f.changes = [] (tactus_device_about& a) { a.rest_file = "/dev/null"; }; }) == "device/bad_driver");
    const std::string endless (1'000'000, '[');
    CHECK (idFor ([&] (FakeDriver& f) { f.guard = endless; }) == "device/bad_driver");
}

TEST_CASE ("a driver that gives neither number nor time must give max_still, and one that promises them must give them", "[plugins][safety]")
{
    FakeDriver fake;
    const auto idNow = [&] (std::uint32_t stamps, const char* guard) {
        fake.stamps = stamps;
        fake.guard = guard;
        return idOf (host::openPluginDevice (*fake.driver, { { "driver", "fake" } }).messages);
    };
    constexpr auto bare = R"({"max_force": "2 N", "max_torque": "20 mN*m"})";
    constexpr auto for_force = R"({"max_force": "2 N", "max_torque": "20 mN*m", "max_still": "1 s", "still_force": "0.5 N"})";
    constexpr auto for_torque = R"({"max_force": "2 N", "max_torque": "20 mN*m", "max_still": "1 s", "still_torque": "5 mN*m"})";
    CHECK (idNow (0, bare) == "device/no_limits");
    CHECK (idNow (0, for_torque) == "device/no_limits");   // it takes no torque, so this watches nothing
    CHECK (idNow (0, for_force) == "");
    CHECK (idNow (TACTUS_DEVICE_NUMBERS, bare) == "");
    CHECK (idNow (TACTUS_DEVICE_TIMES, bare) == "");
    CHECK (idNow (4, bare) == "device/bad_driver");
    fake.tool = TACTUS_DEVICE_ROTATION | TACTUS_DEVICE_TORQUE;
    CHECK (idNow (0, for_force) == "device/no_limits");
    CHECK (idNow (0, for_torque) == "");
    fake.tool = TACTUS_DEVICE_FORCE;   // no position that could freeze
    CHECK (idNow (0, bare) == "");
    fake.tool = TACTUS_DEVICE_POSITION;   // nothing pushes
    CHECK (idNow (0, "") == "");
}

TEST_CASE ("a reading without the number that its driver promises is not used", "[plugins][safety]")
{
    FakeDriver fake;
    const auto device = fake.open();
    device->read();
    device->write ({});
    fake.send (1e-3);
    REQUIRE (tactus::test::eventually ([&] { return device->read().valid; }));
    FakeDriver::Sent bare;
    bare.reading.valid = 1;
    fake.send (bare);
    CHECK (tactus::test::eventually ([&] { return device->read().fault == ReadingFault::malformed; }));
    CHECK_FALSE (device->read().valid);
}

TEST_CASE ("a device without limits is allowed if it takes no efforts", "[plugins]")
{
    FakeDriver fake;
    fake.tool = TACTUS_DEVICE_POSITION;
    fake.guard = "";
    const auto device = fake.open();
    device->read();
    device->write ({});
    device->read();
    device->write ({ .force = { 1.0, 0.0, 0.0 } });
    CHECK (tactus::test::stays (20ms, [&] { return fake.count ("force") == 0; }));
}

TEST_CASE ("a device that nothing brings to rest when the program dies is not opened", "[plugins][safety]")
{
    FakeDriver fake;
    const auto idNow = [&] {
        const auto made = host::openPluginDevice (*fake.driver, { { "driver", "fake" } });
        CHECK ((made.device == nullptr) == hasErrors (made.messages));
        return idOf (made.messages);
    };
    CHECK (idNow() == "");   // the device has a watchdog
    for (const double watchdog : { 0.0, 0.6, 31e6 })
    {
        fake.device_watchdog_s = watchdog;
        CHECK (idNow() == "device/no_failsafe");
    }
    fake.rest_file = "/nowhere/tty";
    CHECK (idNow() == "device/failsafe");
    fake.tool = TACTUS_DEVICE_POSITION;   // nothing pushes
    CHECK (idNow() == "");
    CHECK (fake.count ("rest") >= fake.count ("open"));   // also of devices that are refused
}

#if ! defined(__linux__)
TEST_CASE ("on a system without a guardian, a device that pushes is not opened, whatever watchdog it has", "[plugins][safety]")
{
    CHECK (host::Failsafe::arm ("COM7", { { { 0 }, false } }).error().id == "device/failsafe");
    FakeDriver fake;
    const auto made = [&] { return host::openPluginDevice (*fake.driver, { { "driver", "fake" } }); };
    const auto refused = made();
    CHECK (refused.device == nullptr);
    CHECK (idOf (refused.messages) == "device/failsafe");
    CHECK (fake.count ("force") == 0);
    CHECK (fake.lastTold() == "close");
    fake.tool = TACTUS_DEVICE_POSITION;   // nothing pushes
    CHECK (made().device != nullptr);
}
#endif

TEST_CASE ("limits of a driver that would hold a force for long are refused", "[plugins][safety]")
{
    FakeDriver fake;
    for (const auto* guard : { R"({"max_force": "2 N", "watchdog": "2 s"})", R"({"max_force": "2 N", "watchdog": "3600 s"})" })
    {
        fake.guard = guard;
        CHECK (idOf (host::openPluginDevice (*fake.driver, { { "driver", "fake" } }).messages) == "device/bad_driver");
    }
}
