// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/kit/vec3.hpp>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host::scene
{

/// A box around things, in m. Empty until something is added.
struct Bounds
{
    Vec3 low = Vec3::Constant (std::numeric_limits<double>::infinity()), high = -low;

    bool isEmpty() const noexcept { return ! (low.x() <= high.x()); }
    void add (const Vec3& p) noexcept
    {
        low = low.cwiseMin (p);
        high = high.cwiseMax (p);
    }
    void add (const Bounds& other) noexcept
    {
        low = low.cwiseMin (other.low);
        high = high.cwiseMax (other.high);
    }
    Vec3 centre() const noexcept { return 0.5 * (low + high); }
    double radius() const noexcept { return 0.5 * (high - low).norm(); }
};

/// A camera that turns around a target, with z up. Yaw 0 looks away from the person, along y.
class Camera
{
public:
    static constexpr double nearest = 0.01, farthest = 3.0;   ///< distances from the target, in m; what has been framed may be farther

    Vec3 target = Vec3::Zero();   ///< m
    double yaw = 0.55;            ///< rad, to the left
    double pitch = 0.62;          ///< rad, from above
    double distance = 0.2;        ///< m

    /// The size of the picture, in pixels. Call it before the functions below.
    void setSize (float width, float height) noexcept;

    /// A point in the picture. `depth` is the distance from the camera along the line of sight, in m; what is not in front of the camera
    /// has a depth of at most near().
    struct ImagePoint
    {
        float x = 0.0f, y = 0.0f;
        double depth = 0.0;
    };
    ImagePoint see (const Vec3&) const noexcept;
    juce::Point<float> pixel (const Vec3& p) const noexcept
    {
        const auto s = see (p);
        return { s.x, s.y };
    }

    double near() const noexcept { return 0.05 * distance; }
    Vec3 eye() const noexcept { return target - distance * view(); }
    Vec3 right() const noexcept;
    Vec3 up() const noexcept;
    Vec3 view() const noexcept;   ///< direction of the line of sight

    /// Pixels per metre at a depth.
    double scaleAt (double depth) const noexcept { return focal / std::max (depth, near()); }

    /// The direction from the eye through a pixel.
    Vec3 ray (juce::Point<float>) const noexcept;

    void orbit (double right_rad, double up_rad) noexcept;
    void pan (juce::Point<float> pixels) noexcept;   ///< what is at the target moves by this much

    /// Zooms in by a factor. What is under the pixel, as far away as the target, stays there.
    void zoomAbout (juce::Point<float>, double factor) noexcept;

    /// Shows these bounds as a whole, from the current direction.
    void frame (const Bounds&) noexcept;

private:
    float half_width = 1.0f, half_height = 1.0f;
    double focal = 1.0;   // pixels per unit of slope
    double most_distance = farthest;
};

}   // namespace tactus::host::scene
