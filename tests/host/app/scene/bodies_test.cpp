// SPDX-License-Identifier: GPL-3.0-or-later
#include "preset_bodies.hpp"

#include <host/app/scene/scene.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <iterator>
#include <map>

using namespace tactus;
using namespace tactus::host;
using host::test::bodiesIn;
using scene::Body;
using Kind = Appearance::Kind;

namespace
{
std::vector<Body> ofKind (const std::vector<Body>& all, Kind kind)
{
    std::vector<Body> found;
    std::ranges::copy_if (all, std::back_inserter (found), [kind] (const Body& b) { return b.kind == kind; });
    return found;
}
}   // namespace

TEST_CASE ("a mesh is a body with its place and the ports that say where it is touched", "[app][scene]")
{
    const auto bodies = bodiesIn ("liver");
    REQUIRE (bodies.size() == 1);
    const auto& liver = bodies[0];
    CHECK (liver.kind == Kind::body);
    REQUIRE (liver.surface);
    CHECK (liver.surface->mesh->triangles.size() > 1000);
    CHECK (liver.number (&Appearance::scale, 0.0) == 1e-3);
    CHECK (liver.role == "finger");
    CHECK (liver.is_placed);
    CHECK (liver.ports[scene::partNumber (&Appearance::touch)] == "liver.contact");
    const auto ports = scene::portsOf (bodies, 32);
    CHECK (std::ranges::count (ports, "liver.depth") == 1);
    CHECK (std::ranges::count (ports, "liver.contact") == 1);
    CHECK (scene::portsOf (bodies, 2) == std::vector<std::string> { "liver.depth", "liver.tool" });   // what is more important, and what still fits
}

TEST_CASE ("a round tool has its radius and its middle, and a contact that sticks has a bound", "[app][scene]")
{
    auto bodies = bodiesIn ("liver");
    REQUIRE (bodies.front().radii == std::vector<double> { 8e-3, 2e-3 });
    const auto ports = scene::portsOf (bodies, 32);
    for (const auto* port : { "liver.position", "liver.normal", "liver.tool" })
        CHECK (std::ranges::count (ports, port) == 1);
    scene::Scene scene;
    scene.setBodies (bodies);
    std::map<std::string, double> values;
    const auto state = [&] {
        return scene::SceneState { .live = scene::liveOf (bodies, [&] (const std::string& component) -> std::optional<double> {
                                       const auto at = values.find (component);
                                       return at == values.end() ? std::nullopt : std::optional (at->second);
                                   }) };
    };
    CHECK (scene.roundTools (state()).empty());
    CHECK (scene.stuckBounds (state()).empty());
    values = { { "liver.position.x", 1e-3 }, { "liver.position.y", 0.0 }, { "liver.position.z", 7e-3 }, { "liver.tool", 0.25 } };
    auto tools = scene.roundTools (state());
    REQUIRE (tools.size() == 1);
    CHECK (tools[0].radius == Approx (0.75 * 8e-3 + 0.25 * 2e-3));
    CHECK (tools[0].centre == Vec3 (1e-3, 0.0, 7e-3));
    values["liver.tool"] = 9.0;   // beyond the last tool
    CHECK (scene.roundTools (state()).front().radius == 2e-3);
    CHECK (scene.stuckBounds (state()).empty());   // nothing is touched

    for (const auto* port : { "liver.contact", "liver.normal" })
        for (const auto* component : { ".x", ".y", ".z" })
            values[std::string (port) + component] = component == std::string (".z") ? 1.0 : 0.0;
    values["liver.depth"] = 2e-3;
    const auto bounds = scene.stuckBounds (state());
    REQUIRE (bounds.size() == 1);
    CHECK (bounds[0].radius == Approx (0.133 * 2e-3));   // mu times the depth
    CHECK (bounds[0].normal == Vec3::UnitZ());
    CHECK (bounds[0].centre == Vec3::UnitZ());
}

TEST_CASE ("a tool inside a closed mesh that does not feel it is told from one outside, and from one that is felt", "[app][scene]")
{
    auto ball = std::make_shared<Mesh>();   // of 40 mm, from the triangles of an octahedron, each split twice
    std::vector<std::array<Vec3, 3>> faces;
    for (const double x : { -1.0, 1.0 })
        for (const double y : { -1.0, 1.0 })
            for (const double z : { -1.0, 1.0 })
            {
                const Vec3 a = x * Vec3::UnitX(), b = y * Vec3::UnitY(), c = z * Vec3::UnitZ();
                faces.push_back (x * y * z > 0.0 ? std::array { a, b, c } : std::array { a, c, b });
            }
    for (int i = 0; i < 2; ++i)
        for (const auto& [a, b, c] : std::exchange (faces, {}))
        {
            const Vec3 ab = (a + b).normalized(), bc = (b + c).normalized(), ca = (c + a).normalized();
            for (const auto& f : { std::array { a, ab, ca }, std::array { ab, b, bc }, std::array { ca, bc, c }, std::array { ab, bc, ca } })
                faces.push_back (f);
        }
    const auto add = [&] (const std::array<Vec3, 3>& f) {
        const auto n = static_cast<int> (ball->points.size());
        for (const Vec3& p : f)
            ball->points.push_back (0.02 * p);
        ball->triangles.push_back ({ n, n + 1, n + 2 });
    };
    for (const auto& f : faces)
        add (f);
    auto open = std::make_shared<Mesh> (*ball);
    open->triangles.resize (open->triangles.size() / 2);

    const auto isUnfelt = [] (const std::shared_ptr<const Mesh>& mesh, const Vec3& tool, std::optional<double> depth) {
        auto surface = std::make_shared<Surface>();
        surface->mesh = mesh;
        scene::Scene scene;
        scene.setBodies ({ Body { .kind = Kind::body, .role = "finger", .surface = surface } });
        scene::SceneState state { .tools = { { .role = "finger", .position = tool } }, .live = { {} } };
        if (depth) state.live.front()[scene::partNumber (&Appearance::depth)] = Vec3 (*depth, 0.0, 0.0);
        return scene.hasUnfeltTool (state);
    };
    const Vec3 middle (1e-3, 2e-3, -3e-3);
    CHECK (isUnfelt (ball, middle, 0.0));
    CHECK_FALSE (isUnfelt (ball, middle, 2e-3));                   // felt
    CHECK_FALSE (isUnfelt (ball, middle, {}));                     // nothing runs
    CHECK_FALSE (isUnfelt (open, middle, 0.0));                    // a bowl has no inside
    CHECK_FALSE (isUnfelt (ball, 6.0 * middle, 0.0));              // outside, but within the box around it
    CHECK_FALSE (isUnfelt (ball, Vec3 (0.0, 0.0, 0.0199), 0.0));   // just below the surface, which may be rounder than the mesh
    CHECK (isUnfelt (ball, Vec3 (0.0, 0.0, 0.017), 0.0));
}

TEST_CASE ("ridges have a place only if the position of a tool reaches them", "[app][scene]")
{
    const auto wood = ofKind (bodiesIn ("notched_rail"), Kind::ridges);
    REQUIRE (wood.size() == 2);
    CHECK (wood[0].is_placed);
    CHECK (wood[0].number (&Appearance::frequency, 0.0) == 200.0);
    const auto threads = ofKind (bodiesIn ("scissors_cloth"), Kind::ridges);   // along the crack, not along the path of the hand
    REQUIRE (threads.size() == 1);
    CHECK_FALSE (threads[0].is_placed);
}

TEST_CASE ("a relief is found behind nodes that move the position", "[app][scene]")
{
    const auto grain = ofKind (bodiesIn ("pebbled_leather"), Kind::relief);
    REQUIRE (grain.size() == 1);
    CHECK (grain[0].is_placed);
    CHECK (grain[0].role == "stylus");
    REQUIRE (grain[0].relief.grid);
    CHECK (grain[0].relief.is_picture);
    CHECK (grain[0].relief.pitch == Approx (0.12e-3));
    CHECK (grain[0].relief.height == Approx (0.2e-3));
}

TEST_CASE ("each instance of a subgraph has its own bodies and its own tool", "[app][scene]")
{
    const auto planes = ofKind (bodiesIn ("two_fingers"), Kind::plane);
    REQUIRE (planes.size() == 2);
    CHECK (planes[0].path == "finger[0]/face");
    CHECK (planes[0].role == "thumb");
    CHECK (planes[1].role == "index");
}

TEST_CASE ("blades and scissors follow a tool through nodes that compute a depth or an angle", "[app][scene]")
{
    const std::map<std::string, Kind> cutting { { "potato_cut", Kind::blade }, { "liver_cut", Kind::blade }, { "scissors_cloth", Kind::scissors } };
    for (const auto& [preset, kind] : cutting)
    {
        INFO (preset);
        const auto found = ofKind (bodiesIn (preset), kind);
        REQUIRE (found.size() == 1);
        CHECK_FALSE (found[0].role.empty());
        CHECK_FALSE (found[0].ports[scene::partNumber (&Appearance::crack)].empty());
    }
}

TEST_CASE ("controls and knobs reach what a body looks like, and a bypassed node has no body", "[app][scene]")
{
    auto graph = host::test::presetGraph ("notched_rail");
    for (auto& n : graph.root.nodes)
    {
        if (n.name == "notches") n.params["spatial_frequency"] = 400.0;
        if (n.name == "rail") n.bypass = true;
    }
    const auto bodies = host::test::bodiesOf (graph);
    CHECK (ofKind (bodies, Kind::plane).empty());
    CHECK (ofKind (bodies, Kind::ridges)[0].number (&Appearance::frequency, 0.0) == 400.0);
}

TEST_CASE ("a wire to a param does not place a body, whichever row the param is", "[app][scene]")
{
    auto graph = host::test::presetGraph ("dry_wood");
    auto& wires = graph.root.wires;
    const auto drive = [&] (const std::string& node, const std::string& param, int component, const char* gain) {
        std::erase_if (wires, [&] (const graph::Wire& w) { return w.to.node == node && w.to.port == "position"; });
        graph::Wire w;
        w.from = { "hand", "position", -1, component };
        w.to = { node, param };
        w.gain = Json (gain);
        wires.push_back (std::move (w));
    };
    drive ("board", "normal", -1, "1 1/m");               // a vector, in the row where the inputs have the position
    drive ("grain", "spatial_frequency", 0, "1 1/m^2");   // in a row that the inputs do not have
    const auto bodies = host::test::bodiesOf (graph);
    for (const auto kind : { Kind::plane, Kind::ridges })
    {
        const auto found = ofKind (bodies, kind);
        REQUIRE (found.size() == 1);
        CHECK_FALSE (found[0].is_placed);
        CHECK (found[0].role == "stylus");
    }
}

TEST_CASE ("every part of an appearance is a row of the right size", "[nodes][contract]")
{
    int visible = 0;
    for (const auto& type : catalogue())
    {
        if (! type.appearance) continue;
        ++visible;
        for (const auto& part : appearance_parts)
        {
            const auto id = (*type.appearance).*part.row;
            if (id.empty()) continue;
            INFO (type.info.id << ": " << part.name);
            std::size_t width = 0;
            bool exists = false;
            for (const auto* rows : { &type.inputs, &type.params, &type.outputs })
                for (const auto& row : *rows)
                    if (row.id == id)
                    {
                        exists = true;
                        width = static_cast<std::size_t> (row.width);
                    }
            for (const auto& setting : type.settings)
                if (setting.id == id)
                {
                    exists = true;
                    if (setting.kind == SettingSheet::Kind::vector) width = 3;
                    if (setting.kind == SettingSheet::Kind::number) width = 1;
                }
            CHECK (exists);
            CHECK (width == part.width);
        }
    }
    CHECK (visible >= 9);
}
