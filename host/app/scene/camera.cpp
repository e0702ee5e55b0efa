// SPDX-License-Identifier: GPL-3.0-or-later
#include "camera.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace tactus::host::scene
{

namespace
{
constexpr double half_angle = 0.26;     // rad, of the shorter side of the picture
constexpr double most_pitch = 1.5533;   // 89 degrees
}   // namespace

void Camera::setSize (float width, float height) noexcept
{
    half_width = 0.5f * std::max (width, 1.0f);
    half_height = 0.5f * std::max (height, 1.0f);
    focal = static_cast<double> (std::min (half_width, half_height)) / std::tan (half_angle);
}

Vec3 Camera::right() const noexcept { return { std::cos (yaw), std::sin (yaw), 0.0 }; }

Vec3 Camera::up() const noexcept { return right().cross (view()); }

Vec3 Camera::view() const noexcept { return { -std::sin (yaw) * std::cos (pitch), std::cos (yaw) * std::cos (pitch), -std::sin (pitch) }; }

Camera::ImagePoint Camera::see (const Vec3& p) const noexcept
{
    const Vec3 from_eye = p - eye();
    const double depth = from_eye.dot (view());
    const double scale = scaleAt (depth);
    return { half_width + static_cast<float> (from_eye.dot (right()) * scale), half_height - static_cast<float> (from_eye.dot (up()) * scale), depth };
}

Vec3 Camera::ray (juce::Point<float> at) const noexcept
{
    const double x = static_cast<double> (at.x - half_width) / focal, y = static_cast<double> (half_height - at.y) / focal;
    return (view() + x * right() + y * up()).normalized();
}

void Camera::orbit (double right_rad, double up_rad) noexcept
{
    constexpr double turn = 2.0 * juce::MathConstants<double>::pi;
    yaw = std::remainder (yaw + right_rad, turn);
    pitch = std::clamp (pitch + up_rad, -most_pitch, most_pitch);
}

void Camera::pan (juce::Point<float> pixels) noexcept
{
    const double scale = 1.0 / scaleAt (distance);
    target += scale * (static_cast<double> (pixels.y) * up() - static_cast<double> (pixels.x) * right());
}

void Camera::zoomAbout (juce::Point<float> at, double factor) noexcept
{
    const double now = std::clamp (distance / factor, nearest, most_distance), kept = now / distance;
    const double scale = 1.0 / scaleAt (distance);
    const Vec3 under = target + scale * (static_cast<double> (at.x - half_width) * right() + static_cast<double> (half_height - at.y) * up());
    target = under + kept * (target - under);
    distance = now;
}

void Camera::frame (const Bounds& all) noexcept
{
    if (all.isEmpty()) return;
    constexpr double space = 1.08;   // around the box
    target = all.centre();
    double needed = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
        const auto pick = [&] (int axis) { return (corner >> axis) % 2 == 0 ? all.low[axis] : all.high[axis]; };
        const Vec3 p = Vec3 (pick (0), pick (1), pick (2)) - target;
        const double across = std::abs (p.dot (right())) / static_cast<double> (half_width);
        const double above = std::abs (p.dot (up())) / static_cast<double> (half_height);
        needed = std::max (needed, space * focal * std::max (across, above) - p.dot (view()));
    }
    distance = std::max (needed, nearest);
    most_distance = std::max (distance, farthest);
}

}   // namespace tactus::host::scene
