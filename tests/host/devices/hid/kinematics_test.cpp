// SPDX-License-Identifier: MIT
#include "hid.hpp"

#include <support/property.hpp>

#include <Eigen/LU>

#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
constexpr double pi = std::numbers::pi;

/// A random number between two limits, never quite at either limit.
rc::Gen<double> between (double low, double high)
{
    return rc::gen::map (rc::gen::inRange (1, 999'999), [=] (int i) { return low + (high - low) * i / 1e6; });
}

SerialArm woody() { return std::get<SerialArm> (test::profileOf ("woodenhaptics_usb")->kinematics); }

/// The size of the Pantograph Mk-II: driven links of 63 mm, passive ones of 75 mm, pivots 25 mm apart.
FiveBar pantograph()
{
    FiveBar bar;
    bar.base = 0.025;
    bar.links = { 0.063, 0.075, 0.075, 0.063 };
    bar.origin = { -0.0125, 0.1, 0.0 };
    for (auto& drive : bar.drives)
        drive = { .counts_per_turn = 65536, .torque_constant = 0.0538, .max_current = 2.0 };
    return bar;
}

/// A mechanism and joint ranges that stay far from singular poses.
struct Mechanism
{
    std::string name;   // rapidcheck runs a property once per name
    KinematicsModel model;
    Vec3 low, high;
};

std::vector<Mechanism> mechanisms()
{
    LinearMap skewed;
    skewed.matrix << 1e-3, 2e-4, 0, 0, 5e-4, -1e-4, 3e-4, 0, 2e-3;
    skewed.origin = { 0.01, 0.02, 0.03 };
    return { { "direct", DirectKinematics {}, { -1, -1, -1 }, { 1, 1, 1 } },
             { "linear", skewed, { -100, -100, -100 }, { 100, 100, 100 } },
             { "serial", woody(), { -1.2, -0.5, 0.9 }, { 1.2, 0.7, 2.2 } },
             { "five bars", pantograph(), { 0.3, 1.9, 0.0 }, { 1.2, 2.8, 1e-9 } } };
}

Vec3 anyJoints (const Mechanism& m)
{
    Vec3 q;
    for (int i = 0; i < 3; ++i)
        q[i] = *between (m.low[i], m.high[i]);
    return q;
}

Vec3 anyVector (double size) { return { *between (-size, size), *between (-size, size), *between (-size, size) }; }

// The inverse of each pose: the joint angles for a tool position. Empty if the position is out of reach.

std::optional<Vec3> inverse (const DirectKinematics&, const Vec3& p) { return p; }

std::optional<Vec3> inverse (const LinearMap& map, const Vec3& p)
{
    const Eigen::FullPivLU<Mat3> lu (map.matrix);
    if (! lu.isInvertible()) return {};
    return lu.solve (p - map.origin);
}

/// In a triangle with the sides a, b and `distance`: the angle between a and `distance`. The sides a and b are links, and
/// `distance` is from the start of a to the end of b. Empty if there is no such triangle.
std::optional<double> cornerOf (double a, double b, double distance)
{
    const double cosine = (a * a + distance * distance - b * b) / (2.0 * a * distance);
    if (! (std::abs (cosine) <= 1.0)) return {};
    return std::acos (cosine);
}

std::optional<Vec3> inverse (const SerialArm& arm, const Vec3& p)
{
    // In the plane of the links, seen from the shoulder, with angles from the vertical; the lower link points at pi - c.
    const Vec3 at = p + arm.origin;
    const double across = std::hypot (at.x(), at.y()), up = at.z() - arm.links[0];
    const auto corner = cornerOf (arm.links[1], arm.links[2], std::hypot (across, up));
    if (! corner) return {};

    const double b = std::atan2 (across, up) - *corner;
    const double c = std::numbers::pi - std::atan2 (across - arm.links[1] * std::sin (b), up - arm.links[1] * std::cos (b));
    return Vec3 { std::atan2 (at.y(), at.x()), b, c };
}

std::optional<Vec3> inverse (const FiveBar& bar, const Vec3& p)
{
    // The elbows point outwards.
    const Vec3 at = p + bar.origin;
    const auto right = cornerOf (bar.links[0], bar.links[1], std::hypot (at.x(), at.y()));
    const auto left = cornerOf (bar.links[3], bar.links[2], std::hypot (at.x() + bar.base, at.y()));
    if (! right || ! left) return {};
    return Vec3 { std::atan2 (at.y(), at.x()) - *right, std::atan2 (at.y(), at.x() + bar.base) + *left, 0.0 };
}

std::optional<Vec3> jointsAt (const KinematicsModel& model, const Vec3& position)
{
    return std::visit ([&] (const auto& m) { return inverse (m, position); },
                       model);
}
}   // namespace

TEST_CASE ("the work of the joints equals the work of the tool")
{
    // tau · dq = F · dx for any small step. Central differences avoid any derivative from the code under test.
    for (const auto& m : mechanisms())
        test::property (m.name + ": any pose, force and step", [&] {
            const Kinematics k (m.model);
            const Vec3 q = anyJoints (m), force = anyVector (5.0);
            const bool flat = std::holds_alternative<FiveBar> (m.model);
            Vec3 step = anyVector (1.0);
            if (flat) step.z() = 0.0;
            constexpr double h = 1e-6;
            const Vec3 dx = (k.pose (q + h * step).position - k.pose (q - h * step).position) / (2.0 * h);
            const auto pose = k.pose (q);
            RC_PRE (pose.problem == PoseProblem::none);
            const double of_joints = Kinematics::torques (pose, force).dot (step), of_tool = force.dot (dx);
            RC_ASSERT (std::abs (of_joints - of_tool) <= 1e-6 * (force.norm() * dx.norm() + 1e-6));
        });
}

TEST_CASE ("the work of the motors equals the work of the tool, for gears and encoders of either direction")
{
    // At a current I, a motor of torque constant K gives K I. One turn (2 pi) is counts_per_turn of its encoder.
    for (const auto& m : mechanisms())
    {
        if (! std::holds_alternative<SerialArm> (m.model) && ! std::holds_alternative<FiveBar> (m.model)) continue;
        test::property (m.name + ": any pose", [&] {
            const Kinematics k (m.model);
            const Vec3 q = anyJoints (m), force = anyVector (0.5);
            const Vec3 counts = k.counts (q);
            RC_PRE (k.pose (q).problem == PoseProblem::none);
            const Vec3 currents = k.motors (Kinematics::torques (k.pose (q), force));
            const auto drive = [&] (std::size_t i) {
                const auto* arm = std::get_if<SerialArm> (&m.model);
                return arm != nullptr ? arm->drives[i] : std::get<FiveBar> (m.model).drives[i];
            };
            for (int i = 0; i < (std::holds_alternative<SerialArm> (m.model) ? 3 : 2); ++i)
            {
                const auto d = drive (static_cast<std::size_t> (i));
                const double turn = 1e-4 * d.counts_per_turn / (2.0 * pi);   // the motor turns by 1e-4 rad
                const Vec3 dx = k.pose (k.joints (counts + turn * Vec3::Unit (i))).position - k.pose (k.joints (counts - turn * Vec3::Unit (i))).position;
                RC_ASSERT (std::abs (d.torque_constant * currents[i] * 2e-4 - force.dot (dx)) <= 1e-5 * (force.norm() * dx.norm() + 1e-9));
            }
        });
    }
}

TEST_CASE ("joints to position and back are inverse")
{
    for (const auto& m : mechanisms())
        test::property (m.name + ": any pose", [&] {
            const Kinematics k (m.model);
            const Vec3 q = anyJoints (m);
            RC_ASSERT (k.joints (k.counts (q)).isApprox (q, 1e-12));
            const auto pose = k.pose (q);
            RC_PRE (pose.problem == PoseProblem::none);
            const auto back = jointsAt (m.model, pose.position);
            RC_ASSERT (back.has_value());
            RC_ASSERT (k.pose (*back).position.isApprox (pose.position, 1e-9));
            const Vec3 away = *back - q;
            RC_ASSERT ((std::holds_alternative<FiveBar> (m.model) ? away.head<2>().norm() : away.norm()) < 1e-6);
        });

    CHECK_FALSE (jointsAt (woody(), { 5.0, 0.0, 0.0 }));
    CHECK_FALSE (jointsAt (pantograph(), { 0.0, 1.0, 0.0 }));
    LinearMap flat;
    flat.matrix.row (2).setZero();
    CHECK_FALSE (jointsAt (flat, { 0.0, 0.0, 0.0 }));
}

TEST_CASE ("a pantograph is where its links put it")
{
    // Both driven links point up: the elbows are at (0, 63) and (-25, 63) mm, and the tool is sqrt (75² - 12.5²) mm above their middle.
    const auto pose = Kinematics (pantograph()).pose ({ pi / 2.0, pi / 2.0, 0.0 });
    CHECK (pose.position.isApprox (Vec3 { 0.0, 0.063 + std::sqrt (0.075 * 0.075 - 0.0125 * 0.0125) - 0.1, 0.0 }));
    CHECK (pose.problem == PoseProblem::none);
}

TEST_CASE ("in every pose, even a singular one, forces give finite and bounded efforts")
{
    for (const auto& m : mechanisms())
    {
        const Kinematics k (m.model);
        test::property (m.name + ": any joints and force", [&] {
            // Straight angles, at which the links are in line, occur as often as other angles.
            Vec3 q;
            for (int i = 0; i < 3; ++i)
                q[i] =
                    *rc::gen::oneOf (between (-4.0, 4.0), rc::gen::element (0.0, pi / 2.0, pi, -pi, 1e-9, pi - 1e-9), rc::gen::element (1e9, -1e300, 1e-300));
            const Vec3 force = anyVector (10.0);
            const auto pose = k.pose (q);
            const Vec3 torques = Kinematics::torques (pose, force);
            RC_ASSERT (isFinite (pose.position, torques));
            RC_ASSERT (isFinite (k.motors (torques)));
            if (std::holds_alternative<SerialArm> (m.model)) RC_ASSERT (torques.norm() <= 10.0 * 2.0 * 0.7);
            if (std::holds_alternative<FiveBar> (m.model)) RC_ASSERT (torques.norm() <= 10.0 * 2.0 * 0.063 / 0.02);
            if (pose.strength == 0.0) RC_ASSERT (torques == Vec3::Zero() && pose.problem != PoseProblem::none);
        });

        for (const double bad : { std::nan (""), HUGE_VAL })
        {
            const auto pose = k.pose ({ bad, 0.0, 0.0 });
            CHECK (pose.problem == PoseProblem::not_finite);
            CHECK (Kinematics::torques (pose, { 1.0, 1.0, 1.0 }).isZero (0.0));
        }
    }
}

TEST_CASE ("a force fades to zero towards a singular pose, and the problem is reported")
{
    const Kinematics arm (woody());
    const auto in_line = arm.pose ({ 0.0, pi / 4.0, 3.0 * pi / 4.0 });
    CHECK (in_line.problem == PoseProblem::singular);
    CHECK (in_line.strength == 0.0);
    CHECK (arm.pose ({ 0.0, 0.0, pi / 2.0 }).strength == 1.0);

    // The tool is on the axis of the column, which cannot push it sideways.
    const auto over_column = arm.pose ({ 0.3, -pi / 4.0, std::asin (0.205 * std::sin (pi / 4.0) / 0.2) });
    CHECK (over_column.problem == PoseProblem::singular);
    CHECK (over_column.strength == 0.0);

    // The passive links of the pantograph are in line: elbows 150 mm apart.
    const Kinematics bar (pantograph());
    const double open = std::acos ((0.075 - 0.0125) / 0.063);
    const auto stretched = bar.pose ({ open - 1e-9, pi - open + 1e-9, 0.0 });
    CHECK (stretched.problem != PoseProblem::none);
    CHECK (stretched.strength == 0.0);
    CHECK (bar.pose ({ open - 0.1, pi - open + 0.1, 0.0 }).problem == PoseProblem::unreachable);

    FiveBar flat;   // whole numbers, so that the links are in line to the last bit
    flat.base = 2.0;
    flat.links = { 3.0, 4.0, 4.0, 3.0 };
    const auto dead = Kinematics (flat).pose ({ 0.0, pi, 0.0 });
    CHECK (dead.problem == PoseProblem::singular);
    CHECK (Kinematics::torques (dead, { 1.0, 1.0, 0.0 }).isZero (0.0));

    double last = 1.0;
    bool faded = false;
    for (double q = open + 0.3; q > open; q -= 1e-3)
    {
        const auto pose = bar.pose ({ q, pi - q, 0.0 });
        CHECK (last - pose.strength < 0.3);   // the strength never jumps
        faded = faded || (pose.strength > 0.0 && pose.strength < 1.0);
        last = pose.strength;
    }
    CHECK (faded);
    CHECK (last < 0.2);
}

TEST_CASE ("if one motor saturates, all are reduced and the force keeps its direction")
{
    const auto arm = woody();
    const Kinematics k (arm);
    test::property ("any force", [&] {
        const Vec3 torques = anyVector (20.0);
        const Vec3 currents = k.motors (torques);
        RC_ASSERT (currents.cwiseAbs().maxCoeff() <= 3.0 * (1.0 + 1e-12));
        Vec3 wanted;
        for (int i = 0; i < 3; ++i)
            wanted[i] = torques[i] * arm.drives[static_cast<std::size_t> (i)].ratio / 0.0603;
        RC_ASSERT (currents.cross (wanted).norm() <= 1e-9 * wanted.squaredNorm() + 1e-15);
        RC_ASSERT (currents.dot (wanted) >= 0.0);
        if (wanted.cwiseAbs().maxCoeff() <= 3.0) RC_ASSERT (currents.isApprox (wanted, 1e-12));
    });
}

TEST_CASE ("a force in Tactus axes does work along positions in Tactus axes")
{
    // The whole chain: currents in the report times motor rotation equals the work of the force on the tool.
    test::property ("any position of a WoodenHaptics", [] {
        HidModel model (test::profileOf ("woodenhaptics_usb"));
        const auto report = [] (const Vec3& counts) {
            Bytes bytes (8);
            for (int i = 0; i < 3; ++i)
            {
                const auto count = static_cast<std::uint16_t> (static_cast<int> (counts[i]));
                bytes[static_cast<std::size_t> (2 * i)] = static_cast<std::uint8_t> (count);
                bytes[static_cast<std::size_t> (2 * i + 1)] = static_cast<std::uint8_t> (count >> 8);
            }
            return bytes;
        };
        const Vec3 counts { std::floor (*between (-3000.0, 3000.0)), std::floor (*between (-1000.0, 1000.0)), std::floor (*between (-1000.0, 1000.0)) };
        model.decode (report (counts));
        RC_PRE (model.sample().problem == PoseProblem::none);
        HidEffort effort;
        effort.force = anyVector (1.0);
        const auto sent = model.encode (0, effort);

        const double turns[] = { -2.0 * pi / 4096.0, 2.0 * pi / 2000.0, 2.0 * pi / 2000.0 };   // motor angle per count, in rad
        for (int i = 0; i < 3; ++i)
        {
            const auto raw = static_cast<std::int16_t> (sent[static_cast<std::size_t> (1 + 2 * i)] | sent[static_cast<std::size_t> (2 + 2 * i)] << 8);
            HidModel there (model), back (model);
            const Vec3 dx = there.decode (report (counts + 5.0 * Vec3::Unit (i))).position - back.decode (report (counts - 5.0 * Vec3::Unit (i))).position;
            const double of_motor = 0.0603 * raw * 1e-3 * 10.0 * turns[i], of_tool = effort.force.dot (dx);
            RC_ASSERT (std::abs (of_motor - of_tool) <= 0.0603 * 0.6e-3 * 10.0 * std::abs (turns[i]) + 1e-4 * dx.norm());
        }
    });
}
