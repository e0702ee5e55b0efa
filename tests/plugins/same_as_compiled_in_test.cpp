// SPDX-License-Identifier: MIT
// A node in a plugin has the same datasheet and gives the same bits as when it is compiled in. every_node_test.cpp examines the same
// nodes.
#include "load.hpp"
#include "support/rig.hpp"
#include "support/sketch.hpp"
#include "support/tested_types.hpp"

#include <catch2/catch.hpp>

#include <tactus/kit/geometry/nearest_triangle.hpp>
#include <tactus/node/datasheet_json.hpp>
#include <tactus/run/query_thread.hpp>

#include <dlfcn.h>

#include <cmath>

using namespace tactus;
using test::load;

namespace
{
bool isLoaded (const std::string& plugin)
{
    void* handle = ::dlopen (test::pluginFile (plugin).c_str(), RTLD_NOW | RTLD_NOLOAD);
    if (handle != nullptr) ::dlclose (handle);
    return handle != nullptr;
}

/// Compares the limits of the node types themselves, not as JSON shows them.
bool sameLimits (const Limits& a, const Limits& b) { return a.hard == b.hard && a.usual == b.usual && a.latch == b.latch; }

bool sameUnit (const UnitRule& a, const UnitRule& b) { return a.kind == b.kind && a.unit == b.unit && a.a == b.a && a.b == b.b && a.adds_up == b.adds_up; }

void checkPorts (const std::vector<PortSheet>& a, const std::vector<PortSheet>& b)
{
    REQUIRE (a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
    {
        INFO (a[i].id);
        CHECK (sameUnit (a[i].unit, b[i].unit));
        CHECK (sameLimits (a[i].limits, b[i].limits));
        CHECK (a[i].offset == b[i].offset);
        for (int k = 0; k < 3; ++k)
            CHECK ((a[i].initial[k] == b[i].initial[k] || (std::isnan (a[i].initial[k]) && std::isnan (b[i].initial[k]))));
    }
}

/// The outputs of a node while its inputs oscillate, each with its own phase.
std::vector<double> play (Rig& rig)
{
    std::vector<double> all;
    for (int k = 0; k < 2000; ++k)
    {
        const double t = k * 2.5e-4;
        for (std::size_t i = 0; i < rig.in.size(); ++i)
            rig.in[i] = 3e-3 * std::sin (20.0 * t + static_cast<double> (i)) - 1e-3;
        rig.tick();
        const auto now = rig.outs();
        all.insert (all.end(), now.begin(), now.end());
    }
    return all;
}
}   // namespace

TEST_CASE ("the datasheet of a node in a plugin equals that of the node compiled in", "[plugins]")
{
    const auto loaded = load ("five_nodes");
    CHECK (loaded.messages.empty());
    REQUIRE (loaded.types.size() == 5);
    for (const auto& type : loaded.types)
    {
        INFO (type.info.id);
        const auto* built_in = catalogue().find (type.info.id);
        REQUIRE (built_in);
        auto sheet = datasheetJson (type);
        CHECK (sheet["plugin"] == type.origin);
        sheet.erase ("plugin");
        CHECK (sheet == datasheetJson (*built_in));
        checkPorts (type.inputs, built_in->inputs);
        checkPorts (type.params, built_in->params);
        checkPorts (type.outputs, built_in->outputs);
        REQUIRE (type.settings.size() == built_in->settings.size());
        for (std::size_t i = 0; i < type.settings.size(); ++i)
        {
            CHECK (sameUnit (type.settings[i].unit, built_in->settings[i].unit));
            CHECK (sameUnit (type.settings[i].x_unit, built_in->settings[i].x_unit));
            CHECK (sameLimits (type.settings[i].limits, built_in->settings[i].limits));
            CHECK (type.settings[i].initial.index() == built_in->settings[i].initial.index());
        }
        CHECK (type.outputs_size == built_in->outputs_size);
        CHECK (type.outputs_align == built_in->outputs_align);
        CHECK (type.origin == test::pluginFile ("five_nodes").string());
        CHECK (built_in->origin.empty());

        CHECK (! type.peek == ! built_in->peek);
        CHECK (! type.delay == ! built_in->delay);
        CHECK (! type.cost == ! built_in->cost);
        CHECK (! type.problem == ! built_in->problem);
        CHECK (! type.warning == ! built_in->warning);
        CHECK (! type.prepare == ! built_in->prepare);
        CHECK (! type.update == ! built_in->update);
        CHECK (! type.adopt == ! built_in->adopt);
        CHECK (! type.serialize == ! built_in->serialize);
        CHECK (! type.claims == ! built_in->claims);
        CHECK (! type.bind == ! built_in->bind);
        CHECK (! type.missing == ! built_in->missing);
        CHECK (! type.effort == ! built_in->effort);
    }
}

TEST_CASE ("a node in a plugin gives the same bits as the node compiled in", "[plugins]")
{
    for (const auto& type : test::testedTypes())
    {
        INFO (type.info.id);
        Rig guest { type }, own { type.info.id };
        guest.prepare();
        own.prepare();
        for (auto* rig : { &guest, &own })
            rig->device->applied.force = Vec3 (0.1, 0.2, 0.3);
        CHECK (play (guest) == play (own));
        CHECK (guest.claims().passive == own.claims().passive);
        CHECK (guest.claims().stiffness == own.claims().stiffness);
        CHECK (guest.effort().force == own.effort().force);
    }
}

TEST_CASE ("settings, texts and lists reach a node in a plugin", "[plugins]")
{
    Rig rig { *test::testedTypes().find ("signal.expression") };
    rig.set ("inputs", 3.0).set ("text", std::string ("in0 * in1 + in2"));
    CHECK (rig.problem() == "");
    rig.prepare();
    rig.input ("in", 2.0, 0).input ("in", 3.0, 1).input ("in", 4.0, 2);
    rig.tick();
    CHECK (rig.out ("out") == 10.0);

    Rig wrong { *test::testedTypes().find ("signal.expression") }, same { "signal.expression" };
    for (auto* r : { &wrong, &same })
        r->set ("text", std::string ("in0 +"));
    CHECK_FALSE (wrong.problem().empty());
    CHECK (wrong.problem() == same.problem());
}

TEST_CASE ("a node in a plugin recognises the same surface, and continues its contact when it is replaced", "[plugins]")
{
    const auto& type = *test::testedTypes().find ("deform.surface");
    const auto& setting = type.settings.front();
    REQUIRE (setting.kind == SettingSheet::Kind::surface);
    const auto press = [] (Rig& rig, double x) {
        rig.input ("position", Vec3 (x, 0.0, -1e-3));
        rig.tick();
        return rig.vector ("force");
    };
    Rig old { type }, young { type };
    for (auto* rig : { &old, &young })
    {
        rig->set (setting.id, setting.initial);
        rig->prepare();
    }
    old.input ("position", Vec3 (0.0, 0.0, 1e-3));
    old.tick();
    press (old, 0.0);
    young.adopt (old);
    const Vec3 force = press (young, 2e-4);
    CHECK (force.x() != 0.0);   // a new contact would not be stretched sideways
    CHECK (force == press (old, 2e-4));
}

TEST_CASE ("a node in a plugin gets all of a surface: the weights of tools, and a mu that depends on depth", "[plugins]")
{
    const auto& type = *test::testedTypes().find ("deform.surface");
    const auto& setting = type.settings.front();
    Surface body = *std::get<std::shared_ptr<const Surface>> (setting.initial);
    body.curves.push_back (body.curves[0]);
    for (auto& curves : body.curves[1])
        for (auto& law : curves)
            law.a *= 5.0;
    body.weights = { { { 1.0, 0.0 } }, { { 0.25, 0.75 } } };
    body.mu = { { .curve = { { 0.0, 2e-3 }, { 0.05, 0.3 } } } };
    const auto surface = std::make_shared<const Surface> (std::move (body));

    const auto forces = [&] (const NodeType& of) {
        Rig rig { of };
        rig.set (setting.id, surface);
        rig.prepare();
        std::vector<Vec3> all;
        for (const double tool : { 0.0, 1.0 })
        {
            rig.input ("tool", tool);
            for (int k = 0; k < 40; ++k)
            {
                rig.input ("position", Vec3 (1e-4 * k, 0.0, 1e-3 - 1e-4 * k));
                rig.tick();
                all.push_back (rig.vector ("force"));
            }
        }
        return all;
    };
    const auto guest = forces (type);
    CHECK (guest == forces (*catalogue().find ("deform.surface")));
    CHECK (guest[39].norm() * 2.0 < guest[79].norm());   // the second tool is stiffer
    CHECK (guest[39].x() != 0.0);
}

TEST_CASE ("a node in a plugin borrows the host's index of a mesh and its thread for questions", "[plugins]")
{
    const auto& type = *test::testedTypes().find ("deform.surface");
    struct First final : NearestTriangle
    {
        int operator() (const Vec3&) const noexcept override { return 0; }
    };
    int built = 0;
    QueryThread thread;
    const Setup setup { .rate_hz = 1000.0,
                        .services = { .nearest_triangle =
                                          [&] (const std::shared_ptr<const Mesh>& mesh) {
                                              built += mesh->size();
                                              return std::make_unique<First>();
                                          },
                                      .answers = &thread } };
    const auto node = type.make();
    const auto ticks = std::ranges::find (type.settings, std::string_view ("search_ticks"), &SettingSheet::id);
    REQUIRE (ticks != type.settings.end());
    ticks->set (node.get(), 2.0);
    type.prepare (node.get(), setup);
    CHECK (built == 2);   // the triangles of the default surface
}

TEST_CASE ("a plugin written in C, or with larger or smaller structs, runs", "[plugins]")
{
    for (const std::string name : { "in_c", "grown", "small" })
    {
        INFO (name);
        const Catalogue types { load (name).types };
        const auto* type = types.find ("c.twice");
        REQUIRE (type);
        Rig rig { *type };
        rig.prepare();
        rig.input ("in", 21.0);
        rig.tick();
        CHECK (rig.out ("out") == 42.0);
    }
}

TEST_CASE ("a plugin is unloaded after its last type and its last node, and not before", "[plugins]")
{
    std::shared_ptr<void> node;
    {
        const Catalogue types { load ("throwing").types };
        node = types.find ("bad.throwing")->make();
    }
    CHECK (isLoaded ("throwing"));
    node.reset();
    CHECK_FALSE (isLoaded ("throwing"));
}

TEST_CASE ("a plan keeps the plugins that it uses, also after the catalogue has replaced them", "[plugins]")
{
    auto types = catalogue().with (load ("in_c").types);
    const auto* gain = types.find ("signal.gain");
    CHECK (gain == catalogue().find ("signal.gain"));   // the other types keep their addresses

    auto sketch = test::Sketch {}.node ("twice", "c.twice");
    auto compiled = compile (sketch.graph, types);
    REQUIRE (compiled.plan);
    types = types.with (load ("grown").types);
    CHECK (types.find ("c.twice")->origin == test::pluginFile ("grown").string());
    CHECK (isLoaded ("in_c"));
    {
        Engine engine { std::move (compiled.plan) };
        engine.tick();
    }
    CHECK_FALSE (isLoaded ("in_c"));
}

TEST_CASE ("a graph names the plugin that a missing node comes from", "[plugins]")
{
    auto sketch = test::Sketch {}.node ("twice", "c.twice").node ("other", "d.other");
    sketch.graph.extra["plugins"] = { { "c", "Nodes in C 1.2" } };
    const auto compiled = sketch.compile();
    REQUIRE (compiled.messages.size() == 2);
    CHECK (compiled.messages[0].id == "node/unknown_type");
    CHECK (compiled.messages[0].remedy.find ("install the plugin 'Nodes in C 1.2'") != std::string::npos);
    CHECK (compiled.messages[1].remedy.find ("tactus nodes") != std::string::npos);
    CHECK (compiled.plan);
}
