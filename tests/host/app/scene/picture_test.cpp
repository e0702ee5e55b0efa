// SPDX-License-Identifier: GPL-3.0-or-later
#include "preset_bodies.hpp"
#include "support/waiting.hpp"

#include <host/app/scene/overlay.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <iostream>
#include <numbers>

using namespace tactus;
using namespace tactus::host;
using host::test::bodiesIn;
using scene::Body;
using scene::PartValues;
using scene::SceneState;
using Kind = Appearance::Kind;

namespace
{
constexpr int width = 800, height = 600;

/// Draws scenes, and times them.
struct Studio
{
    scene::Scene scene;
    scene::Camera camera;
    scene::Raster raster;
    juce::Image image { juce::Image::ARGB, width, height, true };
    double took_s = 0.0;

    explicit Studio (std::vector<Body> bodies)
    {
        scene.setBodies (std::move (bodies));
        camera.setSize (width, height);
        camera.frame (scene.bounds());
    }

    void draw (const SceneState& now = {}, int fineness = 1)
    {
        const tactus::test::Stopwatch watch;
        raster.begin (width, height, fineness);
        scene.draw (raster, camera, scene::Paint (Theme::dark()), now);
        raster.write (image);
        took_s = watch.s();
    }

    juce::Colour at (const Vec3& p) const
    {
        const auto pixel = camera.pixel (p).roundToInt();
        return image.getPixelAt (pixel.x, pixel.y);
    }
};

void set (PartValues& values, std::string_view Appearance::*part, const Vec3& v) { values[scene::partNumber (part)] = v; }

/// A ball of 2 n^2 triangles with a radius of 40 mm.
Body ball (int n)
{
    auto mesh = std::make_shared<Mesh>();
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j < n; ++j)
        {
            const double polar = std::numbers::pi * i / n, turn = 2.0 * std::numbers::pi * j / n;
            mesh->points.push_back (0.04 * Vec3 (std::sin (polar) * std::cos (turn), std::sin (polar) * std::sin (turn), std::cos (polar)));
        }
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
        {
            const int next = (j + 1) % n, a = i * n + j, b = i * n + next, c = (i + 1) * n + j, d = (i + 1) * n + next;
            mesh->triangles.push_back ({ a, c, d });
            mesh->triangles.push_back ({ a, d, b });
        }
    auto surface = std::make_shared<Surface>();
    surface->mesh = mesh;
    Body body { .kind = Kind::body, .path = "ball", .role = "tool", .is_placed = true };
    body.surface = surface;
    return body;
}

Body plane()
{
    return { .kind = Kind::plane, .path = "plane", .role = "tool", .is_placed = true };
}

/// How much bluer than red a colour is: the depth is blue.
int blueness (juce::Colour c) { return static_cast<int> (c.getBlue()) - static_cast<int> (c.getRed()); }
}   // namespace

TEST_CASE ("a mesh of 100 000 triangles is drawn whole, and its far side is left out", "[app][scene]")
{
    Studio studio ({ ball (224) });
    REQUIRE (studio.scene.triangles() == 100352);
    studio.draw();   // warms up
    studio.draw();
    std::cout << "100352 triangles at 800 x 600: " << 1e3 * studio.took_s << " ms\n";
    const auto& count = studio.raster.count();
    CHECK (count.all() == 100352);
    CHECK (count.outside == 0);
    CHECK (count.turned_away > 40000);
    CHECK (count.drawn > 40000);
    // The ball fills its outline: nothing shows through.
    const double r = 0.04 * studio.camera.scaleAt (studio.camera.distance);
    CHECK (studio.raster.coverage() * width * height == Approx (std::numbers::pi * r * r).epsilon (0.06));
    CHECK (studio.at (studio.camera.target).getAlpha() == 255);
}

TEST_CASE ("a coarse cube stays when the camera comes close to one of its faces", "[app][scene]")
{
    auto mesh = std::make_shared<Mesh>();
    for (int i = 0; i < 8; ++i)
        mesh->points.push_back (0.05 * Vec3 (i % 2 == 0 ? -1.0 : 1.0, i / 2 % 2 == 0 ? -1.0 : 1.0, i / 4 == 0 ? -1.0 : 1.0));
    mesh->triangles = {
        { 0, 2, 1 },
        { 1, 2, 3 },
        { 4, 5, 6 },
        { 5, 7, 6 },
        { 0, 1, 4 },
        { 1, 5, 4 },
        { 2, 6, 3 },
        { 3, 6, 7 },
        { 0, 4, 2 },
        { 2, 4, 6 },
        { 1, 3, 5 },
        { 3, 7, 5 },
    };
    auto surface = std::make_shared<Surface>();
    surface->mesh = mesh;
    Body cube { .kind = Kind::body, .path = "cube", .role = "tool", .is_placed = true };
    cube.surface = surface;
    Studio studio ({ cube });
    studio.camera.target = { 0.0, 0.0, 0.05 };   // the middle of the upper face
    studio.camera.pitch = 0.3;                   // seen along the face, so that a part of it is behind the camera
    for (const double distance : { 0.03, 0.015, scene::Camera::nearest })
    {
        studio.camera.distance = distance;
        studio.draw();
        INFO (distance);
        CHECK (studio.at (studio.camera.target).getAlpha() == 255);
        CHECK (studio.image.getPixelAt (width / 2, height - 2).getAlpha() == 255);
        CHECK (studio.raster.coverage() > 0.5);
    }
}

TEST_CASE ("the liver at 800 x 600, with the time that a picture takes", "[app][scene]")
{
    Studio studio (bodiesIn ("liver"));
    SceneState now { .tools = { { "finger", { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 1.0 } } }, .live = { {} } };
    set (now.live[0], &Appearance::touch, { 0.0, 0.0, 0.004 });
    set (now.live[0], &Appearance::depth, { 0.004, 0.0, 0.0 });
    for (const int fineness : { 1, 2 })
    {
        std::vector<double> times;
        for (int i = 0; i < 9; ++i)
        {
            studio.draw (now, fineness);
            times.push_back (studio.took_s);
        }
        std::ranges::sort (times);
        std::cout << "liver at 800 x 600, " << fineness * fineness << " samples per pixel: " << 1e3 * times[4] << " ms\n";
    }
    CHECK (studio.raster.count().drawn > 300);
    CHECK (studio.raster.coverage() > 0.1);
}

TEST_CASE ("a mesh sinks and turns blue where the tool presses it", "[app][scene]")
{
    Studio studio ({ ball (60) });
    studio.camera.pitch = 1.0;
    const Vec3 top (0.0, 0.0, 0.04), side = 0.04 * Vec3 (0.8, 0.0, 0.6);
    studio.draw();
    const int before = blueness (studio.at (top)), far_before = blueness (studio.at (side));
    SceneState now { .tools = { { "tool", Vec3 (0.0, 0.0, 0.035), Vec3::Zero() } }, .live = { {} } };
    set (now.live[0], &Appearance::touch, top);
    set (now.live[0], &Appearance::depth, { 0.005, 0.0, 0.0 });
    now.tools[0].role = "other";
    CHECK (studio.scene.touches (now).empty());
    now.tools[0].role = "tool";
    studio.draw (now);
    const Vec3 beside = 0.04 * Vec3 (-0.1, 0.0, 0.995);
    CHECK (blueness (studio.at (beside - Vec3 (0.0, 0.0, 0.004))) > before + 30);
    CHECK (std::abs (blueness (studio.at (side)) - far_before) < 15);
}

TEST_CASE ("a plane is dented by a tool below it, and not by one above it", "[app][scene]")
{
    Studio studio ({ plane() });
    SceneState now { .tools = { { "tool", Vec3 (0.0, 0.0, -0.002), Vec3::Zero() } } };
    const auto touches = studio.scene.touches (now);
    REQUIRE (touches.size() == 1);
    CHECK (touches[0].at.isApprox (Vec3::Zero()));
    CHECK (touches[0].depth == Approx (0.002));
    now.tools[0].position.z() = 0.002;
    CHECK (studio.scene.touches (now).empty());
}

TEST_CASE ("friction drags the dent along: the tool is ahead of the point that it holds", "[app][scene]")
{
    Body drag { .kind = Kind::contact, .path = "drag", .role = "tool", .is_placed = true };
    Studio studio ({ plane(), drag });
    SceneState now { .tools = { { "tool", Vec3 (0.01, 0.0, -0.001), Vec3::Zero() } }, .live = { {}, {} } };
    set (now.live[1], &Appearance::stretch, { 0.0005, 0.0, 0.0 });
    const auto touches = studio.scene.touches (now);
    REQUIRE (touches.size() == 1);
    CHECK (touches[0].at.isApprox (Vec3 (0.0095, 0.0, 0.0)));
    CHECK (touches[0].tool.isApprox (Vec3 (0.01, 0.0, -0.001)));
}

TEST_CASE ("ridges show as bright and dark stripes of their period, and fade when they are finer than the pixels", "[app][scene]")
{
    const auto stripes = [] (double frequency) {
        Body ridges { .kind = Kind::ridges, .path = "ridges", .role = "tool", .is_placed = true };
        set (ridges.fixed, &Appearance::frequency, { frequency, 0.0, 0.0 });
        Studio studio ({ plane(), ridges });
        studio.camera.pitch = 1.5;
        studio.camera.yaw = 0.0;
        studio.camera.target = Vec3 (0.0, 0.003, 0.0);   // between two lines of the grid
        studio.draw();
        int least = 255, most = 0;
        for (int x = 410; x < 476; ++x)   // within one square of the grid
        {
            const int now = studio.image.getPixelAt (x, 300).getGreen();
            least = std::min (least, now);
            most = std::max (most, now);
        }
        return most - least;
    };
    CHECK (stripes (200.0) > 24);
    CHECK (stripes (20000.0) < stripes (200.0) / 2);
}

TEST_CASE ("a crack hangs under the blade, as long as the node says, along its edge", "[app][scene]")
{
    Body blade { .kind = Kind::blade, .path = "knife", .role = "tool" };
    set (blade.fixed, &Appearance::width, { 0.02, 0.0, 0.0 });
    Studio studio ({ blade });
    SceneState now { .tools = { { "tool", Vec3 (0.005, 0.0, -0.004), Vec3::Zero() } }, .live = { {} } };
    CHECK (studio.scene.cracks (now).empty());
    set (now.live[0], &Appearance::crack, { 0.003, 0.0, 0.0 });
    set (now.live[0], &Appearance::rotation, { 0.0, 0.0, std::numbers::pi / 2.0 });
    const auto cracks = studio.scene.cracks (now);
    REQUIRE (cracks.size() == 1);
    CHECK (cracks[0].down.isApprox (Vec3 (0.0, 0.0, -0.003)));
    CHECK ((cracks[0].end - cracks[0].begin).isApprox (Vec3 (0.0, 0.02, 0.0), 1e-9));
    const auto touches = studio.scene.touches (now);
    REQUIRE (touches.size() == 1);
    CHECK (touches[0].depth == Approx (0.001));   // the rest of the depth is the crack
}

TEST_CASE ("planes at one place are one sheet, with the dents of all tools", "[app][scene]")
{
    Studio one ({ plane() });
    one.draw();
    auto second = plane();
    second.role = "index";
    Studio two ({ plane(), second });
    SceneState now { .tools = { { "tool", Vec3 (-0.01, 0.0, -0.001), Vec3::Zero() }, { "index", Vec3 (0.01, 0.0, -0.001), Vec3::Zero() } } };
    two.draw();
    CHECK (two.raster.count().all() == one.raster.count().all());
    CHECK (two.scene.touches (now).size() == 2);
}

TEST_CASE ("many planes are drawn with fewer triangles each", "[app][scene]")
{
    std::vector<Body> bodies;
    for (int i = 0; i < 100; ++i)
    {
        bodies.push_back (plane());
        set (bodies.back().fixed, &Appearance::offset, { 1e-3 * i, 0.0, 0.0 });
    }
    Studio one ({ plane() }), many (bodies);
    one.draw();
    many.draw();
    CHECK (one.raster.count().all() == 8192);
    CHECK (many.raster.count().all() > 8192);
    CHECK (many.raster.count().all() <= 16384);
}

TEST_CASE ("a texture lies once on the plane of its tool", "[app][scene]")
{
    const auto pictureOf = [] (const std::vector<std::string>& roles) {
        auto wall = plane(), floor = plane();
        set (wall.fixed, &Appearance::normal, -Vec3::UnitX());   // towards the light
        set (wall.fixed, &Appearance::offset, { 0.02, 0.0, 0.0 });
        wall.role = "other";
        std::vector<Body> bodies { wall, floor };
        for (const auto& role : roles)
        {
            Body ridges { .kind = Kind::ridges, .path = "ridges", .role = role, .is_placed = true };
            set (ridges.fixed, &Appearance::frequency, { 150.0, 0.0, 0.0 });
            set (ridges.fixed, &Appearance::angle, { std::numbers::pi / 2.0, 0.0, 0.0 });
            bodies.push_back (ridges);
        }
        Studio studio (bodies);
        studio.draw();
        const auto steepest = [&] (const Vec3& from, const Vec3& step) {
            int most = 0;
            for (int i = 0; i < 5; ++i)
                most = std::max (most, std::abs (studio.at (from + i * step).getGreen() - studio.at (from + (i + 1) * step).getGreen()));
            return most;
        };
        const Vec3 step (0.0, 1.6e-3, 0.0);
        return std::pair (steepest ({ 0.015, 0.001, 0.0 }, step), steepest ({ -0.02, 0.001, 0.013 }, step));   // on the floor, on the wall
    };
    const auto none = pictureOf ({}), floor = pictureOf ({ "tool" }), twice = pictureOf ({ "tool", "tool" }), wall = pictureOf ({ "other" });
    CHECK (floor.first > none.first + 5);
    CHECK (floor.second == none.second);
    CHECK (twice == floor);
    CHECK (wall.first == none.first);
    CHECK (wall.second > none.second + 5);
}

TEST_CASE ("a tool that is far away has a short line to the plane or none", "[app][scene]")
{
    using scene::Overlay;
    const juce::Rectangle<float> area (width, height);
    scene::Camera camera;
    camera.setSize (width, height);
    const auto lineTo = [&] (const Vec3& p) { return Overlay::plumb (camera, area, { .role = "tool", .position = p }, plane()); };
    const auto near = lineTo ({ 0.0, 0.0, 0.01 });
    REQUIRE (near);
    CHECK (near->getLength() > 10.0f);
    const auto diagonal = std::hypot (static_cast<float> (width), static_cast<float> (height));
    constexpr double inf = std::numeric_limits<double>::infinity();
    for (const double far : { 0.1, 10.0, 1e6, 1e300, inf })
        for (const Vec3& way : { Vec3 (1, 0, 0.01), Vec3 (0, 1, 0.01), Vec3 (0, 0, 1), Vec3 (0, -1, 1), Vec3 (-1, 1, 1) })
        {
            const auto line = lineTo ({ way.x() == 0.0 ? 0.0 : way.x() * far, way.y() == 0.0 ? 0.0 : way.y() * far, way.z() * far });
            if (line) CHECK (line->getLength() <= diagonal);
            if (! std::isfinite (far)) CHECK_FALSE (line);
        }
}

TEST_CASE ("an arrow grows with its force up to a limit, and its number has a unit", "[app][scene]")
{
    using scene::Overlay;
    CHECK (Overlay::arrowLength (1.0, 600.0) == Approx (48.0));
    CHECK (Overlay::arrowLength (2.0, 600.0) > Overlay::arrowLength (1.0, 600.0));
    CHECK (Overlay::arrowLength (1e6, 600.0) < 300.0);
    CHECK (Overlay::forceText (1.2) == "1.20 N");
    CHECK (Overlay::forceText (0.0123) == "12.3 mN");
}
