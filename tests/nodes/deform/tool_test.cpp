// SPDX-License-Identifier: MIT
// Which face of a tool touches, by its tilt: the outer weights of eq. (8) and (9).
#include "surface_rig.hpp"

#include <expert/hands.hpp>
#include <support/property.hpp>
#include <tactus/kit/geometry/tool_faces.hpp>
#include <tactus/nodes/deform/tool.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <vector>

using namespace tactus;
using namespace tactus::test;
using nodes::DeformTool;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
const Vec3 down = -Vec3::UnitZ();

DeformTool tool()
{
    DeformTool node;
    node.prepare ({});
    return node;
}

Vec3 anyDirection (Dice& dice)
{
    Vec3 v;
    do
        v = { dice.uniform (-1.0, 1.0), dice.uniform (-1.0, 1.0), dice.uniform (-1.0, 1.0) };
    while (v.norm() < 0.1 || v.norm() > 1.0);
    return v.normalized();
}

Vec3 anyRotation (Dice& dice) { return dice.uniform (0.0, std::numbers::pi) * anyDirection (dice); }

/// Faces that do not look in nearly the same direction.
std::vector<ToolFace> anyFaces (Dice& dice)
{
    std::vector<ToolFace> faces;
    const auto count = static_cast<std::size_t> (1 + dice.below (static_cast<int> (most_faces)));
    while (faces.size() < count)
    {
        const Vec3 a = anyDirection (dice);
        if (std::ranges::all_of (faces, [&] (const ToolFace& f) { return f.direction.dot (a) < 0.9; })) faces.push_back ({ a, dice.uniform (0.0, 3.0) });
    }
    return faces;
}

/// A rotation of the world by a small vector.
Mat3 turned (const Vec3& by, const Mat3& rotation) { return rotationMatrix (by) * rotation; }

/// A smooth random motion: position and rotation of a tool that presses.
struct Motion
{
    explicit Motion (Dice& dice)
    {
        for (auto* all : { &sines, &cosines })
            for (auto& v : *all)
                for (int i = 0; i < 6; ++i)
                    v[i] = dice.uniform (-1.0, 1.0);
    }

    Eigen::Matrix<double, 6, 1, Eigen::DontAlign> operator() (double t) const
    {
        Eigen::Matrix<double, 6, 1, Eigen::DontAlign> all = Eigen::Matrix<double, 6, 1>::Zero();
        for (std::size_t w = 0; w < sines.size(); ++w)
        {
            const double phase = 2.0 * std::numbers::pi * static_cast<double> (w + 1) * t;
            all += std::sin (phase) * sines[w] + std::cos (phase) * cosines[w];
        }
        return all;
    }

    std::array<Eigen::Matrix<double, 6, 1, Eigen::DontAlign>, 3> sines, cosines;
};
}   // namespace

TEST_CASE ("tool: between its tip and its side, its number follows the closed form, and is exact at both", "[nodes][deform]")
{
    auto node = tool();
    for (double angle = 0.0; angle <= 90.0; angle += 7.5)
    {
        const double a = angle * std::numbers::pi / 180.0, tip = 1.0 - std::cos (a), side = 1.0 - std::sin (a);
        CHECK (node.tick ({ .rotation = { 0.0, a, 0.0 } }).tool == Approx (tip / (tip + side)).margin (1e-15));
    }
    CHECK (node.tick ({}).tool == 0.0);
    CHECK (node.tick ({ .rotation = { 0.0, std::numbers::pi / 4.0, 0.0 } }).tool == Approx (0.5));
    CHECK (node.tick ({ .rotation = { 0.0, 0.0, 1.0 } }).tool == 0.0);                                                     // about its own axis
    CHECK (node.tick ({ .rotation = { 0.0, std::numbers::pi / 2.0, 0.0 }, .normal = 3.0 * Vec3::UnitX() }).tool == 0.0);   // upright on a wall
    CHECK (node.tick ({ .rotation = { not_a_number, 0.0, 0.0 } }).tool == 0.0);
    CHECK (node.tick ({ .normal = { 0.0, not_a_number, 0.0 } }).tool == 0.0);
    CHECK (node.tick ({ .rotation = { 0.0, std::numbers::pi / 4.0, 0.0 } }).tool == Approx (0.5));
}

TEST_CASE ("tool: the shares of any faces are convex and exact at each face, and the gradient is that of the number", "[nodes][deform]")
{
    property ("any faces, rotation and body", [] (unsigned seed) {
        Dice dice { seed };
        const auto faces = anyFaces (dice);
        const auto [least, most] = std::ranges::minmax_element (faces, {}, &ToolFace::tool);
        const Mat3 r = rotationMatrix (anyRotation (dice));
        const Vec3 m = anyDirection (dice);
        const auto tilt = tiltOf (faces, r, m);
        RC_ASSERT (tilt.tool >= least->tool - 1e-12);
        RC_ASSERT (tilt.tool <= most->tool + 1e-12);
        for (const auto& face : faces)
        {
            const auto flat = tiltOf (faces, r, r * face.direction);
            RC_ASSERT (std::abs (flat.tool - face.tool) <= 1e-12);
            RC_ASSERT (flat.turn.norm() <= 1e-6);
        }
        constexpr double h = 1e-5;
        for (int axis = 0; axis < 3; ++axis)
        {
            const Vec3 by = h * Vec3::Unit (axis);
            const double slope = (tiltOf (faces, turned (by, r), m).tool - tiltOf (faces, turned (-by, r), m).tool) / (2.0 * h);
            RC_ASSERT (std::abs (slope - tilt.turn[axis]) <= 1e-6 * (1.0 + tilt.turn.norm()));
        }
        const Mat3 all = rotationMatrix (anyRotation (dice));   // a tool and a body that turn together
        const auto together = tiltOf (faces, all * r, all * m);
        RC_ASSERT (std::abs (together.tool - tilt.tool) <= 1e-9);
        RC_ASSERT ((together.turn - all * tilt.turn).norm() <= 1e-6 * (1.0 + tilt.turn.norm()));
    });
}

TEST_CASE ("tool: faces without a direction, too many, or two alike are refused", "[nodes][deform]")
{
    const auto problem = [] (std::vector<DeformTool::Face> faces) {
        DeformTool node;
        node.settings.faces = std::move (faces);
        return node.problem();
    };
    CHECK (tool().problem().empty());
    CHECK (problem ({ { down, 2.0 } }).empty());
    CHECK (problem ({ { down, 0.0 }, { -down, 0.0 } }).empty());
    CHECK (problem ({}) == "faces needs from 1 to 8 faces");
    CHECK (problem (std::vector<DeformTool::Face> (9)) == "faces needs from 1 to 8 faces");
    CHECK (problem ({ { down, 0.0 }, { Vec3::Zero(), 1.0 } }) == "face 2 has no direction");
    CHECK (problem ({ { down, 0.0 }, { Vec3::UnitX(), 1.0 }, { 2.0 * down, 1.0 } }) == "faces 1 and 3 look in the same direction");
}

TEST_CASE ("tool: the tilt at the touch counts until the tool has let go, however it tilts meanwhile", "[nodes][deform]")
{
    Surface s;
    s.mesh = std::make_shared<const Mesh> (flat());
    s.curves = { { curves (100.0, 1000.0) }, { curves (700.0, 8000.0) } };
    s.mu = { { .number = 0.5 } };
    const auto surface = std::make_shared<const Surface> (s);
    property ("any tilt at the touch, and any tilts after it: the same bits as with the first tilt held", [&] (unsigned seed) {
        Dice dice { seed };
        auto faces = tool();
        auto tilted = made (surface), held = made (surface);
        const Vec3 above { 0.02, 0.01, 1e-3 };
        for (int touch = 0; touch < 2; ++touch)
        {
            const double at_touch = faces.tick ({ .rotation = anyRotation (dice) }).tool;
            Vec3 p = above;
            tilted.tick ({ .position = p, .tool = faces.tick ({ .rotation = anyRotation (dice) }).tool });
            held.tick ({ .position = p, .tool = at_touch });
            p.z() = -1e-3;
            auto out = tilted.tick ({ .position = p, .tool = at_touch });
            RC_ASSERT (held.tick ({ .position = p, .tool = at_touch }).force == out.force);
            RC_ASSERT (std::abs (out.resistance - (1.0 + 7.0 * at_touch)) <= 1e-12);
            for (int k = 0; k < 50; ++k)
            {
                p += 1e-4 * Vec3 { dice.uniform (-1.0, 1.0), dice.uniform (-1.0, 1.0), dice.uniform (-1.0, 1.0) };
                p.z() = std::min (p.z(), -1e-4);
                out = tilted.tick ({ .position = p, .tool = faces.tick ({ .rotation = anyRotation (dice) }).tool });
                const auto same = held.tick ({ .position = p, .tool = at_touch });
                RC_ASSERT (out.force == same.force);
                RC_ASSERT (out.stored_energy == same.stored_energy);
                RC_ASSERT (out.dissipated_energy == same.dissipated_energy);
            }
            tilted.tick ({ .position = above });
            held.tick ({ .position = above });
        }
    });
}

TEST_CASE ("tool: if its number follows the tilt within a contact, the hand pays dU/dw as a torque: work = change of energy", "[nodes][deform][energy]")
{
    property ("any faces, stiffnesses and smooth motion; the rest falls with the square of the tick, at 1, 4 and 20 kHz", [] (unsigned seed) {
        Dice dice { seed };
        const auto faces = anyFaces (dice);
        const Motion motion { dice };
        const double soft = dice.size (100.0, 5000.0), hard = dice.size (100.0, 5000.0), most = 3.0;
        // U of a tool: k / 2 along z, and a fifth of it across; numbers between two tools blend their energies.
        const auto blended = [&] (double number) { return soft + number / most * (hard - soft); };
        const auto shape = [] (const Vec3& p) { return 0.5 * (p.z() * p.z() + 0.2 * (p.x() * p.x() + p.y() * p.y())); };
        double rest[3], moved = 0.0;
        const double rates[] { 1e3, 4e3, 20e3 };
        for (std::size_t i = 0; i < 3; ++i)
        {
            const int steps = static_cast<int> (0.25 * rates[i]);
            double work = 0.0, begun = 0.0, now = 0.0;
            moved = 0.0;
            Vec3 p_before, f_before, torque_before;
            Mat3 r_before;
            for (int k = 0; k <= steps; ++k)
            {
                const auto at = motion (static_cast<double> (k) / steps);
                const Vec3 p { 1e-3 * at[0], 1e-3 * at[1], -5e-3 + 1e-3 * at[2] };
                const Mat3 r = rotationMatrix (0.3 * Vec3 { at[3], at[4], at[5] });
                const auto tilt = tiltOf (faces, r, down);
                const auto energy = [&] (double number) { return blended (number) * shape (p); };
                const Vec3 f = -blended (tilt.tool) * Vec3 { 0.2 * p.x(), 0.2 * p.y(), p.z() }, torque = -toolSlope (tilt.tool, most, energy) * tilt.turn;
                now = energy (tilt.tool);
                if (k == 0)
                    begun = now;
                else
                {
                    const Mat3 d = r * r_before.transpose();   // a small turn about the axes of the world
                    const Vec3 turn = 0.5 * Vec3 { d (2, 1) - d (1, 2), d (0, 2) - d (2, 0), d (1, 0) - d (0, 1) };
                    const double step = -0.5 * (f + f_before).dot (p - p_before) - 0.5 * (torque + torque_before).dot (turn);
                    work += step;
                    moved += std::abs (step);
                }
                p_before = p;
                r_before = r;
                f_before = f;
                torque_before = torque;
            }
            rest[i] = std::abs (work - (now - begun)) / moved;
        }
        RC_ASSERT (rest[0] <= 5e-2);
        RC_ASSERT (rest[1] <= 5e-3);
        RC_ASSERT (rest[2] <= 3e-4);
    });
}

TEST_CASE ("tool: without the torque, tilting a tool that presses would create energy", "[nodes][deform][energy]")
{
    // Pressed 5 mm with the tip, 1 N/mm; tilted to the side, 8 N/mm; lifted: 0.1 J come back for 12.5 mJ.
    const auto energy = [] (double number) { return 0.5 * (1000.0 + 7000.0 * number) * 25e-6; };
    CHECK (energy (1.0) - energy (0.0) == Approx (87.5e-3));
    const std::vector<ToolFace> faces { { down, 0.0 }, { Vec3::UnitX(), 1.0 } };
    double paid = 0.0;
    constexpr int steps = 10'000;
    for (int k = 0; k < steps; ++k)
    {
        const double by = 0.5 * std::numbers::pi / steps;
        const auto tilt = tiltOf (faces, rotationMatrix ({ 0.0, (k + 0.5) * by, 0.0 }), down);
        paid += toolSlope (tilt.tool, 1.0, energy) * tilt.turn.y() * by;
    }
    CHECK (paid == Approx (87.5e-3).epsilon (1e-6));
}

TEST_CASE ("tool: the slope of the energy between two tools is that of their blend, and belongs to the last two at the end", "[nodes][deform]")
{
    const auto energy = [] (double number) { return number < 1.0 ? 1.0 + 2.0 * number : 3.0 + 5.0 * (number - 1.0); };   // 1, 3 and 8 J
    for (const auto& [number, slope] :
         { std::pair { 0.0, 2.0 }, { 0.3, 2.0 }, { 0.9999, 2.0 }, { 1.0, 5.0 }, { 1.5, 5.0 }, { 2.0, 5.0 }, { 7.0, 5.0 }, { -1.0, 2.0 } })
    {
        CAPTURE (number);
        CHECK (toolSlope (number, 2.0, energy) == Approx (slope));
    }
    CHECK (toolSlope (0.0, 0.0, energy) == 0.0);   // a body for one tool
}
