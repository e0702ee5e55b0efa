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
/// graphics card is needed. The picture may be computed finer than it is shown, which smooths its edges.
class Raster
{
public:
    /// A corner of a triangle in the picture, with N values that are interpolated over it in space, not over the picture.
    template <std::size_t N>
    struct Corner
    {
        float x, y;
        float nearness;   ///< 1 / depth, in 1/m; not above 0: behind the camera
        std::array<float, N> values;
    };

    /// How many triangles were given, and what became of them.
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

    /// Makes the picture empty. `fineness` is the number of samples per pixel in each direction.
    void begin (int width, int height, int fineness);

    /// Fills a triangle. `shade (values)` returns the colour of a sample: 0xffRRGGBB.
    template <std::size_t N, typename Shade>
    void triangle (const Corner<N>&, const Corner<N>&, const Corner<N>&, Sides, Shade&&);

    /// Fills a ball that looks round. `shade (normal)` returns the colour; the normal is in the axes of the picture: right, up, towards the eye.
    template <typename Shade>
    void ball (const Camera&, const Vec3& centre, double radius, Shade&&);

    /// Draws a point of the scene into this picture.
    template <std::size_t N>
    Corner<N> corner (const Camera::Seen& s, double near, std::array<float, N> values) const noexcept
    {
        const auto f = static_cast<float> (samples);
        return { s.x * f, s.y * f, s.depth > near ? static_cast<float> (1.0 / s.depth) : 0.0f, values };
    }

    /// Writes the picture over the image, which must be at least as large, and have the format ARGB. Where nothing was drawn, it stays
    /// transparent.
    void write (juce::Image&) const;

    const Count& count() const noexcept { return counted; }
    int fineness() const noexcept { return samples; }

    /// The share of the picture's samples that something covers.
    double coverage() const noexcept;

private:
    /// The first of `count` samples whose middle is not before this place; `count` if all are. A place may be as far away as a float goes.
    static int firstAfter (float place, int count) noexcept
    {
        const float number = std::ceil (place - 0.5f);
        if (! (number > 0.0f)) return 0;
        return number < static_cast<float> (count) ? static_cast<int> (number) : count;
    }

    /// The samples of a row whose middles are inside a triangle with these corners. Triangles that share an edge share no sample.
    std::pair<int, int> span (const std::array<float, 3>& x, const std::array<float, 3>& y, float middle) const noexcept;

    int columns = 0, rows = 0, samples = 1;
    std::vector<std::uint32_t> colours;
    std::vector<float> nearest;   // 1 / depth of the sample; 0: nothing there
    Count counted;
};

//==============================================================================
// Implementation below.

template <std::size_t N, typename Shade>
void Raster::triangle (const Corner<N>& a, const Corner<N>& b, const Corner<N>& c, Sides sides, Shade&& shade)
{
    if (! (a.nearness > 0.0f && b.nearness > 0.0f && c.nearness > 0.0f)) return void (++counted.outside);
    const float low_y = std::min ({ a.y, b.y, c.y }), high_y = std::max ({ a.y, b.y, c.y });
    const float low_x = std::min ({ a.x, b.x, c.x }), high_x = std::max ({ a.x, b.x, c.x });
    const auto width = static_cast<float> (columns), height = static_cast<float> (rows);
    if (! (low_x < width && high_x > 0.0f && low_y < height && high_y > 0.0f)) return void (++counted.outside);
    const float area = (b.x - a.x) * (a.y - c.y) - (a.y - b.y) * (c.x - a.x);   // y points down: positive is counter-clockwise
    if (area == 0.0f || (area < 0.0f && sides == Sides::front)) return void (++counted.turned_away);
    ++counted.drawn;

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

    for (int y = firstAfter (low_y, rows), last = firstAfter (high_y, rows); y < last; ++y)
    {
        const float py = static_cast<float> (y) + 0.5f;
        const auto [begin, end] = span ({ a.x, b.x, c.x }, { a.y, b.y, c.y }, py);
        if (begin >= end) continue;
        std::array<float, N + 1> now;
        for (std::size_t i = 0; i <= N; ++i)
            now[i] = base[i] + along_y[i] * py + along_x[i] * (static_cast<float> (begin) + 0.5f);
        auto place = static_cast<std::size_t> (y) * static_cast<std::size_t> (columns) + static_cast<std::size_t> (begin);
        for (int x = begin; x < end; ++x, ++place)
        {
            if (now[N] > nearest[place])
            {
                nearest[place] = now[N];
                const float depth = 1.0f / now[N];
                std::array<float, N> values;
                for (std::size_t i = 0; i < N; ++i)
                    values[i] = now[i] * depth;
                colours[place] = shade (values);
            }
            for (std::size_t i = 0; i <= N; ++i)
                now[i] += along_x[i];
        }
    }
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
