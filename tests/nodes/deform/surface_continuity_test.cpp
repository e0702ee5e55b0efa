// SPDX-License-Identifier: MIT
// The force of an elastic surface does not step while the tool touches it, and its energy does not depend on the rate.
#include "bodies.hpp"
#include "surface_rig.hpp"

#include "support/rounds.hpp"

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>

using namespace tactus;
using namespace tactus::test;

namespace
{
/// Straight strokes between random places around the surface of a body.
class Strokes
{
public:
    Strokes (const Body& b, unsigned seed) : body (b), dice (seed) { place.z() = body.centre.z() + 3.0 * body.reach.z() + 0.005; }

    /// Calls visit (position) along the next stroke, in steps of at most this length.
    template <typename Visit>
    void stroke (double step, Visit visit)
    {
        const double x = one (dice), y = one (dice), z = one (dice);   // compilers evaluate arguments in different orders
        const Vec3 from = place, to = body.centre + 0.8 * Vec3 (x, y, z).cwiseProduct (body.reach);
        const int n = static_cast<int> ((to - from).norm() / step) + 1;
        for (int k = 1; k <= n; ++k)
            visit (Vec3 { from + (to - from) * k / n });
        place = to;
    }

    const Vec3& at() const { return place; }

private:
    const Body& body;
    std::mt19937 dice;
    std::uniform_real_distribution<double> one { -1.0, 1.0 };
    Vec3 place = body.centre;
};

/// The steepest curve of a body up to a depth, N/m.
double stiffness (const Body& body, double depth)
{
    double most = 0.0;
    for (const auto& node : body.surface->curves[0])
        for (const auto& law : node)
            most = std::max (most, law.kind == Law::Kind::table ? law.steepest() : law.steepest (depth));
    return most;
}

bool same (const ElasticSurface::Outputs& a, const ElasticSurface::Outputs& b)
{
    return a.force == b.force && a.resistance == b.resistance && a.depth == b.depth && a.normal == b.normal && a.contact == b.contact
           && a.triangle == b.triangle && a.stored_energy == b.stored_energy && a.dissipated_energy == b.dissipated_energy
           && (a.state == 0.0) == (b.state == 0.0);
}
}   // namespace

TEST_CASE ("surface: on any body, the force changes by no more than the stiffness and the curvature say, for steps of any length", "[nodes][deform]")
{
    // |df| over max (k, f / (R - w)) |dp|, up to w = 0.9 R: the smallest radius of curvature, or that of the tool on a body with sharp edges.
    // 1 is the bound of a body with the same curves everywhere. Sideways springs and curves that differ from node to node add to it.
    constexpr double rho = 0.004;
    for (const double mu : { 0.0, 0.01, 0.1, 0.5, 1.0 })
        for (const auto& body : bodies (mu))
        {
            const bool sharp = body.name == "box", uneven_body = body.name == "pad" || body.name == "uneven pad";
            const double crease = sharp ? 30.0 : 180.0;
            const auto& mesh = *body.surface->mesh;
            const SmoothBody smooth (mesh, crease * 3.14159265358979 / 180.0);
            const double radius = sharp ? rho : uneven_body ? 1.0
                                                            : smallestRadius (smooth, mesh, 1.3 * body.reach.norm(), body.centre);
            for (const double step : mu == 0.0 ? std::vector { 1e-5, 1e-6, 1e-7, 1e-8 } : std::vector { 1e-5 })
            {
                double most = 0.0;
                int counted = 0;
                for (unsigned seed = 0; seed < test::rounds (4u); ++seed)
                {
                    Strokes strokes (body, seed);
                    auto node = made (body.surface);
                    node.settings.crease = crease;
                    if (sharp) node.settings.tool_radius = { rho };
                    node.prepare ({ .rate_hz = 1000.0 });
                    Vec3 p = strokes.at();
                    auto before = node.tick ({ .position = p });
                    // The shorter the step, the fewer of them are looked at: a short piece in each 0.2 mm.
                    int k = 0;
                    for (int s = 0; s < 6; ++s)
                        strokes.stroke (1e-5, [&] (const Vec3& next) {
                            const Vec3 way = next - p;
                            const auto look = [&] (const Vec3& there) {
                                const auto out = node.tick ({ .position = there });
                                const double depth = std::max (out.depth, before.depth), moved = (there - p).norm();
                                const bool inside = depth < 0.9 * radius && (out.depth > 0.0) == (before.depth > 0.0);
                                if (moved > 0.0 && depth > 0.0 && inside)
                                {
                                    const double turn = std::max (out.resistance, before.resistance) / (radius - depth);
                                    const double change = (out.force - before.force).norm() / (std::max (stiffness (body, depth), turn) * moved);
                                    most = std::max (most, change);
                                    ++counted;
                                }
                                p = there;
                                before = out;
                            };
                            if (step < 1e-5 && ++k % 20 == 0)
                                for (int i = 1; i <= 5; ++i)
                                    look (p + step * way.normalized());
                            look (next);
                        });
                }
                CAPTURE (body.name, mu, step, radius, counted);
                CHECK (counted > 1000);
                CHECK (most < (mu == 0.0 && ! uneven_body ? 1.05 : 2.0));
            }
        }
}

TEST_CASE ("surface: on a sphere without friction, the force does not step where the contact changes its triangle", "[nodes][deform]")
{
    const auto all = bodies (0.0);
    const auto& sphere = *std::ranges::find (all, "sphere", &Body::name);
    for (const double step : { 1e-4, 1e-5, 1e-6 })
    {
        auto node = made (sphere.surface);
        node.tick ({ .position = Vec3 (-0.006, 0.0013, 0.03) });
        double most = 0.0;
        Vec3 force = Vec3::Zero();
        const int n = static_cast<int> (0.012 / step);
        for (int k = 0; k <= n; ++k)
        {
            const double x = -0.006 + step * k, r = 0.02 - 0.00244;
            const auto out = node.tick ({ .position = Vec3 (x, 0.0013, std::sqrt (r * r - x * x - 0.0013 * 0.0013)) });
            if (k > 0) most = std::max (most, (out.force - force).norm());
            force = out.force;
        }
        CAPTURE (step);
        CHECK (force.norm() == Approx (2.4).epsilon (0.1));
        CHECK (most < 2.0 * 1000.0 * step);
    }
}

TEST_CASE ("surface: a repeated sample changes nothing", "[nodes][deform]")
{
    property ("random strokes over all bodies, at any friction and adhesion", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        const double mus[] { 0.0, 0.01, 0.1, 0.5, 1.0 };
        const auto all = bodies (mus[dice() % 5]);
        const auto& body = all[dice() % all.size()];
        auto node = made (body.surface);
        node.params.adhesion = static_cast<Bristle::Adhesion> (dice() % 4);
        node.params.static_ratio = dice() % 2 == 0 ? 1.0 : 1.7;
        Strokes strokes (body, seed);
        const double step = std::pow (10.0, -4.0 + one (dice));
        for (int s = 0; s < 4; ++s)
        {
            strokes.stroke (step, [&] (const Vec3& p) {
                const auto out = node.tick ({ .position = p });
                for (int k = 0; k < 3; ++k)
                    RC_ASSERT (same (node.tick ({ .position = p }), out));
            });
        }
    });
}

TEST_CASE ("surface: a slip ends on its bound within the tick, however far the tool goes", "[nodes][deform]")
{
    const auto surface = uneven (flat(), 7, 0.5);   // mu differs from node to node
    for (const double far : { 1e-4, 1e-3, 1e-2 })
    {
        auto node = made (surface);
        Vec3 p (0.01, 0.012, 0.001);
        node.tick ({ .position = p });
        p.z() = -0.002;
        node.tick ({ .position = p });
        double ratio = 0.0;
        ElasticSurface::Outputs out;
        for (int k = 0; k < 3; ++k)
        {
            p.x() += far * 0.5;
            out = node.tick ({ .position = p });
        }
        const PlacedSurface placed (surface, 1.0, Vec3::Zero(), Vec3::Zero(), 0.5);
        auto tool = placed.noTool();
        const Spot spot = placed.walk().nearestOfAll (out.contact);
        placed.choose (0.0, spot, tool);
        ratio = placed.ratio (placed.footFrom (spot, { p.x(), p.y(), p.z() }), out.depth, tool);
        const double stretch = std::hypot (p.x() - out.contact.x(), p.y() - out.contact.y());
        CAPTURE (far);
        CHECK (stretch <= ratio * out.depth * (1.0 + 2e-5));
    }
}

TEST_CASE ("surface: dissipated energy is the same at 1, 4 and 20 kHz", "[nodes][deform][energy]")
{
    for (const double mu : { 0.1333, 0.5 })
        for (const auto& body : bodies (mu))
        {
            const auto lost = [&] (double rate_hz) {
                auto node = made (body.surface, ElasticSurface::Friction::bound, rate_hz);
                if (body.name == "bumps") node.settings.crease = 180.0;   // smooth, but coarse: triangles meet at more than 30 degrees
                node.prepare ({ .rate_hz = rate_hz });
                node.tick ({ .position = body.centre + Vec3 (0.0, 0.5 * body.reach.y(), 0.02) });
                const int n = static_cast<int> (0.5 * rate_hz);
                double sum = 0.0;
                for (int k = 0; k <= n; ++k)   // a circle at 0.15 m/s
                {
                    const double phi = 4.0 * 3.14159265358979 * k / n;
                    const Vec3 p = body.centre + Vec3 (0.5 * body.reach.x() * std::sin (phi), 0.5 * body.reach.y() * std::cos (phi), 0.0);
                    sum = node.tick ({ .position = Vec3 (p.x(), p.y(), body.centre.z() - 0.3 * body.reach.z()) }).dissipated_energy;
                }
                return sum;
            };
            const double fine = lost (20000.0);
            CAPTURE (body.name, mu, fine);
            CHECK (fine > 0.0);
            CHECK (lost (4000.0) == Approx (fine).epsilon (0.02));
            CHECK (lost (1000.0) == Approx (fine).epsilon (0.02));
        }
}
