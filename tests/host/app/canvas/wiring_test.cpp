// SPDX-License-Identifier: GPL-3.0-or-later
// Wires that are drawn, dropped, moved and removed with the mouse, and nodes that are inserted into them.
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/desk_stage.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/plan/compile.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using host::test::DeskStage;
using host::test::Hand;
using host::test::latestStep;
using host::test::OnStage;

TEST_CASE ("a wire can be drawn from an output to a matching input, or from the input to the output", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto before = rig.text();
    rig.hand().drag (rig.port ("drag", Role::output, "deflection"), rig.port ("grain", Role::input, "position"));
    // The input takes one wire, so the new one replaces the wire from the hand.
    CHECK (rig.hasWire ("drag.deflection -> grain.position"));
    CHECK_FALSE (rig.hasWire ("hand.position -> grain.position"));
    rig.hand().key ("ctrl + z");
    CHECK (rig.text() == before);

    // Drawing from the input gives the same result.
    rig.hand().drag (rig.port ("grain", Role::input, "position"), rig.port ("drag", Role::output, "deflection"));
    CHECK (rig.hasWire ("drag.deflection -> grain.position"));
}

TEST_CASE ("a step of wires names all of them, also those that come back by undo", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.hand().drag (rig.port ("drag", Role::output, "deflection"), rig.port ("grain", Role::input, "position"));
    CHECK (latestStep (rig.document) == "drag.deflection -> grain.position in place of hand.position -> grain.position");
    const auto add = [] (const std::string& wire) { return graph::Command (graph::AddWire { "", *graph::parseWire (wire) }); };
    REQUIRE (rig.document.perform (graph::Batch { "connect", { add ("drag.force -> motor.force"), add ("grain.force -> motor.force") } }));
    CHECK (latestStep (rig.document) == "drag.force -> motor.force, grain.force -> motor.force");
    graph::Batch both { "delete", {} };
    for (const auto& w : rig.graph().root.wires)
        if (w.from.port == "force" && w.to.node == "motor" && w.from.node != "board") both.commands.push_back (graph::RemoveWire { "", w.id });
    REQUIRE (rig.document.perform (both));
    CHECK (latestStep (rig.document) == "delete grain.force -> motor.force, drag.force -> motor.force");
}

TEST_CASE ("a wire that is dropped on a node goes to the first port that fits, best one without a wire", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto body = [&] (const std::string& name) {
        const auto& n = rig.node (name);
        return rig.canvas->view().toPixels (n.bounds().getCentre().withY (n.bounds().getY() + 8.0f));   // its header has no port
    };
    rig.hand().drag (rig.port ("drag", Role::output, "force"), body ("grain_felt"));
    CHECK (rig.hasWire ("drag.force -> grain_felt.in"));
    const auto before = rig.text();
    rig.hand().drag (rig.port ("board", Role::output, "depth"), body ("motor"));   // nothing fits
    CHECK (rig.text() == before);
    rig.hand().drag (rig.port ("drag", Role::output, "force"), body ("motor"));   // forces add up
    CHECK (rig.hasWire ("drag.force -> motor.force"));
    CHECK (rig.hasWire ("board.force -> motor.force"));
}

TEST_CASE ("forces into one input add up", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto wires = rig.graph().root.wires.size();
    rig.hand().drag (rig.port ("grain", Role::output, "force"), rig.port ("motor", Role::input, "force"));
    CHECK (rig.graph().root.wires.size() == wires + 1);
}

TEST_CASE ("a wire that does not fit shows the reason and is not created", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto before = rig.text();
    auto hand = rig.hand();
    hand.press (rig.port ("hand", Role::output, "position"));
    hand.dragTo (rig.port ("motor", Role::input, "force"));
    CHECK (rig.hint.contains ("Length (m) cannot drive force (N)"));
    REQUIRE (rig.canvas->highlighted().fits);
    const auto& drag = rig.node ("drag");
    CHECK (rig.canvas->highlighted().fits (drag, *drag.face->find (Role::input, "position")));
    CHECK_FALSE (rig.canvas->highlighted().fits (drag, *drag.face->find (Role::input, "normal_force")));
    hand.release (rig.port ("motor", Role::input, "force"));
    CHECK (rig.text() == before);
    CHECK_FALSE (rig.canvas->highlighted().fits);
    CHECK (rig.hint.startsWith ("motor.force: Length (m)"));   // stays after the drop
}

TEST_CASE ("connecting a vector to a scalar asks for the component", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.choice = 2;
    rig.hand().drag (rig.port ("board", Role::output, "force"), rig.port ("drag", Role::input, "normal_force"));
    REQUIRE (rig.choices.size() == 3);
    CHECK (rig.choices[2].type == "board.force.z");
    CHECK (rig.hasWire ("board.force.z -> drag.normal_force"));
    CHECK (rig.hasWire ("board.resistance -> drag.normal_force"));   // forces add up

    // A scalar dropped on a vector input is wired to one component, and the vector that was wired there stays.
    rig.hand().drag (rig.port ("board", Role::output, "resistance"), rig.port ("motor", Role::input, "force"));
    CHECK (rig.hasWire ("board.resistance -> motor.force.z"));
    CHECK (rig.hasWire ("drag.force -> motor.force"));
}

TEST_CASE ("dropping a wire on empty canvas requests a node, which is then connected", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.hand().drag (rig.port ("hand", Role::output, "position"), rig.nowhere());
    REQUIRE (rig.request);
    REQUIRE (rig.request->start);
    CHECK (rig.request->start->port == "position");
    rig.canvas->commands().addNodeAt ("texture.grating", *rig.request);
    CHECK (rig.hasWire ("hand.position -> grating.position"));
    CHECK (rig.document.history().names().size() == 1);   // one step
}

TEST_CASE ("a node that is dropped from an input ends where the wire was dropped", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto drop = rig.canvas->view().toPixels (rig.canvas->scene().bounds().getTopLeft()).translated (-20.0f, -40.0f);
    rig.hand().drag (rig.port ("grain", Role::input, "position"), drop);
    REQUIRE (rig.request);
    rig.canvas->commands().addNodeAt ("device.position", *rig.request);
    const auto made = rig.canvas->scene().nodes().back().bounds();
    CHECK (std::abs (made.getRight() - rig.request->at.x) <= Box::grid);
    CHECK (std::abs (made.getY() - rig.request->at.y) <= Box::grid);
    CHECK (rig.document.history().names().size() == 1);
}

TEST_CASE ("a node that is dropped from a position or a resistance gets its other obvious wires in the same step", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto before = rig.text();
    const auto [node, port, type] =
        GENERATE (std::tuple { "hand", "position", "friction.anisotropic" }, std::tuple { "board", "resistance", "friction.anisotropic" },
                  std::tuple { "hand", "position", "texture.height_map" }, std::tuple { "board", "resistance", "texture.noise" },
                  std::tuple { "hand", "position", "vector.length" });
    CAPTURE (node, port, type);
    rig.hand().drag (rig.port (node, Role::output, port), rig.nowhere());
    REQUIRE (rig.request);
    rig.canvas->commands().addNodeAt (type, *rig.request);
    CHECK (rig.document.history().names().size() == 1);
    if (type == std::string ("friction.anisotropic"))
    {
        CHECK (rig.hasWire ("hand.position -> anisotropic.position"));
        CHECK (rig.hasWire ("board.resistance -> anisotropic.normal_force"));
        CHECK (rig.hasWire ("anisotropic.force -> motor.force"));
    }
    if (type == std::string ("texture.height_map"))
    {
        CHECK (rig.hasWire ("touch.gain -> height_map_felt.gain"));   // not in the air
        CHECK (rig.hasWire ("height_map_felt.out -> motor.force"));
    }
    if (type == std::string ("texture.noise"))
    {
        CHECK (rig.hasWire ("hand.position -> velocity.position"));
        CHECK (rig.hasWire ("velocity.speed -> noise.speed"));
        CHECK (rig.hasWire ("noise_felt.out -> motor.force.z"));
    }
    if (type == std::string ("vector.length")) CHECK (rig.graph().root.wires.size() == 11);   // nothing about it is obvious
    rig.hand().key ("ctrl + z");
    CHECK (rig.text() == before);
}

TEST_CASE ("a node can be inserted into a wire", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    bool is_new = false;   // a new node covers no other one; a dragged one stays where it is dropped
    SECTION ("by double-clicking the wire")
    {
        is_new = true;
        rig.hand().doubleClick (rig.middleOf ("touch.gain -> grain_felt.gain"));
        REQUIRE (rig.request);
        REQUIRE (rig.request->wire != 0);
        rig.request->at = rig.node ("grain_felt").at;   // as on a short wire
        rig.canvas->commands().addNodeAt ("signal.slew", *rig.request);
    }
    SECTION ("by dropping a node on the wire")
    {
        rig.canvas->commands().addNodeAt ("signal.slew", { rig.canvas->view().toCanvas (rig.nowhere()) });
        rig.hand().drag (rig.title ("slew"), rig.middleOf ("touch.gain -> grain_felt.gain"));
    }
    const auto& slew = rig.node ("slew");
    const auto place = [] (const SceneNode& node) { return juce::Rectangle<float> (node.at.x, node.at.y, node.box.width, node.box.height); };
    for (const auto& other : rig.canvas->scene().nodes())
        if (is_new && other.name != "slew") CHECK_FALSE (place (other).intersects (place (slew)));
    const auto in = slew.face->inputs.front().id, out = slew.face->outputs.front().id;
    CHECK (rig.hasWire ("touch.gain -> slew." + in));
    CHECK (rig.hasWire ("slew." + out + " -> grain_felt.gain"));
    CHECK_FALSE (rig.hasWire ("touch.gain -> grain_felt.gain"));

    // Deleting the node reconnects the wire.
    rig.hand().click (rig.title ("slew"));
    rig.hand().key ("backspace");
    CHECK (rig.hasWire ("touch.gain -> grain_felt.gain"));
}

TEST_CASE ("a Scale that is inserted before another one carries newtons, and deleting it joins the wire again", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto* wire = "grain.force -> grain_felt.in";
    SECTION ("by double-clicking the wire")
    {
        rig.hand().doubleClick (rig.middleOf (wire));
        REQUIRE (rig.request);
        rig.canvas->commands().addNodeAt ("vector.scale", *rig.request);
    }
    SECTION ("by dropping a node on the wire")
    {
        rig.canvas->commands().addNodeAt ("vector.scale", { rig.canvas->view().toCanvas (rig.nowhere()) });
        rig.hand().drag (rig.title ("scale"), rig.middleOf (wire));
    }
    REQUIRE (rig.hasWire ("scale.out -> grain_felt.in"));
    for (const auto& w : rig.canvas->scene().wires())
        if (w.text == "scale.out -> grain_felt.in") CHECK (w.quantity == Quantity::force);
    const auto& scale = rig.node ("scale");
    CHECK (scale.quantityOf (scale.face->outputs.front()) == Quantity::force);
    rig.hand().click (rig.title ("scale"));
    rig.hand().key ("delete");
    CHECK (rig.hasWire (wire));
    CHECK_FALSE (hasErrors (compile (rig.graph(), catalogue()).messages));
}

TEST_CASE ("shift-dragging moves a wire to another input or removes it", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto shift = Hand::left (juce::ModifierKeys::shiftModifier);
    rig.hand().drag (rig.port ("grain", Role::input, "position"), rig.nowhere(), shift);
    CHECK_FALSE (rig.hasWire ("hand.position -> grain.position"));
    CHECK_FALSE (rig.request);
    rig.hand().drag (rig.port ("board", Role::input, "position"), rig.port ("grain", Role::input, "position"), shift);
    CHECK (rig.hasWire ("hand.position -> grain.position"));
    CHECK_FALSE (rig.hasWire ("hand.position -> board.position"));
}

TEST_CASE ("moving a wire to another port is one step, and the history names wires and nodes", "[app][undo]")
{
    DeskStage w ("layered_cloth.json", 1600, 900);
    auto& canvas = w.canvas;
    auto& document = w.document;
    canvas.frameAll();
    const auto port = [&] (const std::string& node, Role role, const std::string& id) {
        for (const auto& n : canvas.scene().nodes())
            if (n.name == node) return w.stage->getLocalPoint (&canvas, canvas.view().toPixels (n.placeOf (*n.box.find (role, id))));
        FAIL ("no node " << node);
        return juce::Point<float>();
    };
    const auto texts = [&] {
        std::vector<std::string> all;
        for (const auto& wire : canvas.scene().wires())
            all.push_back (wire.text);
        return all;
    };
    const auto before = writeGraph (w.graph());
    const auto position = document.history().position();
    w.stage->drag (port ("table", Role::input, "position"), port ("threads", Role::input, "position"), juce::ModifierKeys::leftButtonModifier,
                   juce::ModifierKeys::shiftModifier);
    OnStage::settle();
    CHECK (document.history().position() <= position + 1);
    w.stage->drag (port ("drag", Role::input, "position"), port ("table", Role::input, "position"), juce::ModifierKeys::leftButtonModifier,
                   juce::ModifierKeys::shiftModifier);
    OnStage::settle();
    CHECK (std::ranges::count (texts(), "hand.position -> drag.position") == 0);
    CHECK (std::ranges::count (texts(), "hand.position -> table.position") == 1);
    CHECK (latestStep (document) == "re-plug wire hand.position -> table.position in place of hand.position -> drag.position");
    document.goTo (position);
    CHECK (writeGraph (w.graph()) == before);

    // Back where it was: not a step.
    w.stage->drag (port ("drag", Role::input, "position"), port ("drag", Role::input, "position").translated (2.0f, 2.0f),
                   juce::ModifierKeys::leftButtonModifier, juce::ModifierKeys::shiftModifier);
    CHECK (document.history().position() == position);

    canvas.select ({ w.graph().root.find ("touch")->id });
    w.key ("delete");
    CHECK (latestStep (document) == "delete touch");
    w.key ("ctrl + z");
    w.stage->drag (port ("table", Role::output, "force"), port ("felt", Role::input, "in"));
    OnStage::settle();
    CHECK (latestStep (document) == "table.force -> felt.in");
}
