// SPDX-License-Identifier: GPL-3.0-or-later
// New nodes that are wired into a param.
#include "host/app/support/canvas_rig.hpp"

#include "support/sketch.hpp"

#include <host/app/model/param_now.hpp>
#include <host/app/model/param_value.hpp>
#include <host/app/model/quantity_text.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/plan/values.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <host/app/inspector/rows.hpp>
#include <set>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using tactus::test::Sketch;

TEST_CASE ("W offers a new source for a param, which begins near the value that the param has", "[app][canvas][sources]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto before = rig.text();
    const auto count = rig.graph().root.nodes.size();
    const auto* drag = rig.graph().root.find ("drag");
    const auto mu = siOf (paramNow (rig.graph(), {}, *drag, *rig.node ("drag").face->find (Role::param, "mu")).value,
                          *rig.node ("drag").face->find (Role::param, "mu")->sheet);   // what its control sets
    rig.canvas->select ({ rig.node ("drag").id });
    rig.query = "mu lfo";
    rig.hand().key ("w");
    REQUIRE_FALSE (rig.choices.empty());
    CHECK (rig.choices.front().name.find ("-> drag.mu") != std::string::npos);
    REQUIRE (rig.graph().root.nodes.size() == count + 1);
    const auto& lfo = rig.graph().root.nodes.back();
    CHECK (lfo.type == "signal.lfo");
    CHECK (rig.hasWire (lfo.name + ".out -> drag.mu"));
    CHECK (lfo.params["offset"].get<double>() == Approx (mu));
    CHECK (lfo.params["amplitude"].get<double>() == Approx (0.1 * mu));
    CHECK (compile (rig.graph(), catalogue()).plan != nullptr);
    rig.document.undo();
    CHECK (rig.text() == before);   // one step

    rig.canvas->select ({ rig.node ("drag").id });
    rig.query = "d_max constant";   // in the unit in which the value is written
    rig.hand().key ("w");
    const auto& constant = rig.graph().root.nodes.back();
    REQUIRE (constant.type == "signal.constant");
    CHECK (constant.params["value"] == rig.graph().root.find ("drag")->params["d_max"]);
    rig.document.undo();

    rig.canvas->select ({ rig.node ("drag").id });
    rig.choice = 1000000;
    rig.query = "load lfo";   // a choice takes no wire
    rig.hand().key ("w");
    for (const auto& c : rig.choices)
        CHECK_FALSE (c.type.ends_with ("drag.load"));
}

TEST_CASE ("a new oscillator stays in the hard range of each param of the catalogue, and near its value", "[app][canvas][sources]")
{
    for (const auto& type : catalogue())
    {
        INFO (type.info.id);
        const auto g = Sketch {}.node ("driven", std::string (type.info.id)).graph;
        const auto face = faceOf (g, g.root, g.root.nodes[0], catalogue());
        for (const auto& p : face.params)
        {
            if (p.isChoice() || p.width != 1) continue;
            INFO (p.id);
            CanvasRig rig { g };
            rig.canvas->commands().addNodeAt ("signal.lfo", { { 0.0f, 0.0f }, PortId { rig.node ("driven").id, Role::param, p.id } });
            REQUIRE (rig.graph().root.nodes.size() == 2);
            const auto& sheet = *p.sheet;
            const auto& lfo = rig.graph().root.nodes[1].params;
            const double now = siOf (paramNow (g, {}, g.root.nodes[0], p).value, sheet);
            const double offset = plan::readNumber (lfo["offset"])->value, amplitude = plan::readNumber (lfo["amplitude"])->value;
            const double slack = 0.01 * amplitude;   // of rounding
            CHECK (amplitude > 0.0);
            CHECK (offset - amplitude >= sheet.limits.hard.min - slack);
            CHECK (offset + amplitude <= sheet.limits.hard.max + slack);
            CHECK (std::abs (offset - now) <= amplitude + slack);
            if (now != 0.0) CHECK (amplitude <= 0.1 * std::abs (now) + slack);
            CHECK (rig.document.history().position() == 1);
        }
    }
}

TEST_CASE ("a drag of a source by 200 pixels covers the usual range of the param that it is wired to", "[app][canvas][sources]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    for (const char* param : { "mu", "d_max" })
    {
        INFO (param);
        rig.canvas->select ({ rig.node ("drag").id });
        rig.query = std::string (param) + " lfo";
        rig.hand().key ("w");
        const auto lfo = rig.graph().root.nodes.back().name;
        REQUIRE (rig.hasWire (lfo + ".out -> drag." + param));
        const auto usual = rig.node ("drag").face->find (Role::param, param)->sheet->limits.usual;
        const auto si = [&] (const char* id) { return plan::readNumber (rig.graph().root.find (lfo)->params.at (id))->value; };
        for (const char* id : { "offset", "amplitude" })
        {
            INFO (id);
            const double before = si (id);
            const auto at = rig.value (lfo, id);
            rig.hand().drag (at, at.translated (40.0f, 0.0f));
            const double ratio = std::pow (usual.max / usual.min, 0.2);   // of a range of decades, which a drag scales through
            const double wanted = usual.min > 0.0 && usual.max / usual.min >= 100.0 ? before * ratio : before + 0.2 * (usual.max - usual.min);
            CHECK (si (id) == Approx (wanted).epsilon (0.02));
            rig.document.undo();
        }
        rig.document.undo();
    }
}

TEST_CASE ("a drag of a number with a unit whose range nothing tells is relative to the number", "[app][canvas][sources]")
{
    Sketch s;
    s.node ("tremble", "signal.lfo", { { "offset", "1 mm" }, { "amplitude", "0.1 mm" } }).node ("touch", "contact.window");
    CanvasRig rig { s.wire ("tremble.out -> touch.depth").graph };
    const auto at = rig.value ("tremble", "offset");
    rig.hand().drag (at, at.translated (50.0f, 0.0f));
    CHECK (rig.graph().root.find ("tremble")->params["offset"] == "1.5 mm");
}

TEST_CASE ("a new control of a source covers the usual range of the param that it is wired to", "[app][controls][sources]")
{
    const auto g = Sketch {}.node ("shake", "signal.lfo", { { "offset", 0.4 } }).node ("drag", "friction.elasto_plastic").wire ("shake.out -> drag.mu").graph;
    Document document (g);
    const auto face = faceOf (g, g.root, g.root.nodes[0], catalogue());
    REQUIRE (controlBy (document, {}, "shake", *face.find (Role::param, "offset"), {}, catalogue()));
    const auto usual = faceOf (g, g.root, g.root.nodes[1], catalogue()).find (Role::param, "mu")->sheet->limits.usual;
    const auto& to = document.graph().controls.front().to.front();
    CHECK (plan::readNumber (to.low)->value == Approx (usual.min));
    CHECK (plan::readNumber (to.high)->value == Approx (usual.max));
}

TEST_CASE ("a modulator that is wired to a param moves it around its value, with a depth that is the gain of the wire", "[app][canvas][sources]")
{
    for (const auto& [source, port, of_one] : { std::tuple { "signal.lfo", "out", 1.0 }, std::tuple { "signal.envelope", "out", 1.0 },
                                                std::tuple { "signal.noise", "out", 1.0 }, std::tuple { "motion.velocity", "speed", 10.0 } })
        for (const auto& type : catalogue())
        {
            INFO (source << " -> " << type.info.id);
            const auto g = Sketch {}.node ("driven", std::string (type.info.id)).node ("source", source).graph;
            const auto face = faceOf (g, g.root, g.root.nodes[0], catalogue());
            for (const auto& p : face.params)
            {
                if (p.isChoice() || p.width != 1) continue;
                INFO (p.id);
                CanvasRig rig { g };
                const auto& scene = rig.canvas->scene();
                const auto from = scene.findPort ({ rig.node ("source").id, Role::output, port });
                const auto to = scene.findPort ({ rig.node ("driven").id, Role::param, p.id });
                REQUIRE (from);
                REQUIRE (to);
                rig.canvas->commands().join (from, to);
                REQUIRE (rig.graph().root.wires.size() == 1);
                const auto& wire = rig.graph().root.wires[0];
                CHECK (wire.add);
                CHECK (rig.graph().root.find ("driven")->params == g.root.nodes[0].params);
                const auto gain = plan::readNumber (wire.gain);
                REQUIRE (gain);
                const auto& sheet = *p.sheet;
                const double now = siOf (paramNow (g, {}, g.root.nodes[0], p).value, sheet), depth = gain->value / of_one;
                CHECK (depth > 0.0);
                if (now != 0.0) CHECK (depth == Approx (0.1 * std::abs (now)).epsilon (0.02));
                const auto compiled = compile (rig.graph(), catalogue());
                for (const auto& m : compiled.messages)
                {
                    INFO (m.where << ": " << m.text);
                    CHECK (m.id.find ("unit") == std::string::npos);
                }
                CHECK (writeGraph (readGraph (rig.text()).graph) == rig.text());
                CHECK (addedTo (rig.graph().root, "driven", p).isNotEmpty());
                rig.document.undo();
                CHECK (rig.graph().root.wires.empty());
            }
        }
}

TEST_CASE ("a modulator of a param brings no error, whether the datasheet, a value or a wire decides the unit of the param", "[app][canvas][sources]")
{
    const auto errorsOf = [] (const graph::Graph& g) {
        std::multiset<std::string> all;
        for (const auto& m : problemsOf (g, catalogue()))
            if (m.severity == Message::Severity::error) all.insert (m.id + ' ' + m.where);
        return all;
    };
    const auto modulate = [&] (const graph::Graph& g, const std::string& node, const std::string& param) {
        const auto before = errorsOf (g);
        for (const char* type : { "signal.lfo", "signal.envelope", "signal.noise", "motion.velocity" })
        {
            INFO (type << " -> " << node << '.' << param);
            CanvasRig rig { g };
            rig.canvas->commands().addModulator (node, param, type);
            CHECK (std::ranges::count_if (rig.graph().root.wires, &graph::Wire::add) == 1);
            CHECK (errorsOf (rig.graph()) == before);
        }
    };
    for (const auto& type : catalogue())
    {
        const auto g = Sketch {}.node ("driven", std::string (type.info.id)).graph;
        for (const auto& p : faceOf (g, g.root, g.root.nodes[0], catalogue()).params)
        {
            if (p.isChoice() || p.width != 1) continue;
            INFO (type.info.id);
            auto valued = g;
            if (p.unit.kind != UnitRule::Kind::fixed) valued.root.nodes[0].params[baseOf (p.id)] = *withValue (valued.root.nodes[0], p, Json ("0.5 N"));
            modulate (valued, "driven", p.id);
        }
    }

    Sketch wired;
    wired.node ("wall", "deform.plane").node ("slow", "signal.slew").node ("level", "signal.constant").node ("up", "vector.join");
    wired.node ("motor", "device.force").wire ("wall.resistance -> slow.in").wire ("level.out -> up.z").wire ("up.out -> motor.force");
    modulate (wired.graph, "slow", "rate");   // N/s
    modulate (wired.graph, "level", "value");
}

TEST_CASE ("a modulator with an amplitude keeps its unit, and a second wire replaces nothing that is set", "[app][canvas][sources]")
{
    Sketch s;
    s.node ("drag", "friction.elasto_plastic").node ("shake", "signal.lfo", { { "amplitude", 4 } }).node ("level", "signal.constant");
    s.wire ("level.out -> drag.d_max");
    CanvasRig rig { s.graph };
    const auto join = [&] (const char* param) {
        rig.canvas->commands().join (rig.canvas->scene().findPort ({ rig.node ("shake").id, Role::output, "out" }),
                                     rig.canvas->scene().findPort ({ rig.node ("drag").id, Role::param, param }));
        return rig.graph().root.wires.back();
    };
    const auto mu = join ("mu");
    CHECK (mu.add);
    const auto* sheet = rig.node ("drag").face->find (Role::param, "mu")->sheet;
    CHECK (plan::readNumber (mu.gain)->value == Approx (0.1 * sheet->initial[0] / 4.0).epsilon (0.02));
    const auto d_max = join ("d_max");   // a wire sets it, which the new one replaces
    CHECK_FALSE (d_max.add);
    CHECK (rig.graph().root.wires.size() == 2);
}

TEST_CASE ("a speed can be drawn to any number that no wire sets, and what is refused for another output names the units", "[app][canvas][sources]")
{
    Sketch s;
    s.node ("drag", "friction.elasto_plastic").node ("speed", "motion.velocity").node ("level", "signal.constant").node ("hand", "device.position");
    s.wire ("level.out -> drag.d_max");
    CanvasRig rig { s.graph };
    const auto port = [&] (const char* node, Role role, const char* id) { return rig.canvas->scene().findPort ({ rig.node (node).id, role, id }); };
    const auto may = [&] (const char* node, const char* out, Role role, const char* to, graph::Id replaced = 0) {
        return rig.canvas->commands().mayJoin (port (node, Role::output, out), port ("drag", role, to), replaced).has_value();
    };
    CHECK (may ("speed", "speed", Role::param, "mu"));
    CHECK (may ("speed", "speed", Role::param, "break_away"));
    CHECK_FALSE (may ("speed", "speed", Role::param, "d_max"));                              // a wire sets it
    CHECK_FALSE (may ("speed", "speed", Role::param, "mu", rig.graph().root.wires[0].id));   // a moved wire keeps its gain
    CHECK_FALSE (may ("hand", "position", Role::param, "mu"));
    CHECK_FALSE (may ("speed", "speed", Role::input, "normal_force"));
}
