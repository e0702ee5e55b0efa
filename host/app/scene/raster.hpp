// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "camera.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace tactus::host::scene
{

/// Fills triangles into a picture, with a depth for each pixel, so that what is nearer covers what is farther. All in software: no
/// graphics card is needed. The picture may be computed at a higher resolution than it is shown, which smooths its edges.
class Raster
{
public:
    /// A corner of a triangle in the picture, with N values that are interpolated over it in space, not over the picture.
    template <std::size_t N>
    struct Corner
    {
        float x, y;
        float nearness;   ///< 1 / depth, in 1/m; 0 or less: behind the near plane of the camera
        std::array<float, N> values;

        // In m. Set only in corners that corner() makes; needed to cut triangles at the near plane. x and y of a corner behind this plane are
        // computed as if its depth were `near`.
        float depth = 0.0f, near = 0.0f;
    };

    /// The number of triangles that were given, by what became of them.
    struct Count
    {
        int drawn = 0, turned_away = 0, outside = 0;

        int all() const noexcept { return drawn + turned_away + outside; }
    };

    enum class Sides
    {
        front,   ///< only triangles that run counter-clockwise in the picture
        both
    };

    /// The part of a picture that has a colour of its own. If it is the pixel, a triangle is shaded once for all its samples there, in the middle of
    /// the pixel: its edges are as smooth, and a picture takes half the time.
    enum class Shading
    {
        sample,
        pixel
    };

    /// Makes the picture empty. `fineness` is the number of samples per pixel in each direction; Shading::pixel has an effect if it is 2.
    void begin (int width, int height, int fineness, Shading = Shading::sample);

    /// Fills the part of a triangle that is in front of the camera. `shade (values)` returns the colour of a sample: 0xffRRGGBB.
    template <std::size_t N, typename Shade>
    void triangle (const Corner<N>&, const Corner<N>&, const Corner<N>&, Sides, Shade&&);

    /// Fills a ball that looks round. `shade (normal)` returns the colour; the normal is in the axes of the picture: right, up, towards the eye.
    template <typename Shade>
    void ball (const Camera&, const Vec3& centre, double radius, Shade&&);

    /// Draws a point of the scene into this picture.
    template <std::size_t N>
    Corner<N> corner (const Camera::ImagePoint& s, double near, std::array<float, N> values) const noexcept
    {
        const auto f = static_cast<float> (samples);
        const float nearness = s.depth > near ? static_cast<float> (1.0 / s.depth) : 0.0f;
        return { s.x * f, s.y * f, nearness, values, static_cast<float> (s.depth), static_cast<float> (near) };
    }

    /// Writes the picture over the image, which must be at least as large, and have the format ARGB. Where nothing was drawn, it stays
    /// transparent.
    void write (juce::Image&) const;

    const Count& count() const noexcept { return counted; }
    int fineness() const noexcept { return samples; }

    /// The share of the picture's samples that something covers.
    double coverage() const noexcept;

private:
    enum class DepthResult
    {
        drawn,
        turned_away,
        outside
    };

    /// Fills a triangle whose corners are all in front of the camera.
    template <std::size_t N, typename Shade>
    DepthResult fill (const Corner<N>&, const Corner<N>&, const Corner<N>&, Sides, Shade&&);

    /// The point where the edge between a corner in front of the near plane and one behind it meets the plane.
    template <std::size_t N>
    Corner<N> cut (const Corner<N>& front, const Corner<N>& behind) const noexcept;

    void note (DepthResult f) noexcept { ++(f == DepthResult::drawn ? counted.drawn : f == DepthResult::turned_away ? counted.turned_away
                                                                                                                    : counted.outside); }

    /// The first of `count` samples whose middle is not before this place; `count` if all are. A place may be as far away as a float goes.
    static int firstAfter (float place, int count) noexcept
    {
        const float number = std::ceil (place - 0.5f);
        if (! (number > 0.0f)) return 0;
        return number < static_cast<float> (count) ? static_cast<int> (number) : count;
    }

    /// The samples of a row whose middles are inside a triangle with these corners. Triangles that share an edge share no sample.
    std::pair<int, int> span (const std::array<float, 3>& x, const std::array<float, 3>& y, float middle) const noexcept;

    /// With two samples per pixel in each direction: how far the middle of a sample is from that of its pixel, in samples.
    static float fromMiddle (int sample) noexcept { return static_cast<float> (sample & 1) - 0.5f; }

    /// The triangle that was shaded last in a pixel.
    struct Shaded
    {
        std::uint32_t triangle, colour;
    };

    int columns = 0, rows = 0, samples = 1;
    bool by_pixel = false;
    std::uint32_t triangle_number = 0;
    std::vector<Shaded> pixels;   // where the pixel has the colour
    std::vector<std::uint32_t> colours;
    std::vector<float> nearest;   // 1 / depth of the sample; 0: nothing there
    Count counted;
};

//==============================================================================
// Implementation below.

template <std::size_t N, typename Shade>
void Raster::triangle (const Corner<N>& a, const Corner<N>& b, const Corner<N>& c, Sides sides, Shade&& shade)
{
    if (a.nearness > 0.0f && b.nearness > 0.0f && c.nearness > 0.0f) return note (fill (a, b, c, sides, shade));
    if (! (a.nearness > 0.0f || b.nearness > 0.0f || c.nearness > 0.0f)) return note (DepthResult::outside);

    // The part in front of the near plane has three or four corners, in the same order.
    const std::array all { &a, &b, &c };
    std::array<Corner<N>, 4> kept;
    std::size_t count = 0;
    for (std::size_t i = 0; i < 3; ++i)
    {
        const auto &from = *all[i], &to = *all[(i + 1) % 3];
        const bool begins = from.nearness > 0.0f, ends = to.nearness > 0.0f;
        if (! begins && ! (from.near > 0.0f)) return note (DepthResult::outside);   // its position behind the plane is not known
        if (begins) kept[count++] = from;
        if (begins != ends) kept[count++] = begins ? cut (from, to) : cut (to, from);
    }
    auto fate = fill (kept[0], kept[1], kept[2], sides, shade);
    if (count == 4)
        if (const auto second = fill (kept[0], kept[2], kept[3], sides, shade); fate != DepthResult::drawn) fate = second;
    note (fate);
}

template <std::size_t N>
Raster::Corner<N> Raster::cut (const Corner<N>& front, const Corner<N>& behind) const noexcept
{
    const float near = behind.near, depth = 1.0f / front.nearness, share = std::clamp ((depth - near) / (depth - behind.depth), 0.0f, 1.0f);
    const auto between = [share] (float v, float w) { return v + share * (w - v); };
    const auto place = [&] (float v, float w, int size) {   // in space, the distance from the middle of the picture grows in proportion to the depth
        const float middle = 0.5f * static_cast<float> (size);
        return middle + between ((v - middle) * depth, (w - middle) * near) / near;
    };
    Corner<N> made { place (front.x, behind.x, columns), place (front.y, behind.y, rows), 1.0f / near, {}, near, near };
    for (std::size_t i = 0; i < N; ++i)
        made.values[i] = between (front.values[i], behind.values[i]);
    return made;
}

inline std::pair<int, int> Raster::span (const std::array<float, 3>& xs, const std::array<float, 3>& ys, float middle) const noexcept
{
    float from = static_cast<float> (columns), to = 0.0f;
    for (std::size_t i = 0; i < 3; ++i)
    {
        const auto j = (i + 1) % 3, upper = ys[i] < ys[j] ? i : j, lower = i + j - upper;   // the same computation for both triangles at an edge
        if (! (ys[upper] <= middle && middle < ys[lower])) continue;
        const float x = xs[upper] + (xs[lower] - xs[upper]) * ((middle - ys[upper]) / (ys[lower] - ys[upper]));
        from = std::min (from, x);
        to = std::max (to, x);
    }
    return { firstAfter (from, columns), firstAfter (to, columns) };
}

template <std::size_t N, typename Shade>
Raster::DepthResult Raster::fill (const Corner<N>& a, const Corner<N>& b, const Corner<N>& c, Sides sides, Shade&& shade)
{
    const float low_y = std::min ({ a.y, b.y, c.y }), high_y = std::max ({ a.y, b.y, c.y });
    const float low_x = std::min ({ a.x, b.x, c.x }), high_x = std::max ({ a.x, b.x, c.x });
    const auto width = static_cast<float> (columns), height = static_cast<float> (rows);
    if (! (low_x < width && high_x > 0.0f && low_y < height && high_y > 0.0f)) return DepthResult::outside;
    const float area = (b.x - a.x) * (a.y - c.y) - (a.y - b.y) * (c.x - a.x);   // y points down: positive is counter-clockwise
    if (area == 0.0f || (area < 0.0f && sides == Sides::front)) return DepthResult::turned_away;

    // The nearness, and each value times the nearness, are linear over the picture: `base` at a, and slopes along x and y.
    const float over = 1.0f / area;
    const float bx = (a.y - c.y) * over, by = (c.x - a.x) * over, cx = (b.y - a.y) * over, cy = (a.x - b.x) * over;
    std::array<float, N + 1> base, along_x, along_y;
    const auto lay = [&] (std::size_t i, float va, float vb, float vc) {
        along_x[i] = (vb - va) * bx + (vc - va) * cx;
        along_y[i] = (vb - va) * by + (vc - va) * cy;
        base[i] = va - a.x * along_x[i] - a.y * along_y[i];
    };
    for (std::size_t i = 0; i < N; ++i)
        lay (i, a.values[i] * a.nearness, b.values[i] * b.nearness, c.values[i] * c.nearness);
    lay (N, a.nearness, b.nearness, c.nearness);

    ++triangle_number;
    for (int y = firstAfter (low_y, rows), last = firstAfter (high_y, rows); y < last; ++y)
    {
        const float py = static_cast<float> (y) + 0.5f;
        const auto [begin, end] = span ({ a.x, b.x, c.x }, { a.y, b.y, c.y }, py);
        if (begin >= end) continue;
        std::array<float, N + 1> now;
        for (std::size_t i = 0; i <= N; ++i)
            now[i] = base[i] + along_y[i] * py + along_x[i] * (static_cast<float> (begin) + 0.5f);
        const auto row_of_pixels = static_cast<std::size_t> (y >> 1) * static_cast<std::size_t> (columns >> 1);
        const auto step = [&] {
            for (std::size_t i = 0; i <= N; ++i)
                now[i] += along_x[i];
        };
        auto place = static_cast<std::size_t> (y) * static_cast<std::size_t> (columns) + static_cast<std::size_t> (begin);
        for (int x = begin; x < end; ++x, ++place, step())
        {
            if (now[N] > nearest[place])
            {
                nearest[place] = now[N];
                const auto pixel = by_pixel ? row_of_pixels + static_cast<std::size_t> (x >> 1) : 0;
                if (by_pixel && pixels[pixel].triangle == triangle_number)
                {
                    colours[place] = pixels[pixel].colour;
                    continue;
                }
                float dx = by_pixel ? fromMiddle (x) : 0.0f, dy = by_pixel ? fromMiddle (y) : 0.0f;
                const auto at = [&] (std::size_t i) { return now[i] - along_x[i] * dx - along_y[i] * dy; };
                if (! (at (N) > 0.0f)) dx = dy = 0.0f;   // the middle of the pixel is behind the camera
                const float depth = 1.0f / at (N);
                std::array<float, N> values;
                for (std::size_t i = 0; i < N; ++i)
                    values[i] = at (i) * depth;
                colours[place] = shade (values);
                if (by_pixel) pixels[pixel] = { triangle_number, colours[place] };
            }
        }
    }
    return DepthResult::drawn;
}

template <typename Shade>
void Raster::ball (const Camera& camera, const Vec3& centre, double radius, Shade&& shade)
{
    const auto seen = camera.see (centre);
    if (! (seen.depth > camera.near())) return;
    const float f = static_cast<float> (samples), cx = seen.x * f, cy = seen.y * f, r = static_cast<float> (camera.scaleAt (seen.depth) * radius) * f;
    const int top = firstAfter (cy - r, rows), bottom = firstAfter (cy + r, rows), left = firstAfter (cx - r, columns), right = firstAfter (cx + r, columns);
    for (int y = top; y < bottom; ++y)
        for (int x = left; x < right; ++x)
        {
            const float nx = (static_cast<float> (x) + 0.5f - cx) / r, ny = (cy - static_cast<float> (y) - 0.5f) / r, square = nx * nx + ny * ny;
            if (square >= 1.0f) continue;
            const float nz = std::sqrt (1.0f - square), nearness = static_cast<float> (1.0 / (seen.depth - radius * static_cast<double> (nz)));
            const auto place = static_cast<std::size_t> (y) * static_cast<std::size_t> (columns) + static_cast<std::size_t> (x);
            if (! (nearness > nearest[place])) continue;
            nearest[place] = nearness;
            colours[place] = shade (std::array<float, 3> { nx, ny, nz });
        }
}

}   // namespace tactus::host::scene
