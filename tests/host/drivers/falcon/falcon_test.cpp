// SPDX-License-Identifier: MIT
// The driver of the Novint Falcon against a fake at the other end of a pseudo-terminal. Both are ours; no Falcon has been tried.

#include "../dry_wood.hpp"
#include "../trial_person.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/devices/device_plugins/device_driver.hpp>
#include <host/devices/device_plugins/plugin_device.hpp>
#include <host/drivers/falcon/device.hpp>
#include <host/drivers/falcon/fake_falcon.hpp>
#include <host/drivers/falcon/kinematics.hpp>
#include <host/drivers/falcon/packets.hpp>
#include <host/drivers/falcon/serial_port.hpp>
#include <tactus/run/engine.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <random>

using namespace tactus;
using namespace std::chrono_literals;
using host::FakeFalcon;
using host::falcon::Kinematics;
using test::eventually;
namespace falcon_legs = host::falcon_legs;
using falcon_legs::Place;
using Fault = FakeFalcon::Fault;

namespace
{
bool contains (const std::string& text, const char* part) { return text.find (part) != std::string::npos; }

Vec3 vec (const Place& p) { return { p[0], p[1], p[2] }; }
Place placeOf (const Vec3& v) { return { v.x(), v.y(), v.z() }; }
double distance (const Vec3& a, const Vec3& b) { return (a - b).norm(); }

/// A Falcon and the driver on it.
struct Desk
{
    explicit Desk (bool has_firmware = true, std::size_t image_size = 0) : falcon ({}, has_firmware, image_size) {}
    ~Desk()
    {
        device.reset();
        ::unsetenv ("LD_LIBRARY_PATH");
        ::unsetenv ("TACTUS_FAKE_FTDI");
    }
    Desk (const Desk&) = delete;
    Desk& operator= (const Desk&) = delete;

    /// This computer has a libftdi, which finds these Falcons.
    static void hasUsb (const std::string& falcons, const std::string& libraries = std::string (TACTUS_FAKE_LIBRARIES) + "/ftdi")
    {
        ::setenv ("LD_LIBRARY_PATH", libraries.c_str(), 1);
        ::setenv ("TACTUS_FAKE_FTDI", falcons.c_str(), 1);
    }

    bool opens (Json description = Json::object(), double silence_s = 60.0)
    {
        description["driver"] = "falcon";
        if (! description.contains ("port")) description["port"] = falcon.port();
        if (description.at ("port").is_null()) description.erase ("port");
        messages.clear();
        device.reset();
        const auto driver = host::DeviceDriver::within (is_patient ? host::falcon::patient_driver : host::falcon::driver);
        REQUIRE (driver);
        auto there = (*driver)->open (description, messages);
        if (! there) return false;
        limits = there->about().limits;
        rest_file = there->about().rest_file;
        const host::PluginDevice::Options options { .silence_s = silence_s, .look_again = 2ms, .patience = 60s, .real_time = false };
        device = std::make_unique<host::PluginDevice> (std::move (there), std::nullopt, options);
        device->prepare (1e-3);
        return true;
    }

    std::string said (const Json& description = Json::object())
    {
        opens (description);
        return test::text (messages);
    }

    template <typename F>
    bool ticksUntil (F&& so, const Vec3& force = Vec3::Zero())
    {
        return eventually ([&] {
            reading = device->read();
            Effort effort;
            if (reading.valid) effort.force = force;
            device->write (effort);
            return so();
        });
    }

    bool reads()
    {
        return ticksUntil ([&] { return reading.valid; });
    }

    bool pushes()
    {
        const auto before = falcon.pushes.load();
        return ticksUntil ([&] { return falcon.pushes > before + 5; }, { 0.0, 0.0, 1.0 });
    }

    FakeFalcon falcon;
    bool is_patient = true;   // a busy computer must not look like a Falcon that does not answer
    GuardLimits limits;
    std::string rest_file;
    Messages messages;
    std::unique_ptr<host::PluginDevice> device;
    Reading reading;
};
}   // namespace

TEST_CASE ("the legs of the Falcon meet where its equations say, to 1 nm", "[falcon]")
{
    Kinematics legs;
    const auto at = [&] (const std::array<int, 3>& counts) {
        const auto place = legs.placeOf (Kinematics::anglesOf (counts));
        REQUIRE (place);
        return *place;
    };
    CHECK (distance (at ({ 0, 0, 0 }), { 0.0, 0.0, 0.13460 }) < 1e-5);
    CHECK (distance (at ({ 500, 500, 500 }), { 0.0, 0.0, 0.15686 }) < 1e-5);
    CHECK (distance (at ({ -500, -500, -500 }), { 0.0, 0.0, 0.11075 }) < 1e-5);
    CHECK (distance (at ({ 1000, 1000, 1000 }), { 0.0, 0.0, 0.17360 }) < 1e-5);
    CHECK (distance (at ({ -1000, -1000, -1000 }), { 0.0, 0.0, 0.08961 }) < 1e-5);
    CHECK (distance (at ({ 300, 0, 0 }), { 0.00388, -0.01288, 0.13849 }) < 1e-5);
    CHECK (distance (at ({ 0, 300, 0 }), { -0.01310, 0.00308, 0.13849 }) < 1e-5);
    CHECK (distance (at ({ 0, 0, 300 }), { 0.00922, 0.00980, 0.13849 }) < 1e-5);
    at ({ 0, 0, 0 });
    const auto motorsFor = [&] (const Vec3& force) {
        const auto torques = legs.torquesOf (force);
        return std::array { std::lround (-1e4 * torques[0]), std::lround (-1e4 * torques[1]), std::lround (-1e4 * torques[2]) };
    };
    CHECK (motorsFor ({ 1.0, 0.0, 0.0 }) == std::array { -193l, 651l, -458l });
    CHECK (motorsFor ({ 0.0, 1.0, 0.0 }) == std::array { 640l, -153l, -487l });
    CHECK (motorsFor ({ 0.0, 0.0, 1.0 }) == std::array { -249l, -249l, -249l });

    // The whole workspace, forwards and backwards. The fake's kinematics give the angles, and their differences the torques.
    double worst = 0.0, worst_force = 0.0;
    int places = 0;
    for (int i = 0; i < 9; ++i)
        for (int j = 0; j < 9; ++j)
            for (int k = 0; k < 9; ++k)
            {
                const Place place { 0.01 * (i - 4), 0.01 * (j - 4), 0.095 + 0.009 * k };
                const auto angles = falcon_legs::anglesAt (place);
                if (! std::isfinite (angles[0] + angles[1] + angles[2])) continue;
                const auto found = legs.placeOf (vec (angles));
                INFO (place[0] << ", " << place[1] << ", " << place[2]);
                REQUIRE (found);
                worst = std::max (worst, distance (*found, vec (place)));
                const Vec3 force { 1.0, -2.0, 3.0 };
                worst_force = std::max (worst_force, distance (vec (falcon_legs::forceOf (placeOf (legs.torquesOf (force)), place)), force));
                ++places;
            }
    CHECK (places > 600);
    CHECK (worst < 1e-9);
    CHECK (worst_force < 1e-4);   // differences are coarse at the edge of the workspace

    CHECK_FALSE (legs.placeOf ({ 3.0, -2.0, 0.1 }));                       // the legs do not meet
    CHECK_FALSE (legs.placeOf (Kinematics::anglesOf ({ 16384, 0, 0 })));   // they would, after more than a turn
    const auto place = at ({ 100, 110, 90 });
    at ({ 1000, 900, 1100 });
    CHECK (at ({ 100, 110, 90 }) == place);   // to the last bit: otherwise a frozen sensor would not be seen
}

TEST_CASE ("packets of a Falcon are found among any bytes, and nothing else is", "[falcon]")
{
    std::mt19937 random (1);
    const auto upTo = [&] (unsigned most) { return static_cast<unsigned> (random() % (most + 1)); };
    host::falcon::PacketFinder finder;
    std::vector<std::uint8_t> past;
    int found = 0, hidden = 0;
    for (int round = 0; round < 20'000; ++round)
    {
        const std::array<int, 3> counts { static_cast<std::int16_t> (random()), static_cast<std::int16_t> (random()), static_cast<std::int16_t> (random()) };
        const auto packet = host::falcon::packetOf (counts, upTo (0x7f));
        std::vector<std::uint8_t> bytes (packet.begin(), packet.end());
        const bool is_whole = upTo (2) > 0;
        if (! is_whole) bytes.erase (bytes.begin() + upTo (15));
        for (unsigned noise = upTo (20); noise > 0; --noise)   // of the bytes that packets have, and others
            bytes.push_back (upTo (1) == 0 ? static_cast<std::uint8_t> (upTo (255)) : static_cast<std::uint8_t> ("<>A"[upTo (2)]));
        bool has_come = false;
        for (std::size_t i = 0; i < bytes.size(); ++i)
        {
            past.push_back (bytes[i]);
            const auto report = finder.take (bytes[i]);
            if (! report) continue;
            ++found;
            // The packet that was found is the latest bytes.
            REQUIRE (past.size() >= packet.size());
            const auto again = host::falcon::packetOf (report->counts, report->bits);
            CHECK (std::equal (again.begin(), again.begin() + 14, past.end() - 16));
            CHECK (past.back() == '>');
            has_come = has_come || (is_whole && i + 1 == packet.size() && report->counts == counts);
        }
        hidden += is_whole && ! has_come ? 1 : 0;
    }
    CHECK (found > 12'000);
    CHECK (hidden == 0);   // noise alone makes no packet in which one could be lost
}

TEST_CASE ("a Falcon is read and pushed in the axes of Tactus, one packet at a time", "[falcon]")
{
    Desk desk;
    auto& falcon = desk.falcon;
    REQUIRE (desk.opens());
    CHECK (desk.limits.max_force == 8.0);
    CHECK (desk.rest_file == falcon.port());
    falcon.target[0] = 0.01;
    falcon.target[1] = 0.005;
    falcon.target[2] = 0.13;
    const auto is_at = [&] (const Vec3& place) { return desk.reading.valid && (desk.reading.position - place).norm() < 1e-4; };
    const Vec3 middle { 0.01, 0.02, 0.005 };
    REQUIRE (desk.ticksUntil ([&] { return is_at (middle); }));
    for (int axis = 0; axis < 3; ++axis)
        for (const double newtons : { 1.0, -1.0 })
        {
            Vec3 force = Vec3::Zero(), place = middle;
            force[axis] = newtons;
            place[axis] += newtons / 300.0;
            const bool is_there = desk.ticksUntil ([&] { return is_at (place); }, force);
            INFO ("axis " << axis << ", " << newtons << " N, " << desk.reading.position.transpose());
            REQUIRE (is_there);
        }
    CHECK (falcon.malformed == 0);
    CHECK (falcon.without_homing == 0);
    CHECK (desk.ticksUntil ([&] { return falcon.bits == (1u | 2u); }));   // homing, and green
    falcon.buttons = 9;
    CHECK (desk.ticksUntil ([&] { return desk.reading.buttons == 9; }));
    CHECK (desk.device->layout().buttons == std::vector<std::string> { "plus", "forward", "center", "minus" });

    // More than the motors can do: all of them less, and told.
    CHECK (desk.device->layout().axes == std::vector<std::string> { "saturated" });
    CHECK (desk.reading.axes[0] == 0.0);
    falcon.hold ({ 0.01, 0.005, 0.13 }, 0);
    REQUIRE (desk.ticksUntil ([&] { return is_at (middle); }));   // the driver turns a force into torques at the place that it knows
    CHECK (desk.ticksUntil ([&] { return desk.reading.axes[0] == 1.0; }, { 30.0, 0.0, 0.0 }));
    CHECK (falcon.largest_motor == 4096);
    const Place pushed = falcon_legs::forceOf ({ -1e-4 * falcon.motors[0], -1e-4 * falcon.motors[1], -1e-4 * falcon.motors[2] }, falcon.place());
    CHECK (std::hypot (pushed[1], pushed[2]) < 0.01 * pushed[0]);   // along x, as asked for
    CHECK (desk.ticksUntil ([&] { return desk.reading.axes[0] == 0.0; }, { 1.0, 0.0, 0.0 }));

    // One packet at a time, also after those of a rest, and after answers that were so late that they counted as lost.
    falcon.looks_ms = 1;
    CHECK (desk.ticksUntil ([&] { return falcon.alone > 50; }));
    falcon.fault = Fault::late;
    const auto answers = desk.device->counts().readings;
    CHECK (desk.ticksUntil ([&] { return desk.device->counts().readings > answers + 5; }));
    falcon.fault = Fault::none;
    CHECK (desk.ticksUntil ([&] { return falcon.alone > 50; }));

    desk.device.reset();
    CHECK (eventually ([&] { return falcon.isAtRest(); }));
}

TEST_CASE ("dry wood on a Falcon has the forces of its render at the positions that its encoders have rounded", "[falcon]")
{
    FakeFalcon falcon;
    test::DryWood wood { host::falcon::patient_driver, { { "port", falcon.port() } } };
    CHECK (wood.about().limits.max_still == 1.0);   // its readings have neither a number nor a time
    CHECK (wood.about().limits.still_force == 0.5);
    Kinematics legs;
    std::array<int, 3> sent {};
    const int readings = test::readings (30'000);
    for (int k = 0; k < readings; ++k)
    {
        const Vec3 at = test::DryWood::placeAt (k);
        const auto number = static_cast<unsigned> (k % 15) + 1;   // tells this reading from the one before, which an earlier packet may bring
        falcon.hold ({ at.x(), at.z(), 0.15 - at.y() }, number);
        const auto place = legs.placeOf (Kinematics::anglesOf (falcon_legs::countsAt ({ at.x(), at.z(), 0.15 - at.y() })));
        REQUIRE (place);
        const Vec3 rounded { (*place)[0], 0.15 - (*place)[2], (*place)[1] };
        const Vec3 asked = wood.tick (rounded, [&] (const auto& reading, const auto&) { return reading.buttons == number; });
        INFO ("reading " << k << ": motors " << falcon.motors[0] << ", " << falcon.motors[1] << ", " << falcon.motors[2] << " instead of " << sent[0] << ", "
                         << sent[1] << ", " << sent[2]);
        if (k > 0) REQUIRE (falcon.hasGot (sent));   // the force of the reading before, with the packet that this reading answers
        const Vec3 torques = legs.torquesOf ({ asked.x(), asked.z(), -asked.y() });
        for (int i = 0; i < 3; ++i)
            sent[static_cast<std::size_t> (i)] = static_cast<int> (std::lround (-1e4 * torques[i]));
    }
    CHECK (wood.pushes() > readings / 4);
    CHECK_FALSE (wood.hasFailed());
}

TEST_CASE ("a Falcon whose position jumps, is impossible or is frozen under a push is not trusted", "[falcon][safety]")
{
    Desk desk;
    auto& falcon = desk.falcon;
    REQUIRE (desk.opens());
    test::Sketch sketch;
    sketch.node ("push", "signal.constant", { { "value", 0.8 } }).node ("motor", "device.force").wire ("push.out -> motor.force.y");
    sketch.graph.root.nodes.back().role = "stylus";
    const auto plan = sketch.compile().plan;
    REQUIRE (plan);
    Engine engine { plan };
    auto limits = desk.limits;
    limits.watchdog = GuardLimits::none;   // the ticks of this test are not those of a clock
    limits.max_impulse = limits.max_energy = GuardLimits::none;
    engine.attach ("stylus", *desk.device, limits);
    const auto& guard = engine.guardOf ("stylus");
    const auto ticksUntil = [&] (auto&& so) {
        return eventually ([&] {
            engine.tick();
            return so();
        });
    };
    auto pushes = [&, at = 50]() mutable {   // it moves all the time, at 0.1 m/s
        return ticksUntil ([&] {
            falcon.hold ({ 1e-4 * std::abs (at++ % 100 - 50), 0.0, 0.14 }, 0);
            return ! falcon.isAtRest();
        });
    };
    REQUIRE (pushes());
    SECTION ("a byte has changed: the position jumps")
    {
        falcon.fault = Fault::changed;
        CHECK (ticksUntil ([&] { return guard.isLatched(); }));
        CHECK (ticksUntil ([&] { return falcon.isAtRest(); }));
        falcon.fault = Fault::none;
        const auto packets = falcon.packets.load();
        CHECK (ticksUntil ([&] { return falcon.packets > packets + 200; }));
        CHECK (falcon.isAtRest());   // until a person rearms
    }
    SECTION ("counts that no pose has")
    {
        falcon.fault = Fault::impossible;
        CHECK (ticksUntil ([&] { return desk.device->read().fault == ReadingFault::failed && falcon.isAtRest(); }));
        CHECK_FALSE (guard.isLatched());
        falcon.fault = Fault::none;
        CHECK (pushes());
    }
    SECTION ("frozen")
    {
        CHECK (ticksUntil ([&] { return falcon.isAtRest(); }));
        CHECK_FALSE (guard.isLatched());
        CHECK (pushes());
    }
}

TEST_CASE ("a Falcon has no force until all its encoders have passed their marks", "[falcon][safety]")
{
    Desk desk;
    desk.falcon.homed = 5;
    REQUIRE (desk.opens());
    CHECK (desk.ticksUntil ([&] { return desk.reading.fault == ReadingFault::not_homed; }, { 0.0, 0.0, 1.0 }));
    CHECK (desk.ticksUntil ([&] { return desk.falcon.bits == (1u | 8u); }));   // homing, and red
    CHECK (desk.falcon.pushes == 0);
    desk.falcon.homed = 7;
    CHECK (desk.pushes());
    desk.falcon.fault = Fault::forgetful;
    CHECK (desk.ticksUntil ([&] { return desk.reading.fault == ReadingFault::not_homed && desk.falcon.isAtRest(); }, { 0.0, 0.0, 1.0 }));
    desk.falcon.fault = Fault::none;
    desk.falcon.homed = 7;
    CHECK (desk.pushes());
}

TEST_CASE ("bytes between the Falcon and the computer that are lost or added make no wrong reading", "[falcon][safety]")
{
    Desk desk;
    auto& falcon = desk.falcon;
    falcon.hold ({ 0.01, 0.0, 0.14 }, 0);
    REQUIRE (desk.opens());
    REQUIRE (desk.reads());
    const auto known = desk.reading.position;
    falcon.fault = GENERATE (Fault::shorter, Fault::shifted, Fault::noisy);
    const auto before = desk.device->counts().readings;
    CHECK (desk.ticksUntil ([&] {
        CHECK ((desk.reading.position - known).norm() < 1e-9);
        CHECK (desk.reading.buttons == 0);
        return desk.device->counts().readings > before + 100;
    }));
    CHECK (desk.device->counts().departures == 0);
}

TEST_CASE ("a Falcon that answers late or not at all has no force for long, and is opened again", "[falcon][safety]")
{
    Desk desk;
    auto& falcon = desk.falcon;
    REQUIRE (desk.opens());
    REQUIRE (desk.pushes());
    SECTION ("each answer takes 30 ms: readings are old, and come all the same")
    {
        falcon.fault = Fault::late;
        const auto before = desk.device->counts().readings;
        CHECK (desk.ticksUntil ([&] { return desk.device->counts().readings > before + 10; }));
        CHECK (desk.device->counts().oldest > 0.02);
        falcon.fault = Fault::none;
        CHECK (desk.pushes());
    }
    SECTION ("none comes")
    {
        desk.is_patient = false;
        REQUIRE (desk.opens());
        REQUIRE (desk.pushes());
        falcon.fault = Fault::silent;
        CHECK (desk.ticksUntil ([&] { return desk.reading.fault == ReadingFault::unplugged; }, { 0.0, 0.0, 1.0 }));
        CHECK (contains (desk.device->trouble(), "it does not answer"));
        CHECK (eventually ([&] { return falcon.isAtRest(); }));
        falcon.fault = Fault::none;
        CHECK (desk.pushes());
    }
    SECTION ("it is unplugged")
    {
        falcon.unplug();
        CHECK (desk.ticksUntil ([&] { return desk.reading.fault == ReadingFault::unplugged; }, { 0.0, 0.0, 1.0 }));
    }
    SECTION ("when no force is asked for any more, the last one does not stay")
    {
        REQUIRE (desk.opens (Json::object(), 0.02));
        REQUIRE (desk.pushes());
        CHECK (eventually ([&] { return falcon.isAtRest(); }));
        CHECK (desk.device->counts().silences > 0);
        CHECK (desk.device->counts().departures == 0);
    }
}

TEST_CASE ("a stop of a Falcon waits for no answer", "[falcon][safety]")
{
    FakeFalcon falcon;
    Messages messages;
    const auto driver = host::DeviceDriver::within (host::falcon::patient_driver);
    REQUIRE (driver);
    const auto device = (*driver)->open ({ { "driver", "falcon" }, { "port", falcon.port() } }, messages);
    REQUIRE (device);
    host::DriverReport why;
    tactus_reading reading;
    tactus_device_stamp stamp;
    const auto write = [&] (double z) {
        Effort effort;
        effort.force.z() = z;
        return device->write (effort, z == 0.0, GuardLimits::none, why);
    };
    REQUIRE (eventually ([&] {
        write (1.0);
        return device->read (50ms, reading, stamp, why) == TACTUS_DEVICE_OK && falcon.pushes > 5;
    }));

    // From now on the answers are not read, so a packet that the device gets is not triggered by one.
    falcon.fault = Fault::silent;
    REQUIRE (eventually ([&] {   // the last packet has a force, and its answer never comes
        write (1.0);
        device->read (1ms, reading, stamp, why);
        return ! falcon.isAtRest();
    }));
    const auto before = falcon.packets.load();
    CHECK (eventually ([&] {
        write (0.0);
        return falcon.isAtRest();
    }));
    CHECK (falcon.packets <= before + 2);   // and not one for each tick; one with a force may have been on its way
}

TEST_CASE ("the firmware of a Falcon comes from a file of the person, and what is wrong is said", "[falcon]")
{
    const TemporaryFolder folder;
    const auto file = (folder / "firmware.bin").string();
    std::vector<std::uint8_t> image (7324);
    for (std::size_t i = 0; i < image.size(); ++i)
        image[i] = static_cast<std::uint8_t> (i * 31 + (i >> 8));
    std::ofstream (file, std::ios::binary).write (reinterpret_cast<const char*> (image.data()), static_cast<std::streamsize> (image.size()));

    Desk desk { false, image.size() };
    CHECK (contains (desk.said(), R"(Give the file that has its firmware with the key "firmware")"));
    CHECK (contains (desk.said ({ { "firmware", (folder / "none.bin").string() } }), "it cannot be read"));
    CHECK (contains (desk.said ({ { "firmware", "/dev/zero" } }), "it cannot be read"));   // it never ends
    CHECK (desk.falcon.loaded == 0);
    desk.falcon.first_tries_that_fail = 3;
    REQUIRE (desk.opens ({ { "firmware", file } }));
    CHECK (desk.falcon.image() == image);
    CHECK (desk.pushes());
    CHECK (desk.said().empty());   // it has its firmware until its power is cut
    CHECK (contains (desk.said ({ { "port", "ttyUSB0" } }), "name the port: falcon:/dev/ttyUSB0"));
    CHECK (contains (desk.said ({ { "port", "/dev/null" } }), "it is not a serial line"));
    CHECK (contains (desk.said ({ { "port", "/dev/not_there" } }), "No such file"));
    REQUIRE (desk.opens());
    Desk other;
    CHECK (contains (other.said ({ { "port", desk.falcon.port() } }), "another role, another instance of Tactus or another program is using it"));
}

TEST_CASE ("a Falcon without a serial port is played by libftdi, and gets its firmware by it", "[falcon]")
{
    const TemporaryFolder folder;
    const std::string image (7324, 'x');
    std::ofstream (folder / "firmware.bin", std::ios::binary) << image;
    Desk desk { false, image.size() };
    Desk::hasUsb (desk.falcon.port());
    const Json port = GENERATE (Json(), Json ("usb"), Json ("usb:0"));
    if (port.is_null() && ! host::falcon::SerialPort::ofFalcon().empty()) return;   // a Falcon of this computer would be played
    const Json description { { "port", port }, { "firmware", (folder / "firmware.bin").string() } };
    REQUIRE (desk.opens (description));
    CHECK (desk.falcon.image().size() == image.size());
    CHECK (desk.rest_file.starts_with ("/dev/pts/"));
    CHECK (desk.rest_file != desk.falcon.port());
    CHECK (desk.pushes());
    CHECK (desk.falcon.malformed == 0);
    CHECK (desk.falcon.without_homing == 0);
    desk.falcon.hold ({ 0.01, 0.0, 0.14 }, 4);
    CHECK (desk.ticksUntil ([&] { return desk.reading.buttons == 4 && std::abs (desk.reading.position.x() - 0.01) < 1e-4; }));

    // Another use of it is refused, and each end leaves no force.
    Desk other;
    CHECK (contains (other.said ({ { "port", "usb" } }), "libftdi says: unable to claim usb device: another role or another program is using it"));
    REQUIRE (desk.pushes());
    desk.device.reset();
    CHECK (eventually ([&] { return desk.falcon.isAtRest(); }));
    Desk::hasUsb (desk.falcon.port());
    REQUIRE (desk.opens ({ { "port", "usb" } }));   // at once: nothing of the last use holds it
    CHECK (desk.pushes());
    desk.falcon.unplug();
    CHECK (desk.ticksUntil ([&] { return desk.reading.fault == ReadingFault::unplugged; }, { 0.0, 0.0, 1.0 }));
    CHECK (contains (desk.device->trouble(), "it was unplugged"));
}

TEST_CASE ("why libftdi cannot be used is said, and a second Falcon is found by its number", "[falcon]")
{
    const TemporaryFolder folder;
    Desk desk, other;
    Desk::hasUsb (desk.falcon.port() + ":denied:" + other.falcon.port());
    REQUIRE (desk.opens ({ { "port", "usb:2" } }));
    desk.ticksUntil ([&] { return other.falcon.packets > 20; });
    CHECK (other.falcon.packets > 20);
    CHECK (desk.falcon.packets == 0);
    CHECK (contains (desk.said ({ { "port", "usb:1" } }), "unable to open device: you may not open it; docs/known_devices.md has a udev rule"));
    CHECK (contains (desk.said ({ { "port", "usb:3" } }), "libftdi says: device not found"));
    for (const auto* wrong : { "usb:", "usb:x", "usb:1x", "usb:-1", "usb1", "ttyUSB0" })
        CHECK (contains (desk.said ({ { "port", wrong } }), "name the port: falcon:/dev/ttyUSB0, or falcon:usb or falcon:usb:1"));
    Desk::hasUsb (desk.falcon.port(), std::string (TACTUS_FAKE_LIBRARIES) + "/old_ftdi");
    CHECK (contains (desk.said ({ { "port", "usb" } }), "libftdi lacks ftdi_set_latency_timer"));
    folder.write ("libftdi1.so.2", "this is no library");
    Desk::hasUsb (desk.falcon.port(), folder.path().string());
    CHECK (contains (desk.said ({ { "port", "usb" } }), "libftdi1.so.2: file too short (on Debian: sudo apt install libftdi1-2)"));
}

TEST_CASE ("a Falcon without an address is the one whose adapter has a serial port", "[falcon]")
{
    const TemporaryFolder folder;
    using host::falcon::SerialPort;
    CHECK (SerialPort::ofFalcon (folder / "none").empty());
    for (const auto& [port, product] : { std::pair { "1-1", "6001" }, { "1-2", "cb48" } })
    {
        const auto usb = folder / "usb" / port;
        std::filesystem::create_directories (usb / "1.0" / ("ttyUSB" + std::string (port + 2)));
        std::ofstream (usb / "idVendor") << "0403\n";
        std::ofstream (usb / "idProduct") << product << "\n";
        std::filesystem::create_directories (folder / "adapters");
        const auto name = "ttyUSB" + std::string (port + 2);
        std::filesystem::create_directory_symlink (usb / "1.0" / name, folder / "adapters" / name);
    }
    CHECK (SerialPort::ofFalcon (folder / "adapters") == "/dev/ttyUSB2");
    std::filesystem::remove (folder / "adapters/ttyUSB2");
    CHECK (SerialPort::ofFalcon (folder / "adapters").empty());
}

TEST_CASE ("a trial of a Falcon finds everything as expected, with at most 0.3 N, and its capture replays", "[falcon][trial]")
{
    Desk desk;
    auto& falcon = desk.falcon;
    REQUIRE (desk.opens (Json::object(), 0.05));   // the trial stops its ticks on purpose
    REQUIRE (desk.reads());
    test::TrialHand hand;
    hand.move = [&] (const Vec3& to) {
        const Vec3 by_falcon { 0.6 * to.x(), 0.6 * to.z(), 0.145 - 0.6 * to.y() };   // 3 cm instead of 5: its space is small
        for (std::size_t i = 0; i < 3; ++i)
            falcon.target[i] = by_falcon[static_cast<Eigen::Index> (i)];
        REQUIRE (eventually ([&] { return distance (vec (falcon.place()), by_falcon) < 2e-3; }));   // its packets go on without ticks
    };
    hand.force = [&] {
        const Vec3 torques = Vec3 (falcon.motors[0], falcon.motors[1], falcon.motors[2]) / -1e4;
        const Vec3 f = vec (falcon_legs::forceOf (placeOf (torques), falcon.place()));
        return falcon.isAtRest() ? Vec3 (Vec3::Zero()) : Vec3 { f.x(), -f.z(), f.y() };
    };
    hand.press = [&] (unsigned buttons) {
        falcon.buttons = buttons;
        const auto before = desk.device->counts().readings;   // one of them may have been on its way
        REQUIRE (eventually ([&] { return desk.device->counts().readings >= before + 2; }));
    };
    hand.unplug = [&] { falcon.unplug(); };
    falcon.tremor = 2e-4;
    const auto report = host::tryDevice (*desk.device, desk.limits, { .pace = 0.3 }, hand);
    INFO (host::trialText (report));
    for (const auto* step : test::steps_of_trial)
    {
        CAPTURE (step);
        CHECK (test::verdictOf (report, step) == "as expected");
    }
    CHECK (test::verdictOf (report, "a pulled cable") == "as expected");
    CHECK (test::verdictOf (report, "walls") == "not tried");   // the person does not let go of it
    CHECK (contains (host::trialText (report), "pressed: forward; not seen: plus, center, minus"));
    // One count of one leg, or of several, moves the grip by 34 to 53 um within the space.
    CHECK (report.at ("numbers").at ("quantum").get<double>() > 30e-6);
    CHECK (report.at ("numbers").at ("quantum").get<double>() < 60e-6);
    CHECK (hand.largest > 0.1);
    CHECK (hand.largest <= 1.05 * host::trial_push);   // as the fake computes it, from whole counts
    const auto replayed = host::replayTrial (report);
    REQUIRE (replayed);
    CHECK (*replayed == 0.0);
}
