// SPDX-License-Identifier: MIT
// The driver of Haply's Inverse3 against a fake of the service that it talks to. Both are ours; no device has been tried.

#include "support/sketch.hpp"

#include <host/device_plugins/open_plugin_device.hpp>
#include <host/device_plugins/plugin_device.hpp>
#include <host/haply/fake_inverse3.hpp>

#include <tactus/run/device/make_device.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

using namespace tactus;
using namespace std::chrono_literals;
using Fault = host::FakeInverse3::Fault;

namespace
{
template <typename F>
bool eventually (F&& so, std::chrono::seconds within = 30s)
{
    const auto end = std::chrono::steady_clock::now() + within;
    while (! so())
    {
        if (std::chrono::steady_clock::now() > end) return false;
        std::this_thread::sleep_for (1ms);
    }
    return true;
}

/// A service with an arm that stands still, and the driver on it.
struct Arm
{
    explicit Arm (Json more = Json::object(), int answer_after_ms = 0)
    {
        auto hand = makeDevice ({ { "driver", "sim" }, { "position", Json::array ({ "1 cm", "2 cm", "3 cm" }) }, { "mass", "1000 kg" } }, {});
        INFO (test::text (hand.messages));
        REQUIRE (hand.device);
        auto made = host::FakeInverse3::make (0, std::move (hand.device), answer_after_ms);
        REQUIRE (made);
        service = std::move (*made);
        more["driver"] = "haply";
        more["port"] = "localhost:" + std::to_string (service->port());
        description = std::move (more);
        opened = host::openPluginDevice (description);
        INFO (test::text (opened.messages));
        REQUIRE (opened.device);
        device = dynamic_cast<host::PluginDevice*> (opened.device.get());
        REQUIRE (device != nullptr);
        device->prepare (1e-3);
    }

    /// One tick with a force if the reading is valid; true if it is.
    bool tick (double newtons)
    {
        reading = device->read();
        Effort effort;
        if (reading.valid) effort.force.z() = newtons;
        device->write (effort);
        return reading.valid;
    }

    bool pushes()
    {
        return eventually ([&] {
            tick (1.0);
            return service->force().z() == Approx (1.0);
        });
    }

    std::unique_ptr<host::FakeInverse3> service;   // ends after the device
    Json description;
    MadeDevice opened;
    host::PluginDevice* device = nullptr;
    Reading reading;
};
}   // namespace

TEST_CASE ("the Inverse3 is read and pushed through its service, with one message in flight", "[haply][wires]")
{
    Arm arm { Json { { "grip", "wireless" } }, 3 };   // each answer comes after 3 ms, so that whatever is sent before it is seen
    CHECK (arm.opened.limits.max_force == 2.0);
    CHECK (arm.device->about().rotation);
    CHECK (arm.device->about().layout.buttons == std::vector<std::string> { "a", "b", "c", "home" });
    REQUIRE (eventually ([&] { return arm.tick (0.0); }));
    CHECK ((arm.reading.position - Vec3 (0.01, 0.02, 0.03)).norm() < 1e-6);
    CHECK (arm.reading.rotation.isZero (1e-12));
    REQUIRE (arm.pushes());
    REQUIRE (eventually ([&] {
        arm.tick (1.0);
        return arm.service->counts().forces > 200;
    }));
    CHECK (arm.reading.fault == ReadingFault::none);
    const auto n = arm.service->counts();
    CHECK (n.together == 0);
    CHECK (n.refused == 0);
    CHECK (n.largest == Approx (1.0));
    CHECK (arm.device->counts().departures == 0);

    // At the end, the last message that the service has heard asks for no force.
    arm.opened.device.reset();
    CHECK (arm.service->force().isZero (0.0));
}

TEST_CASE ("position, rotation and buttons of an arm and its grip are one reading", "[haply][wires]")
{
    /// The same number moves, turns and presses.
    struct Hand final : Device
    {
        void prepare (double) override {}
        Reading read() noexcept override
        {
            ++number;
            const double turn = 1e-4 * (number % 30000);
            return { .position = { 1e-6 * number, 0.0, 0.0 }, .rotation = { 0.6 * turn, 0.0, -0.8 * turn }, .buttons = static_cast<std::uint32_t> (number % 16) };
        }
        void write (const Effort&) noexcept override {}
        int number = 0;
    };
    auto made = host::FakeInverse3::make (0, std::make_unique<Hand>());
    REQUIRE (made);
    auto opened = host::openPluginDevice ({ { "driver", "haply" }, { "port", "localhost:" + std::to_string ((*made)->port()) }, { "grip", "wireless" } });
    INFO (test::text (opened.messages));
    REQUIRE (opened.device);
    opened.device->prepare (1e-3);
    int seen = 0, last = 0;
    REQUIRE (eventually ([&] {
        const auto reading = opened.device->read();
        opened.device->write ({});
        if (! reading.valid) return false;
        const int number = static_cast<int> (std::lround (1e6 * reading.position.x()));
        if (number == last) return false;
        const double turn = 1e-4 * (number % 30000);
        CHECK ((reading.rotation - Vec3 (0.6 * turn, 0.0, -0.8 * turn)).norm() < 1e-9);
        CHECK (reading.buttons == static_cast<std::uint32_t> (number % 16));
        CHECK (number > last);
        last = number;
        return ++seen > 100;
    }));
}

TEST_CASE ("the Inverse3 understands both spellings of a force, and is asked where it is while nobody pushes", "[haply][wires]")
{
    Arm arm { Json { { "spelling", "vector" } } };
    CHECK_FALSE (arm.device->about().rotation);
    REQUIRE (arm.pushes());
    CHECK (arm.service->counts().refused == 0);

    // The program stops offering forces: the arm is brought to rest, and then only asked.
    const auto at = arm.service->counts();
    CHECK (eventually ([&] { return arm.service->counts().probes > at.probes + 10 && arm.service->force().isZero (0.0); }));
    CHECK (arm.device->counts().silences == 1);
}

TEST_CASE ("a service of the Inverse3 that fails costs no force longer than a tick of it, and is found again", "[haply][wires][safety]")
{
    const auto fault = GENERATE (Fault::silent, Fault::rename, Fault::restart, Fault::garbage);
    Arm arm;
    REQUIRE (arm.pushes());
    const auto before = arm.service->counts();
    arm.service->fail (fault);
    CHECK (eventually ([&] {
        arm.tick (1.0);
        return arm.device->counts().departures > 0;
    }));
    CHECK (eventually ([&] { return arm.service->force().isZero (0.0); }));   // the last one lasts for its tick
    if (fault == Fault::silent)                                               // each connection has one message that is not answered, and no other one follows
    {
        const auto n = arm.service->counts();
        CHECK (n.forces - before.forces <= n.answered - before.answered + n.clients);
    }

    arm.service->fail (Fault::none);
    CHECK (eventually ([&] { return arm.tick (0.0); }));
    CHECK (arm.pushes());
    CHECK (arm.service->counts().largest <= 2.0);
}

TEST_CASE ("a service of the Inverse3 that pushes instead of answering is read, and rests when the program does", "[haply][wires][safety]")
{
    Arm arm;
    REQUIRE (arm.pushes());
    arm.service->fail (Fault::push);
    const auto readings = arm.device->counts().readings;
    CHECK (eventually ([&] {
        arm.tick (1.0);
        return arm.device->counts().readings > readings + 100;
    }));
    CHECK (arm.device->counts().departures == 0);
    CHECK (eventually ([&] {
        arm.tick (0.0);
        return arm.service->force().isZero (0.0);
    }));
    arm.opened.device.reset();
    CHECK (arm.service->force().isZero (0.0));
}

TEST_CASE ("an Inverse3 that stays idle although it is pushed is not trusted", "[haply][wires][safety]")
{
    Arm arm;
    REQUIRE (arm.pushes());
    arm.service->fail (Fault::deaf);
    CHECK (eventually ([&] {
        arm.tick (1.0);
        return arm.reading.fault == ReadingFault::not_driven && ! arm.reading.valid;
    }));
    arm.service->fail (Fault::none);
    CHECK (arm.pushes());
}

TEST_CASE ("what is wrong with a description of an Inverse3, or with its service, is said", "[haply][wires]")
{
    Arm arm;
    const auto problem = [&] (const Json& description) { return test::text (host::openPluginDevice (description).messages); };
    const auto with = [&] (const char* key, const char* value) {
        auto d = arm.description;
        d[key] = value;
        return problem (d);
    };
    CHECK (with ("grip", "loose").find ("wireless or wired") != std::string::npos);
    CHECK (with ("spelling", "words").find ("values") != std::string::npos);
    CHECK (with ("port", "localhost:one").find ("written as") != std::string::npos);
    CHECK (with ("colour", "red").find ("colour") != std::string::npos);
    CHECK (problem ({ { "driver", "haply" }, { "port", "localhost:9" } }).find ("refused") != std::string::npos);
    arm.opened.device.reset();   // the fake serves one client at a time
    CHECK (with ("device_id", "FFFF").find ("no Inverse3 with the id FFFF") != std::string::npos);
    CHECK (with ("grip", "wired").find ("how the grip is held") != std::string::npos);
}

TEST_CASE ("a long run of an Inverse3: each message is answered, one at a time, and nothing pushes after a stop", "[haply][wires][soak]")
{
    const auto* wanted = std::getenv ("TACTUS_SOAK_SECONDS");
    const auto pushes = static_cast<std::uint64_t> (300.0 * (wanted != nullptr ? std::max (1.0, std::atof (wanted)) : 3.0));   // about a quarter of what a second has room for
    Arm arm;
    REQUIRE (arm.pushes());
    const auto before = arm.service->counts();
    int tick = 0;
    REQUIRE (eventually (
        [&] {
            arm.tick (++tick % 2 == 0 ? 0.5 : -0.5);
            return arm.service->counts().forces - before.forces >= pushes;
        },
        std::chrono::seconds (60 + pushes / 20)));
    CHECK (arm.device->counts().departures == 0);
    const auto n = arm.service->counts();
    CHECK (n.heard - n.answered <= 1);   // the last one may be under way
    CHECK (n.clients == 1);
    CHECK (n.together == 0);
    CHECK (n.refused == 0);
    CHECK (n.largest <= 1.0);

    // After a stop, no message asks for a force, not even the last one.
    REQUIRE (eventually ([&] {
        arm.tick (0.0);
        return arm.service->force().isZero (0.0);
    }));
    const auto at_rest = arm.service->counts();
    REQUIRE (eventually ([&] {
        arm.tick (0.0);
        return arm.service->counts().heard > at_rest.heard + 300;
    }));
    arm.opened.device.reset();
    CHECK (arm.service->counts().pushes == at_rest.pushes);
}

TEST_CASE ("a state of an Inverse3 is answered at once by whoever reads it", "[haply][wires][hops]")
{
    const auto* wanted = std::getenv ("TACTUS_HOPS");
    const int states = wanted ? std::stoi (wanted) : 200;
    Arm arm;
    REQUIRE (arm.pushes());
    std::vector<double> us;
    auto last = std::chrono::steady_clock::now();
    auto known = arm.device->counts().readings;
    REQUIRE (eventually (
        [&] {
            // From a force to the next state: the force on its way, the service, and the state on its way. The pause is that of ticks at 1 kHz.
            while (arm.device->counts().readings == known)
                if (std::chrono::steady_clock::now() - last > 1s) return true;
            known = arm.device->counts().readings;
            us.push_back (1e6 * std::chrono::duration<double> (std::chrono::steady_clock::now() - last).count());
            std::this_thread::sleep_for (1ms);
            known = arm.device->counts().readings;
            last = std::chrono::steady_clock::now();
            arm.tick (0.5);
            return us.size() > static_cast<std::size_t> (states);
        },
        120s));
    REQUIRE (us.size() > static_cast<std::size_t> (states));
    const auto n = arm.service->counts();
    CHECK (n.together == 0);
    CHECK (n.heard - n.answered <= 1);
    CHECK (n.forces >= static_cast<std::uint64_t> (states));
    if (wanted == nullptr) return;
    us.erase (us.begin());
    std::ranges::sort (us);
    const auto quantile = [&] (double part) { return us[static_cast<std::size_t> (part * static_cast<double> (us.size() - 1))]; };
    std::cout << "WebSocket (Inverse3): " << us.size() << " reports, p50 " << quantile (0.5) << ", p90 " << quantile (0.9) << ", p99 " << quantile (0.99)
              << ", p99.9 " << quantile (0.999) << ", max " << us.back() << " us\n";
}
