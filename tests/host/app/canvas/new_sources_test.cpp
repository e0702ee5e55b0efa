// SPDX-License-Identifier: GPL-3.0-or-later
// New nodes that are wired into a param.
#include "host/app/support/canvas_rig.hpp"

#include "support/sketch.hpp"

#include <host/app/model/param_now.hpp>
#include <host/app/model/quantity_text.hpp>
#include <tactus/plan/values.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <host/app/inspector/rows.hpp>

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
