// SPDX-License-Identifier: MIT
// Random graphs drive random devices through the engine; the test decodes the reports on the wire.

#include "hid.hpp"
#include "support/sketch.hpp"

#include <host/devices/hid/bits.hpp>

#include <support/property.hpp>
#include <tactus/run/engine.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host::hid;
using test::Sketch;

namespace
{
constexpr double rate_hz = 1000.0;

double any (double least, double most) { return least + (most - least) * *rc::gen::inRange (0, 1001) / 1000.0; }

/// A device whose reports are decoded where they would reach the wire.
struct Wired final : Device
{
    explicit Wired (std::shared_ptr<const Profile> p) : profile (p), model (p) {}

    void prepare (double dt_s) override { dt = dt_s; }

    Reading read() noexcept override
    {
        const auto report = reports[tick++ % reports.size()];
        model.decode (report);
        auto reading = model.reading();
        reading.unrendered_force = guarded_force - model.renderedForce();
        return reading;
    }

    void write (const Effort& guarded) noexcept override
    {
        guarded_force = guarded.force;
        HidEffort effort { guarded.force, guarded.torque, model.restEfforts() };
        model.take (guarded.axes, effort);
        const auto values = model.drive (effort, dt);
        for (std::size_t r = 0; r < model.outputs(); ++r)
        {
            const auto wire = model.encodeValues (r, values);
            const auto body = profile->outputs[r].id ? wire : wire.subspan (1);
            for (const auto& field : profile->outputs[r].fields)
                for (std::size_t i = 0; i < model.effortNames().size(); ++i)
                    if (field.source == OutputField::Source::effort && field.name == model.effortNames()[i])
                        sent[i] = numberOf (field.bits, bitsAt (field.bits, body)) * field.encoding.scale + field.encoding.offset;
        }
    }

    DeviceLayout layout() const override { return { .axes = model.axisNames(), .efforts = model.ownEffortNames() }; }

    std::shared_ptr<const Profile> profile;
    HidModel model;
    std::vector<Bytes> reports;
    std::size_t tick = 0;
    double dt = 0.0;
    EffortValues sent {};
    Vec3 guarded_force = Vec3::Zero();
};

enum class Arm
{
    shipped,   // that of a shipped profile: Direct or SerialArm
    linear,
    five_bars
};

std::shared_ptr<const Profile> anyProfile (Arm kind = Arm::shipped)
{
    Profile p = *test::profileOf (kind == Arm::shipped ? *rc::gen::element<std::string> ("tactus_board", "woodenhaptics_usb") : "woodenhaptics_usb");
    if (auto* arm = std::get_if<SerialArm> (&p.kinematics))
    {
        arm->links = { any (0.05, 0.2), any (0.1, 0.3), any (0.1, 0.3) };
        for (auto& drive : arm->drives)
        {
            drive.torque_constant = any (0.02, 0.1);
            drive.max_current = any (0.5, 4.0);
        }
        if (kind == Arm::linear)
        {
            LinearMap map;
            for (int i = 0; i < 9; ++i)
                map.matrix (i / 3, i % 3) = any (-0.3, 0.3);
            p.kinematics = map;
        }
        if (kind == Arm::five_bars)   // of the size of a Pantograph; the counts of anyReports turn each driven link by up to 0.06 rad
        {
            FiveBar bar;
            bar.base = 0.025;
            bar.links = { any (0.05, 0.07), any (0.07, 0.09), any (0.07, 0.09), any (0.05, 0.07) };
            for (std::size_t i = 0; i < 2; ++i)
                bar.drives[i] = { .counts_per_turn = 300000, .offset = i == 0 ? 0.8 : 2.3, .torque_constant = any (0.02, 0.1), .max_current = any (0.5, 4.0) };
            p.kinematics = bar;
        }
    }
    auto& guard = p.limits.guard;
    guard = { .max_force = any (0.5, 5.0), .max_torque = any (0.01, 0.1), .ramp = 0.005, .max_axis_effort = any (0.1, 2.0) };
    guard.max_slew = guard.max_force * any (5.0, 100.0);
    guard.max_torque_slew = guard.max_torque * any (5.0, 100.0);
    guard.max_axis_slew = guard.max_axis_effort * any (5.0, 100.0);
    p.limits.max_motor = any (0.1, 3.0);
    p.limits.max_motor_slew = p.limits.max_motor * any (5.0, 100.0);
    return std::make_shared<const Profile> (std::move (p));
}

/// Reports of a hand that moves arbitrarily fast.
std::vector<Bytes> anyReports (const Profile& profile)
{
    const auto& in = profile.inputs[0];
    std::vector<Bytes> all (40, Bytes (in.length));
    int number = 0;
    for (auto& bytes : all)
    {
        ++number;
        for (const auto& field : in.fields)
        {
            auto raw = static_cast<int> (field.expect.value_or (field.name == profile.valid ? 1 : 0));
            if (std::ranges::count (profile.position, field.name) > 0) raw = *rc::gen::inRange (-3000, 3001);
            if (field.name == in.sequence) raw = number;
            if (field.name == in.timestamp) raw = 1000 * number;
            putBits (field.bits, static_cast<std::uint32_t> (raw), bytes);
        }
    }
    return all;
}

/// A graph in which several nodes push each part of the device, far harder than allowed.
Sketch anyGraph (const std::vector<std::string>& efforts)
{
    Sketch s;
    auto source = [&, n = 0] (double most) mutable {
        const auto name = "source" + std::to_string (n++);
        const double size = most * any (0.0, 1.0) * *rc::gen::element (1.0, 1.0, 1e6);
        if (*rc::gen::arbitrary<bool>())
        {
            const auto shape = *rc::gen::element<std::string> ("sine", "square");
            s.node (name, "signal.lfo", { { "amplitude", size }, { "frequency", any (1.0, 300.0) }, { "shape", shape } });
        }
        else
            s.node (name, "signal.constant", { { "value", size * *rc::gen::element (1.0, -1.0) } });
        return name + ".out";
    };
    const int motors = *rc::gen::inRange (1, 4);
    for (int i = 0; i < motors; ++i)
    {
        const auto motor = "motor" + std::to_string (i);
        s.node (motor, "device.force");
        for (const auto* port : { ".force.x", ".force.y", ".force.z", ".torque.x", ".torque.y" })
            if (*rc::gen::arbitrary<bool>()) s.wire (source (20.0) + " -> " + motor + port);
    }
    for (const auto& effort : efforts)
        if (*rc::gen::arbitrary<bool>())
        {
            s.node ("push_" + effort, "device.effort", {}, { { "axis", effort } });
            s.wire (source (5.0) + " -> push_" + effort + ".effort");
        }
    return s;
}
}   // namespace

TEST_CASE ("no report on the wire exceeds a limit or a slew of its device, whatever the graph, the profile and the kinematics", "[hid][property]")
{
    const auto kind = GENERATE (Arm::shipped, Arm::linear, Arm::five_bars);
    int driven = 0, turned = 0;
    test::property ("any graph and device " + std::to_string (static_cast<int> (kind)), [&] {   // rapidcheck runs a property once per name
        const auto profile = anyProfile (kind);
        Wired device (profile);
        device.reports = anyReports (*profile);
        const auto sketch = anyGraph (device.model.ownEffortNames());
        const auto compiled = sketch.compile ({ .rate_hz = rate_hz });
        RC_ASSERT (compiled.plan != nullptr);
        if (compiled.plan->roles().empty()) return;
        const auto& role = compiled.plan->roles()[0].name;
        Engine engine { compiled.plan };
        const auto& limits = profile->limits;
        engine.attach (role, device, limits.guard);

        constexpr double dt = 1.0 / rate_hz, count = 1e-3;   // in the unit of the coarser device
        constexpr double torque_count = 1e-5;                // N m
        EffortValues last = device.model.restEfforts();
        for (int k = 0; k < 40; ++k)
        {
            engine.tick();
            Vec3 motors;
            for (std::size_t i = 0; i < 3; ++i)
            {
                const auto at = static_cast<std::size_t> (indexOf (device.model.effortNames(), profile->force[i]));
                motors[static_cast<int> (i)] = device.sent[at];
                RC_ASSERT (std::abs (device.sent[at]) <= limits.max_motor + count);
                RC_ASSERT (std::abs (device.sent[at] - last[at]) <= limits.max_motor_slew * dt + 2.0 * count);
            }
            for (const auto& name : device.model.ownEffortNames())
            {
                const auto at = static_cast<std::size_t> (indexOf (device.model.effortNames(), name));
                RC_ASSERT (std::abs (device.sent[at]) <= limits.guard.max_axis_effort + count);
                RC_ASSERT (std::abs (device.sent[at] - last[at]) <= limits.guard.max_axis_slew * dt + 2.0 * count);
            }
            driven += motors.isZero (0.0) ? 0 : 1;
            if (std::holds_alternative<DirectKinematics> (profile->kinematics))
            {
                Vec3 torque, step, force_step;
                for (std::size_t i = 0; i < 3; ++i)
                {
                    const auto at = static_cast<std::size_t> (indexOf (device.model.effortNames(), profile->torque[i]));
                    const auto force_at = static_cast<std::size_t> (indexOf (device.model.effortNames(), profile->force[i]));
                    torque[static_cast<int> (i)] = device.sent[at];
                    step[static_cast<int> (i)] = device.sent[at] - last[at];
                    force_step[static_cast<int> (i)] = device.sent[force_at] - last[force_at];
                }
                RC_ASSERT (motors.norm() <= limits.guard.max_force + 2.0 * count);
                RC_ASSERT (force_step.norm() <= limits.guard.max_slew * dt + 4.0 * count);
                RC_ASSERT (torque.norm() <= limits.guard.max_torque + 2.0 * torque_count);
                RC_ASSERT (step.norm() <= limits.guard.max_torque_slew * dt + 4.0 * torque_count);
                turned += torque.isZero (0.0) ? 0 : 1;
            }
            last = device.sent;
        }
    });
    CHECK (driven > 100);
    if (kind == Arm::shipped) CHECK (turned > 30);
}

TEST_CASE ("device.force.applied shows the force that the motors render, decoded from the wire", "[hid][property]")
{
    int limited = 0, whole = 0;
    test::property ("any graph", [&] {
        auto changed = *anyProfile();
        changed.kinematics = DirectKinematics {};
        changed.axes = Mat3::Identity();
        const auto profile = std::make_shared<const Profile> (changed);
        Wired device (profile);
        device.reports = anyReports (*profile);
        Sketch s;
        s.node ("push", "signal.lfo", { { "amplitude", any (0.0, 6.0) }, { "frequency", any (1.0, 300.0) } });
        s.node ("motor", "device.force").wire ("push.out -> motor.force.x").wire ("push.out -> motor.force.y");
        const auto compiled = s.compile ({ .rate_hz = rate_hz });
        RC_ASSERT (compiled.plan != nullptr);
        Engine engine { compiled.plan };
        engine.attach (compiled.plan->roles()[0].name, device, profile->limits.guard);

        constexpr double count = 1e-3;   // one count of the coarser device, in N or A
        for (int k = 0; k < 40; ++k)
        {
            const auto before = device.sent;
            const Vec3 guarded = device.guarded_force;
            Vec3 applied;
            engine.tick ([&] (Plan& plan) noexcept {
                applied = plan.roles()[0].state->applied.force;   // as the nodes see it on this tick
                plan.tick();
            });
            for (int i = 0; i < 2; ++i)
            {
                const auto at = static_cast<std::size_t> (indexOf (device.model.effortNames(), profile->force[static_cast<std::size_t> (i)]));
                RC_ASSERT (std::abs (applied[i] - before[at]) <= 2.0 * count);
            }
            (applied == guarded ? whole : limited) += 1;
        }
    });
    CHECK (limited > 100);
    CHECK (whole > 100);
}
