// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/height_steps.hpp>
#include <tactus/kit/geometry/spline_surface.hpp>
#include <tactus/kit/math/math.hpp>
#include <tactus/node/node.hpp>
#include <tactus/node/prepared_data.hpp>
#include <tactus/node/setting.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tactus::nodes
{

/// A measured or painted relief: a force pushes the tool down its slopes.
///
///     force = -gain grad h (x, y)      value = h (x, y)
///
/// h is the map, smooth between its points: a B-spline of degree 5 through all of them, on a grid twice as fine, so the force
/// has neither steps nor corners from cell to cell. The force is the gradient of a potential: at constant speed it does no work
/// over any closed path.
///
/// A relief scanned fast would contain higher frequencies than the tick rate can carry. So h has levels, each with half the
/// detail of the previous one, and the speed of the hand blends between two of them: nothing is left above f_max.
///
/// By default f_max = 1 / (alpha T) with alpha = 4: 250 Hz at 1 kHz, where touch is most sensitive (Table 1: alpha >= 2, preferably
/// 10). So a faster graph renders finer detail. The param `f_max` makes the relief the same at all rates above 2 f_max.
///
/// A component (kx, ky) sounds at |kx vx + ky vy| <= k_max (|vx| + |vy|), and each level ends at a k_max in x and in y, so it is
/// usable up to the speed at which this bound reaches f_max. From half of that speed up, the finest level gives way to the next.
/// Above the speed of the last level only the mean height is left.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 5, Table 1. A force that follows the gradient creates
/// no energy: Campion & Hayward 2008. Levels: Williams 1983; B-splines: Unser 1999.
///
/// Departures from the printed chapter
///  - Table 1 bounds the gain by A k. For a relief this is gain times the norm of the Hessian of h, the Jacobian of the force in
///    N/m. `claims` gives a bound of it as stiffness.
///
/// Good to know
///  - The map's columns run along x, `pitch` apart, and its rows along y. The first row of a table is at y = 0. In a picture the
///    last row is at y = 0, so that it lies as seen from above. A map of one row is a profile along x, the same for all y.
///  - Outside the map the relief is continued by mirroring, so it never ends in a step.
///  - A picture with 8 bits has 256 heights, so an even slope in it is a stair, and is felt as a file. `tactus validate` warns of such steps. Save
///    16 bits, or average the heights with `smooth`, which keeps slopes.
///  - `height` is the height of white above black, or of 1 in a table. Left at 0, it is 0.1 mm for a picture, and 1 m for a table;
///    "1 um" suits a table from an instrument that writes micrometres.
///  - At a speed v, waves shorter than about v / f_max are gone: at 4 kHz and 0.1 m/s those below 0.1 mm, at 1 kHz below 0.4 mm.
///    A finer map only helps a slower hand.
///  - Speed is the difference between two samples, and 0 on the first sample and after a fault. A rise in speed acts immediately;
///    a fall acts only after 20 ms and then decays with a time constant of 50 ms. So a quantum q of the position counts as a
///    speed q / T throughout, and nothing flutters. Detail too fine for that speed is gone (Table 1, high speed: alpha k q < 1).
///  - A hand at rest keeps the detail it arrived with, so its force does not change.
///  - For the roughest possible map, white noise, less than 0.6 % of the force (-45 dB) is left above f_max.
///  - While the speed changes, so does h: a closed path may then generate or absorb energy. The node claims to be passive only if
///    the map is flat.
///  - For a force in N think of slopes: gain is the force on a slope of 1, 45 degrees. Real slopes are about 0.1.
///  - Multiply by contact.window, so that the force does not jump at a touch.
struct HeightMap
{
    struct Map
    {
        Image image {};
        Sheet csv {};
        double pitch = 1e-4;
        double height = 0.0;
        double smooth = 0.0;

        static constexpr std::tuple fields {
            field (&Map::image, "image", unit::count, "a picture; white is high"),
            field (&Map::csv, "csv", unit::count, "a table of heights instead of a picture"),
            field (&Map::pitch, "pitch", unit::metre, "distance between columns, and between rows", { .hard = { 1e-9, 1 }, .usual = { 1e-6, 1e-3 } }),
            field (&Map::height, "height", unit::metre,
                   "height of white above black in an image, or of the value 1 in a table; if 0, an image uses 0.1 mm and a table 1 m",
                   { .usual = { 0, 1e-3 } }),
            field (&Map::smooth, "smooth", unit::metre, "heights are averaged over this length; slopes stay, shorter detail and the steps of 8 bits go",
                   { .hard = { 0, 1 }, .usual = { 0, 5e-3 } }),
        };
    };

    struct Inputs
    {
        Vec3 position = Vec3::Zero();
    };

    struct Params
    {
        double gain = 1.0;
        double f_max = 0.0;
    };

    struct Settings
    {
        Map map;
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
        double value = 0.0;
    };

    static constexpr Info info {
        .id = "texture.height_map",
        .name = "Height map",
        .summary = "A measured or painted relief, felt as a force down its slopes.",
        .source = "Hayward 2007, section 5; Campion & Hayward 2008",
        .keywords = "bump image displacement roughness",
    };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position"),
        param (&Params::gain, "gain", unit::newton, "force on a slope of 1", { .usual = { 0, 10 } }),
        param (&Params::f_max, "f_max", unit::hertz, "highest frequency that is rendered, at most half the rate; 0: a quarter of the rate",
               { .hard = { 0, inf }, .usual = { 0, 1000 } }),
        setting (&Settings::map, "map", unit::count, "the relief; without one it is flat"),
        output (&Outputs::force, "force", unit::newton, "force on the tool, down the slope"),
        output (&Outputs::value, "value", unit::metre, "height of the relief under the tool"),
    };

    static constexpr Appearance appearance { .kind = Appearance::Kind::relief, .tool = "position", .map = "map" };

    Params params;
    Settings settings;

    Cost cost() const;
    std::string problem() const;
    std::string warning (const Setup&) const;

    void prepare (const Setup& setup)
    {
        dt = setup.dt_s();
        hold = static_cast<int> (hold_s / dt);
        release = math::exp (-dt / release_s);
        last = {};
        build (setup.services.prepared);
        update();
    }

    void update() noexcept
    {
        f_max = params.f_max > 0.0 ? std::min (params.f_max, 0.5 / dt) : 1.0 / (alpha * dt);
        fastest = ! levels ? 0.0 : 1.01 * f_max / (*levels)[levels->size() - 2].edge;
    }

    void adopt (const HeightMap& old) noexcept { last = old.last; }

    Claims claims() const;

    Outputs tick (const Inputs& in) noexcept
    {
        const Vec3& p = in.position;
        if (! isFinite (p))
        {
            last = {};
            return {};
        }
        const double speed = last.known ? std::min (speedOf (p - last.p), fastest) : 0.0;
        if (speed >= 0.99 * last.speed)
            last.held = hold;
        else if (p != last.p && last.held > 0)
            --last.held;
        else if (p != last.p)
            last.speed *= release;
        last = { .p = p, .speed = std::max (speed, last.speed), .held = last.held, .known = true };
        if (! levels) return {};

        const auto relief = blended (p);
        const Vec3 force { -params.gain * relief.slope_x, -params.gain * relief.slope_y, 0.0 };
        return { .force = finiteOrZero (force), .value = finiteOrZero (relief.height) };
    }

    void serialize (auto& archive) { archive (last); }

private:
    static constexpr double alpha = 4.0;
    static constexpr double hold_s = 0.02, release_s = 0.05;
    static constexpr std::size_t largest = std::size_t (1) << 22;   // most points that a map can have

    /// The surface at one level of detail.
    struct Level
    {
        double edge = 0.0;   // spatial frequency in 1/m above which the level holds nothing, along x and y
        SplineSurface surface;
    };

    const std::shared_ptr<const Grid>& grid() const noexcept { return settings.map.image.grid ? settings.map.image.grid : settings.map.csv.grid; }

    double speedOf (const Vec3& moved) const noexcept
    {
        return ((wide ? std::abs (moved.x()) : 0.0) + (deep ? std::abs (moved.y()) : 0.0)) / dt;
    }

    /// Blends the finest level that the speed allows with the next one. At the speed where the previous, finer
    /// level drops out, only the finest allowed level contributes.
    SplineSurface::Point blended (const Vec3& p) const noexcept
    {
        const double speed = last.speed;
        const auto& all = *levels;
        std::size_t fine = 0;
        while (fine + 1 < all.size() && all[fine].edge * speed > f_max)
            ++fine;
        const auto a = all[fine].surface (p.x(), p.y());
        if (fine + 1 == all.size()) return a;

        const double end = all[fine].edge * speed / f_max;   // <= 1
        const double begin = fine == 0 ? 0.5 : all[fine].edge / all[fine - 1].edge;
        if (end <= begin) return a;
        const double w = 1.0 - math::log (end) / math::log (begin);
        const auto b = all[fine + 1].surface (p.x(), p.y());
        return { std::lerp (a.height, b.height, w), std::lerp (a.slope_x, b.slope_x, w), std::lerp (a.slope_y, b.slope_y, w) };
    }

    using Levels = std::vector<Level>;   // each with less detail than the previous one; the last one is flat

    MirroredGrid heights() const;
    Levels made() const;
    void build (PreparedData*);

    double dt = 1.0 / Setup {}.rate_hz;   // s
    double f_max = 0.0, release = 0.0;
    int hold = 0;
    double fastest = 0.0;                   // m/s; from this speed up only the mean is left
    bool wide = false, deep = false;        // more than one column, more than one row
    std::shared_ptr<const Levels> levels;   // null without a map

    struct Sample
    {
        Vec3 p = Vec3::Zero();
        double speed = 0.0;   // m/s, |vx| + |vy|, falling late and slowly
        int held = 0;         // ticks until `speed` begins to fall
        bool known = false;   // false until the first finite sample
    };
    Sample last;
};

//==============================================================================
// Implementation below.

/// The finest level, which is most of the work, has twice the points in each direction. Each is a weighted sum along x, then along
/// y; the weights are computed once for each column and row.
inline Cost HeightMap::cost() const
{
    if (! grid()) return {};
    constexpr double weights = 33.0, work_per_weight = 60.0, work_per_product = 0.8, bytes_per_weights = 1000.0;
    const double columns = std::max (grid()->columns, 0), rows = std::max (grid()->rows, 0), fine = 4.0 * columns * rows, lines = 2.0 * (columns + rows);
    return {
        .work = lines * weights * work_per_weight + 1.5 * fine * weights * work_per_product,
        .memory = 3.0 * sizeof (double) * fine + lines * bytes_per_weights,   // three grids exist at the same time
    };
}

inline std::string HeightMap::problem() const
{
    const Map& m = settings.map;
    if (m.image.grid && m.csv.grid) return "the map has an image and a csv; give only one";
    if (! (m.pitch > 0.0) || ! isFinite (m.pitch)) return "the map's pitch must be above 0 m";
    if (! isFinite (m.height)) return "the map's height is not finite";
    if (! grid()) return {};

    const auto rows = at (std::max (grid()->rows, 0)), columns = at (std::max (grid()->columns, 0));
    const auto& values = grid()->values;
    if (rows == 0 || columns == 0 || values.size() != rows * columns) return "the map is empty";
    if (values.size() > largest) return "the map has " + std::to_string (values.size()) + " points; it can have at most " + std::to_string (largest);
    for (std::size_t i = 0; i < values.size(); ++i)
        if (! isFinite (values[i]))
            return "the map is not finite in row " + std::to_string (i / columns + 1) + ", column " + std::to_string (i % columns + 1);
    return {};
}

inline std::string HeightMap::warning (const Setup&) const
{
    if (! grid()) return {};
    const Map& m = settings.map;
    const double usual = m.image.grid ? 1e-4 : 1.0, step = feltStep (*grid()) * std::abs (m.height == 0.0 ? usual : m.height);
    if (! (step > 0.0) || m.smooth >= 8.0 * m.pitch) return {};
    constexpr double rise_at_a_step = 1.2;   // of a step per pitch: 1.14 to 1.2 on stairs with 3 to 20 columns a step, as a test measures
    const auto text = [] (double v) { return roundedText (v, 3); };
    return "its heights are steps of " + text (1e6 * step) + " um, as with 8 bits: a slope is felt as a stair, with about "
           + text (rise_at_a_step * step / m.pitch * std::abs (params.gain)) + " N at each step; save it with 16 bits, or set smooth, which keeps slopes, to \""
           + text (1e3 * 10.0 * m.pitch) + " mm\" or more";
}

/// The map in m, its first row at y = 0.
inline MirroredGrid HeightMap::heights() const
{
    const Map& m = settings.map;
    const Grid& from = *grid();
    const bool is_image = m.image.grid != nullptr;
    const double usual = is_image ? 1e-4 : 1.0, height = m.height == 0.0 ? usual : m.height;

    MirroredGrid to { { from.columns - 1, m.pitch }, { from.rows - 1, m.pitch }, std::vector<double> (from.values.size()) };
    for (int row = 0; row < from.rows; ++row)
        for (int column = 0; column < from.columns; ++column)
            to (is_image ? from.rows - 1 - row : row, column) = height * from (row, column);
    return m.smooth > 0.0 ? smoothedOver (std::move (to), m.smooth) : to;
}

inline void HeightMap::build (PreparedData* shelf)
{
    levels = nullptr;
    wide = grid() && grid()->columns > 1;
    deep = grid() && grid()->rows > 1;
    if (! grid()) return;
    const Map& m = settings.map;
    levels = prepared<Levels> (
        shelf, grid(), [&] { return keyOf (std::array { m.image.grid ? 1.0 : 0.0, m.pitch, m.height, m.smooth }); },
        [&] { return std::make_shared<const Levels> (made()); });
}

inline HeightMap::Levels HeightMap::made() const
{
    Levels all;
    const double pitch = settings.map.pitch;
    MirroredGrid points = heights();
    const double mean = meanOf (points);

    // A sinc that is zero at all other points of the map keeps the value of each point. It leaves little beyond 0.6 / pitch.
    const auto fine = resampled (points, points.x.with (2 * points.x.intervals), points.y.with (2 * points.y.intervals), 0.5 / pitch, 16.0);
    all.push_back ({ 0.6 / pitch, SplineSurface { fine } });

    // Use four points per period at the band edge. The splines then add less than 1 % above it.
    const double length = pitch * std::max (points.x.intervals, points.y.intervals);
    for (double spacing = pitch; 0.25 / spacing > 0.5 / length; spacing *= 2.0)
    {
        const auto coarser = [spacing] (const MirroredAxis& a) {
            const auto intervals = static_cast<int> (std::ceil (a.intervals * a.spacing / spacing * (1.0 - margin (1e-12))));
            return a.with (std::max (1, intervals));
        };
        const double edge = 0.25 / spacing;
        points = resampled (points, coarser (points.x), coarser (points.y), 0.8 * edge, 8.0);
        all.push_back ({ edge, SplineSurface { points } });
    }

    all.push_back ({ 0.0, SplineSurface { MirroredGrid { {}, {}, { mean } } } });
    return all;
}

inline Claims HeightMap::claims() const
{
    double steepest = 0.0;
    if (levels)
        for (const Level& level : *levels)
            steepest = std::max (steepest, level.surface.largestCurvature());
    return {
        .passive = steepest == 0.0,
        .stiffness = std::abs (params.gain) * steepest,
        .spatial_frequency = levels ? levels->front().edge : 0.0,
    };
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::HeightMap);
