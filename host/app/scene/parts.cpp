// SPDX-License-Identifier: GPL-3.0-or-later
// What a scene draws of tools, blades and scissors.
#include "parts.hpp"

#include <tactus/kit/geometry/rotation.hpp>

#include <numbers>

namespace tactus::host::scene
{

namespace
{
/// Fills a flat shape of four corners, seen from both sides.
void flat (Raster& raster, const Camera& camera, const Paint& paint, const std::array<Vec3, 4>& p, const Ink& ink)
{
    const Vec3 n = (p[1] - p[0]).cross (p[3] - p[0]);
    const Vec3 facing = n.dot (camera.eye() - p[0]) < 0.0 ? Vec3 (-n) : n;
    const auto colour = pixelOf (ink, paint.light (static_cast<float> (facing.x()), static_cast<float> (facing.y()), static_cast<float> (facing.z())));
    std::array<Raster::Corner<1>, 4> c;
    for (std::size_t i = 0; i < 4; ++i)
        c[i] = raster.corner<1> (camera.see (p[i]), camera.near(), { 0.0f });
    const auto shade = [colour] (const std::array<float, 1>&) noexcept { return colour; };
    raster.triangle (c[0], c[1], c[2], Raster::Sides::both, shade);
    raster.triangle (c[0], c[2], c[3], Raster::Sides::both, shade);
}

/// A rod that gets thicker from one end to the other.
void rod (Raster& raster, const Camera& camera, const Paint& paint, const Vec3& from, const Vec3& to, double thin, double thick, const Ink& ink)
{
    constexpr int sides = 14;
    const Vec3 along = direction (to - from), x = perpendicularTo (along), y = along.cross (x);
    std::vector<Raster::Corner<3>> ring;
    for (int i = 0; i <= sides; ++i)
    {
        const double a = 2.0 * std::numbers::pi * i / sides;
        const Vec3 out = std::cos (a) * x + std::sin (a) * y;
        const float light = paint.light (static_cast<float> (out.x()), static_cast<float> (out.y()), static_cast<float> (out.z()));
        for (const auto& p : { Vec3 (from + thin * out), Vec3 (to + thick * out) })
            ring.push_back (raster.corner<3> (camera.see (p), camera.near(), { ink[0] * light, ink[1] * light, ink[2] * light }));
    }
    const auto shade = [] (const std::array<float, 3>& c) noexcept { return pixelOf (c, 1.0f); };
    for (std::size_t i = 0; i + 3 < ring.size(); i += 2)
    {
        raster.triangle (ring[i], ring[i + 1], ring[i + 2], Raster::Sides::both, shade);
        raster.triangle (ring[i + 1], ring[i + 3], ring[i + 2], Raster::Sides::both, shade);
    }
}
/// The axis of what is drawn of a tool without a blade, from the middle of its tip.
std::array<Vec3, 2> shaft (const Tool& tool, double radius)
{
    const Vec3 lean = Vec3 (0.42, -0.30, 1.0).normalized(), tip = tool.position + Vec3 (0.0, 0.0, radius);
    return { tip, tip + 16.0 * radius * lean };
}

struct Blade
{
    Vec3 normal, along;
    double half, height;   // m
};

Blade bladeOf (const Body& b, std::size_t number, const SceneState& now)
{
    const Vec3 normal = direction (b.vector (&Appearance::normal, Vec3::UnitZ()));
    const double half = 0.5 * b.number (&Appearance::width, 0.02);
    return { normal, bladeDirection (b, number, now, normal), half, std::max (0.012, 1.2 * half) };
}
}   // namespace

Vec3 bladeDirection (const Body& b, std::size_t number, const SceneState& now, const Vec3& normal)
{
    const Vec3 edge = rotationMatrix (now.of (number, &Appearance::rotation).value_or (b.vector (&Appearance::rotation, Vec3::Zero()))) * Vec3::UnitX();
    const Vec3 along = edge - edge.dot (normal) * normal;
    return along.norm() > 1e-6 ? Vec3 (along.normalized()) : perpendicularTo (normal);
}

double Scene::tipRadius (const Tool& tool, const Camera& camera) noexcept
{
    return std::clamp (5.0 / camera.scaleAt (camera.see (tool.position).depth), 3e-4, 2.5e-3);
}

std::vector<std::array<Vec3, 2>> Scene::linesOf (const Tool& tool, const Camera& camera, const SceneState& now) const
{
    const auto number = static_cast<std::size_t> (
        std::ranges::find_if (
            all, [&] (const Body& b) { return b.role == tool.role && (b.kind == Appearance::Kind::blade || b.kind == Appearance::Kind::scissors); })
        - all.begin());
    if (number == all.size()) return { shaft (tool, tipRadius (tool, camera)) };
    const auto& b = all[number];
    if (b.kind == Appearance::Kind::scissors) return {};
    const auto blade = bladeOf (b, number, now);
    const Vec3 p = tool.position;
    return { { p - blade.half * blade.along, p + blade.half * blade.along }, { p, p + 1.9 * blade.height * blade.normal } };
}

void Scene::drawTool (Raster& raster, const Camera& camera, const Paint& paint, const Tool& tool) const
{
    const auto seen = camera.see (tool.position);
    if (! (seen.depth > camera.near())) return;
    const double radius = tipRadius (tool, camera);
    const auto [tip, top] = shaft (tool, radius);
    rod (raster, camera, paint, tip, top, 0.5 * radius, 1.15 * radius, mixed (paint.metal, paint.lines, 0.25f));
    const Vec3 right = camera.right(), up = camera.up(), back = -camera.view();
    raster.ball (camera, tip, radius, [&] (const std::array<float, 3>& n) {
        const Vec3 world = static_cast<double> (n[0]) * right + static_cast<double> (n[1]) * up + static_cast<double> (n[2]) * back;
        return pixelOf (paint.tool, paint.light (static_cast<float> (world.x()), static_cast<float> (world.y()), static_cast<float> (world.z())));
    });
}

void Scene::drawBlade (Raster& raster, const Camera& camera, const Paint& paint, const Body& b, std::size_t number, const SceneState& now) const
{
    const auto* tool = now.tool (b.role);
    if (tool == nullptr) return;
    const auto [normal, along, half, height] = bladeOf (b, number, now);
    const Vec3 side = normal.cross (along);
    constexpr double thick = 4e-4;
    const Vec3 p = tool->position;
    for (const double s : { -1.0, 1.0 })   // a wedge: an edge below, and a back above
    {
        const Vec3 back = p + height * normal + s * thick * side;
        flat (raster, camera, paint, { p - half * along, p + half * along, back + half * along, back - half * along }, paint.metal);
    }
    const Vec3 low = p + height * normal, high = low + 0.9 * height * normal;
    rod (raster, camera, paint, low, high, 1.2e-3, 1.5e-3, mixed (paint.metal, paint.lines, 0.4f));
    for (const auto& crack : cracks (now))
    {
        const Vec3 wide = 2.5e-4 * side, over = 2e-5 * normal;
        flat (raster, camera, paint, { crack.begin - wide + over, crack.end - wide + over, crack.end + wide + over, crack.begin + wide + over }, paint.slit);
    }
}

void Scene::drawScissors (Raster& raster, const Camera& camera, const Paint& paint, const Body& b, std::size_t number, const SceneState& now) const
{
    constexpr double length = 0.065, half_plate = 0.025, broad = 6e-3;
    const double angle = std::clamp (now.of (number, &Appearance::angle).value_or (Vec3 (0.5, 0.0, 0.0)).x(), 0.0, 1.5);
    const double first = b.number (&Appearance::pivot, 0.0), thick = std::max (2e-4, b.number (&Appearance::thickness, 1e-3));
    const double cut = std::clamp (now.of (number, &Appearance::crack).value_or (Vec3 (first, 0.0, 0.0)).x(), first, length);
    for (const double s : { -1.0, 1.0 })
    {
        const Vec3 along (std::cos (0.5 * angle), 0.0, s * std::sin (0.5 * angle)), out (-s * along.z(), 0.0, std::abs (along.x()));
        const Vec3 shift (0.0, s * 4e-4, 0.0), back = s * broad * Vec3 (-std::abs (along.z()), 0.0, along.x());
        flat (raster, camera, paint, { shift, shift + length * along, shift + length * along + 0.15 * back, shift + back }, paint.metal);
        rod (raster, camera, paint, shift, shift - 0.03 * along, 2e-3, 1.4e-3, mixed (paint.metal, paint.lines, 0.4f));
    }
    // The plate: whole beyond the end of the cut, and two halves before it.
    const double gap = 3e-4, z = 0.5 * thick;
    const auto plate = [&] (double x0, double x1, double y0, double y1) {
        flat (raster, camera, paint, { Vec3 (x0, y0, z), Vec3 (x1, y0, z), Vec3 (x1, y1, z), Vec3 (x0, y1, z) }, paint.material);
        flat (raster, camera, paint, { Vec3 (x0, y0, z), Vec3 (x1, y0, z), Vec3 (x1, y0, -z), Vec3 (x0, y0, -z) }, mixed (paint.material, paint.slit, 0.4f));
    };
    plate (cut, length + 0.01, -half_plate, half_plate);
    plate (first, cut, -half_plate, -gap);
    plate (first, cut, gap, half_plate);
}

}   // namespace tactus::host::scene
