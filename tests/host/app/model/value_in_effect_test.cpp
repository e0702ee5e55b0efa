// SPDX-License-Identifier: GPL-3.0-or-later
// No edit of controls, names and copies changes a value that the graph runs with.
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/values.hpp"

#include <host/app/inspector/rows.hpp>
#include <host/app/model/controlled_param.hpp>
#include <host/app/model/param_value.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/value_in_effect.hpp>

#include <tactus/file/graph_file.hpp>

#include "support/sketch.hpp"

#include <catch2/catch.hpp>
#include <rapidcheck.h>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::test;

TEST_CASE ("the control of a parameter inside is that of the parameter which exposes it, and is released there", "[app][controls]")
{
    const auto read = readGraph (R"({ "format": "tactus-graph", "version": 1, "rate_hz": 1000,
      "nodes": { "weave": { "type": "graph:weave" } },
      "graphs": { "weave": { "nodes": { "warp": { "type": "graph:warp" } }, "expose": { "params": { "amplitude": "warp.amplitude" } } },
                  "warp": { "nodes": { "wave": { "type": "texture.grating", "params": { "amplitude": "400 mN" } } },
                            "expose": { "params": { "amplitude": "wave.amplitude", "angle": "wave.angle" } } } },
      "controls": { "size": { "value": 0.5, "to": { "weave/warp/wave.amplitude": [ "0 mN", "800 mN" ] } } } })");
    INFO (tactus::test::text (read.messages));
    REQUIRE_FALSE (hasErrors (read.messages));
    const auto param = controlOf (read.graph, "weave.amplitude");
    REQUIRE (param);
    CHECK (param->path == "weave/warp/wave.amplitude");
    CHECK (param->value == Approx (0.4));
    CHECK (controlOf (read.graph, "weave/warp.amplitude"));
    CHECK_FALSE (controlOf (read.graph, "weave/warp.angle"));
    CHECK_FALSE (controlOf (read.graph, "no.amplitude"));
    CHECK (removeTarget (read.graph, param->control, param->path, catalogue()));

    auto endless = read.graph;
    for (auto& [name, patch] : endless.graphs)
        if (name == "warp") patch.nodes.front().type = "graph:warp";   // its param amplitude is that of itself, inside
    endless.controls.clear();
    CHECK_FALSE (controlOf (endless, "weave.amplitude"));
}

namespace
{
/// Someone who adds, extends, names and removes controls, and copies, groups and renames nodes.
struct Editor
{
    CanvasRig rig;
    int named = 0;

    explicit Editor (const std::string& preset) : rig (CanvasRig::preset (preset)) {}

    Canvas& canvas() { return *rig.canvas; }
    Document& document() { return rig.document; }

    static int upTo (int n) { return *rc::gen::inRange (0, std::max (1, n)); }

    /// A param with one number, of a node on the canvas.
    std::optional<std::pair<std::string, FacePort>> someParam()
    {
        std::vector<std::pair<std::string, FacePort>> all;
        for (const auto& n : canvas().scene().nodes())
            for (const auto& p : n.face->params)
                if (p.sheet != nullptr && p.width == 1 && ! p.isChoice()) all.emplace_back (n.name, p);
        return all.empty() ? std::nullopt : std::optional (all[static_cast<std::size_t> (upTo (static_cast<int> (all.size())))]);
    }

    void selectSome()
    {
        Selection some;
        for (const auto& n : canvas().scene().nodes())
            if (upTo (2) == 0) some.insert (n.id);
        canvas().select (some);
    }

    std::string control()
    {
        const auto& all = document().graph().controls;
        return all.empty() ? std::string() : all[static_cast<std::size_t> (upTo (static_cast<int> (all.size())))].id;
    }

    std::string act()
    {
        const auto& g = document().graph();
        const auto param = someParam();
        switch (upTo (12))
        {
        case 0:
        case 1:
            if (param && ! controlOf (g, canvas().seen().address (param->first + '.' + param->second.id)))
                controlBy (document(), canvas().seen(), param->first, param->second, {}, catalogue());
            return "new control";
        case 2:
        case 3:
            if (const auto c = control(); param && ! c.empty() && ! controlOf (g, canvas().seen().address (param->first + '.' + param->second.id)))
                controlBy (document(), canvas().seen(), param->first, param->second, c, catalogue());
            return "extend a control";
        case 4:
            if (const auto c = control(); ! c.empty()) document().perform (removeControl (g, c, catalogue()));
            return "remove a control";
        case 5:
            if (param) release (document(), canvas().seen(), param->first, param->second, catalogue());
            return "release a param";
        case 6:
            selectSome();
            canvas().commands().duplicateSelection();
            return "duplicate";
        case 7:
            selectSome();
            canvas().commands().copySelection();
            canvas().commands().pasteText();
            return "copy and paste";
        case 8:
            if (param) document().perform (graph::RenameNode { canvas().patch(), param->first, "renamed_" + std::to_string (++named) });
            return "rename a node";
        case 9:
            selectSome();
            canvas().commands().groupSelection();
            return "group";
        case 10:
            for (const auto& n : canvas().scene().nodes())
                if (n.type.starts_with ("graph:"))
                {
                    canvas().enter (n);
                    return "enter";
                }
            return "nothing to enter";
        default:
            if (! canvas().breadcrumbs().empty()) canvas().leaveTo (0);
            return "leave";
        }
    }
};
}   // namespace

TEST_CASE ("no value in effect changes while controls are added, extended and removed and nodes are copied and renamed", "[app][controls]")
{
    CHECK (rc::check ([] {
        const char* presets[] { "layered_cloth", "bronze_bell", "two_fingers" };
        Editor editor (presets[Editor::upTo (3)]);
        for (int i = 0; i < 12; ++i)
        {
            const auto before = valuesInEffect (editor.document().graph());
            const auto action = editor.act();
            RC_LOG() << action << '\n';
            RC_ASSERT (changedValue (before, valuesInEffect (editor.document().graph())) == std::string());
        }
        // A copy in effect has the values of the original.
        editor.canvas().leaveTo (0);
        auto& g = editor.document().graph();
        const auto original = g.root.nodes[static_cast<std::size_t> (Editor::upTo (static_cast<int> (g.root.nodes.size())))];
        editor.canvas().select ({ original.id });
        editor.canvas().commands().duplicateSelection();
        RC_ASSERT (editor.canvas().selection().size() == 1u);
        const auto values = valuesInEffect (editor.document().graph());
        RC_ASSERT (valuesOf (values, *editor.canvas().selection().begin()) == valuesOf (values, original.id));
    }));
}

TEST_CASE ("a second parameter of a control keeps its value, wherever the control is", "[app][controls]")
{
    CHECK (rc::check ([] {
        const double at = *rc::gen::element (0.0, 0.1, 0.25, 0.5, 1.0 / 3.0, 0.9, 1.0);
        const double low = *rc::gen::element (-5.0, 0.0, 1.0), high = low + *rc::gen::element (1.0, 10.0);
        const double now = low + (high - low) * *rc::gen::element (-0.2, 0.0, 0.1, 0.5, 1.0, 1.7);
        const Limits limits { .hard = { low - 100.0, high + 100.0 }, .usual = { low, high } };
        const PortSheet sheet { Role::param, "k", UnitRule (unit::stiffness), {}, limits, {}, 1, false, 0, { low, 0.0, 0.0 } };
        const auto [from, to] = sweepThrough (Json (now), sheet, at);
        const double a = siOf (from, sheet), b = siOf (to, sheet);
        RC_ASSERT (a != b);
        RC_ASSERT (std::abs (a + at * (b - a) - now) < 1e-9 * (high - low));
        RC_ASSERT (limits.hard.contains (a));
        RC_ASSERT (limits.hard.contains (b));
    }));
}
