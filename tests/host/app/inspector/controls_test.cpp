// SPDX-License-Identifier: GPL-3.0-or-later
// Controls in the inspector and on nodes: no click on them moves a force unless it turns one, and parameters have their menu where they are.
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/seen_text.hpp"
#include "host/app/support/values.hpp"

#include "support/sketch.hpp"

#include <host/app/inspector/blocks/number_field.hpp>
#include <host/app/inspector/knob_strip.hpp>
#include <host/app/model/controlled_param.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::test;
using tactus::test::Sketch;

namespace
{
/// Layered cloth, whose knobs are not where its nodes store them.
struct Cloth
{
    std::unique_ptr<DeskStage> w;

    Cloth()
    {
        auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/layered_cloth.json").graph;
        g.controls[0].value = 0.7;   // warp 70 mN, stored 40 mN
        g.controls[1].value = 0.25;
        w = std::make_unique<DeskStage> (std::move (g), 1048, 850);   // the row of a parameter is in view
    }

    const graph::Node& node (const std::string& name) const { return *w->document.graph().root.find (name); }
    void select (const std::string& name) { w->canvas.select ({ node (name).id }); }
    ValuesInEffect values() const { return valuesInEffect (w->document.graph()); }

    /// Where the value of a param is on the canvas.
    juce::Point<float> value (const std::string& name, const std::string& param)
    {
        auto& canvas = w->canvas;
        for (const auto& n : canvas.scene().nodes())
            if (n.name == name)
            {
                const auto* socket = n.box.find (Role::param, param);
                REQUIRE (socket != nullptr);
                const auto at = canvas.view().toPixels (n.at + juce::Point<float> (n.box.width - 20.0f, socket->at.y));
                REQUIRE (canvas.getLocalBounds().toFloat().contains (at));
                return w->stage->getLocalPoint (&canvas, at);
            }
        FAIL ("no node " << name);
        return {};
    }

    void key (const char* k, int times = 1)
    {
        for (int i = 0; i < times; ++i)
            w->key (k);
        OnStage::settle();
    }
};
}   // namespace

TEST_CASE ("copies have the values that the controls set", "[app][controls]")
{
    Cloth c;
    for (const bool by_clipboard : { false, true })
    {
        INFO (by_clipboard);
        c.w->canvas.grabKeyboardFocus();
        c.select ("threads");
        if (by_clipboard)
        {
            c.key ("ctrl + c");
            c.key ("ctrl + v");
        }
        else
            c.key ("ctrl + d");
        const auto& copy = c.w->graph().root.nodes.back();
        CHECK (copy.name.starts_with ("threads_"));
        CHECK (copy.params["warp"] == "70 mN");
        CHECK (copy.params["weft"] == "105 mN");
        CHECK (c.node ("threads").params["warp"] == "40 mN");
    }
}

TEST_CASE ("the range of a control keeps its unit when its parameter gets into a group", "[app][controls]")
{
    Cloth c;
    auto& canvas = c.w->canvas;
    const auto ranges = [&] {
        canvas.select ({});
        OnStage::settle();
        std::vector<juce::String> texts;
        const std::function<void (juce::Component&)> look = [&] (juce::Component& at) {
            if (const auto* field = dynamic_cast<NumberField*> (&at)) texts.push_back (field->spokenValue());
            for (auto* child : at.getChildren())
                look (*child);
        };
        look (c.w->inspector);
        return texts;
    };
    const auto before = ranges();
    REQUIRE (std::ranges::any_of (before, [] (const juce::String& t) { return t.endsWith ("mm"); }));
    for (int depth = 1; depth <= 2; ++depth)
    {
        INFO (depth);
        canvas.grabKeyboardFocus();
        depth == 1 ? c.select ("drag") : canvas.select ({ c.w->graph().root.nodes.back().id });
        c.key ("g");
        if (OnStage::focused() != &canvas) c.key ("return");   // its name
        REQUIRE (c.w->graph().controls[1].to[0].path != "drag.d_max");
        CHECK (ranges() == before);
    }
}

TEST_CASE ("both ends of the range of a control show the unit that one of them is written with", "[app][controls]")
{
    DeskStage w ("heartbeat.json", 1048, 850);
    REQUIRE (w.graph().controls[1].to[0].low == Json (0));
    OnStage::settle();
    std::vector<juce::String> texts;
    const std::function<void (juce::Component&)> look = [&] (juce::Component& at) {
        if (const auto* field = dynamic_cast<NumberField*> (&at)) texts.push_back (field->spokenValue());
        for (auto* child : at.getChildren())
            look (*child);
    };
    look (w.inspector);
    CHECK (std::ranges::count (texts, juce::String ("0 N")) == 1);
    CHECK (std::ranges::count (texts, juce::String ("1 N")) == 1);
}

TEST_CASE ("a control that is deleted leaves its values, and one more parameter moves none", "[app][controls]")
{
    Cloth c;
    const auto before = c.values();
    c.select ("table");
    c.w->choose (c.w->middleOf (*c.w->titled ("Damping")), 2);   // the second entry: the first control
    REQUIRE (c.w->graph().controls[0].to.size() == 3);
    CHECK (changedValue (before, c.values()) == "");
    CHECK (latestStep (c.w->document) == "assign table.damping to Coarseness");

    c.w->canvas.select ({});
    c.w->clickTitled ("Delete this control. Its parameters keep the values that it sets.");
    REQUIRE (c.w->graph().controls.size() == 1);
    CHECK (changedValue (before, c.values()) == "");
    CHECK (c.node ("threads").params["warp"] == "70 mN");
    c.w->canvas.grabKeyboardFocus();
    c.key ("ctrl + z", 2);
    CHECK (c.w->graph().controls.size() == 2);
    CHECK (c.node ("threads").params["warp"] == "40 mN");
    CHECK (changedValue (before, c.values()) == "");
}

TEST_CASE ("a double click on the name of a knob renames it and moves nothing", "[app][controls]")
{
    Cloth c;
    c.select ("drag");
    auto& knobs = c.w->inspector.knobs();
    REQUIRE (knobs.isVisible());
    auto& knob = knobs.knob (0);
    const auto label =
        c.w->stage->getLocalPoint (&knob, juce::Point<float> (0.5f * static_cast<float> (knob.getWidth()), static_cast<float> (knob.getHeight()) - 6.0f));
    c.w->stage->doubleClick (label);
    OnStage::settle();
    CHECK (c.w->graph().controls[0].value == 0.7);
    c.w->stage->type ("Rough");
    c.key ("return");
    CHECK (c.w->graph().controls[0].name == "Rough");
    CHECK (c.w->graph().controls[0].value == 0.7);
    CHECK (OnStage::focused() == &c.w->canvas);
    CHECK (c.w->titled ("Name of the control") == nullptr);

    // On the dial, a value is typed.
    const auto dial = c.w->middleOf (knob).translated (0.0f, -8.0f);
    const auto type = [&] (const char* text) {
        c.w->stage->doubleClick (dial);
        OnStage::settle();
        c.w->stage->type (text);
        c.key ("return");
        OnStage::settle();
    };
    type ("30 %");
    CHECK (c.w->graph().controls[0].value == Approx (0.3));
    for (const auto* wrong : { "loud", "0,35", "30", "-1", "" })
    {
        type (wrong);
        CHECK (c.w->graph().controls[0].value == Approx (0.3));
    }
    CHECK (OnStage::focused() == &c.w->canvas);
}

TEST_CASE ("on a knob with the keyboard focus, Return and digits open its value, and the keyboard stays at the knob", "[app][controls]")
{
    Cloth c;
    c.select ("drag");
    auto& knob = c.w->inspector.knobs().knob (0);
    const auto& control = c.w->graph().controls[0];
    knob.grabKeyboardFocus();
    REQUIRE (OnStage::focused() == &knob);
    CHECK_FALSE (knob.keyPressed ({ '1', juce::ModifierKeys::ctrlModifier, '1' }));   // a command of the window

    c.key ("return");
    OnStage::settle();
    c.w->stage->type ("30 %");
    c.key ("return");
    OnStage::settle();
    CHECK (control.value == Approx (0.3));
    CHECK (OnStage::focused() == &knob);

    c.w->stage->type (".25");
    c.key ("return");
    OnStage::settle();
    CHECK (control.value == Approx (0.25));
    CHECK (OnStage::focused() == &knob);
    CHECK (c.w->titled ("Value of the control") == nullptr);
}

TEST_CASE ("a click on a knob or a field gives it the keyboard, so that what is typed is its value", "[app][controls]")
{
    Cloth c;
    c.select ("drag");
    const auto& control = c.w->graph().controls[0];
    c.w->stage->click (c.w->middleOf (c.w->inspector.knobs().knob (0)).translated (0.0f, -8.0f));
    CHECK (control.value == Approx (0.7));
    c.w->stage->type ("0.4");
    c.key ("return");
    CHECK (control.value == Approx (0.4));

    auto* field = c.w->titled ("Stiffness");
    REQUIRE (field != nullptr);
    c.w->stage->click (c.w->middleOf (*field));
    CHECK (OnStage::focused() == field);
    c.w->stage->type ("12");
    c.key ("return");
    CHECK (latestStep (c.w->document) == "drag: Stiffness 0 -> 12 N/m");
    c.key ("ctrl + z", 2);
    CHECK (control.value == Approx (0.7));
    CHECK_FALSE (c.node ("drag").params.contains ("stiffness"));
}

TEST_CASE ("one turn of the wheel over a knob is one step, and Shift+drag is fine", "[app][controls][undo]")
{
    Cloth c;
    c.select ("drag");
    auto& knob = c.w->inspector.knobs().knob (0);
    const auto dial = c.w->middleOf (knob).translated (0.0f, -8.0f);
    const auto& control = c.w->graph().controls[0];
    const auto before = c.w->document.history().position();
    for (int i = 0; i < 3; ++i)
        c.w->stage->wheel (dial, -0.2f, false);
    OnStage::settle();
    CHECK (control.value < 0.65);
    CHECK (c.w->document.history().position() == before + 1);
    const double now = control.value;
    c.w->stage->drag (dial, dial.translated (0.0f, -50.0f), juce::ModifierKeys::leftButtonModifier, juce::ModifierKeys::shiftModifier);
    OnStage::settle();
    CHECK (control.value == Approx (now + 0.025).margin (0.005));
    CHECK (c.w->document.history().position() == before + 2);
}

TEST_CASE ("the wheel scrolls the inspector over whatever is under the pointer, and moves no value", "[app][controls]")
{
    Cloth c;
    c.w->canvas.select ({});
    c.w->settle();
    auto* value = c.w->titled (juce::String (c.w->graph().controls[0].name).toRawUTF8());
    REQUIRE (value != nullptr);
    const auto version = c.w->document.version();
    for (int i = 0; i < 5; ++i)
        c.w->stage->wheel (c.w->middleOf (*value), -0.2f, false);
    OnStage::settle();
    CHECK (c.w->document.version() == version);
}

TEST_CASE ("what is typed as the value of a control is read whole, or refused", "[app][controls]")
{
    Cloth c;
    c.w->canvas.select ({});
    c.w->settle();
    const auto& control = c.w->graph().controls[0];
    const auto type = [&] (const char* text) {
        auto* value = dynamic_cast<NumberField*> (c.w->titled (juce::String (control.name).toRawUTF8()));
        REQUIRE (value != nullptr);
        c.w->stage->doubleClick (c.w->middleOf (*value));
        OnStage::settle();
        c.w->stage->type (text);   // in place of all of it
        c.key ("return");
        c.key ("escape");
        OnStage::settle();
    };
    type ("35 %");
    CHECK (control.value == Approx (0.35));
    type ("0.6");
    CHECK (control.value == Approx (0.6));
    for (const auto* wrong : { "loud", "0,35", "70", "-0.1", "0.3 N" })
    {
        INFO (wrong);
        type (wrong);
        CHECK (control.value == Approx (0.6));
    }
}

TEST_CASE ("a drag of a control's value is one step, as a drag of its knob is", "[app][controls][undo]")
{
    Cloth c;
    c.w->canvas.select ({});   // the inspector shows the graph
    c.w->settle();
    const auto& control = c.w->graph().controls[0];
    auto* fader = dynamic_cast<NumberField*> (c.w->titled (juce::String (control.name).toRawUTF8()));
    REQUIRE (fader != nullptr);
    const auto at = [&] (float part) {
        return c.w->stage->getLocalPoint (fader, fader->getLocalBounds().toFloat().getRelativePoint (part, 0.5f));
    };
    const auto before = c.w->document.history().position();
    c.w->stage->move (at (0.2f));
    c.w->stage->press();
    c.w->settle();
    CHECK (control.value == 0.7);   // a press moves nothing, wherever it is
    c.w->stage->move (at (0.3f));
    const double more = control.value;
    CHECK (more > 0.7);
    c.w->stage->move (at (0.1f));
    CHECK (control.value < 0.7);
    c.w->stage->release();
    c.w->settle();
    CHECK (c.w->document.history().position() == before + 1);
    c.w->stage->drag (at (0.8f), at (0.3f));   // another drag is another step
    c.w->settle();
    CHECK (c.w->document.history().position() == before + 2);
}

TEST_CASE ("a right click on a parameter of a node opens its menu, inside a subgraph too", "[app][controls]")
{
    Cloth c;
    auto& canvas = c.w->canvas;
    const auto before = c.values();
    c.w->choose (c.value ("drag", "mu"), 1);   // New control
    REQUIRE (c.w->graph().controls.size() == 3);
    CHECK (c.w->graph().controls[2].to[0].path == "drag.mu");
    c.w->stage->type ("Grip");   // the field for its name is open
    c.key ("return");
    CHECK (c.w->graph().controls[2].name == "Grip");
    CHECK (changedValue (before, c.values()) == "");

    c.w->choose (c.value ("drag", "mu"), 1);   // Release
    CHECK (c.w->graph().controls[2].to.empty());
    CHECK (changedValue (before, c.values()) == "");

    const auto& scene = canvas.scene();
    const auto threads = std::ranges::find (scene.nodes(), "threads", &SceneNode::name);
    REQUIRE (threads != scene.nodes().end());
    canvas.enter (*threads);
    const auto& inside = canvas.scene().nodes();
    const auto shows = [] (const SceneNode& n) {
        return std::ranges::any_of (n.box.sockets, [] (const Socket& s) { return s.port->role == Role::param && s.port->width == 1 && ! s.port->isChoice(); });
    };
    const auto node = std::ranges::find_if (inside, shows);
    REQUIRE (node != inside.end());
    const auto socket = std::ranges::find_if (node->box.sockets, [] (const Socket& s) { return s.port->role == Role::param && ! s.port->isChoice(); });
    const auto name = node->name, param = socket->port->id;
    const auto within = c.values();
    c.w->choose (c.value (name, param), 1);
    REQUIRE (c.w->graph().controls.size() == 4);
    CHECK (c.w->graph().controls[3].to[0].path == "threads/" + name + "." + param);
    c.key ("return");
    CHECK (changedValue (within, c.values()) == "");

    // The preset exposes the parameter outside the subgraph. The menu hides it, and exposes it again.
    const auto exposed = [&] { return c.w->graph().find (canvas.patch())->expose.params.size(); };
    const auto count = exposed();
    for (const std::size_t wanted : { count - 1, count })
    {
        c.w->choose (c.value (name, param), 3);   // below Release and Modulate by
        CHECK (exposed() == wanted);
    }
    c.w->choose (c.value (name, param), -2);   // above the commands of the node
    c.w->stage->move ({ 4.0f, 4.0f });         // off the canvas, whose hints cover the notice
    OnStage::settle();
    INFO (c.w->status.text());
    CHECK (c.w->status.text().contains ("Usual"));
}

TEST_CASE ("a click beside the fields of the inspector leaves the keyboard to the canvas", "[app][keys]")
{
    DeskStage w ("dry_wood.json");
    auto& canvas = w.canvas;
    canvas.grabKeyboardFocus();
    for (const bool has_node : { true, false })
    {
        canvas.select (has_node ? Selection { w.graph().root.find ("drag")->id } : Selection {});
        OnStage::settle();
        const auto area = w.inspector.getBounds();
        const auto& knobs = w.inspector.knobs();
        for (int y = area.getY() + 4; y < area.getBottom() - (knobs.isVisible() ? knobs.getHeight() : 0); y += 8)
        {
            INFO (y);
            w.stage->click (juce::Point<int> (area.getX() + 4, y).toFloat());
            CHECK (canvas.hasKeyboardFocus (true));
        }
    }
}

TEST_CASE ("the controls of a graph are in reach as knobs, whatever is selected", "[app][keys]")
{
    DeskStage w ("bronze_bell.json");
    auto& knobs = w.inspector.knobs();
    w.canvas.select ({});
    CHECK (knobs.isVisible());
    w.canvas.select ({ w.graph().root.find ("wall")->id });
    REQUIRE (knobs.isVisible());
    REQUIRE (knobs.size() == 4);
    const auto before = w.document.history().position();
    const auto middle = [&] (std::size_t i) { return w.stage->getLocalPoint (&knobs.knob (i), knobs.knob (i).getLocalBounds().getCentre()).toFloat(); };
    w.stage->drag (middle (0), middle (0).translated (0, -40));
    CHECK (w.graph().controls[0].value > 0.65);
    CHECK (w.document.history().position() == before + 1);   // one step for the whole drag
    CHECK (latestStep (w.document).starts_with ("Blow 0.60 -> "));
    w.document.undo();
    CHECK (knobs.knob (0).getValue() == Approx (0.6));
    knobs.knob (1).grabKeyboardFocus();
    w.key ("cursor up");
    CHECK (w.graph().controls[1].value == Approx (0.51));
}

TEST_CASE ("what is selected counts the wires between the nodes", "[app][inspector]")
{
    DeskStage w ("dry_wood.json");
    auto& canvas = w.canvas;
    w.key ("ctrl + a");
    OnStage::settle();
    const auto& root = w.graph().root;
    CHECK (showsText (w.inspector, juce::String (root.nodes.size()) + " nodes, " + juce::String (root.wires.size()) + " wires"));
    const auto from = root.find (root.wires.front().from.node)->id, to = root.find (root.wires.front().to.node)->id;
    const auto between = std::ranges::count_if (root.wires, [&] (const graph::Wire& v) {
        const std::set<graph::Id> ends { root.find (v.from.node)->id, root.find (v.to.node)->id };
        return std::ranges::includes (std::set { from, to }, ends);
    });
    canvas.select ({ from, to });
    OnStage::settle();
    const auto wires = [&] (auto count) { return "2 nodes, " + juce::String (static_cast<int> (count)) + " wires"; };
    CHECK (showsText (w.inspector, wires (between)));
    const auto& other = *std::ranges::find_if (root.wires, [&] (const graph::Wire& v) { return root.find (v.from.node)->id != from; });
    canvas.select ({ from, to, other.id });
    OnStage::settle();
    CHECK (showsText (w.inspector, wires (between + 1)));
    REQUIRE (w.document.perform (graph::RemoveWire { {}, other.id }));
    OnStage::settle();
    CHECK (showsText (w.inspector, wires (between)));
}

namespace
{
/// Dry wood, whose knob Roughness sets grain.amplitude and drag.mu, with wires from a constant into one or both of them.
struct WiredKnob
{
    std::unique_ptr<DeskStage> w;

    explicit WiredKnob (std::initializer_list<const char*> wires)
    {
        auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
        for (const auto* node : { "force", "ratio" })
            g.root.nodes.push_back (Sketch::makeNode (node, "signal.constant", { { "value", 0.1 } }));
        for (const auto* wire : wires)
            g.root.wires.push_back (*graph::parseWire (wire));
        w = std::make_unique<DeskStage> (std::move (g), 1048, 850);
        w->canvas.select ({ w->graph().root.find ("board")->id });   // the knobs are below its parameters
        OnStage::settle();
    }

    juce::Slider& knob()
    {
        auto* strip = dynamic_cast<KnobStrip*> (w->titled ("Controls"));
        REQUIRE (strip != nullptr);
        REQUIRE (strip->size() == 1);
        return strip->knob (0);
    }

    double value() const { return w->graph().controls.front().value; }

    void turn()
    {
        const auto at = w->stage->getLocalPoint (&knob(), knob().getLocalBounds().getCentre().translated (0, -10)).toFloat();
        w->stage->drag (at, at.translated (0.0f, -40.0f));
        w->stage->wheel (at, 0.2f, false);
        OnStage::settle();
    }

    /// How many pixels of the knob have the colour of what is live.
    int lit()
    {
        const auto image = knob().createComponentSnapshot (knob().getLocalBounds());
        const auto accent = lookOf (knob()).theme().accent;
        int count = 0;
        for (int y = 0; y < image.getHeight(); ++y)
            for (int x = 0; x < image.getWidth(); ++x)
                count += image.getPixelAt (x, y) == accent ? 1 : 0;
        return count;
    }
};
}   // namespace

TEST_CASE ("a knob whose parameters get wires is dimmed, names the wires, and does not turn", "[app][controls]")
{
    const auto both = { "force.out -> grain.amplitude", "ratio.out -> drag.mu" };
    WiredKnob k (both);
    CHECK (k.knob().getTooltip().contains ("force.out"));
    CHECK (k.knob().getTooltip().contains ("ratio.out"));
    CHECK (k.lit() == 0);
    const double before = k.value();
    const auto version = k.w->document.version();
    k.turn();
    CHECK (k.value() == before);
    CHECK (k.knob().getValue() == before);
    CHECK (k.w->document.version() == version);

    k.w->canvas.select ({});   // the same in the list of controls
    OnStage::settle();
    const auto texts = readTexts (k.w->inspector);
    CHECK (std::ranges::any_of (texts, [] (const auto& t) { return t.text.contains ("drag.mu, without effect: a wire from ratio.out"); }));
    auto* field = dynamic_cast<NumberField*> (k.w->titled ("Roughness"));
    REQUIRE (field != nullptr);
    CHECK (field->isDriven());

    const auto& wires = k.w->graph().root.wires;
    const auto wire = std::ranges::find_if (wires, [] (const graph::Wire& w) { return w.to.port == "mu"; });
    REQUIRE (wire != wires.end());
    k.w->document.perform (graph::RemoveWire { {}, wire->id });
    OnStage::settle();
    field = dynamic_cast<NumberField*> (k.w->titled ("Roughness"));
    REQUIRE (field != nullptr);
    CHECK_FALSE (field->isDriven());
}

TEST_CASE ("a knob of which one parameter gets a wire turns, and names that wire", "[app][controls]")
{
    WiredKnob k ({ "ratio.out -> drag.mu" });
    CHECK (k.knob().getTooltip().contains ("A wire from ratio.out sets drag.mu"));
    CHECK (k.lit() > 0);
    const double before = k.value();
    k.turn();
    CHECK (k.value() > before);
}
