// SPDX-License-Identifier: MIT
// The driver of Haply's Inverse3 against a fake of the service that it talks to. Both are ours; no device has been tried.

#include "host/drivers/websocket/service_bench.hpp"
#include "support/rounds.hpp"
#include "support/waiting.hpp"

#include <host/cli/program.hpp>
#include <host/cli/running.hpp>
#include <host/drivers/haply/fake_inverse3.hpp>
#include <host/drivers/haply/inverse3.hpp>
#include <tactus/run/device/gestures.hpp>
#include <tactus/run/guard.hpp>
#include <tactus/run/realtime.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>
#include <vector>

using namespace tactus;
using namespace std::chrono_literals;
using test::eventually;
using test::Patience;
using Fault = host::FakeInverse3::Fault;

namespace
{
/// An arm that stands still, and knows what has pushed it. The same effort may act for several of its steps.
struct StillArm final : Device
{
    struct Felt
    {
        std::atomic<double> force = 0.0;   // along z, the last that was not 0
        std::atomic<std::uint64_t> steps = 0;
    };

    explicit StillArm (std::shared_ptr<Felt> f) : felt (std::move (f)) {}
    void prepare (double) override {}
    Reading read() noexcept override { return { .position = { 0.01, 0.02, 0.03 } }; }
    void write (const Effort& effort) noexcept override
    {
        if (effort.force.isZero (0.0)) return;
        felt->force = effort.force.z();
        ++felt->steps;
    }

    std::shared_ptr<Felt> felt;
};

/// A service with an arm that stands still, and the driver on it.
struct Arm : test::ServiceBench<host::FakeInverse3>
{
    explicit Arm (Patience patience, const Json& more = Json::object(), int answer_after_ms = 0, double silence_s = 60.0)
        : Arm (std::make_shared<StillArm::Felt>(), patience, more, answer_after_ms, silence_s)
    {
    }

    bool tick (double newtons)
    {
        return ServiceBench::tick ([&] (Effort& effort) { effort.force.z() = newtons; });
    }

    /// True as soon as the arm has felt 1 N from now on.
    bool pushes()
    {
        const auto before = felt->steps.load();
        felt->force = 0.0;
        return eventually ([&] {
            tick (1.0);
            return felt->steps > before && felt->force == 1.0;
        });
    }

    /// True as soon as no force acts any more.
    bool rests() const
    {
        return eventually ([&] { return service->force().isZero (0.0); });
    }

    std::shared_ptr<StillArm::Felt> felt;

private:
    static std::unique_ptr<host::FakeInverse3> made (const std::shared_ptr<StillArm::Felt>& f, int answer_after_ms)
    {
        auto made = host::FakeInverse3::make (0, std::make_unique<StillArm> (f), answer_after_ms);
        REQUIRE (made);
        return std::move (*made);
    }

    Arm (const std::shared_ptr<StillArm::Felt>& f, Patience patience, const Json& more, int answer_after_ms, double silence_s)
        : ServiceBench (made (f, answer_after_ms), "haply", host::patient_haply_driver, patience, more, silence_s), felt (f)
    {
    }
};
}   // namespace

TEST_CASE ("the Inverse3 is read and pushed through its service, with one message in flight", "[haply][wires]")
{
    Arm arm { Patience::ample, Json { { "grip", "wireless" } }, 3 };   // each answer comes after 3 ms, so that whatever is sent before it is seen
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
    CHECK (n.largest == 1.0);
    CHECK (arm.device->counts().departures == 0);

    // At the end, the last message that the service has heard asks for no force.
    arm.opened.device.reset();
    CHECK (arm.service->force().isZero (0.0));
}

TEST_CASE ("an arm behind a service is driven by one role, because the service adds up the forces of all", "[haply][wires][safety]")
{
    auto arm = std::make_unique<Arm> (Patience::ample);
    const int port = arm->service->port();
    CHECK_FALSE (test::lockOn (port, "04BA"));
    CHECK (test::lockOn (port, "1F2E"));   // another arm of the same service
    arm->opened.device.reset();
    auto other = test::lockOn (port, "04BA");
    REQUIRE (other);
    const Json description { { "driver", "haply" }, { "port", "127.0.0.1:" + std::to_string (port) } };
    const auto refused = host::openPluginDevice (description);
    CHECK_FALSE (refused.device);
    CHECK (test::text (refused.messages).find ("another role or another instance of Tactus is using it") != std::string::npos);
    other.reset();
    CHECK (host::openPluginDevice (description).device);
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
            const auto buttons = static_cast<std::uint32_t> (number % 16);
            return { .position = { 1e-6 * number, 0.0, 0.0 }, .rotation = { 0.6 * turn, 0.0, -0.8 * turn }, .buttons = buttons };
        }
        void write (const Effort&) noexcept override {}
        int number = 0;
    };
    auto made = host::FakeInverse3::make (0, std::make_unique<Hand>());
    REQUIRE (made);
    test::ServiceBench<host::FakeInverse3> arm { std::move (*made), "haply", host::patient_haply_driver, Patience::ample, { { "grip", "wireless" } } };
    int seen = 0, last = 0;
    REQUIRE (eventually ([&] {
        if (! arm.tick ([] (Effort&) {})) return false;
        const auto& reading = arm.reading;
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
    Arm arm { Patience::ample, Json { { "spelling", "vector" } }, 0, 0.02 };
    CHECK_FALSE (arm.device->about().rotation);
    const auto silences = arm.device->counts().silences;
    REQUIRE (arm.pushes());
    CHECK (arm.service->counts().refused == 0);

    // The program stops offering forces: the arm is brought to rest once, and then only asked.
    CHECK (eventually ([&] { return arm.device->counts().silences > silences; }));
    const auto at = arm.service->counts().probes;
    CHECK (eventually ([&] { return arm.service->counts().probes > at + 10; }));
    CHECK (arm.rests());
    const auto at_rest = arm.service->counts();
    const auto then = arm.device->counts().silences;
    CHECK (eventually ([&] { return arm.service->counts().probes > at_rest.probes + 10; }));
    CHECK (arm.service->counts().forces == at_rest.forces);
    CHECK (arm.device->counts().silences == then);
}

TEST_CASE ("a service of the Inverse3 that fails costs no force longer than a tick of it, and is found again", "[haply][wires][safety]")
{
    const auto fault = GENERATE (Fault::silent, Fault::rename, Fault::restart, Fault::garbage);
    Arm arm { fault == Fault::silent ? Patience::promised : Patience::ample };
    REQUIRE (arm.pushes());
    const auto before = arm.service->counts();
    arm.service->fail (fault);
    CHECK (eventually ([&] {
        arm.tick (1.0);
        return arm.device->counts().departures > 0;
    }));
    CHECK (arm.rests());          // the last force lasts for its tick
    if (fault == Fault::silent)   // each connection has one message that is not answered, and no other one follows
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
    Arm arm { Patience::ample };
    REQUIRE (arm.pushes());
    arm.service->fail (Fault::push);
    const auto readings = arm.device->counts().readings;
    CHECK (eventually ([&] {
        arm.tick (1.0);
        return arm.device->counts().readings > readings + 100;
    }));
    CHECK (arm.device->counts().departures == 0);
    CHECK (arm.stops());
    CHECK (arm.rests());
    arm.opened.device.reset();
    CHECK (arm.service->force().isZero (0.0));
}

TEST_CASE ("a service of the Inverse3 that only answers is asked", "[haply][wires]")
{
    auto felt = std::make_shared<StillArm::Felt>();
    auto made = host::FakeInverse3::make (0, std::make_unique<StillArm> (felt));
    REQUIRE (made);
    auto& service = **made;
    service.fail (Fault::shy);
    const auto driver = host::DeviceDriver::within (host::patient_haply_driver);
    REQUIRE (driver);
    Messages messages;
    auto opened = (*driver)->open ({ { "driver", "haply" }, { "port", "localhost:" + std::to_string (service.port()) } }, messages);
    INFO (test::text (messages));
    REQUIRE (opened);
    host::PluginDevice device { std::move (opened), std::nullopt, { .silence_s = 60.0, .patience = 60s, .real_time = false } };
    device.prepare (1e-3);
    CHECK (eventually ([&] {
        const auto reading = device.read();
        Effort effort;
        if (reading.valid) effort.force.z() = 1.0;
        device.write (effort);
        return felt->force == 1.0;
    }));
    CHECK (device.counts().departures == 0);
    CHECK (service.counts().refused == 0);
    CHECK (service.counts().together == 0);
}

TEST_CASE ("devices --probe shows an Inverse3 whose service only answers, and pushes nothing", "[haply][wires]")
{
    auto felt = std::make_shared<StillArm::Felt>();
    auto made = host::FakeInverse3::make (0, std::make_unique<StillArm> (felt));
    REQUIRE (made);
    auto& service = **made;
    service.fail (Fault::shy);
    test::Running program ({ "devices", "--probe", "--json", "--device", "haply:localhost:" + std::to_string (service.port()) });
    const bool is_asked = test::soon ([&] { return service.counts().answered > 50; });
    const auto ended = program.stop();
    INFO (ended.out << ended.err);
    REQUIRE (is_asked);
    CHECK (ended.status == 0);
    const auto json = Json::parse (ended.out);
    REQUIRE (json.size() == 1);
    CHECK (json[0]["valid"] == true);
    CHECK (json[0]["position"] == Json { 0.01, 0.02, 0.03 });
    CHECK (felt->steps == 0);
    CHECK (service.counts().pushes == 0);
}

TEST_CASE ("an Inverse3 that stays idle although it is pushed is not trusted", "[haply][wires][safety]")
{
    Arm arm { Patience::promised };
    REQUIRE (arm.pushes());
    arm.service->fail (Fault::deaf);
    CHECK (eventually ([&] {
        arm.tick (1.0);
        return arm.reading.fault == ReadingFault::not_driven && ! arm.reading.valid;
    }));
    arm.service->fail (Fault::none);
    CHECK (arm.pushes());
}

TEST_CASE ("an Inverse3 that freezes under a push is stopped, and ten minutes of a hand that rests against a push are not", "[haply][safety]")
{
    constexpr double dt = 1e-3, quantum = 10e-6;
    constexpr int ten_minutes = 600'000;
    auto limits = Arm (Patience::ample).opened.limits;
    CHECK (limits.max_still == 1.0);
    limits.watchdog = GuardLimits::none;   // no time passes here
    const auto guarded = [&] {
        Guard guard;
        guard.prepare (limits, dt);
        return guard;
    };
    const auto* hold = findGesture ("hold");
    REQUIRE (hold != nullptr);
    const auto resting = [&] (int k) {   // a tremor of tens of micrometres, as a coarse sensor has it
        const Vec3 at = hold->position (1.0 + std::fmod (k * dt, 4.0));
        Reading reading;
        for (int i = 0; i < 3; ++i)
            reading.position[i] = quantum * std::round (at[i] / quantum);
        return reading;
    };

    auto hand = guarded(), light = guarded();
    const Effort push { .force = { 0.0, 0.0, 1.2 } }, touch { .force = { 0.0, 0.0, 0.49 } };
    for (int k = 0; k < ten_minutes && hand.events() == 0 && light.events() == 0; ++k)
    {
        hand (push, resting (k));
        light (touch, resting (0));   // frozen, or lying on a table: less than still_force
    }
    CHECK (hand.stop() == Guard::Stop::none);
    CHECK (hand.events() == 0);
    CHECK (light.events() == 0);

    auto frozen = resting (ten_minutes);
    frozen.position.array() += quantum;   // at a place that is new in each direction, so that the time begins now
    int ticks = 0;
    while (ticks < 2000 && ! hand (push, frozen).force.isZero (0.0))
        ++ticks;
    CHECK (ticks > 990);
    CHECK (ticks <= 1000 + 5 + 2);
    CHECK (hand.stop() == Guard::Stop::stale);
}

TEST_CASE ("what is wrong with a description of an Inverse3, or with its service, is said", "[haply][wires]")
{
    Arm arm { Patience::ample };
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
    const auto driver = host::DeviceDriver::within (host::patient_haply_driver);
    REQUIRE (driver);
    const auto patiently = [&] (const char* key, const char* value) {
        auto d = arm.description;
        d[key] = value;
        Messages messages;
        CHECK ((*driver)->open (d, messages) == nullptr);
        return test::text (messages);
    };
    CHECK (patiently ("device_id", "FFFF").find ("no Inverse3 with the id FFFF") != std::string::npos);
    CHECK (patiently ("grip", "wired").find ("how the grip is held") != std::string::npos);
}

TEST_CASE ("a long run of an Inverse3: each message is answered, one at a time, and nothing pushes after a stop", "[haply][wires][soak]")
{
    const auto* wanted = std::getenv ("TACTUS_SOAK_SECONDS");
    // Forces follow as fast as they are answered, so 60 s of a client that sends 300 times a second take a few seconds. As in wire_soak_test, this shows
    // that no message is lost, doubled or sent before its time, and says nothing about time.
    const auto pushes = wanted != nullptr ? static_cast<std::uint64_t> (300.0 * std::max (1.0, std::atof (wanted))) : test::rounds (18'000ull);
    Arm arm { Patience::ample };
    REQUIRE (arm.pushes());
    const auto before = arm.service->counts();
    int tick = 0;
    REQUIRE (eventually (200us, 10'000 + 100 * static_cast<int> (pushes), [&] {
        arm.tick (++tick % 2 == 0 ? 0.5 : -0.5);
        return arm.service->counts().forces - before.forces >= pushes;
    }));
    CHECK (arm.device->counts().departures == 0);
    const auto n = arm.service->counts();
    CHECK (n.heard - n.answered <= 1);   // the last one may be under way
    CHECK (n.clients == 1);
    CHECK (n.together == 0);
    CHECK (n.refused == 0);
    CHECK (n.largest <= 1.0);

    // After a stop, only the message that was under way may ask for a force, and none after it, not even the last one.
    REQUIRE (arm.stops());
    const auto at_stop = arm.service->counts().heard;
    REQUIRE (eventually ([&] {
        arm.tick (0.0);
        return arm.service->counts().heard >= at_stop + 3;
    }));
    CHECK (arm.rests());
    const auto at_rest = arm.service->counts();
    REQUIRE (eventually ([&] {
        arm.tick (0.0);
        return arm.service->counts().heard > at_rest.heard + 300;
    }));
    arm.opened.device.reset();
    CHECK (arm.service->counts().pushes == at_rest.pushes);
    if (wanted != nullptr) std::cout << "WebSocket: " << n.heard << " messages, " << n.answered << " answers, never two forces in flight\n";
}

TEST_CASE ("a state of an Inverse3 is answered at once by whoever reads it", "[haply][wires][hops]")
{
    const auto* wanted = std::getenv ("TACTUS_HOPS");
    const int states = wanted ? std::stoi (wanted) : 200;
    if (wanted) becomeRealTime (std::nullopt);
    Arm arm { Patience::ample };
    REQUIRE (arm.pushes());
    std::vector<double> us;
    test::Pace pace { 1ms };
    while (us.size() < static_cast<std::size_t> (states))
    {
        // From a force to the arrival of the next state: the force on its way, the service, and the state on its way. A tick comes each millisecond, and
        // after the answer to the last one; nothing that this thread waits for is in the time.
        pace.next();
        const auto known = arm.device->counts().readings;
        const auto begin = test::fromNow (0ms);
        const bool pushed = arm.tick (0.5);
        REQUIRE (eventually ([&] { return arm.device->counts().readings > known; }));
        if (pushed) us.push_back (1e6 * std::chrono::duration<double> (arm.device->lastArrival() - begin).count());
    }
    const auto n = arm.service->counts();
    CHECK (n.together == 0);
    CHECK (n.heard - n.answered <= 1);
    CHECK (n.forces >= static_cast<std::uint64_t> (states));
    if (wanted == nullptr) return;
    std::ranges::sort (us);
    const auto quantile = [&] (double part) { return us[static_cast<std::size_t> (part * static_cast<double> (us.size() - 1))]; };
    std::cout << "WebSocket (Inverse3): " << us.size() << " reports, p50 " << quantile (0.5) << ", p90 " << quantile (0.9) << ", p99 " << quantile (0.99)
              << ", p99.9 " << quantile (0.999) << ", max " << us.back() << " us\n";
}
