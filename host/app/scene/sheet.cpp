// SPDX-License-Identifier: GPL-3.0-or-later
#include "sheet.hpp"

#include <tactus/kit/geometry/rotation.hpp>

#include <numbers>

namespace tactus::host::scene
{

namespace
{
constexpr double full_colour_m = 2e-3;   // depth at which the colour of depth is complete

/// The sine to 1e-3, which changes a ridge by less than a step of its colour: a parabola and its square. That of the C library takes a tenth of a
/// running scene.
float sine (float angle) noexcept
{
    constexpr float turn = 1.0f / (2.0f * std::numbers::pi_v<float>);
    const float turns = angle * turn, part = turns - static_cast<float> (static_cast<int> (turns + std::copysign (0.5f, turns)));   // -0.5 to 0.5
    const float arch = 16.0f * part * (0.5f - std::abs (part));
    return arch + 0.225f * arch * (std::abs (arch) - 1.0f);
}

/// Heights of a grid as slopes at any place: linear between its points, mirrored beyond its ends.
class Slopes
{
public:
    explicit Slopes (const Grain& g) : grid (*g.map.grid), pitch (g.map.pitch), scale (g.map.height / g.map.pitch), flips (g.map.is_picture), from (g.from) {}

    /// Height from 0 to 1, and slopes along x and y.
    std::array<float, 3> operator() (double x, double y) const noexcept
    {
        const double column = std::clamp ((x - from.x()) / pitch, -1e6, 1e6), along = (y - from.y()) / pitch;
        const double row = std::clamp (flips ? static_cast<double> (grid.rows - 1) - along : along, -1e6, 1e6);
        const double r = std::floor (row), c = std::floor (column);
        const auto fr = static_cast<float> (row - r), fc = static_cast<float> (column - c);
        const int r0 = mirrored (static_cast<int> (r), grid.rows), r1 = mirrored (static_cast<int> (r) + 1, grid.rows);
        const int c0 = mirrored (static_cast<int> (c), grid.columns), c1 = mirrored (static_cast<int> (c) + 1, grid.columns);
        const auto get = [this] (int i, int j) { return static_cast<float> (grid (i, j)); };
        const float a = get (r0, c0), b = get (r0, c1), d = get (r1, c0), e = get (r1, c1);
        const float along_x = (b - a) + fr * ((e - d) - (b - a)), along_y = (d - a) + fc * ((e - b) - (d - a));
        const auto steep = static_cast<float> (scale);
        return { a + fc * (b - a) + fr * along_y, along_x * steep, flips ? -along_y * steep : along_y * steep };
    }

    double cell() const noexcept { return pitch; }

private:
    static int mirrored (int i, int n) noexcept
    {
        if (i >= 0 && i < n) return i;
        if (n < 2) return 0;
        const int period = 2 * n - 2;
        i = ((i % period) + period) % period;
        return i < n ? i : period - i;
    }

    const Grid& grid;
    double pitch, scale;
    bool flips;
    Vec3 from;
};

/// Colours a sample of a sheet from where it is on the sheet and how far it has moved.
class Skin
{
public:
    enum Value
    {
        u,         ///< place along the sheet, before it moved, m
        v,         ///< the same
        slope_u,   ///< of the dents
        slope_v,
        moved,   ///< how far it has moved, m
        count
    };

    Skin (const Sheet3D& s, const Camera& c, const Paint& p) : sheet (s), paint (p), axes (s.axes()), pixel (1.0 / c.scaleAt (c.distance))
    {
        for (const auto& g : s.grains)
            if (g.map.grid && g.map.grid->rows > 0 && g.map.grid->columns > 0 && g.map.pitch > 0.0) slopes.emplace_back (g);
        for (const auto& r : s.ridges)
        {
            const double k = 2.0 * std::numbers::pi * r.frequency, along_u = std::cos (r.angle), along_v = std::sin (r.angle);
            const double from = along_u * r.from.dot (axes[0]) + along_v * r.from.dot (axes[1]);
            const auto f = [] (double x) { return static_cast<float> (x); };
            waves.push_back ({ f (k * along_u), f (k * along_v), f (r.phase - k * from), f (along_u), f (along_v),
                               sharpness (1.0 / std::max (r.frequency, 1e-9)) });
        }
        for (int i = 0; i < 3; ++i)
        {
            nu[static_cast<std::size_t> (i)] = static_cast<float> (axes[0][i]);
            nv[static_cast<std::size_t> (i)] = static_cast<float> (axes[1][i]);
            nn[static_cast<std::size_t> (i)] = static_cast<float> (sheet.normal[i]);
        }
        line_share = sharpness (sheet.grid) * 0.4f;
    }

    std::uint32_t operator() (const std::array<float, count>& at) const noexcept
    {
        float su = at[slope_u], sv = at[slope_v], height = 0.5f;
        for (const auto& w : waves)
        {
            const float steep = -0.42f * w.share * sine (w.ku * at[u] + w.kv * at[v] + w.phase);   // the force is this slope, downwards
            su += steep * w.du;
            sv += steep * w.dv;
        }
        for (const auto& s : slopes)
        {
            const auto [h, hu, hv] = s (static_cast<double> (at[u]), static_cast<double> (at[v]));
            const float share = sharpness (4.0 * s.cell());
            su += share * hu;
            sv += share * hv;
            height = h;
        }
        const float nx = nn[0] - su * nu[0] - sv * nv[0], ny = nn[1] - su * nu[1] - sv * nv[1], nz = nn[2] - su * nu[2] - sv * nv[2];
        Ink ink = mixed (paint.material, paint.depth, at[moved] / static_cast<float> (full_colour_m) * 0.8f);
        ink = mixed (ink, paint.lines, lineAt (at[u], at[v]));
        return pixelOf (ink, paint.light (nx, ny, nz) * (0.8f + 0.4f * height));
    }

private:
    struct Wave
    {
        float ku, kv, phase, du, dv, share;
    };

    /// The share of a pattern of this period that can be seen: none once it is finer than the pixels.
    float sharpness (double period) const noexcept { return static_cast<float> (std::clamp (0.5 * period / pixel - 0.75, 0.0, 1.0)); }

    float lineAt (float x, float y) const noexcept
    {
        const auto part = [this] (float p) {
            const auto step = static_cast<float> (sheet.grid), away = std::abs (p - step * std::round (p / step)) / static_cast<float> (pixel);
            return std::clamp (1.2f - away, 0.0f, 1.0f);
        };
        return line_share * std::max (part (x), part (y));
    }

    const Sheet3D& sheet;
    const Paint& paint;
    std::array<Vec3, 2> axes;
    double pixel;   // m, at the target
    std::vector<Slopes> slopes;
    std::vector<Wave> waves;
    std::array<float, 3> nu {}, nv {}, nn {};
    float line_share = 0.0f;
};

/// Places from -half to half that lie closer together around the middle.
std::vector<double> places (double half, double middle, int cells)
{
    const double centre = std::clamp (middle, -0.9 * half, 0.9 * half);
    std::vector<double> all;
    for (int i = 0; i <= cells; ++i)
    {
        const double s = 2.0 * i / cells - 1.0, reach = s < 0.0 ? half + centre : half - centre;
        all.push_back (centre + (s < 0.0 ? -reach : reach) * std::pow (std::abs (s), 1.9));
    }
    return all;
}
}   // namespace

std::array<Vec3, 2> Sheet3D::axes() const noexcept
{
    const Vec3 n = direction (normal);
    const Vec3 v = (std::abs (n.y()) < 0.9 ? Vec3 (Vec3::UnitY() - n.y() * n) : Vec3 (Vec3::UnitZ() - n.z() * n)).normalized();
    return { v.cross (n), v };
}

void Sheet3D::cover (const Vec3& p) noexcept
{
    constexpr double step = 0.02, margin = 0.01, most = 0.5;
    const auto [u, v] = axes();
    const Vec3 away = p - centre();
    const double farthest = std::max (std::abs (away.dot (u)), std::abs (away.dot (v))) + margin;
    if (farthest > half) half = std::min (most, step * std::ceil (farthest / step));
}

void Sheet3D::draw (Raster& raster, const Camera& camera, const Paint& paint) const
{
    const auto [u, v] = axes();
    const Vec3 busy = dents.empty() ? Vec3 (camera.target) : dents.front().at;
    const auto us = places (half, (busy - centre()).dot (u), cells), vs = places (half, (busy - centre()).dot (v), cells);
    const Skin skin (*this, camera, paint);
    using Corner = Raster::Corner<Skin::count>;
    std::vector<Corner> corners;
    corners.reserve (us.size() * vs.size());
    for (const double b : vs)
        for (const double a : us)
        {
            const Vec3 rest = centre() + a * u + b * v;
            Vec3 moved = Vec3::Zero();
            double slope_u = 0.0, slope_v = 0.0;
            for (const auto& d : dents)
            {
                const double share = d.share (rest), down = d.by.dot (normal);
                moved += share * d.by;
                const Vec3 away = rest - d.at;
                const double fall = -3.0 * share / (Dent::radius * Dent::radius + away.squaredNorm()) * down;
                slope_u += fall * away.dot (u);
                slope_v += fall * away.dot (v);
            }
            corners.push_back (raster.corner<Skin::count> (camera.see (rest + moved), camera.near(),
                                                           { static_cast<float> (a), static_cast<float> (b), static_cast<float> (slope_u),
                                                             static_cast<float> (slope_v), static_cast<float> (moved.norm()) }));
        }
    const auto row = us.size();
    for (std::size_t j = 0; j + 1 < vs.size(); ++j)
        for (std::size_t i = 0; i + 1 < row; ++i)
        {
            const auto &a = corners[j * row + i], &b = corners[j * row + i + 1], &c = corners[(j + 1) * row + i + 1], &d = corners[(j + 1) * row + i];
            raster.triangle (a, b, c, Raster::Sides::both, skin);
            raster.triangle (a, c, d, Raster::Sides::both, skin);
        }
}

}   // namespace tactus::host::scene
