// SPDX-License-Identifier: MIT
// The effort that a graph requests goes through the guard to the bytes on the wire. The test converts them back to the force at the tool.

#include "hid.hpp"

#include <host/devices/hid/bits.hpp>

#include <support/property.hpp>
#include <tactus/run/guard.hpp>

#include <Eigen/LU>

#include <algorithm>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
Effort anyEffort (const HidModel& model)
{
    const auto any = [] (double size) { return *rc::gen::map (rc::gen::inRange (-1000, 1001), [=] (int i) { return size * i / 1000.0; }); };
    Effort e { { any (50.0), any (50.0), any (50.0) }, { any (5.0), any (5.0), any (5.0) } };
    for (std::size_t i = 0; i < model.effortNames().size(); ++i)   // more entries than the number of the device's own efforts
        if (*rc::gen::arbitrary<bool>()) e.axes.set (static_cast<int> (i), any (*rc::gen::element (1.0, 1e3, 1e12)));
    return e;
}

/// The bytes of all reports of this effort, as HidDevice sends them.
std::vector<Bytes> sent (HidModel& model, const Effort& guarded)
{
    HidEffort effort { guarded.force, guarded.torque, model.restEfforts() };
    model.take (guarded.axes, effort);
    std::vector<Bytes> all;
    for (std::size_t i = 0; i < model.outputs(); ++i)
    {
        const auto wire = model.encode (i, effort);
        const auto body = model.profile().outputs[i].id ? wire : wire.subspan (1);
        all.emplace_back (body.begin(), body.end());
    }
    return all;
}

/// The values that the reports carry in three fields.
Vec3 carried (const Profile& profile, const std::vector<Bytes>& reports, const std::array<std::string, 3>& names)
{
    Vec3 v = Vec3::Zero();
    for (std::size_t r = 0; r < reports.size(); ++r)
        for (const auto& field : profile.outputs[r].fields)
            for (int i = 0; i < 3; ++i)
                if (! field.name.empty() && field.name == names[static_cast<std::size_t> (i)])
                    v[i] = numberOf (field.bits, bitsAt (field.bits, reports[r])) * field.encoding.scale + field.encoding.offset;
    return v;
}

/// The force at the tool per unit of each motor: the inverse of the map from a force to motor values.
Mat3 forces (const Kinematics& kinematics, const Kinematics::Pose& pose)
{
    Mat3 motors;
    for (int i = 0; i < 3; ++i)
        motors.col (i) = 1e3 * kinematics.motors (Kinematics::torques (pose, 1e-3 * Vec3::Unit (i)));   // small, so no motor saturates
    return motors.inverse();
}
}   // namespace

TEST_CASE ("no report carries more force, or a larger step of it, than the profile allows, whatever a graph asks for", "[hid][property]")
{
    int tested = 0;
    for (const std::string id : { "tactus_board", "woodenhaptics_usb" })
        test::property (id + ": any efforts", [&] {
            const auto profile = test::profileOf (id);
            HidModel model (profile);
            const auto sample = std::ranges::find_if (profile->samples, [] (const GoldenSample& s) { return s.output.empty() && ! s.input.empty(); });
            RC_ASSERT (sample != profile->samples.end());
            for (const auto& report : sample->input)
                model.decode (report);
            auto reading = model.reading();
            reading.valid = true;

            auto limits = model.limits();
            limits.ramp = 0.002;
            constexpr double dt = 1e-3;
            Guard guard;
            guard.prepare (limits, dt);
            const Kinematics kinematics (profile->kinematics);
            Vec3 counts = Vec3::Zero();
            for (int i = 0; i < 3; ++i)
                if (const int axis = indexOf (model.axisNames(), profile->position[static_cast<std::size_t> (i)]); axis >= 0)
                    counts[i] = model.sample().axes[static_cast<std::size_t> (axis)];
            const auto pose = kinematics.pose (kinematics.joints (counts));

            const Mat3 inverse = forces (kinematics, pose);
            const double rounding = 1e-3 * inverse.norm() + 1e-6;   // each motor's value is rounded by at most a count
            Vec3 last = Vec3::Zero();
            for (int k = 0; k < 40; ++k)
            {
                const auto reports = sent (model, guard (anyEffort (model), reading));
                const Vec3 force = inverse * carried (*profile, reports, profile->force);
                RC_ASSERT (force.norm() <= limits.max_force + rounding);
                RC_ASSERT ((force - last).norm() <= limits.max_slew * dt + 2.0 * rounding);
                RC_ASSERT (carried (*profile, reports, profile->torque).norm() <= limits.max_torque + 2e-6);
                last = force;
            }
            ++tested;
        });
    CHECK (tested > 2);
}
