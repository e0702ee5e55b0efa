// SPDX-License-Identifier: MIT
// Strokes over a stiff nodule, flat and curved: what a hand feels that palpates. The figures are those of docs/decisions/surface_slips.md.
#include "bodies.hpp"
#include "surface_rig.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

using namespace tactus;
using namespace tactus::test;
using Frictions = ElasticSurface::Friction;

namespace
{
constexpr double soft = 300.0, mu_c = 0.3, across = 0.6, deep = 0.003, radius = 0.04;   // N/m, -, -, m, m

/// The stiffness along the normal at a distance from the middle of a nodule that is `ratio` times as stiff as what is around it. On the pad, the
/// nodes are on rings at 4 and 9 mm, and the smooth weights are between them.
double stiffnessAt (double distance, double ratio)
{
    const double x = std::clamp ((0.009 - distance) / 0.005, 0.0, 1.0);
    return soft * (1.0 + (ratio - 1.0) * x * x * (3.0 - 2.0 * x));
}

/// A flat pad around the origin, with seven cells over the rise of the stiffness: three take a tenth off its slope, five a fourteenth.
Mesh pad()
{
    constexpr double length = 0.06;
    Mesh mesh = flat (80, length);
    for (auto& p : mesh.points)
        p -= Vec3 (0.5 * length, 0.5 * length, 0.0);
    return mesh;
}

/// A pad, or a ball, with a nodule at the origin or at its top.
std::shared_ptr<const Surface> nodule (bool is_ball, double ratio)
{
    auto mesh = is_ball ? ball (radius, 5) : pad();
    std::vector<Surface::Curves> nodes;
    for (const auto& p : mesh.points)
    {
        const double k = stiffnessAt ((p - (is_ball ? radius : 0.0) * Vec3::UnitZ()).norm(), ratio);
        nodes.push_back (curves (across * k, k));
    }
    return body (std::move (mesh), { nodes }, { { .number = mu_c } });
}

/// The place at x along the body and z above it, a little beside the middle.
Vec3 placeOn (bool is_ball, double x, double z)
{
    constexpr double beside = 0.0003;
    if (! is_ball) return { x, beside, z };
    const double a = x / radius, b = beside / radius;
    return (radius + z) * Vec3 (std::sin (a), std::cos (a) * std::sin (b), std::cos (a) * std::cos (b));
}

struct Stroke
{
    double lag = 0.0, middle = 0.0, drag_up = 0.0, drag_down = 0.0;   // the most of |s| / bound; N; N; N
    double missing = 0.0, peak = 0.0, fall = 0.0, steepest = 0.0;     // J; J; J; N/m
};

/// Down at one side, over the nodule at 0.1 m/s, and up at the other side.
Stroke stroke (const std::shared_ptr<const Surface>& surface, Frictions friction, bool is_ball, double rate_hz, double way)
{
    auto node = made (surface, friction, rate_hz);
    Stroke done;
    const double step = 0.1 / rate_hz;
    Vec3 p = placeOn (is_ball, -0.018 * way, 0.001);
    auto before = node.tick ({ .position = p });
    double work = 0.0, nearest = 1.0;
    std::vector<double> drag;
    const auto to = [&] (double x, double z) {
        const Vec3 next = placeOn (is_ball, x, z);
        const auto earlier = node;
        const auto out = node.tick ({ .position = next });
        const double lost = out.dissipated_energy - before.dissipated_energy;
        const bool begins = before.state == 0.0 && out.state > 0.0;
        work += begins ? out.stored_energy + lost : workOf (earlier, node, p, next);
        done.missing = std::max (done.missing, std::abs (out.stored_energy + out.dissipated_energy - work));
        done.peak = std::max (done.peak, out.stored_energy);
        done.fall = std::max (done.fall, -lost);
        done.steepest = std::max (done.steepest, (out.force - before.force).norm() / (next - p).norm());
        // Just before the tool lifts off, the bound can be a nanometre, and the anchor is a place in space, so it is rounded to 2e-17 m.
        if (out.state > 0.0) done.lag = std::max (done.lag, (node.lag() - 2e-17) / (mu_c * out.depth));
        const Vec3 along = (placeOn (is_ball, x + 1e-6, z) - placeOn (is_ball, x - 1e-6, z)).normalized();
        if (std::abs (x) < nearest)
        {
            nearest = std::abs (x);
            done.middle = out.resistance;
        }
        if (out.depth > 0.99 * deep) drag.push_back (way * out.force.dot (along));
        p = next;
        before = out;
    };
    const auto line = [&] (double x0, double z0, double x1, double z1) {
        const int n = static_cast<int> (std::ceil (std::hypot (x1 - x0, z1 - z0) / step));
        for (int k = 1; k <= n; ++k)
            to (x0 + (x1 - x0) * k / n, z0 + (z1 - z0) * k / n);
    };
    line (-0.018 * way, 0.001, -0.018 * way, -deep);
    line (-0.018 * way, -deep, 0.018 * way, -deep);
    line (0.018 * way, -deep, 0.018 * way, 0.001);
    CHECK (before.state == 0.0);
    const auto cell = static_cast<std::size_t> (std::lround (0.001 / step));   // the mean over half a cell of the ball: smooth weights ripple within it
    for (std::size_t i = 0; i + cell <= drag.size(); ++i)
    {
        double mean = 0.0;
        for (std::size_t k = i; k < i + cell; ++k)
            mean += drag[k] / static_cast<double> (cell);
        done.drag_up = std::min (done.drag_up, mean);
        done.drag_down = std::max (done.drag_down, mean);
    }
    return done;
}
}   // namespace

TEST_CASE ("surface: a stroke over a nodule feels it, and its lag keeps its bound", "[nodes][deform]")
{
    for (const bool is_ball : { false, true })
        for (const double ratio : { 1.5, 3.0, 30.0 })
            for (const auto friction : { Frictions::bound, Frictions::frictionless })
            {
                const auto surface = nodule (is_ball, ratio);
                const bool sticks = friction == Frictions::bound;
                for (const double rate_hz : { 1000.0, 4000.0, 20000.0 })
                {
                    const auto there = stroke (surface, friction, is_ball, rate_hz, 1.0), back = stroke (surface, friction, is_ball, rate_hz, -1.0);
                    CAPTURE (is_ball, ratio, sticks, rate_hz);
                    for (const auto& s : { there, back })
                    {
                        CAPTURE (s.lag, s.middle, s.drag_up, s.drag_down, s.missing, s.peak, s.steepest);
                        CHECK (s.lag <= 1.0 + 1e-9);
                        CHECK (s.lag >= (sticks ? 0.999 : 0.0));
                        CHECK (s.middle == Approx (ratio * soft * deep).epsilon (0.02));
                        CHECK (s.missing <= 1e-9 * s.peak);
                        CHECK (s.fall == 0.0);
                        if (! is_ball) CHECK (s.steepest <= 2.0 * ratio * soft);
                    }
                    CHECK (there.drag_up == Approx (back.drag_up).epsilon (0.05));
                    CHECK (there.drag_down == Approx (back.drag_down).epsilon (0.05));
                    if (! is_ball && ratio == 3.0)
                    {
                        const double slope =
                            0.5 * 1.5 * 600.0 / 0.005 * deep * deep * (1.0 + (sticks ? across * mu_c * mu_c : 0.0));   // - k' w^2 / 2 and the same for s
                        const double drag = sticks ? mu_c * across * 600.0 * deep : 0.0;                               // Amontons, halfway up
                        CHECK (there.drag_up == Approx (-slope - drag).epsilon (0.05));
                        CHECK (there.drag_down == Approx (slope - drag).epsilon (0.1));
                    }
                }
            }
}
