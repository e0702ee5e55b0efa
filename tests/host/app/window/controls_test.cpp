// SPDX-License-Identifier: GPL-3.0-or-later
// Controls in the window: no click on them moves a force unless it turns one, and parameters have their menu where they are.
#include "host/app/support/seen_text.hpp"
#include "host/app/support/values.hpp"
#include "host/app/support/window_rig.hpp"

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
    TemporaryFolder folder;
    std::unique_ptr<WindowRig> w;

    Cloth()
    {
        auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/layered_cloth.json").graph;
        g.controls[0].value = 0.7;   // warp 70 mN, stored 40 mN
        g.controls[1].value = 0.25;
        REQUIRE (saveGraph (g, folder / "cloth.json"));
        w = std::make_unique<WindowRig> ((folder / "cloth.json").string(), 1280, 1000);   // the row of a parameter is in view
    }

    const graph::Node& node (const std::string& name) const { return *w->view->document().graph().root.find (name); }
    void select (const std::string& name) { w->view->canvas().select ({ node (name).id }); }
    ValuesInEffect values() const { return valuesInEffect (w->view->document().graph()); }

    /// Where the value of a param is on the canvas.
    juce::Point<float> value (const std::string& name, const std::string& param)
    {
        auto& canvas = w->view->canvas();
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
        WindowRig::settle();
    }
};
}   // namespace

TEST_CASE ("copies have the values that the controls set", "[app][controls]")
{
    Cloth c;
    for (const bool by_clipboard : { false, true })
    {
        INFO (by_clipboard);
        c.w->view->canvas().grabKeyboardFocus();
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
    auto& canvas = c.w->view->canvas();
    const auto ranges = [&] {
        canvas.select ({});
        WindowRig::settle();
        std::vector<juce::String> texts;
        const std::function<void (juce::Component&)> look = [&] (juce::Component& at) {
            if (const auto* field = dynamic_cast<NumberField*> (&at)) texts.push_back (field->spokenValue());
            for (auto* child : at.getChildren())
                look (*child);
        };
        look (c.w->view->part<Inspector>());
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
        if (WindowRig::focused() != &canvas) c.key ("return");   // its name
        REQUIRE (c.w->graph().controls[1].to[0].path != "drag.d_max");
        CHECK (ranges() == before);
    }
}

TEST_CASE ("a control that is deleted leaves its values, and one more parameter moves none", "[app][controls]")
{
    Cloth c;
    const auto before = c.values();
    c.select ("table");
    c.w->choose (c.w->middleOf (*c.w->titled ("Damping")), 2);   // the second entry: the first control
    REQUIRE (c.w->graph().controls[0].to.size() == 3);
    CHECK (changedValue (before, c.values()) == "");
    CHECK (latestStep (c.w->view->document()) == "assign table.damping to Coarseness");

    c.w->view->canvas().select ({});
    c.w->clickTitled ("Delete this control. Its parameters keep the values that it sets.");
    REQUIRE (c.w->graph().controls.size() == 1);
    CHECK (changedValue (before, c.values()) == "");
    CHECK (c.node ("threads").params["warp"] == "70 mN");
    c.w->view->canvas().grabKeyboardFocus();
    c.key ("ctrl + z", 2);
    CHECK (c.w->graph().controls.size() == 2);
    CHECK (c.node ("threads").params["warp"] == "40 mN");
    CHECK (changedValue (before, c.values()) == "");
}

TEST_CASE ("a double click on the name of a knob renames it and moves nothing", "[app][controls]")
{
    Cloth c;
    c.select ("drag");
    auto& knobs = c.w->view->part<Inspector>().knobs();
    REQUIRE (knobs.isVisible());
    auto& knob = knobs.knob (0);
    const auto label =
        c.w->stage->getLocalPoint (&knob, juce::Point<float> (0.5f * static_cast<float> (knob.getWidth()), static_cast<float> (knob.getHeight()) - 6.0f));
    c.w->stage->doubleClick (label);
    WindowRig::settle();
    CHECK (c.w->graph().controls[0].value == 0.7);
    c.w->stage->type ("Rough");
    c.key ("return");
    CHECK (c.w->graph().controls[0].name == "Rough");
    CHECK (c.w->graph().controls[0].value == 0.7);
    CHECK (WindowRig::focused() == &c.w->view->canvas());
    CHECK (c.w->titled ("Name of the control") == nullptr);

    // On the dial, a value is typed.
    const auto dial = c.w->middleOf (knob).translated (0.0f, -8.0f);
    const auto type = [&] (const char* text) {
        c.w->stage->doubleClick (dial);
        WindowRig::settle();
        c.w->stage->type (text);
        c.key ("return");
        WindowRig::settle();
    };
    type ("30 %");
    CHECK (c.w->graph().controls[0].value == Approx (0.3));
    for (const auto* wrong : { "loud", "0,35", "30", "-1", "" })
    {
        type (wrong);
        CHECK (c.w->graph().controls[0].value == Approx (0.3));
    }
    CHECK (WindowRig::focused() == &c.w->view->canvas());
}

TEST_CASE ("on a knob with the keyboard focus, Return and digits open its value, and the keyboard stays at the knob", "[app][controls]")
{
    Cloth c;
    c.select ("drag");
    auto& knob = c.w->view->part<Inspector>().knobs().knob (0);
    const auto& control = c.w->graph().controls[0];
    knob.grabKeyboardFocus();
    REQUIRE (WindowRig::focused() == &knob);
    CHECK_FALSE (knob.keyPressed ({ '1', juce::ModifierKeys::ctrlModifier, '1' }));   // a command of the window

    c.key ("return");
    WindowRig::settle();
    c.w->stage->type ("30 %");
    c.key ("return");
    WindowRig::settle();
    CHECK (control.value == Approx (0.3));
    CHECK (WindowRig::focused() == &knob);

    c.w->stage->type (".25");
    c.key ("return");
    WindowRig::settle();
    CHECK (control.value == Approx (0.25));
    CHECK (WindowRig::focused() == &knob);
    CHECK (c.w->titled ("Value of the control") == nullptr);
}

TEST_CASE ("a click on a knob or a field gives it the keyboard, so that what is typed is its value", "[app][controls]")
{
    Cloth c;
    c.select ("drag");
    const auto& control = c.w->graph().controls[0];
    c.w->stage->click (c.w->middleOf (c.w->view->part<Inspector>().knobs().knob (0)).translated (0.0f, -8.0f));
    CHECK (control.value == Approx (0.7));
    c.w->stage->type ("0.4");
    c.key ("return");
    CHECK (control.value == Approx (0.4));

    auto* field = c.w->titled ("Stiffness");
    REQUIRE (field != nullptr);
    c.w->stage->click (c.w->middleOf (*field));
    CHECK (WindowRig::focused() == field);
    c.w->stage->type ("12");
    c.key ("return");
    CHECK (latestStep (c.w->view->document()) == "drag: Stiffness 0 -> 12 N/m");
    c.key ("ctrl + z", 2);
    CHECK (control.value == Approx (0.7));
    CHECK_FALSE (c.node ("drag").params.contains ("stiffness"));
    c.key ("escape");
    CHECK (WindowRig::focused() == &c.w->view->canvas());
}

TEST_CASE ("one turn of the wheel over a knob is one step, and Shift+drag is fine", "[app][controls][undo]")
{
    Cloth c;
    c.select ("drag");
    auto& knob = c.w->view->part<Inspector>().knobs().knob (0);
    const auto dial = c.w->middleOf (knob).translated (0.0f, -8.0f);
    const auto& control = c.w->graph().controls[0];
    const auto before = c.w->view->document().history().position();
    for (int i = 0; i < 3; ++i)
        c.w->stage->wheel (dial, -0.2f, false);
    WindowRig::settle();
    CHECK (control.value < 0.65);
    CHECK (c.w->view->document().history().position() == before + 1);
    const double now = control.value;
    c.w->stage->drag (dial, dial.translated (0.0f, -50.0f), juce::ModifierKeys::leftButtonModifier, juce::ModifierKeys::shiftModifier);
    WindowRig::settle();
    CHECK (control.value == Approx (now + 0.025).margin (0.005));
    CHECK (c.w->view->document().history().position() == before + 2);
}

TEST_CASE ("the wheel scrolls the inspector over whatever is under the pointer, and moves no value", "[app][controls]")
{
    Cloth c;
    c.w->view->canvas().select ({});
    c.w->settle();
    auto* value = c.w->titled (juce::String (c.w->graph().controls[0].name).toRawUTF8());
    REQUIRE (value != nullptr);
    const auto version = c.w->view->document().version();
    for (int i = 0; i < 5; ++i)
        c.w->stage->wheel (c.w->middleOf (*value), -0.2f, false);
    WindowRig::settle();
    CHECK (c.w->view->document().version() == version);
}

TEST_CASE ("what is typed as the value of a control is read whole, or refused", "[app][controls]")
{
    Cloth c;
    c.w->view->canvas().select ({});
    c.w->settle();
    const auto& control = c.w->graph().controls[0];
    const auto type = [&] (const char* text) {
        auto* value = dynamic_cast<NumberField*> (c.w->titled (juce::String (control.name).toRawUTF8()));
        REQUIRE (value != nullptr);
        c.w->stage->doubleClick (c.w->middleOf (*value));
        WindowRig::settle();
        c.w->stage->type (text);   // in place of all of it
        c.key ("return");
        c.key ("escape");
        WindowRig::settle();
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

TEST_CASE ("a click beside the fields of the inspector gives no field the keyboard", "[app][controls]")
{
    Cloth c;
    c.select ("drag");
    const auto name = c.node ("drag").name;
    auto& inspector = c.w->view->part<Inspector>();
    for (int y = 4; y < inspector.getHeight(); y += 12)
    {
        c.w->view->canvas().grabKeyboardFocus();
        c.w->stage->click (c.w->stage->getLocalPoint (&inspector, juce::Point<int> (6, y)).toFloat());   // at the margin
        WindowRig::settle();
        CHECK (dynamic_cast<juce::TextEditor*> (WindowRig::focused()) == nullptr);
    }
    CHECK (c.node ("drag").name == name);
}

TEST_CASE ("a drag of a control's value is one step, as a drag of its knob is", "[app][controls][undo]")
{
    Cloth c;
    c.w->view->canvas().select ({});   // the inspector shows the graph
    c.w->settle();
    const auto& control = c.w->graph().controls[0];
    auto* fader = dynamic_cast<NumberField*> (c.w->titled (juce::String (control.name).toRawUTF8()));
    REQUIRE (fader != nullptr);
    const auto at = [&] (float part) {
        return c.w->stage->getLocalPoint (fader, fader->getLocalBounds().toFloat().getRelativePoint (part, 0.5f));
    };
    const auto before = c.w->view->document().history().position();
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
    CHECK (c.w->view->document().history().position() == before + 1);
    c.w->stage->drag (at (0.8f), at (0.3f));   // another drag is another step
    c.w->settle();
    CHECK (c.w->view->document().history().position() == before + 2);
}

TEST_CASE ("a right click on a parameter of a node opens its menu, inside a subgraph too", "[app][controls]")
{
    Cloth c;
    auto& canvas = c.w->view->canvas();
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
        c.w->choose (c.value (name, param), 2);   // below Release
        CHECK (exposed() == wanted);
    }
    c.w->choose (c.value (name, param), -2);   // above the commands of the node
    c.w->stage->move ({ 4.0f, 4.0f });         // off the canvas, whose hints cover the notice
    WindowRig::settle();
    INFO (c.w->view->statusText());
    CHECK (c.w->view->statusText().contains ("Usual"));
}

namespace
{
/// Dry wood, whose knob Roughness sets grain.amplitude and drag.mu, with wires from a constant into one or both of them.
struct WiredKnob
{
    TemporaryFolder folder;
    std::unique_ptr<WindowRig> w;

    explicit WiredKnob (std::initializer_list<const char*> wires)
    {
        auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
        for (const auto* node : { "force", "ratio" })
            g.root.nodes.push_back (Sketch::makeNode (node, "signal.constant", { { "value", 0.1 } }));
        for (const auto* wire : wires)
            g.root.wires.push_back (*graph::parseWire (wire));
        REQUIRE (saveGraph (g, folder / "wood.json"));
        w = std::make_unique<WindowRig> ((folder / "wood.json").string(), 1280, 1000);
        w->view->canvas().select ({ w->graph().root.find ("board")->id });   // the knobs are below its parameters
        WindowRig::settle();
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
        WindowRig::settle();
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
    const auto version = k.w->view->document().version();
    k.turn();
    CHECK (k.value() == before);
    CHECK (k.knob().getValue() == before);
    CHECK (k.w->view->document().version() == version);

    k.w->view->canvas().select ({});   // the same in the list of controls
    WindowRig::settle();
    const auto texts = readTexts (k.w->view->part<Inspector>());
    CHECK (std::ranges::any_of (texts, [] (const auto& t) { return t.text.contains ("drag.mu, without effect: a wire from ratio.out"); }));
    auto* field = dynamic_cast<NumberField*> (k.w->titled ("Roughness"));
    REQUIRE (field != nullptr);
    CHECK (field->isDriven());

    const auto& wires = k.w->graph().root.wires;
    const auto wire = std::ranges::find_if (wires, [] (const graph::Wire& w) { return w.to.port == "mu"; });
    REQUIRE (wire != wires.end());
    k.w->view->document().perform (graph::RemoveWire { {}, wire->id });
    WindowRig::settle();
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
