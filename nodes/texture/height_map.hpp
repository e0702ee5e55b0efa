// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>
#include <framework/setting.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

namespace tactus::nodes
{

/// A measured or painted relief: the tool is pushed down its slopes.
///
///     force = -gain grad h (x, y)      value = h (x, y)
///
/// h is the map, smooth between its points: a B-spline of degree 5 through all of them, on a grid twice as fine, so that the
/// force has no step nor corner from cell to cell. The force is the gradient of a potential: at a constant speed it does
/// no work over any closed path.
///
/// A relief scanned fast would sound at more than the tick rate can carry. So h has levels, each with half the detail of
/// the one before, and the hand's speed blends between two of them: nothing is left above
///
///     f_max = 1 / (alpha T),  alpha = 4      at 1 kHz 250 Hz, where touch is keenest (Table 1: alpha >= 2, better 10)
///
/// as a component (kx, ky) sounds at |kx vx + ky vy| <= k_max (|vx| + |vy|), and each level ends at a k_max in x and in y.
/// From half of that speed on the finest level gives way to the next; above the last one there is only the mean height.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 5, Table 1. That force is to follow the gradient,
/// so that no energy comes of it: Campion & Hayward 2008. Levels: Williams 1983; B-splines: Unser 1999.
///
/// Departures from the printed chapter
///  - Table 1 bounds the gain by A k; of a relief that is gain times the norm of the Hessian of h, the Jacobian of the
///    force in N/m. `claims` has a bound of it as stiffness.
///
/// Good to know
///  - The map's columns run along x, `pitch` apart, its rows along y: the first row of a table at y = 0, of a picture the
///    last, so that it lies as one sees it from above. One row alone is a profile along x, the same for all y.
///  - Outside the map it goes on as in a mirror, and so never ends in a step.
///  - `height` is that of white over black, or of 1 in a table. Left at 0, it is 0.1 mm for a picture, and a table has its
///    heights in m; "1 um" is for one of an instrument that writes micrometres.
///  - At a speed v waves shorter than about v / f_max are gone: at 4 kHz and 0.1 m/s those below 0.1 mm, at 1 kHz below
///    0.4 mm. A finer map is of use only to a slower hand.
///  - Speed is the difference of two samples, 0 on the first and after a fault. When it rises it counts at once, when it
///    falls late and slowly (after 20 ms, in 50 ms): so a quantum q of the position counts as a speed q / T throughout,
///    and nothing flutters. Detail finer than that is not there (Table 1, high speed: alpha k q < 1).
///  - A hand at rest keeps the detail it came with, so that its force stays.
///  - What is left above f_max of the roughest map there is, white noise, is less than 0.6 % of its force (-45 dB).
///  - While the speed changes, so does h: then a closed path may give or take energy. It claims to be passive only if flat.
///  - A force in N needs slopes: gain is the force on a slope of 1, 45 degrees. Real slopes are about 0.1.
///  - Multiply by contact.window, so that a touch does not step the force.
struct HeightMap
{
    struct Map
    {
        Image image {};
        Sheet csv {};
        double pitch = 1e-4;
        double height = 0.0;

        static constexpr std::tuple fields {
            field (&Map::image, "image", unit::count, "a picture, white high"),
            field (&Map::csv, "csv", unit::count, "a table of heights instead"),
            field (&Map::pitch, "pitch", unit::metre, "from one column to the next, and from one row to the next", { .hard = { 1e-9, 1 }, .usual = { 1e-6, 1e-3 } }),
            field (&Map::height, "height", unit::metre, "of white over black, or of 1 in a table; 0: 0.1 mm, or 1 m", { .usual = { 0, 1e-3 } }),
        };
    };

    struct Inputs
    {
        Vec3 position = Vec3::Zero();
    };

    struct Params
    {
        double gain = 1.0;
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
    };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position"),
        param (&Params::gain, "gain", unit::newton, "force on a slope of 1", { .usual = { 0, 10 } }),
        setting (&Settings::map, "map", unit::count, "the relief; none is flat"),
        output (&Outputs::force, "force", unit::newton, "force on the tool, down the slope"),
        output (&Outputs::value, "value", unit::metre, "height of the relief under the tool"),
    };

    Params params;
    Settings settings;

    std::string problem() const;

    void prepare (const Setup& setup)
    {
        dt = setup.dt_s();
        f_max = 1.0 / (alpha * dt);
        hold = static_cast<int> (hold_s / dt);
        release = std::exp (-dt / release_s);
        last = {};
        build();
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
        if (levels.empty()) return {};

        const Point at = blended (p);
        const Vec3 force { -params.gain * at.slope_x, -params.gain * at.slope_y, 0.0 };
        return { .force = finiteOrZero (force), .value = finiteOrZero (at.height) };
    }

private:
    static constexpr double alpha = 4.0;
    static constexpr double hold_s = 0.02, release_s = 0.05;
    static constexpr std::size_t largest = std::size_t (1) << 22;   // points of a map

    /// The points of one direction, mirrored at both ends: index i stands for index 2 n - i.
    struct Axis
    {
        int n = 0;              // intervals between points
        double spacing = 1.0;   // m

        std::size_t points() const noexcept { return static_cast<std::size_t> (n) + 1; }

        std::size_t mirrored (int i) const noexcept
        {
            if (n == 0) return 0;
            i %= 2 * n;
            if (i < 0) i += 2 * n;
            return static_cast<std::size_t> (i <= n ? i : 2 * n - i);
        }
    };

    /// The surface at one detail.
    struct Level
    {
        Axis x, y;
        double edge = 0.0;             // 1/m; it holds nothing above, along x or y
        std::vector<double> weights;   // of the B-splines, row after row
    };

    /// The six B-splines that reach a point, and their slopes.
    struct Reach
    {
        std::array<std::size_t, 6> index {};
        std::array<double, 6> weight {}, slope {};
    };

    struct Point
    {
        double height = 0.0, slope_x = 0.0, slope_y = 0.0;
    };

    double speedOf (const Vec3& moved) const noexcept
    {
        return ((wide ? std::abs (moved.x()) : 0.0) + (deep ? std::abs (moved.y()) : 0.0)) / dt;
    }

    static Reach reach (const Axis& axis, double at) noexcept
    {
        if (axis.n == 0) return { .weight { 1.0 } };
        const double u = std::fmod (at, 2.0 * axis.n * axis.spacing) / axis.spacing, floor = std::floor (u);
        const double t = u - floor, s = 1.0 - t;
        const auto near = [] (double v)
        { return (66.0 + v * v * (-60.0 + v * v * (30.0 - 10.0 * v))) / 120.0; };
        const auto far = [] (double v)
        { return (26.0 + v * (-50.0 + v * (20.0 + v * (20.0 + v * (-20.0 + 5.0 * v))))) / 120.0; };
        const auto near_slope = [] (double v)
        { return v * (-120.0 + v * v * (120.0 - 50.0 * v)) / 120.0; };
        const auto far_slope = [] (double v)
        { return (-50.0 + v * (40.0 + v * (60.0 + v * (-80.0 + 25.0 * v)))) / 120.0; };
        Reach r {
            .weight { s * s * s * s * s / 120.0, far (t), near (t), near (s), far (s), t * t * t * t * t / 120.0 },
            .slope { -s * s * s * s / 24.0, far_slope (t), near_slope (t), -near_slope (s), -far_slope (s), t * t * t * t / 24.0 },
        };
        for (int i = 0; i < 6; ++i)
        {
            const auto k = static_cast<std::size_t> (i);
            r.index[k] = axis.mirrored (static_cast<int> (floor) + i - 2);
            r.slope[k] /= axis.spacing;
        }
        return r;
    }

    static Point sample (const Level& level, const Vec3& p) noexcept
    {
        const Reach x = reach (level.x, p.x()), y = reach (level.y, p.y());
        Point sum;
        for (std::size_t j = 0; j < 6; ++j)
        {
            const double* row = level.weights.data() + y.index[j] * level.x.points();
            double height = 0.0, slope = 0.0;
            for (std::size_t i = 0; i < 6; ++i)
            {
                height += x.weight[i] * row[x.index[i]];
                slope += x.slope[i] * row[x.index[i]];
            }
            sum.height += y.weight[j] * height;
            sum.slope_x += y.weight[j] * slope;
            sum.slope_y += y.slope[j] * height;
        }
        return sum;
    }

    /// The finest level that ends below what the speed leaves, and the next: that one alone where the first just does.
    Point blended (const Vec3& p) const noexcept
    {
        const double speed = last.speed;
        std::size_t fine = 0;
        while (fine + 1 < levels.size() && levels[fine].edge * speed > f_max)
            ++fine;
        const Point a = sample (levels[fine], p);
        if (fine + 1 == levels.size()) return a;

        const double end = levels[fine].edge * speed / f_max;   // <= 1
        const double begin = fine == 0 ? 0.5 : levels[fine].edge / levels[fine - 1].edge;
        if (end <= begin) return a;
        const double w = 1.0 - std::log (end) / std::log (begin);
        const Point b = sample (levels[fine + 1], p);
        return { std::lerp (a.height, b.height, w), std::lerp (a.slope_x, b.slope_x, w), std::lerp (a.slope_y, b.slope_y, w) };
    }

    void build();
    static double meanOf (const std::vector<double>&, const Axis& x, const Axis& y);
    static std::vector<double> resampled (const std::vector<double>&, const Axis& x, const Axis& y, const Axis& to_x, const Axis& to_y, double cutoff, double zeros);
    static std::vector<double> resampledRows (const std::vector<double>&, std::size_t rows, const Axis& from, const Axis& to, double cutoff, double zeros);
    static void makeSpline (std::vector<double>&, const Axis& x, const Axis& y);

    double dt = 1.0 / Setup {}.rate_hz;   // s
    double f_max = 0.0, release = 0.0;
    int hold = 0;
    double fastest = 0.0;              // m/s, from where on there is only the mean
    bool wide = false, deep = false;   // more than one column, more than one row
    std::vector<Level> levels;         // ever less detail; the last one is flat

    struct Sample
    {
        Vec3 p = Vec3::Zero();
        double speed = 0.0;   // m/s, |vx| + |vy|, falling late and slowly
        int held = 0;         // ticks until it begins to fall
        bool known = false;   // false until the first finite sample
    };
    Sample last;
};

//==============================================================================
// Implementation below.

inline std::string HeightMap::problem() const
{
    const Map& m = settings.map;
    if (m.image.grid && m.csv.grid) return "the map is an image or a csv, not both";
    if (! (m.pitch > 0.0) || ! isFinite (m.pitch)) return "the map's pitch must be above 0 m";
    if (! isFinite (m.height)) return "the map's height is not finite";
    const auto& grid = m.image.grid ? m.image.grid : m.csv.grid;
    if (! grid) return {};

    const auto rows = static_cast<std::size_t> (std::max (grid->rows, 0)), columns = static_cast<std::size_t> (std::max (grid->columns, 0));
    if (rows == 0 || columns == 0 || grid->values.size() != rows * columns) return "the map is empty";
    if (rows * columns > largest) return "the map has " + std::to_string (rows * columns) + " points; it may have " + std::to_string (largest);
    for (std::size_t i = 0; i < grid->values.size(); ++i)
        if (! isFinite (grid->values[i]))
            return "the map is not finite in row " + std::to_string (i / columns + 1) + ", column " + std::to_string (i % columns + 1);
    return {};
}

inline void HeightMap::build()
{
    levels.clear();
    const Map& m = settings.map;
    const auto& grid = m.image.grid ? m.image.grid : m.csv.grid;
    wide = grid && grid->columns > 1;
    deep = grid && grid->rows > 1;
    if (! grid) return;

    const double usual = m.image.grid ? 1e-4 : 1.0, height = m.height == 0.0 ? usual : m.height;
    Axis x { grid->columns - 1, m.pitch }, y { grid->rows - 1, m.pitch };
    std::vector<double> heights (grid->values.size());
    for (int row = 0; row < grid->rows; ++row)
        for (int column = 0; column < grid->columns; ++column)
            heights[static_cast<std::size_t> (m.image.grid ? grid->rows - 1 - row : row) * x.points() + static_cast<std::size_t> (column)] = height * (*grid) (row, column);

    const auto with = [] (const Axis& a, int n)
    { return a.n == 0 ? a : Axis { n, a.spacing * a.n / n }; };
    const auto add = [this] (const Axis& ax, const Axis& ay, double edge, std::vector<double> points)
    {
        makeSpline (points, ax, ay);
        levels.push_back ({ ax, ay, edge, std::move (points) });
    };

    const double mean = meanOf (heights, x, y);

    // A sinc that crosses zero at every point of the map keeps them all. It leaves little beyond 0.6 / pitch.
    const Axis fine_x = with (x, 2 * x.n), fine_y = with (y, 2 * y.n);
    add (fine_x, fine_y, 0.6 / m.pitch, resampled (heights, x, y, fine_x, fine_y, 0.5 / m.pitch, 16.0));

    // Four points a period at the edge: what the splines add above it is then less than a hundredth.
    const double length = m.pitch * std::max (x.n, y.n);
    double spacing = m.pitch;
    for (; 0.25 / spacing > 0.5 / length; spacing *= 2.0)
    {
        const auto coarser = [&] (const Axis& a)
        { return with (a, std::max (1, static_cast<int> (std::ceil (a.n * a.spacing / spacing * (1.0 - 1e-12))))); };
        const Axis next_x = coarser (x), next_y = coarser (y);
        const double edge = 0.25 / spacing;
        heights = resampled (heights, x, y, next_x, next_y, 0.8 * edge, 8.0);
        x = next_x;
        y = next_y;
        add (x, y, edge, heights);
    }

    fastest = 1.01 * f_max / levels.back().edge;
    add ({}, {}, 0.0, { mean });
}

/// Of the mirrored surface, where the points at the ends come once and the others twice.
inline double HeightMap::meanOf (const std::vector<double>& heights, const Axis& x, const Axis& y)
{
    const auto times = [] (const Axis& a, std::size_t i)
    { return i == 0 || i + 1 == a.points() ? 1.0 : 2.0; };
    double sum = 0.0, all = 0.0;
    for (std::size_t j = 0; j < y.points(); ++j)
        for (std::size_t i = 0; i < x.points(); ++i)
        {
            const double weight = times (x, i) * times (y, j);
            sum += weight * heights[j * x.points() + i];
            all += weight;
        }
    return sum / all;
}

inline std::vector<double> HeightMap::resampled (const std::vector<double>& points, const Axis& x, const Axis& y, const Axis& to_x, const Axis& to_y, double cutoff, double zeros)
{
    const auto transposed = [] (const std::vector<double>& from, std::size_t rows, std::size_t columns)
    {
        std::vector<double> to (from.size());
        for (std::size_t j = 0; j < rows; ++j)
            for (std::size_t i = 0; i < columns; ++i)
                to[i * rows + j] = from[j * columns + i];
        return to;
    };
    auto rows = resampledRows (points, y.points(), x, to_x, cutoff, zeros);
    rows = resampledRows (transposed (rows, y.points(), to_x.points()), to_x.points(), y, to_y, cutoff, zeros);
    return transposed (rows, to_x.points(), to_y.points());
}

/// Each row at new points, with nothing left above the cutoff in 1/m: a sinc with so many zeros a side, under a Kaiser window.
inline std::vector<double> HeightMap::resampledRows (const std::vector<double>& points, std::size_t rows, const Axis& from, const Axis& to, double cutoff, double zeros)
{
    if (from.n == 0) return points;
    constexpr double beta = 5.65;   // 60 dB
    const double reach = 0.5 * zeros / cutoff;
    const auto bessel = [] (double v)   // I_0; std::cyl_bessel_i is not everywhere
    {
        double sum = 1.0, term = 1.0;
        for (int k = 1; k < 30; ++k)
            sum += term *= 0.25 * v * v / (k * k);
        return sum;
    };
    const auto kernel = [&] (double distance)
    {
        const double r = distance / reach, phase = 2.0 * std::numbers::pi * cutoff * distance;
        if (std::abs (r) >= 1.0) return 0.0;
        return (phase == 0.0 ? 1.0 : std::sin (phase) / phase) * bessel (beta * std::sqrt (1.0 - r * r));
    };

    struct Tap
    {
        std::size_t index;
        double weight;
    };
    std::vector<Tap> taps;
    std::vector<std::size_t> ends;   // of the taps of each new point
    for (std::size_t k = 0; k < to.points(); ++k)
    {
        const double at = static_cast<double> (k) * to.spacing;
        const std::size_t begin = taps.size();
        double sum = 0.0;
        for (int i = static_cast<int> (std::ceil ((at - reach) / from.spacing)); i * from.spacing <= at + reach; ++i)
        {
            taps.push_back ({ from.mirrored (i), kernel (i * from.spacing - at) });
            sum += taps.back().weight;
        }
        for (std::size_t i = begin; i < taps.size(); ++i)
            taps[i].weight /= sum;
        ends.push_back (taps.size());
    }

    std::vector<double> result (rows * to.points());
    for (std::size_t j = 0; j < rows; ++j)
        for (std::size_t k = 0, tap = 0; k < to.points(); ++k)
            for (; tap < ends[k]; ++tap)
                result[j * to.points() + k] += taps[tap].weight * points[j * from.points() + taps[tap].index];
    return result;
}

/// From heights at the points to weights of the B-splines through them: the recursive filters of Unser 1999, box 2.
inline void HeightMap::makeSpline (std::vector<double>& points, const Axis& x, const Axis& y)
{
    const auto along = [] (double* first, std::size_t stride, int n, double pole)
    {
        if (n == 0) return;
        const auto c = [&] (int k) -> double&
        { return first[static_cast<std::size_t> (k) * stride]; };

        double start = c (0) + std::pow (pole, n) * c (n), forth = pole, back = std::pow (pole, 2 * n - 1);
        for (int k = 1; k < n; ++k, forth *= pole, back /= pole)
            start += (forth + back) * c (k);
        c (0) = start / (1.0 - std::pow (pole, 2 * n));
        for (int k = 1; k <= n; ++k)
            c (k) += pole * c (k - 1);
        c (n) = pole / (pole * pole - 1.0) * (c (n) + pole * c (n - 1));
        for (int k = n - 1; k >= 0; --k)
            c (k) = pole * (c (k + 1) - c (k));
        for (int k = 0; k <= n; ++k)
            c (k) *= (1.0 - pole) * (1.0 - 1.0 / pole);
    };
    for (const double pole : { -0.430575347099973792, -0.0430962882032646536 })
    {
        for (std::size_t j = 0; j < y.points(); ++j)
            along (points.data() + j * x.points(), 1, x.n, pole);
        for (std::size_t i = 0; i < x.points(); ++i)
            along (points.data() + i, x.points(), y.n, pole);
    }
}

/// The second derivatives of a B-spline are averages of the second differences of its weights, so these bound them.
inline Claims HeightMap::claims() const
{
    double steepest = 0.0;
    for (const Level& level : levels)
    {
        const auto at = [&] (int i, int j)
        { return level.weights[level.y.mirrored (j) * level.x.points() + level.x.mirrored (i)]; };
        double xx = 0.0, yy = 0.0, xy = 0.0;
        for (int j = 0; j <= level.y.n; ++j)
            for (int i = 0; i <= level.x.n; ++i)
            {
                xx = std::max (xx, std::abs (at (i - 1, j) - 2.0 * at (i, j) + at (i + 1, j)));
                yy = std::max (yy, std::abs (at (i, j - 1) - 2.0 * at (i, j) + at (i, j + 1)));
                xy = std::max (xy, std::abs (at (i, j) - at (i + 1, j) - at (i, j + 1) + at (i + 1, j + 1)));
            }
        const double dx = level.x.spacing, dy = level.y.spacing;
        steepest = std::max (steepest, std::max (xx / (dx * dx), yy / (dy * dy)) + xy / (dx * dy));
    }
    return {
        .passive = steepest == 0.0,
        .stiffness = std::abs (params.gain) * steepest,
        .spatial_frequency = levels.empty() ? 0.0 : levels.front().edge,
    };
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::HeightMap);
