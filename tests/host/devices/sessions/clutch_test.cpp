// SPDX-License-Identifier: MIT
// A button that moves the workspace: no step of the position or the force, whatever the hand does with it.

#include <host/devices/sessions/workspace.hpp>
#include <support/property.hpp>

#include "support/no_allocation.hpp"
#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

using namespace tactus;
using namespace tactus::host;

namespace
{
constexpr double dt = 1e-3, stiffness = 300.0, strongest = 3.0, ramp = 0.02;

/// A device whose position and button the test sets.
struct Put final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override { return reading; }
    void write (const Effort& e) noexcept override { asked = e; }
    DeviceLayout layout() const override { return { .buttons = { "", "grip" } }; }

    Reading reading;
    Effort asked;
};

/// A device in a workspace, and what the nodes see of it: like device.position, they keep the last valid position.
struct Spy final : Device
{
    explicit Spy (const Workspace& w)
    {
        auto inner = std::make_unique<Put>();
        put = inner.get();
        device = std::make_unique<WorkspaceDevice> (std::move (inner), w);
    }

    void prepare (double dt_s) override { device->prepare (dt_s); }
    Reading read() noexcept override
    {
        latest = device->read();
        if (latest.valid) seen = latest.position;
        return latest;
    }
    void write (const Effort& e) noexcept override { device->write (e); }
    DeviceLayout layout() const override { return device->layout(); }

    void hold (bool down) { put->reading.buttons = down ? 2u : 0u; }

    Put* put;
    std::unique_ptr<WorkspaceDevice> device;
    Reading latest;
    Vec3 seen = Vec3::Zero();
};

/// A wall at z = 0, and a guard without a limit of the slew, so that only the clutch keeps the force from stepping.
struct Contact
{
    explicit Contact (const Workspace& w, double max_speed = GuardLimits::none) : spy (w), engine (wall().compile ({ .rate_hz = 1.0 / dt }).plan)
    {
        engine.attach ("stylus", spy, { .max_force = strongest, .ramp = ramp, .max_speed = max_speed });
    }

    static test::Sketch wall()
    {
        return test::Sketch {}
            .node ("hand", "device.position")
            .node ("wall", "deform.plane", { { "stiffness", stiffness } })
            .node ("motor", "device.force")
            .wire ("hand.position -> wall.position")
            .wire ("wall.force -> motor.force");
    }

    void tick (int n = 1)
    {
        for (; n > 0; --n)
            engine.tick();
    }

    Vec3& position() { return spy.put->reading.position; }
    const Vec3& force() const { return spy.put->asked.force; }

    Spy spy;
    Engine engine;
};

double within (double low, double high) { return low + (high - low) * *rc::gen::inRange (0, 1'000'001) / 1e6; }
}   // namespace

TEST_CASE ("a clutch moves the workspace and leaves the tool where it is in the graph", "[sessions][clutch]")
{
    Contact contact { { .scale = 2.0, .clutch = "grip" } };
    contact.position() = { 0.0, 0.0, -0.002 };
    contact.tick (100);
    CHECK (contact.force().z() == Approx (stiffness * 0.004));
    CHECK (contact.spy.seen.z() == -0.004);

    contact.spy.hold (true);
    contact.tick (20);
    CHECK (contact.force().isZero (0.0));
    CHECK_FALSE (contact.spy.latest.valid);
    CHECK (describe (contact.spy.latest.fault) == "its workspace is being moved");
    contact.spy.put->reading.valid = false;   // what the device says itself counts for more
    contact.spy.put->reading.fault = ReadingFault::unplugged;
    contact.tick();
    CHECK (contact.spy.latest.fault == ReadingFault::unplugged);
    contact.spy.put->reading.valid = true;
    contact.spy.put->reading.fault = ReadingFault::none;
    for (int k = 0; k < 100; ++k)
    {
        contact.position().x() += 0.0005;
        contact.spy.put->reading.true_velocity.x() = 0.5;
        contact.tick();
        REQUIRE (contact.force().isZero (0.0));
        REQUIRE (contact.spy.latest.position.z() == -0.004);
        REQUIRE (contact.spy.latest.position.x() == 0.0);
        REQUIRE (contact.spy.latest.true_velocity.isZero (0.0));
    }

    contact.spy.hold (false);
    contact.tick();
    CHECK (contact.spy.latest.valid);
    CHECK (contact.spy.seen == Vec3 (0.0, 0.0, -0.004));
    CHECK (contact.force().z() < 0.1);   // the guard's ramp begins
    contact.tick (100);
    CHECK (contact.force().z() == Approx (stiffness * 0.004));
    contact.position().x() += 0.001;
    contact.tick();
    CHECK (contact.spy.seen.x() == Approx (0.002));
}

TEST_CASE ("however the hand moves and presses, neither the position nor the force steps", "[sessions][clutch][safety]")
{
    test::property ("contact", [] {
        const double scale = std::pow (10.0, within (-0.5, 0.5)), speed = within (0.0, 1.0);
        Contact contact { { .scale = scale, .clutch = *rc::gen::element<std::string> ("grip", "1") } };
        contact.position() = { 0.0, 0.0, within (-0.01, 0.005) };
        contact.tick();
        bool is_held = false, was_moved = false, was_there = true;
        int next = 0;
        for (int k = 0; k < 600; ++k)
        {
            if (k >= next)
            {
                is_held = ! is_held;
                next = k + *rc::gen::inRange (1, 80);   // also shorter than the force needs to fall
            }
            contact.spy.hold (is_held);
            const bool is_there = *rc::gen::inRange (0, 50) > 0;
            contact.spy.put->reading.valid = is_there;
            const Vec3 step = speed * dt * Vec3 (within (-1.0, 1.0), within (-1.0, 1.0), within (-1.0, 1.0));
            contact.position() += step;
            const Vec3 before = contact.spy.seen, force = contact.force();
            contact.tick();
            const double moved = scale * step.norm();
            // After a while without a reading the device is somewhere else, clutch or not.
            if (was_there && is_there) RC_ASSERT ((contact.spy.seen - before).norm() <= moved + 1e-12);
            was_there = is_there;
            RC_ASSERT ((contact.force() - force).norm() <= strongest * dt * (1.0 / Guard::fade_s + 1.0 / ramp) + stiffness * moved + 1e-9);
            RC_ASSERT (contact.force().norm() <= strongest * (1.0 + 1e-12));
            was_moved = was_moved || (contact.spy.seen - scale * contact.position()).norm() > 1e-9;
        }
        if (speed > 0.1) RC_ASSERT (was_moved);
    });
}

TEST_CASE ("a press and a release between two ticks of valid readings keep the position to the last bit", "[sessions][clutch]")
{
    Contact contact { { .clutch = "grip" } };
    contact.position() = { 0.0, 0.0, -0.005 };
    contact.tick (100);
    contact.spy.hold (true);
    contact.tick();
    contact.spy.hold (false);
    int until_valid = 0;
    for (; ! contact.spy.latest.valid && until_valid < 100; ++until_valid)
    {
        contact.position().z() -= 0.0001;
        contact.tick();
        CHECK (contact.spy.seen.z() == -0.005);
    }
    CHECK (until_valid < 20);   // the press is carried through: as long as the force needs to fall
    CHECK (until_valid > 2);
}

TEST_CASE ("a lying device cannot move the workspace out of the sight of the guard", "[sessions][clutch][safety]")
{
    Clutch clutch;
    const auto put = [&] (double x, bool is_held) {
        Reading reading { .position = { x, 0.0, 0.0 } };
        clutch (reading, is_held);
        return reading;
    };
    put (0.01, false);
    CHECK_FALSE (put (0.01, true).valid);
    for (const double far : { 1e6, -1e300, std::numeric_limits<double>::infinity(), std::nan ("") })
    {
        put (far, true);
        put (far, false);
        CHECK (clutch.moved().isZero (0.0));
        CHECK_FALSE (put (0.01, true).valid);
    }
    CHECK (put (0.5, false).position.x() == 0.5);   // the last place that the nodes know is too far away to go on from
    put (0.01, false);
    CHECK_FALSE (put (0.01, true).valid);
    CHECK (put (0.5, false).position.x() == Approx (0.01));
    CHECK (clutch.moved().x() == Approx (-0.49));

    // A reading that is not a number is passed on as it is.
    CHECK (std::isnan (put (std::nan (""), true).position.x()));
    CHECK (std::isnan (put (std::nan (""), false).position.x()));
}

TEST_CASE ("a key holds the clutch as its button does, and needs none", "[sessions][clutch]")
{
    Contact contact { {} };
    contact.position() = { 0.0, 0.0, -0.004 };
    contact.tick (100);
    CHECK (contact.force().z() == Approx (stiffness * 0.004));
    contact.spy.device->hold (true);
    contact.tick (20);
    CHECK (contact.force().isZero (0.0));
    contact.position() = { 0.03, 0.0, 0.01 };
    contact.tick (5);
    CHECK (contact.spy.seen.z() == -0.004);
    contact.spy.device->hold (false);
    contact.tick();
    CHECK (contact.spy.latest.valid);
    CHECK ((contact.spy.seen - Vec3 (0.0, 0.0, -0.004)).norm() < 1e-15);
    CHECK (contact.force().z() <= strongest * dt / ramp * (1.0 + 1e-12));
    contact.tick (100);
    CHECK (contact.force().z() == Approx (stiffness * 0.004));
    CHECK (contact.spy.device->origin().x() == Approx (-0.03));
    CHECK (contact.spy.device->origin().z() == Approx (-0.014));
}

TEST_CASE ("an origin that is moved puts the tool elsewhere in the graph, without a step of the force and without a speed", "[sessions][clutch][safety]")
{
    Contact contact { { .scale = 2.0, .offset = { 0.0, 0.0, 0.001 } }, 1.0 };   // the place jumps by 3 mm in a tick, which would be 3 m/s
    contact.position() = { 0.0, 0.0, -0.002 };
    contact.tick (100);
    CHECK (contact.force().z() == Approx (stiffness * 0.003));
    CHECK (contact.spy.device->origin() == Vec3 (0.0, 0.0, 0.001));

    contact.spy.device->moveTo ({ 0.0, 0.0, 0.5 });
    contact.spy.device->moveTo ({ 0.01, 0.0, -0.002 });   // the latest one counts
    CHECK (contact.spy.device->origin() == Vec3 (0.01, 0.0, -0.002));
    int invalid = 0;
    for (int k = 0; k < 100; ++k)
    {
        const double before = contact.force().z();
        const Vec3 seen = contact.spy.seen;
        contact.tick();
        REQUIRE (std::abs (contact.force().z() - before) <= strongest * dt * (1.0 / Guard::fade_s + 1.0 / ramp) + 1e-12);
        if (contact.spy.seen != seen)
        {
            CHECK (before == 0.0);
            CHECK (contact.force().z() <= strongest * dt / ramp * (1.0 + 1e-12));
        }
        invalid += contact.spy.latest.valid ? 0 : 1;
    }
    CHECK (invalid > 1);
    CHECK (contact.spy.seen.z() == Approx (-0.006));
    CHECK (contact.spy.seen.x() == Approx (0.01));
    CHECK (contact.force().z() == Approx (stiffness * 0.006));
    CHECK (contact.spy.device->origin().isApprox (Vec3 (0.01, 0.0, -0.002)));

    // In the air, too, the reading is missed for a tick.
    for (int k = 0; k < 200; ++k)   // slowly, for the limit of the speed
    {
        contact.position().z() = -0.002 + 0.0002 * k;
        contact.tick();
    }
    CHECK (contact.force().isZero (0.0));
    contact.spy.device->moveTo ({ 0.0, 0.0, -0.3 });
    contact.tick();
    CHECK_FALSE (contact.spy.latest.valid);
    contact.tick();
    CHECK (contact.spy.latest.valid);
    CHECK (contact.spy.seen.z() < 0.0);
    CHECK (contact.force().z() > 0.0);
    CHECK (contact.force().z() <= strongest * dt / ramp * (1.0 + 1e-12));
    contact.tick (100);
    CHECK (contact.force().z() == Approx (strongest));   // no stop: the guard has seen no speed
}

TEST_CASE ("however the origin is moved and the key is pressed, the force does not step", "[sessions][clutch][safety]")
{
    test::property ("contact", [] {
        const double scale = std::pow (10.0, within (-0.5, 0.5)), speed = within (0.0, 1.0);
        Contact contact { { .scale = scale, .clutch = "grip" } };
        auto& device = *contact.spy.device;
        contact.position() = { 0.0, 0.0, within (-0.01, 0.005) };
        contact.tick();
        std::optional<Vec3> goal;
        int next = 0;
        for (int k = 0; k < 600; ++k)
        {
            if (k >= next)
            {
                next = k + *rc::gen::inRange (1, 60);
                switch (*rc::gen::inRange (0, 4))
                {
                case 0:
                    goal = Vec3 (within (-0.05, 0.05), within (-0.05, 0.05), within (-0.01, 0.01));
                    device.moveTo (*goal);
                    break;
                case 1:
                    device.hold (true);
                    break;
                case 2:
                    device.hold (false);
                    break;
                default:
                    contact.spy.hold (*rc::gen::inRange (0, 2) == 0);
                }
            }
            contact.spy.put->reading.valid = *rc::gen::inRange (0, 50) > 0;
            const Vec3 step = speed * dt * Vec3 (within (-1.0, 1.0), within (-1.0, 1.0), within (-1.0, 1.0));
            contact.position() += step;
            const Vec3 before = contact.force();
            contact.tick();
            RC_ASSERT ((contact.force() - before).norm()
                       <= strongest * dt * (1.0 / Guard::fade_s + 1.0 / ramp) + stiffness * scale * step.norm() + 1e-9);
            RC_ASSERT (contact.force().norm() <= strongest * (1.0 + 1e-12));
        }

        // At rest, it arrives where it shall be.
        contact.spy.put->reading.valid = true;
        contact.spy.hold (false);
        device.hold (false);
        const Vec3 last (0.01, -0.02, 0.003);
        device.moveTo (last);
        contact.tick (200);
        RC_ASSERT ((device.origin() - last).norm() < 1e-15);
        RC_ASSERT ((contact.spy.seen - (scale * contact.position() + last)).norm() < 1e-12);
    });
}

TEST_CASE ("a clutch is a button that the device has, by name or number", "[sessions][clutch]")
{
    const DeviceLayout has { .buttons = { "", "grip" } };
    for (const auto* good : { "", "grip", "0", "1" })
        CHECK_FALSE (wrongClutch ({ .clutch = good }, has));
    for (const auto* bad : { "grab", "2", "-1", "1x" })
    {
        const auto wrong = wrongClutch ({ .clutch = bad }, has);
        REQUIRE (wrong);
        CHECK (wrong->id == "device/no_button");
        CHECK (wrong->where == "/workspace/clutch");
    }
    CHECK (wrongClutch ({ .clutch = "grab" }, has)->text.find ("grip") != std::string::npos);

    Contact contact { { .clutch = "grip" } };
    contact.spy.hold (true);
    contact.tick();
    NoAllocation none;
    for (int k = 0; k < 50; ++k)
    {
        contact.spy.hold (k > 20 && k < 30);
        contact.spy.device->hold (k > 35 && k < 40);
        if (k % 7 == 0) contact.spy.device->moveTo ({ 0.001 * k, 0.0, 0.0 });
        contact.spy.read();
        contact.spy.write ({});
    }
    CHECK (none.allocations() == 0);
    CHECK (none.locks() == 0);
}
