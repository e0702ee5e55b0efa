// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/scene/raster.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <cmath>
#include <optional>

using namespace tactus;
using host::scene::Camera;
using host::scene::Raster;

namespace
{
constexpr int width = 40, height = 30;

Raster::Corner<1> corner (float x, float y, float depth = 1.0f) { return { x, y, 1.0f / depth, { 0.0f } }; }

auto paint (std::uint32_t colour)
{
    return [colour] (const std::array<float, 1>&) { return colour; };
}

void quad (Raster& r, float x0, float y0, float x1, float y1, float depth, std::uint32_t colour)
{
    const auto a = corner (x0, y1, depth), b = corner (x1, y1, depth), c = corner (x1, y0, depth), d = corner (x0, y0, depth);
    r.triangle (a, b, c, Raster::Sides::front, paint (colour));
    r.triangle (a, c, d, Raster::Sides::front, paint (colour));
}

juce::Image pictureOf (const Raster& r)
{
    juce::Image image (juce::Image::ARGB, width, height, true);
    r.write (image);
    return image;
}
}   // namespace

TEST_CASE ("two triangles that share an edge cover each sample once", "[app][scene]")
{
    rc::check ([] {
        const auto place = [] (int most) { return static_cast<float> (*rc::gen::inRange (-20, 10 * most + 20)) / 10.0f; };
        const float x = place (width), y = place (height);
        // A fan around any point covers the picture without a gap and without an overlap.
        const std::array<std::array<float, 2>, 4> rim { { { -50.0f, 80.0f }, { 90.0f, 80.0f }, { 90.0f, -50.0f }, { -50.0f, -50.0f } } };
        double sum = 0.0;
        for (std::size_t i = 0; i < 4; ++i)
        {
            Raster one;
            one.begin (width, height, 1);
            const auto &p = rim[i], &q = rim[(i + 1) % 4];
            one.triangle (corner (x, y), corner (p[0], p[1]), corner (q[0], q[1]), Raster::Sides::front, paint (0xff112233));
            sum += one.coverage();
        }
        RC_ASSERT (std::abs (sum - 1.0) < 1e-9);
    });
}

TEST_CASE ("what is nearer covers what is farther, in either order", "[app][scene]")
{
    for (const bool near_first : { true, false })
    {
        Raster r;
        r.begin (width, height, 1);
        if (near_first) quad (r, 10.0f, 10.0f, 20.0f, 20.0f, 1.0f, 0xffff0000);
        quad (r, 0.0f, 0.0f, 40.0f, 30.0f, 2.0f, 0xff0000ff);
        if (! near_first) quad (r, 10.0f, 10.0f, 20.0f, 20.0f, 1.0f, 0xffff0000);
        const auto image = pictureOf (r);
        CHECK (image.getPixelAt (15, 15) == juce::Colour (0xffff0000));
        CHECK (image.getPixelAt (5, 5) == juce::Colour (0xff0000ff));
        CHECK (image.getPixelAt (20, 20) == juce::Colour (0xff0000ff));
        CHECK (r.coverage() == 1.0);
    }
}

TEST_CASE ("triangles that face away, or lie outside or behind the camera, are not drawn", "[app][scene]")
{
    Raster r;
    r.begin (width, height, 1);
    const auto a = corner (5.0f, 25.0f), b = corner (25.0f, 25.0f), c = corner (15.0f, 5.0f);
    r.triangle (a, c, b, Raster::Sides::front, paint (0xffffffff));
    CHECK (r.count().turned_away == 1);
    CHECK (r.coverage() == 0.0);
    r.triangle (corner (50.0f, 25.0f), corner (70.0f, 25.0f), corner (60.0f, 5.0f), Raster::Sides::front, paint (0xffffffff));
    auto behind = c;
    behind.nearness = 0.0f;
    r.triangle (a, b, behind, Raster::Sides::front, paint (0xffffffff));
    CHECK (r.count().outside == 2);
    CHECK (r.coverage() == 0.0);
    r.triangle (a, c, b, Raster::Sides::both, paint (0xffffffff));
    r.triangle (a, b, c, Raster::Sides::front, paint (0xffffffff));
    CHECK (r.count().drawn == 2);
    CHECK (r.coverage() > 0.1);
}

TEST_CASE ("what is far outside of the picture is drawn as far as the picture shows it", "[app][scene]")
{
    constexpr float far = 1e12f;
    Raster r;
    r.begin (width, height, 1);
    quad (r, -far, -far, far, far, 1.0f, 0xff112233);
    CHECK (r.coverage() == 1.0);
    r.begin (width, height, 1);
    quad (r, far, far, 2.0f * far, 2.0f * far, 1.0f, 0xff112233);
    CHECK (r.coverage() == 0.0);
    Camera camera;
    camera.setSize (width, height);
    const auto green = [] (const std::array<float, 3>&) { return 0xff00ff00u; };
    r.ball (camera, camera.target + 1e12 * camera.right(), 1e-3, green);
    r.ball (camera, camera.target - 1e12 * camera.up(), 1e-3, green);
    CHECK (r.coverage() == 0.0);
}

TEST_CASE ("values are interpolated in space, not over the picture", "[app][scene]")
{
    Raster r;
    r.begin (width, height, 1);
    // From depth 1 at the left to depth 3 at the right, the middle of the picture is a quarter of the way in space.
    const Raster::Corner<1> left { 0.0f, 60.0f, 1.0f, { 0.0f } }, right { 40.0f, 60.0f, 1.0f / 3.0f, { 1.0f } };
    const Raster::Corner<1> high_left { 0.0f, -60.0f, 1.0f, { 0.0f } }, high_right { 40.0f, -60.0f, 1.0f / 3.0f, { 1.0f } };
    const auto shade = [] (const std::array<float, 1>& v) { return 0xff000000u | static_cast<std::uint32_t> (v[0] * 200.0f); };
    r.triangle (left, right, high_right, Raster::Sides::front, shade);
    r.triangle (left, high_right, high_left, Raster::Sides::front, shade);
    CHECK (static_cast<int> (pictureOf (r).getPixelAt (20, 15).getBlue()) == Approx (52).margin (3));
}

TEST_CASE ("finer samples smooth an edge", "[app][scene]")
{
    Raster r;
    r.begin (width, height, 2);
    quad (r, 0.0f, 0.0f, 2.0f * 10.5f, 2.0f * 30.0f, 1.0f, 0xffffffff);   // in samples, of which there are two per pixel
    const auto image = pictureOf (r);
    CHECK (image.getPixelAt (9, 10).getAlpha() == 255);
    CHECK (static_cast<int> (image.getPixelAt (10, 10).getAlpha()) == Approx (127).margin (1));
    CHECK (image.getPixelAt (11, 10).getAlpha() == 0);
}

TEST_CASE ("a triangle that is shaded by the pixel covers the same samples, with the colour of the pixel's middle, and shades each pixel once", "[app][scene]")
{
    rc::check ("random triangles", [] {
        const auto number = [] { return 0.1f * static_cast<float> (*rc::gen::inRange (-100, 900)); };
        std::array<Raster::Corner<1>, 3> all;
        for (auto& c : all)
            c = { number(), number(), 1.0f, { number() } };
        const auto draw = [&] (Raster& r, Raster::Shading shading, int& shaded) {
            r.begin (width, height, 2, shading);
            shaded = 0;
            r.triangle (all[0], all[1], all[2], Raster::Sides::both, [&] (const std::array<float, 1>& v) {
                ++shaded;
                return 0xff000000u | static_cast<std::uint32_t> (std::clamp (v[0], 0.0f, 255.0f));
            });
            return pictureOf (r);
        };
        Raster r;
        int by_sample = 0, by_pixel = 0, covered = 0;
        const auto one = draw (r, Raster::Shading::sample, by_sample), other = draw (r, Raster::Shading::pixel, by_pixel);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
            {
                const auto a = one.getPixelAt (x, y), b = other.getPixelAt (x, y);
                RC_ASSERT (static_cast<int> (a.getAlpha()) == static_cast<int> (b.getAlpha()));
                if (a.getAlpha() > 0) ++covered;
            }
        RC_ASSERT (by_pixel == covered);
        RC_ASSERT (by_sample >= by_pixel);
    });

    Raster r;
    r.begin (width, height, 2, Raster::Shading::pixel);
    const auto shade = [] (const std::array<float, 1>& v) { return 0xff000000u | static_cast<std::uint32_t> (v[0]); };
    const Raster::Corner<1> a { 0.0f, 0.0f, 1.0f, { 0.0f } }, b { 0.0f, 160.0f, 1.0f, { 0.0f } }, c { 160.0f, 0.0f, 1.0f, { 400.0f } };   // 5 per pixel
    r.triangle (a, b, c, Raster::Sides::both, shade);
    for (const int x : { 0, 7, 20 })
        CHECK (static_cast<int> (pictureOf (r).getPixelAt (x, 5).getBlue()) == Approx (5 * x + 2).margin (1));
}

TEST_CASE ("a ball is round and hides what is behind it", "[app][scene]")
{
    Camera camera;
    camera.setSize (width, height);
    camera.distance = 0.1;
    Raster r;
    r.begin (width, height, 1);
    const double radius = 8.0 / camera.scaleAt (camera.distance);
    r.ball (camera, camera.target, radius, [] (const std::array<float, 3>&) { return 0xff00ff00u; });
    CHECK (r.coverage() * width * height == Approx (3.14159 * 64.0).epsilon (0.05));
    const auto colour = [&r] (int x) { return pictureOf (r).getPixelAt (x, height / 2); };
    quad (r, 0.0f, 0.0f, 40.0f, 30.0f, static_cast<float> (camera.distance + 2.0 * radius), 0xff0000ff);
    CHECK (colour (width / 2) == juce::Colour (0xff00ff00));
    CHECK (colour (2) == juce::Colour (0xff0000ff));
    quad (r, 0.0f, 0.0f, 40.0f, 30.0f, static_cast<float> (camera.distance - 2.0 * radius), 0xffff0000);
    CHECK (colour (width / 2) == juce::Colour (0xffff0000));
}

namespace
{
using Corners = std::array<Vec3, 3>;

/// Where the ray through a place in the picture meets a triangle in front of the near plane, as shares of the triangle's corners.
std::optional<Vec3> meets (const Camera& camera, const Corners& t, double x, double y)
{
    const Vec3 ray = camera.ray ({ static_cast<float> (x), static_cast<float> (y) }), eye = camera.eye();
    Eigen::Matrix3d sides;
    sides << t[1] - t[0], t[2] - t[0], -ray;
    if (std::abs (sides.determinant()) < 1e-12) return std::nullopt;
    const Vec3 found = sides.inverse() * (eye - t[0]);
    const Vec3 shares (1.0 - found.x() - found.y(), found.x(), found.y());
    if (shares.minCoeff() < 0.0 || found.z() * ray.dot (camera.view()) <= camera.near()) return std::nullopt;
    return shares;
}
}   // namespace

TEST_CASE ("of a triangle that reaches behind the camera, the part in front of the camera is drawn", "[app][scene]")
{
    rc::check ("as rays from the eye meet it", [] {
        Camera camera;
        camera.setSize (width, height);
        camera.yaw = *rc::gen::inRange (-300, 300) / 100.0;
        camera.pitch = *rc::gen::inRange (-150, 150) / 100.0;
        camera.distance = 0.1;
        Corners corners;
        for (auto& p : corners)
        {
            const int x = *rc::gen::inRange (-300, 300), y = *rc::gen::inRange (-300, 300), z = *rc::gen::inRange (-300, 300);
            p = camera.eye() + 1e-3 * Vec3 (x, y, z);
        }
        Raster r;
        r.begin (width, height, 1);
        const auto made = [&] (std::size_t i) {
            std::array<float, 3> shares {};
            shares[i] = 1.0f;
            return r.corner<3> (camera.see (corners[i]), camera.near(), shares);
        };
        const auto shade = [] (const std::array<float, 3>& s) {
            const auto part = [] (float v) { return static_cast<std::uint32_t> (std::clamp (v, 0.0f, 1.0f) * 255.0f + 0.5f); };
            return 0xff000000u | part (s[0]) << 16 | part (s[1]) << 8 | part (s[2]);
        };
        r.triangle (made (0), made (1), made (2), Raster::Sides::both, shade);
        RC_ASSERT (r.count().all() == 1);
        const auto image = pictureOf (r);
        int wrong = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
            {
                const auto shares = meets (camera, corners, x + 0.5, y + 0.5);
                const auto colour = image.getPixelAt (x, y);
                const bool is_drawn = colour.getAlpha() > 0;
                if (is_drawn != shares.has_value()) ++wrong;
                if (! is_drawn || ! shares) continue;
                const Vec3 seen (colour.getRed(), colour.getGreen(), colour.getBlue());
                RC_ASSERT ((seen / 255.0 - *shares).cwiseAbs().maxCoeff() < 0.05);
            }
        RC_ASSERT (wrong <= 6);   // samples on an edge
    });
}
