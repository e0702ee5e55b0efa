// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/scene/camera.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <cmath>

using namespace tactus;
using host::scene::Bounds;
using host::scene::Camera;

namespace
{
double between (double low, double high) { return low + (high - low) * *rc::gen::inRange (0, 1001) / 1000.0; }

Camera anyCamera()
{
    Camera c;
    c.yaw = between (-3.0, 3.0);
    c.pitch = between (-1.5, 1.5);
    c.distance = between (0.02, 1.0);
    c.target = { between (-0.1, 0.1), between (-0.1, 0.1), between (-0.1, 0.1) };
    c.setSize (800.0f, 600.0f);
    return c;
}
}   // namespace

TEST_CASE ("a camera sees its target in the middle, at its distance", "[app][scene]")
{
    rc::check ([] {
        const auto c = anyCamera();
        const auto seen = c.see (c.target);
        RC_ASSERT (std::abs (seen.x - 400.0f) < 1e-2f);
        RC_ASSERT (std::abs (seen.y - 300.0f) < 1e-2f);
        RC_ASSERT (std::abs (seen.depth - c.distance) < 1e-9);
    });
}

TEST_CASE ("zooming about a pixel keeps what is under it, at the depth of the target", "[app][scene]")
{
    rc::check ([] {
        auto c = anyCamera();
        const juce::Point<float> at { static_cast<float> (between (0, 800)), static_cast<float> (between (0, 600)) };
        const Vec3 ray = c.ray (at), under = c.eye() + c.distance / ray.dot (c.view()) * ray;
        c.zoomAbout (at, between (0.5, 2.0));
        RC_ASSERT (c.pixel (under).getDistanceFrom (at) < 0.2f);
    });
}

TEST_CASE ("framing shows all corners of a box from any direction, also of a mesh in millimetres that is read as metres", "[app][scene]")
{
    rc::check ([] {
        auto c = anyCamera();
        Bounds box;
        const double size = std::pow (10.0, between (-1.0, 3.0));   // m
        for (int i = 0; i < 3; ++i)
            box.add (size * Vec3 (between (-1.0, 1.0), between (-1.0, 1.0), between (-1.0, 1.0)));
        if (box.radius() < 0.01) return;
        c.frame (box);
        for (int corner = 0; corner < 8; ++corner)
        {
            const auto pick = [&] (int axis) { return (corner >> axis) % 2 == 0 ? box.low[axis] : box.high[axis]; };
            const auto seen = c.see ({ pick (0), pick (1), pick (2) });
            RC_ASSERT (seen.depth > c.near());
            RC_ASSERT (seen.x >= 0.0f && seen.x <= 800.0f && seen.y >= 0.0f && seen.y <= 600.0f);
        }
    });
}

TEST_CASE ("panning moves the target by the pixels of the drag", "[app][scene]")
{
    auto c = Camera {};
    c.setSize (800.0f, 600.0f);
    const Vec3 before = c.target;
    c.pan ({ 30.0f, -20.0f });
    CHECK (c.pixel (before).getDistanceFrom ({ 430.0f, 280.0f }) < 0.1f);
}

TEST_CASE ("a camera turns past the side, but not over the top", "[app][scene]")
{
    Camera c;
    c.orbit (0.0, 10.0);
    CHECK (c.pitch < 1.5708);
    c.orbit (7.0, -20.0);
    CHECK (c.pitch > -1.5708);
    CHECK (std::abs (c.yaw) <= 3.1416);
}
