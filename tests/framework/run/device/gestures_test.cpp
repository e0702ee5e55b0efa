// SPDX-License-Identifier: MIT
#include <tactus/run/device/gesture_device.hpp>
#include <tactus/run/device/gestures.hpp>

#include <support/no_allocation.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <set>
#include <string>

using namespace tactus;

namespace
{
constexpr double h = 1e-4;   // step of the finite differences, in s

/// Extremes of a gesture over its duration.
struct Extent
{
    double deepest = 0.0, fastest = 0.0, acceleration = 0.0, jerk = 0.0;
};

Extent extentOf (const Gesture& gesture)
{
    Extent extent;
    Vec3 a_before = Vec3::Zero();
    const auto n = static_cast<int> (gesture.duration_s / h);

    // Two periods, so that the seam is included.
    const auto at = [&] (int k) { return gesture.position (h * ((k + n) % n)); };

    for (int k = 0; k < 2 * n; ++k)
    {
        const Vec3 before = at (k - 1), now = at (k), after = at (k + 1);
        const Vec3 v = (after - before) / (2 * h), a = (after - 2 * now + before) / (h * h);
        extent.deepest = std::max (extent.deepest, -now.z());
        extent.fastest = std::max (extent.fastest, v.norm());
        extent.acceleration = std::max (extent.acceleration, a.norm());
        if (k > 0) extent.jerk = std::max (extent.jerk, (a - a_before).norm() / h);
        a_before = a;
    }
    return extent;
}
}   // namespace

TEST_CASE ("gestures: there are strokes, presses, taps and more, each with a one-sentence description", "[host][devices]")
{
    std::set<std::string_view> ids;
    for (const auto& gesture : gestures())
    {
        ids.insert (gesture.id);
        CHECK (findGesture (gesture.id) == &gesture);
        CHECK (gesture.duration_s > 0.0);
        CHECK (gesture.about.ends_with ('.'));
    }
    CHECK (ids.size() == gestures().size());
    for (const char* id : { "stroke", "press", "tap", "circle", "sweep", "hold", "touch" })
        CHECK (ids.contains (id));
    CHECK (findGesture ("wave") == nullptr);
}

TEST_CASE ("gestures: a hand starts and ends at rest above the surface, at the same place", "[host][devices]")
{
    for (const auto& gesture : gestures())
    {
        CAPTURE (gesture.id);
        const Vec3 start = gesture.position (0.0), end = gesture.position (gesture.duration_s);
        CHECK (start.z() > 1e-3);
        CHECK ((end - start).norm() < 1e-15);
        CHECK ((gesture.position (h) - start).norm() / h < 1e-3);
        CHECK ((end - gesture.position (gesture.duration_s - h)).norm() / h < 1e-3);
        CHECK (gesture.position (-1.0) == start);
        CHECK (gesture.position (1e9) == end);
    }
}

TEST_CASE ("gestures: each one touches the surface, and none is faster or more abrupt than a human hand", "[host][devices]")
{
    for (const auto& gesture : gestures())
    {
        CAPTURE (gesture.id);
        const auto extent = extentOf (gesture);
        CHECK (extent.deepest >= 0.9e-3);
        CHECK (extent.fastest <= 0.45);
        CHECK (extent.acceleration <= 20.0);

        // A step in the acceleration would appear as a jerk of acceleration / h: a hundred thousand or more.
        CHECK (extent.jerk <= 3500.0);
    }
}

TEST_CASE ("gestures: each one matches its name", "[host][devices]")
{
    CHECK (extentOf (*findGesture ("stroke")).deepest == Approx (2e-3));
    CHECK (extentOf (*findGesture ("press")).deepest == Approx (4e-3));
    CHECK (extentOf (*findGesture ("sweep")).fastest == Approx (0.4).epsilon (1e-3));

    const auto& sweep = *findGesture ("sweep");
    double slow = 0.0;
    for (double t = 0.6; t < 6.0; t += 1e-3)
        slow = std::max (slow, (sweep.position (t + h) - sweep.position (t)).norm() / h);
    CHECK (slow == Approx (0.010).epsilon (1e-3));
}

TEST_CASE ("gestures: each tap is faster than the previous one", "[host][devices]")
{
    const auto& tap = *findGesture ("tap");
    std::vector<double> speeds;
    for (double t = 0.0, z = 1.0; t < tap.duration_s; t += h)
    {
        const double now = tap.position (t).z();
        if (z > 0.0 && now <= 0.0) speeds.push_back ((z - now) / h);
        z = now;
    }
    CHECK (speeds.size() == 5);
    CHECK (std::ranges::is_sorted (speeds));
    CHECK (speeds.back() > 3.0 * speeds.front());
}

TEST_CASE ("gestures: a resting hand trembles by tens of micrometres", "[host][devices]")
{
    const auto& hold = *findGesture ("hold");
    double most = 0.0;
    for (double t = 1.0; t < 5.0; t += 1e-3)
        most = std::max (most, (hold.position (t) - Vec3 (0, 0, -1e-3)).norm());
    CHECK (most > 20e-6);
    CHECK (most < 100e-6);
}

TEST_CASE ("gesture device: the hand follows the gesture regardless of the force, and repeats it", "[host][devices]")
{
    const auto& circle = *findGesture ("circle");
    GestureDevice device (circle);
    device.prepare (1e-3);
    CHECK (device.duration() == circle.duration_s);

    for (int k = 0; k < 10'000; ++k)
    {
        const auto reading = device.read();
        const double t = std::fmod (k * 1e-3, circle.duration_s);
        REQUIRE ((reading.position - circle.position (t)).norm() < 1e-12);
        device.write ({ .force = { 100, 100, 100 } });
    }
}

TEST_CASE ("gesture device: speed and pressure match the motion", "[host][devices]")
{
    GestureDevice device (*findGesture ("press"), { .offset = { 0.1, 0, 0.02 } });
    device.prepare (1e-3);

    Vec3 before = device.read().position;
    double hardest = 0.0;
    for (int k = 0; k < 3000; ++k)
    {
        const auto a = device.read();
        device.write ({});
        const auto b = device.read();
        REQUIRE ((0.5 * (a.true_velocity + b.true_velocity) - (b.position - a.position) / 1e-3).norm() < 1e-6);
        hardest = std::max (hardest, b.pressure);
        before = b.position;
    }
    CHECK (before.x() == Approx (0.1));
    CHECK (hardest == Approx (2.0));   // 4 mm into a pad of 500 N/m
}

TEST_CASE ("gesture device: a tick allocates nothing", "[host][devices]")
{
    GestureDevice device (*findGesture ("sweep"));
    device.prepare (1e-3);

    const NoAllocation watch;
    for (int k = 0; k < 1000; ++k)
    {
        device.read();
        device.write ({});
    }
    CHECK (watch.allocations() == 0);
}
