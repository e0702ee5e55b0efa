// SPDX-License-Identifier: MIT
// A device's workspace in a graph: scaling and turning, the force on the hand, and limits that must not be loosened.

#include <host/devices/sessions/workspace.hpp>
#include <support/property.hpp>
#include <tactus/run/device/sim.hpp>
#include <tactus/text/json_text.hpp>

#include "support/no_allocation.hpp"
#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <memory>
#include <utility>

using namespace tactus;
using namespace tactus::host;

namespace
{
constexpr double dt = 1e-3;

/// A device whose position the test sets.
struct Put final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override { return reading; }
    void write (const Effort& e) noexcept override { asked = e; }
    void limitSignals (double max, double max_slew) override { signal_limits = { max, max_slew }; }
    void limitSlews (double force, double torque, double axis) override { slews = { force, torque, axis }; }
    DeviceLayout layout() const override { return { .axes = { "trigger" }, .mechanics = { 0.06, 1.5 } }; }
    double duration() const noexcept override { return 3.0; }

    Reading reading;
    Effort asked;
    std::pair<double, double> signal_limits;
    std::array<double, 3> slews {};
};

double within (double low, double high) { return low + (high - low) * *rc::gen::inRange (0, 1'000'001) / 1e6; }
Vec3 vectorWithin (double most) { return { within (-most, most), within (-most, most), within (-most, most) }; }
Workspace anyWorkspace() { return { std::pow (10.0, within (-1.0, 1.0)), vectorWithin (0.5) }; }

Vec3 anyDirection()
{
    const Vec3 v = vectorWithin (1.0);
    return v.norm() > 0.01 ? v.normalized() : Vec3 (1.0, 0.0, 0.0);
}

Mat3 matrixOf (const Vec3& rotation)
{
    return rotation.isZero (0.0) ? Mat3 (Mat3::Identity()) : Eigen::AngleAxisd (rotation.norm(), rotation.normalized()).toRotationMatrix();
}

/// Axes that turn and perhaps mirror, through a file, as a session has them.
Workspace anyTurnedWorkspace()
{
    const Mat3 turn = matrixOf (within (-3.0, 3.0) * anyDirection());
    const double side = *rc::gen::arbitrary<bool>() ? 1.0 : -1.0;
    Json rows = Json::array();
    for (int row = 0; row < 3; ++row)
        rows.push_back (Json::array ({ side * turn (row, 0), side * turn (row, 1), side * turn (row, 2) }));
    const auto named = rc::gen::element<std::string> (R"(["y", "-x", "z"])", R"(["-x", "y", "z"])", R"(["-y", "-z", "-x"])");
    if (*rc::gen::inRange (0, 3) == 0) rows = readJson (*named).root;
    Messages messages;
    auto w = readWorkspace ({ { "axes", rows }, { "scale", std::pow (10.0, within (-1.0, 1.0)) } }, "", messages);
    RC_ASSERT (messages.empty());
    w.offset = vectorWithin (0.5);
    return w;
}

struct Placed
{
    explicit Placed (const Workspace& w) : device (make (w)) {}

    std::unique_ptr<WorkspaceDevice> make (const Workspace& w)
    {
        auto inner = std::make_unique<Put>();
        put = inner.get();
        return std::make_unique<WorkspaceDevice> (std::move (inner), w);
    }

    Put* put;
    std::unique_ptr<WorkspaceDevice> device;
};
}   // namespace

TEST_CASE ("positions are scaled and shifted, and everything else is unchanged", "[sessions]")
{
    test::property ("reading", [] {
        const auto w = anyWorkspace();
        Placed placed { w };
        auto& there = placed.put->reading;
        there = { .position = vectorWithin (0.1),
                  .rotation = vectorWithin (3.0),
                  .pressure = within (0.0, 9.0),
                  .buttons = 5,
                  .age = within (0.0, 1.0),
                  .valid = *rc::gen::arbitrary<bool>(),
                  .true_position = vectorWithin (0.1),
                  .true_velocity = vectorWithin (2.0),
                  .axes = { 0.25 },
                  .signals = { 1.5 } };
        const auto seen = placed.device->read();
        RC_ASSERT ((seen.position - w.offset - w.scale * there.position).norm() < 1e-12);
        RC_ASSERT ((seen.true_position - w.offset - w.scale * there.true_position).norm() < 1e-12);
        RC_ASSERT (seen.true_velocity == w.scale * there.true_velocity);
        RC_ASSERT (seen.rotation == there.rotation);
        RC_ASSERT (seen.pressure == there.pressure && seen.buttons == there.buttons && seen.age == there.age && seen.valid == there.valid);
        RC_ASSERT (seen.axes[0] == 0.25 && seen.signals[0] == 1.5);
    });

    Placed placed { { 3.0, { 0.0, 0.0, 0.01 } } };
    CHECK (placed.device->layout() == DeviceLayout { .axes = { "trigger" }, .mechanics = { 0.02, 0.5 } });   // a third, because motion is scaled by 3
    CHECK (placed.device->duration() == 3.0);
    NoAllocation none;
    placed.device->read();
    placed.device->write ({ { 1.0, 2.0, 3.0 }, { 4.0, 5.0, 6.0 } });
    CHECK (none.allocations() == 0);
    CHECK (none.locks() == 0);
    CHECK (placed.put->asked.force == Vec3 (1.0, 2.0, 3.0));
    CHECK (placed.put->asked.torque == Vec3 (4.0, 5.0, 6.0));
}

TEST_CASE ("a turned or mirrored workspace turns motion and effort alike, so their work is the same", "[sessions]")
{
    test::property ("power", [] {
        const auto w = anyTurnedWorkspace();
        RC_ASSERT (w.isTurned());
        Placed placed { w };
        auto& there = placed.put->reading;
        there.position = vectorWithin (0.1);
        there.true_position = vectorWithin (0.1);
        there.true_velocity = vectorWithin (2.0);
        there.rotation = within (0.0, 3.0) * anyDirection();
        there.unrendered_force = vectorWithin (2.0);
        there.unrendered_torque = vectorWithin (0.1);
        const auto seen = placed.device->read();
        RC_ASSERT ((seen.position - w.toGraph (there.position)).norm() < 1e-12);
        RC_ASSERT ((seen.true_position - w.toGraph (there.true_position)).norm() < 1e-12);

        // What is turned about an axis on the device is turned about the same axis, seen in the graph, and the other way round in a mirror.
        RC_ASSERT ((matrixOf (seen.rotation) - w.axes * matrixOf (there.rotation) * w.axes.transpose()).norm() < 1e-12);

        const Effort effort { .force = vectorWithin (3.0), .torque = vectorWithin (0.1) };
        placed.device->write (effort);
        const auto& at = placed.put->asked;
        RC_ASSERT (std::abs (at.force.dot (there.true_velocity) - effort.force.dot (seen.true_velocity) / w.scale) < 1e-12);
        RC_ASSERT (at.force.norm() <= effort.force.norm() * (1.0 + 1e-15));   // the order of a sum may round
        RC_ASSERT (at.torque.norm() <= effort.torque.norm() * (1.0 + 1e-15));
        RC_ASSERT (at.force.norm() > effort.force.norm() * (1.0 - 1e-14));

        // The same for a torque: turn on by a small angle.
        const Vec3 turn = 1e-4 * anyDirection();
        there.rotation = turn;
        RC_ASSERT (std::abs (at.torque.dot (turn) - effort.torque.dot (placed.device->read().rotation)) < 1e-15);

        // What the motors did not render comes back along the same axes.
        there.unrendered_force = at.force;
        there.unrendered_torque = at.torque;
        const auto back = placed.device->read();
        RC_ASSERT ((back.unrendered_force - effort.force).norm() < 1e-12);
        RC_ASSERT ((back.unrendered_torque - effort.torque).norm() < 1e-12);
    });
}

TEST_CASE ("no workspace raises the force or its steps at the device above the limits of the guard", "[sessions][safety]")
{
    test::property ("attack", [] {
        auto w = anyTurnedWorkspace();
        if (*rc::gen::arbitrary<bool>()) w.scale = *rc::gen::element (1e-3, 1e3);
        const GuardLimits limits { .max_force = 2.0, .max_torque = 0.05, .max_slew = 500.0, .max_torque_slew = 20.0 };
        Guard guard;
        guard.prepare (inWorkspace (limits, w), dt);
        Placed placed { w };
        placed.device->prepare (dt);
        Effort before;
        for (int k = 0; k < 200; ++k)
        {
            placed.put->reading.position = vectorWithin (0.1);
            placed.put->reading.rotation = vectorWithin (1.0);
            const double size = std::pow (10.0, within (-3.0, 300.0));
            const auto guarded = guard ({ size * vectorWithin (1.0), size * vectorWithin (1.0) }, placed.device->read());
            placed.device->write (guarded);
            const auto& at = placed.put->asked;
            RC_ASSERT (at.force.norm() <= 2.0 * (1.0 + 1e-14));
            RC_ASSERT (at.torque.norm() <= 0.05 * (1.0 + 1e-14));
            RC_ASSERT ((at.force - before.force).norm() <= 0.5 * (1.0 + 1e-12));
            RC_ASSERT ((at.torque - before.torque).norm() <= 0.02 * (1.0 + 1e-12));
            before = at;
        }
    });
}

TEST_CASE ("a coordinate of the device that stands still is noticed in oblique axes, too", "[sessions][safety]")
{
    const Mat3 turn = matrixOf ({ 0.3, 0.2, 0.1 });
    auto inner = std::make_unique<Put>();
    auto& put = *inner;
    WorkspaceDevice device { std::move (inner), { .axes = turn }, { .max_still = 0.1, .still_force = 0.5, .still_torque = 0.01 } };
    device.prepare (dt);
    const auto ticksUntilFrozen = [&] (const Vec3& force) {
        for (int k = 1; k < 1000; ++k)
        {
            put.reading.position.x() += 1e-5;
            put.reading.position.y() -= 1e-5;
            device.write ({ turn * force });
            const auto reading = device.read();
            if (! reading.valid) return reading.fault == ReadingFault::frozen ? k : -1;
        }
        return 0;
    };
    put.reading.position.z() = 0.01;
    device.read();
    put.reading.position.z() = 0.02;
    device.read();
    CHECK (ticksUntilFrozen ({ 1.0, 1.0, 0.1 }) == 0);   // the device does not push along the coordinate that stands still
    CHECK (ticksUntilFrozen ({ 0.0, 0.0, 1.0 }) >= 100);
    put.reading.position.z() = 0.03;
    CHECK (device.read().valid);
}

TEST_CASE ("a wall of stiffness K in the graph feels like K times the scale to a pushing hand at rest", "[sessions]")
{
    const auto sketch = test::Sketch {}
                            .node ("hand", "device.position")
                            .node ("wall", "deform.plane", { { "stiffness", 400.0 } })
                            .node ("motor", "device.force")
                            .wire ("hand.position -> wall.position")
                            .wire ("wall.force -> motor.force");
    test::property ("stiffness", [&] {
        const double scale = std::pow (10.0, within (-0.6, 0.4)), push = within (0.2, 1.0);
        const Workspace w { scale, { 0.0, 0.0, within (-0.05, 0.05) } };
        // The position, on the device, of the surface that is at 0 in the graph.
        const double surface = -w.offset.z() / scale;
        auto simulated = std::make_unique<SimulatedDevice> (
            Simulation { .mass = 0.1, .damping = 20.0, .position = { 0.0, 0.0, surface }, .hand_force = { 0.0, 0.0, -push } });
        auto* tool = simulated.get();
        WorkspaceDevice device { std::move (simulated), w };
        Engine engine { sketch.compile ({ .rate_hz = 1000.0 }).plan };
        engine.attach ("stylus", device);
        for (int k = 0; k < 4000; ++k)
            engine.tick();
        const double depth = surface - tool->read().true_position.z();
        RC_ASSERT (std::abs (push / depth / (400.0 * scale) - 1.0) < 1e-3);
    });
}

TEST_CASE ("at any scale, a guard stops a device exactly at the device's own limits", "[sessions]")
{
    test::property ("limits", [] {
        const auto w = anyWorkspace();
        GuardLimits limits { .max_force = 3.0 };
        const bool by_speed = *rc::gen::arbitrary<bool>();
        if (by_speed)
            limits.max_speed = 0.5;
        else
        {
            limits.max_energy = 0.01;
            limits.energy_window = 1.0;
        }
        Guard plain, placed;
        plain.prepare (limits, dt);
        placed.prepare (inWorkspace (limits, w), dt);
        const double speed = within (0.3, 0.7);
        const Vec3 along = Vec3 (1.0, 0.5, -0.2).normalized();
        Placed device { w };
        int plain_stopped = -1, placed_stopped = -1;
        for (int k = 0; k < 400; ++k)
        {
            device.put->reading.position = along * speed * dt * k;
            const Effort wanted { 2.0 * along, Vec3::Zero() };
            plain (wanted, device.put->reading);
            placed (wanted, device.device->read());
            if (plain_stopped < 0 && plain.stop() != Guard::Stop::none) plain_stopped = k;
            if (placed_stopped < 0 && placed.stop() != Guard::Stop::none) placed_stopped = k;
            RC_ASSERT (plain.stop() == placed.stop() || std::abs (plain_stopped - placed_stopped) <= 1);
        }
        RC_ASSERT (std::abs (plain_stopped - placed_stopped) <= 1);
    });

    const auto limits = inWorkspace ({ .max_force = 3.0, .max_slew = 100.0, .max_speed = 1.0, .max_impulse = 2.0 }, { 0.5, Vec3::Zero() });
    CHECK (limits.max_force == 3.0);
    CHECK (limits.max_slew == 100.0);
    CHECK (limits.max_speed == 1.0);
    CHECK (limits.workspace_scale == 0.5);
    CHECK (limits.max_impulse == 2.0);
    CHECK (tightest (limits, { .max_speed = 2.0 }).workspace_scale == 0.5);
}

TEST_CASE ("a workspace is read with units, and a bad one is refused", "[sessions]")
{
    Messages messages;
    CHECK (readWorkspace ({ { "scale", 2 }, { "offset", { 0, 0, "1 cm" } } }, "", messages) == Workspace { 2.0, { 0.0, 0.0, 0.01 } });
    CHECK (readWorkspace (Json::object(), "", messages).isPlain());
    const auto mirrored = readWorkspace ({ { "axes", { "y", "x", "-z" } }, { "clutch", "grip" } }, "", messages);
    CHECK (mirrored.axes * Vec3 (1.0, 2.0, 3.0) == Vec3 (2.0, 1.0, -3.0));
    CHECK_FALSE (mirrored.isMirrored());
    CHECK (mirrored.clutch == "grip");
    CHECK (readWorkspace ({ { "axes", { "x", "y", "-z" } } }, "", messages).isMirrored());
    // A rotation with ten digits is straightened.
    const auto turned = readWorkspace ({ { "axes", { { 0.8, -0.6, 0 }, { 0.5999999999, 0.8000000001, 0 }, "z" } } }, "", messages);
    CHECK ((turned.axes * turned.axes.transpose() - Mat3::Identity()).norm() < 1e-15);
    CHECK ((turned.axes * Vec3 (1.0, 0.0, 0.0) - Vec3 (0.8, 0.6, 0.0)).norm() < 1e-9);
    CHECK (messages.empty());

    const auto [json, id] = GENERATE (table<Json, std::string> ({
        { { { "scale", 0 } }, "device/out_of_range" },
        { { { "scale", -1 } }, "device/out_of_range" },
        { { { "scale", 1e6 } }, "device/out_of_range" },
        { { { "scale", "2 mm" } }, "device/unit" },
        { { { "offset", { 1, 2 } } }, "device/kind" },
        { { { "offset", { 0, 0, "1 N" } } }, "device/unit" },
        { { { "rotation", 3 } }, "device/unknown_key" },
        { { { "axes", { "x", "y" } } }, "device/axes" },
        { { { "axes", { "x", "y", "y" } } }, "device/axes" },
        { { { "axes", { "x", "y", "w" } } }, "device/axes" },
        { { { "axes", { { 2, 0, 0 }, "y", "z" } } }, "device/axes" },
        { { { "axes", 3 } }, "device/axes" },
        { { { "clutch", 3 } }, "device/kind" },
        { 3, "device/kind" },
    }));
    const auto w = readWorkspace (json, "/roles/stylus/workspace", messages);
    REQUIRE (messages.size() == 1);
    CHECK (messages.front().id == id);
    CHECK (messages.front().where.starts_with ("/roles/stylus/workspace"));
    CHECK (w.scale == 1.0);
    CHECK_FALSE (w.isTurned());
}

TEST_CASE ("a brake in a workspace takes the same force at the same motion of the device", "[sessions][brake]")
{
    SimulatedDevice plain ({ .mass = 0.1, .damping = 0.0, .brake = 6.0, .velocity = { 1, 0, 0 } });
    auto owned = std::make_unique<SimulatedDevice> (Simulation { .mass = 0.1, .damping = 0.0, .brake = 6.0, .velocity = { 1, 0, 0 } });
    auto* tool = owned.get();
    WorkspaceDevice scaled { std::move (owned), Workspace { .scale = 3.0 } };
    CHECK (scaled.layout().brake == 2.0);
    CHECK (inWorkspace ({ .max_brake = 6.0, .brake_at_stop = 3.0 }, { .scale = 3.0 }).max_brake == 2.0);
    CHECK (inWorkspace ({ .max_brake = 6.0, .brake_at_stop = 3.0 }, { .scale = 3.0 }).brake_at_stop == 1.0);
    plain.prepare (dt);
    scaled.prepare (dt);
    plain.write ({ .brake = 4.5 });
    scaled.write ({ .brake = 1.5 });   // the tool of the graph moves three times as far
    CHECK (tool->read().true_velocity.x() == plain.read().true_velocity.x());
}

TEST_CASE ("a device in a workspace gets the signal limits of its guard, as the guard reads them", "[sessions][safety]")
{
    const auto plan = test::Sketch {}.node ("out", "device.signal_out").compile ({ .rate_hz = 1.0 / dt }).plan;
    REQUIRE (plan);
    Engine engine { plan };
    Placed placed { { .scale = 2.0 } };
    engine.attach ("stylus", *placed.device, { .max_signal = 0.5, .max_signal_slew = 20.0 });
    CHECK (placed.put->signal_limits == std::pair { 0.5, 20.0 });
    engine.attach ("stylus", *placed.device, { .max_signal = -1.0, .max_signal_slew = std::nan ("") });
    CHECK (placed.put->signal_limits == std::pair { 0.0, 0.0 });
    engine.attach ("stylus", *placed.device, { .max_slew = 30.0, .max_torque_slew = 2.0, .max_axis_slew = 5.0 });
    CHECK (placed.put->slews == std::array { 30.0, 2.0, 5.0 });
}
