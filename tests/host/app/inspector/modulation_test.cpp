// SPDX-License-Identifier: GPL-3.0-or-later
// The depth of a modulator, as the dials and knobs show and change it. The reference is the run: how far the parameter moves there.
#include "host/app/support/desk_stage.hpp"

#include <host/app/compose/add_preset.hpp>
#include <host/app/inspector/blocks/depth_ring.hpp>
#include <host/app/inspector/modulation.hpp>
#include <host/app/problems/unfelt.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/engine.hpp>

#include "support/sketch.hpp"

#include <algorithm>
#include <cmath>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::OnStage;
using tactus::test::Sketch;

namespace
{
/// Dry wood with an oscillator that moves the friction.
graph::Graph wavy (const char* gain)
{
    Sketch s { loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph };
    s.node ("wave", "signal.lfo", { { "frequency", "5 Hz" }, { "amplitude", 2 } });
    s.wire ("wave.out -> (+) drag.mu");
    s.graph.root.wires.back().gain = Json::parse (gain);
    return s.graph;
}

Modulation first (const graph::Graph& g, const std::string& path)
{
    const auto all = modulationsAt (g, path, catalogue());
    REQUIRE (all.size() == 1);
    return all[0];
}

/// How far the sum of a constant 0.3 and the modulator goes from 0.3 in a run: the gain of a node whose input is 1.
std::pair<double, double> reachOf (graph::Graph g)
{
    auto compiled = compile (g, catalogue(), { .records = { "scaled.out" } });
    REQUIRE (compiled.plan);
    Engine engine (std::move (compiled.plan));
    double low = 1e9, high = -1e9;
    for (int k = 0; k < 5000; ++k)
    {
        engine.tick();
        const double v = engine.plan().taps()[0].sample (0, 1);
        low = std::min (low, v);
        high = std::max (high, v);
    }
    return { low - 0.3, high - 0.3 };
}
}   // namespace

TEST_CASE ("the depth of a modulator is how far the parameter moves in the run", "[app][modulation]")
{
    using Case = std::tuple<const char*, const char*, bool>;
    for (const auto& [type, gain, one_sided] :
         { Case { "signal.lfo", "0.05", false }, Case { "signal.lfo", "-0.2", false }, Case { "signal.envelope", "0.25", true } })
    {
        INFO (type << " " << gain);
        Sketch s;
        s.node ("one", "signal.constant", { { "value", 1 } }).node ("scaled", "signal.gain", { { "gain", 0.3 } }).node ("source", type);
        s.wire ("one.out -> scaled.in").wire ("source.out -> (+) scaled.gain");
        s.graph.root.wires.back().gain = Json::parse (gain);
        if (type == std::string ("signal.lfo"))
            std::ranges::find (s.graph.root.nodes, "source", &graph::Node::name)->params["amplitude"] = 0.5;
        else
            s.wire ("one.out -> source.gate");
        const auto m = first (s.graph, "scaled.gain");
        const auto [low, high] = reachOf (s.graph);
        CHECK (m.is_one_sided == one_sided);
        CHECK (high == Approx (std::abs (m.depth)).epsilon (0.02));
        CHECK (low == Approx (one_sided ? 0.0 : -std::abs (m.depth)).margin (0.01));
        const auto changed = changeDepth (s.graph, m, 0.123);
        REQUIRE (changed);
        REQUIRE (graph::apply (s.graph, *changed));
        CHECK (first (s.graph, "scaled.gain").depth == Approx (0.123));
        CHECK (reachOf (s.graph).second == Approx (0.123).epsilon (0.02));
        REQUIRE (graph::apply (s.graph, removeModulation (m)));
        CHECK (modulationsAt (s.graph, "scaled.gain", catalogue()).empty());
    }
}

TEST_CASE ("a depth has the unit of its parameter, and its gain keeps the one in which it is written", "[app][modulation]")
{
    Sketch s;
    s.node ("wall", "deform.plane", { { "stiffness", "2 N/mm" } }).node ("lfo", "signal.lfo");
    s.wire ("lfo.out -> (+) wall.stiffness");
    s.graph.root.wires.back().gain = "0.3 N/mm";
    const auto m = first (s.graph, "wall.stiffness");
    CHECK (m.depth == Approx (300.0));
    CHECK (textOf (m).toStdString() == "\xc2\xb1"
                                       "300 N/m by lfo.out");
    REQUIRE (graph::apply (s.graph, *changeDepth (s.graph, m, 450.0)));
    CHECK (s.graph.root.wires.back().gain == Json ("0.45 N/mm"));
    s.graph.root.wires.back().enabled = false;
    CHECK (modulationsAt (s.graph, "wall.stiffness", catalogue()).empty());
    CHECK (modulationsAt (s.graph, "nothing/at.all", catalogue()).empty());
}

TEST_CASE ("a depth has the unit of a parameter also where wires decide it, and a depth in another unit is refused", "[app][modulation]")
{
    const std::string sign = "\xc2\xb1";
    for (const auto& [value, amplitude, gain] : { std::tuple { R"("0.5 N")", "2", "0.1" }, { "0.5", R"("2 N")", "0.1" }, { "0.5", "2", R"("0.1 N")" } })
    {
        INFO (value << ' ' << amplitude << ' ' << gain);
        Sketch s;
        s.node ("beat", "signal.clip", { { "gain", Json::parse (value) } }).node ("lfo", "signal.lfo", { { "amplitude", Json::parse (amplitude) } });
        s.wire ("lfo.out -> (+) beat.gain");
        s.graph.root.wires.back().gain = Json::parse (gain);
        const auto m = first (s.graph, "beat.gain");
        CHECK (sizeOf (m).toStdString() == sign + "200 mN");
        const auto face = faceOf (s.graph, s.graph.root, s.graph.root.nodes[0], catalogue());
        const auto& sheet = *face.find (Role::param, "gain")->sheet;
        CHECK (*readDepth ("30", m, sheet) == Approx (0.03));   // it shows mN
        CHECK (*readDepth ("0.3 N", m, sheet) == Approx (0.3));
        CHECK_FALSE (readDepth ("3 mm", m, sheet));
    }
    Sketch speed;
    speed.node ("beat", "signal.clip", { { "gain", 0.5 } }).node ("motion", "motion.velocity").wire ("motion.speed -> (+) beat.gain");
    speed.graph.root.wires.back().gain = "1 N*s/m";
    CHECK (sizeOf (first (speed.graph, "beat.gain")) == "+100 mN");
}

TEST_CASE ("a dial beside a parameter shows its modulator, and a drag changes the depth or ends it, in one undo step", "[app][modulation]")
{
    DeskStage w (wavy ("0.02"), 1280, 1000);
    w.canvas.select ({ w.graph().root.find ("drag")->id });
    OnStage::settle();
    const auto before = writeGraph (w.graph());
    const auto ring = [&] { return dynamic_cast<DepthRing*> (w.titled ("Depth of mu by wave.out")); };
    REQUIRE (ring() != nullptr);
    CHECK (ring()->shown().depth == Approx (0.04));
    CHECK (ring()->getDescription().contains ("0.04"));
    const auto at = w.middleOf (*ring());
    w.stage->drag (at, at.translated (0.0f, -30.0f));
    OnStage::settle();
    REQUIRE (ring() != nullptr);
    CHECK (ring()->shown().depth > 0.06);
    CHECK (w.status.text().contains ("by wave.out"));
    w.document.undo();
    CHECK (writeGraph (w.graph()) == before);
    OnStage::settle();

    const auto again = w.middleOf (*ring());
    // Down to where the depth is 0: there, it holds for some pixels.
    w.stage->move (again);
    w.stage->press();
    float y = 0.0f;
    while (ring() != nullptr && ring()->shown().depth > 0.0 && y < 400.0f)
        w.stage->move (again.translated (0.0f, y += 1.0f));
    w.stage->release();
    OnStage::settle();
    CHECK (ring() == nullptr);
    CHECK (modulationsAt (w.graph(), "drag.mu", catalogue()).empty());
    w.document.undo();
    CHECK (writeGraph (w.graph()) == before);
    OnStage::settle();

    w.stage->click (w.middleOf (*ring()));
    OnStage::settle();
    w.key ("cursor up");
    CHECK (first (w.graph(), "drag.mu").depth > 0.04);
    w.key ("delete");
    OnStage::settle();
    CHECK (modulationsAt (w.graph(), "drag.mu", catalogue()).empty());
    CHECK (w.graph().root.find ("drag") != nullptr);   // the key was for the dial
}

TEST_CASE ("a ring around a knob shows the modulators of its targets, and a drag on it turns the depth and not the knob", "[app][modulation]")
{
    auto g = wavy ("0.02");
    REQUIRE (g.controls.size() == 1);
    REQUIRE (std::ranges::count (g.controls[0].to, "drag.mu", [] (const auto& t) { return t.path; }) == 1);
    DeskStage w (std::move (g), 1280, 1000);
    w.canvas.select ({ w.graph().root.find ("board")->id });
    OnStage::settle();
    auto* strip = dynamic_cast<KnobStrip*> (w.titled ("Controls"));
    REQUIRE (strip != nullptr);
    auto& knob = strip->knob (0);
    CHECK (knob.getTooltip().contains ("by wave.out"));
    const double value = w.graph().controls[0].value;
    const auto before = writeGraph (w.graph());
    const auto middle = w.stage->getLocalPoint (&knob, knob.getLocalBounds().withTrimmedBottom (16).getCentre()).toFloat();
    const auto on_ring = middle.translated (-21.0f, 0.0f);
    w.stage->drag (on_ring, on_ring.translated (0.0f, -30.0f));
    OnStage::settle();
    CHECK (w.graph().controls[0].value == value);
    CHECK (first (w.graph(), "drag.mu").depth > 0.05);
    w.document.undo();
    CHECK (writeGraph (w.graph()) == before);
    w.stage->drag (middle, middle.translated (0.0f, -30.0f));
    CHECK (w.graph().controls[0].value > value);
    CHECK (first (w.graph(), "drag.mu").depth == Approx (0.04));
    w.document.undo();
    OnStage::settle();

    // Down on the ring to where the depth is 0 ends the modulation, in one step.
    w.stage->move (on_ring);
    w.stage->press();
    for (float y = 0.0f; y < 400.0f && first (w.graph(), "drag.mu").depth > 0.0;)
        w.stage->move (on_ring.translated (0.0f, y += 1.0f));
    CHECK (first (w.graph(), "drag.mu").depth == 0.0);
    w.stage->release();
    OnStage::settle();
    CHECK (modulationsAt (w.graph(), "drag.mu", catalogue()).empty());
    CHECK (std::ranges::none_of (w.graph().root.wires, &graph::Wire::add));
    CHECK (w.graph().controls[0].value == value);
    w.document.undo();
    CHECK (writeGraph (w.graph()) == before);
}

TEST_CASE ("a node on the canvas shows how far modulators move its parameter", "[app][canvas][modulation]")
{
    const auto sign = std::string ("\xc2\xb1");
    auto g = wavy ("0.02");
    g.controls.clear();
    DeskStage w (std::move (g), 1280, 1000);
    auto& canvas = w.canvas;
    const auto shown = [&] (const char* node, const char* param) {
        const auto* n = canvas.scene().find (w.graph().root.find (node)->id);
        const auto* socket = n->box.find (Role::param, param);
        return socket == nullptr ? std::string ("no row") : socket->value + " " + socket->depth;
    };
    CHECK (shown ("drag", "mu") == "0.4 " + sign + "0.04");
    CHECK (shown ("drag", "d_max") == "0.7 mm ");
    REQUIRE (w.document.perform (*changeDepth (w.graph(), first (w.graph(), "drag.mu"), 0.05)));
    CHECK (shown ("drag", "mu") == "0.4 " + sign + "0.05");
    REQUIRE (w.document.perform (removeModulation (first (w.graph(), "drag.mu"))));
    CHECK (shown ("drag", "mu") == "0.4 ");

    // Two modulators are both shown, and one that is never below 0 has a plus.
    Sketch s { w.graph() };
    s.node ("gate", "signal.envelope").wire ("wave.out -> (+) drag.static_ratio").wire ("gate.out -> (+) drag.static_ratio");
    const auto count = s.graph.root.wires.size();
    s.graph.root.wires[count - 2].gain = 0.1;
    s.graph.root.wires[count - 1].gain = 0.25;
    REQUIRE (w.document.perform (graph::ReplaceGraph { std::make_shared<const graph::Graph> (s.graph) }));
    CHECK (shown ("drag", "static_ratio") == "1.5 " + sign + "0.2 +0.25");
}

TEST_CASE ("a depth can be typed on its dial, in the unit that it shows", "[app][modulation]")
{
    DeskStage w (wavy ("0.02"), 1280, 1000);
    w.select ("drag");
    const auto ring = [&] { return dynamic_cast<DepthRing*> (w.titled ("Depth of mu by wave.out")); };
    REQUIRE (ring() != nullptr);
    const auto before = writeGraph (w.graph());
    for (const juce::String begin : { "return", "0" })   // Return selects what is there, and a digit replaces it
    {
        ring()->grabKeyboardFocus();
        w.key (begin);
        OnStage::settle();
        w.stage->type (begin == "0" ? ".1" : "0.1");
        w.key ("return");
        OnStage::settle();
        REQUIRE (ring() != nullptr);
        CHECK (ring()->shown().depth == Approx (0.1));
        CHECK (ring()->hasKeyboardFocus (false));
        CHECK (writeGraph (w.graph()).find ("wave.out") != std::string::npos);
        w.document.undo();
        CHECK (writeGraph (w.graph()) == before);
        OnStage::settle();
    }
    ring()->grabKeyboardFocus();
    w.key ("return");
    OnStage::settle();
    w.stage->type ("3 N");
    w.key ("return");
    OnStage::settle();
    CHECK (writeGraph (w.graph()) == before);
    CHECK (w.status.text().contains ("does not fit"));

    const auto all = modulationsAt (w.graph(), "drag.mu", catalogue());
    PortSheet newtons;
    newtons.unit = UnitRule { UnitRule::Kind::fixed, unit::newton };
    Modulation small;
    small.depth = 0.008;
    CHECK (*readDepth ("30", small, newtons) == Approx (0.03));   // it shows mN
    CHECK (*readDepth ("30 N", small, newtons) == Approx (30.0));
    CHECK (*readDepth ("-5", small, newtons) == Approx (-0.005));
    CHECK_FALSE (readDepth ("much", small, newtons));
    REQUIRE (all.size() == 1);
}

TEST_CASE ("the menu of a parameter adds what modulates it: it stays the base, and one undo takes all away", "[app][modulation]")
{
    DeskStage w ("dry_wood.json");
    const auto before = writeGraph (w.graph());
    const auto choose = [&] (const juce::String& name) {
        juce::PopupMenu menu;
        w.inspector.fillParamMenu (menu, "drag", "mu");
        for (juce::PopupMenu::MenuItemIterator i (menu, true); i.next();)
            if (i.getItem().text == name && i.getItem().action) return i.getItem().action();
        FAIL ("there is no " << name);
    };
    for (const juce::String type : { "LFO", "Envelope", "Noise", "Speed of the hand" })
    {
        INFO (type);
        w.select ("drag");
        const auto value = w.graph().root.find ("drag")->params.at ("mu");
        choose (type);
        OnStage::settle();
        const auto made = first (w.graph(), "drag.mu");
        CHECK (made.depth == Approx (0.1 * value.get<double>()).epsilon (0.02));
        CHECK (w.graph().root.find ("drag")->params.at ("mu") == value);
        CHECK (compile (w.graph(), catalogue()).plan != nullptr);
        const auto isFromHand = [] (const graph::Wire& e) { return e.from.port == "position" && graph::toText (e.to).starts_with ("velocity"); };
        CHECK (std::ranges::any_of (w.graph().root.wires, isFromHand) == (type == "Speed of the hand"));
        w.document.undo();
        CHECK (writeGraph (w.graph()) == before);
        OnStage::settle();
    }
}

TEST_CASE ("a cable that is dropped on a knob moves what the knob sets, in one undo step; beside the canvas it adds nothing", "[app][modulation]")
{
    auto g = wavy ("0.02");
    g.root.wires.pop_back();
    DeskStage w (std::move (g), 1280, 1000);
    const auto before = writeGraph (w.graph());
    bool asks = false;
    w.canvas.onNodeRequested = [&] (const NodeRequest&) { asks = true; };
    const auto start = [&] {
        const auto& nodes = w.canvas.scene().nodes();
        const auto& wave = *std::ranges::find (nodes, "wave", &SceneNode::name);
        return w.onStage (wave.placeOf (*wave.box.find (Role::output, "out")));
    };
    const auto dropOn = [&] (juce::Component& c) {
        w.stage->drag (start(), w.middleOf (c));
        OnStage::settle();
    };
    w.select ("board");
    auto* strip = dynamic_cast<KnobStrip*> (w.titled ("Controls"));
    REQUIRE (strip != nullptr);
    dropOn (strip->knob (0));
    CHECK (first (w.graph(), "drag.mu").depth == Approx (0.04).epsilon (0.02));
    const auto once = writeGraph (w.graph());
    dropOn (strip->knob (0));   // it moves it already
    CHECK (writeGraph (w.graph()).size() == once.size());
    CHECK (first (w.graph(), "drag.mu").depth == Approx (0.04).epsilon (0.02));
    while (w.document.history().position() > 0)
        w.document.undo();
    CHECK (writeGraph (w.graph()) == before);

    w.canvas.select ({});   // the column has the control itself
    OnStage::settle();
    auto* name = w.titled ("Name of the control");
    REQUIRE (name != nullptr);
    dropOn (*name);
    CHECK (first (w.graph(), "drag.mu").depth == Approx (0.04).epsilon (0.02));
    w.document.undo();

    dropOn (w.status);
    CHECK (writeGraph (w.graph()) == before);
    CHECK_FALSE (asks);
}

TEST_CASE ("a modulator of a knob moves what it sets as a turn of the knob does, also where the parameters run in opposite directions", "[app][modulation]")
{
    DeskStage w ("velvet.json", 1280, 1000);
    REQUIRE (w.graph().controls[0].name == "Comb");
    w.select ("cloth");
    w.canvas.commands().addModulatorOf ("comb", "signal.lfo");
    OnStage::settle();
    const auto share = [&] {   // of the way of the knob
        const auto along = first (w.graph(), "pile.mu_along").depth / (0.2 - 0.5), against = first (w.graph(), "pile.mu_against").depth / (1.0 - 0.5);
        CHECK (along == Approx (against).epsilon (0.02).margin (1e-9));
        return along;
    };
    CHECK (share() == Approx (0.1));
    auto& knob = w.inspector.knobs().knob (0);
    const auto middle = w.stage->getLocalPoint (&knob, knob.getLocalBounds().withTrimmedBottom (16).getCentre()).toFloat();
    const auto on_ring = middle.translated (-21.0f, 0.0f);
    w.stage->drag (on_ring, on_ring.translated (0.0f, -30.0f));
    OnStage::settle();
    const double more = share();
    CHECK (more > 0.15);

    // Down to 0 and up again, in one drag.
    w.stage->move (on_ring);
    w.stage->press();
    float y = 0.0f;
    while (first (w.graph(), "pile.mu_along").depth != 0.0 && y < 400.0f)
        w.stage->move (on_ring.translated (0.0f, y += 1.0f));
    CHECK (share() == 0.0);
    w.stage->move (on_ring);
    w.stage->release();
    OnStage::settle();
    CHECK (share() == Approx (more).epsilon (0.02));
}

TEST_CASE ("an envelope that modulates a knob moves all that it sets, whatever the units", "[app][modulation]")
{
    DeskStage w ("dry_wood.json", 1280, 1000);
    w.canvas.commands().addModulatorOf ("roughness", "signal.envelope");
    OnStage::settle();
    CHECK (std::ranges::count (w.graph().root.nodes, "signal.envelope", &graph::Node::type) == 1);
    CHECK (first (w.graph(), "drag.mu").depth == Approx (0.04));
    CHECK (first (w.graph(), "grain.amplitude").depth == Approx (0.012));
    CHECK (compile (w.graph(), catalogue()).plan != nullptr);
    CHECK (w.document.history().position() == 1);
}

TEST_CASE ("a modulator of a knob has the unit that wires give to the parameter, also inside of a group", "[app][modulation]")
{
    for (const char* type : { "signal.lfo", "signal.envelope", "signal.noise", "motion.velocity" })
        for (const bool is_grouped : { false, true })
        {
            INFO (type << (is_grouped ? ", grouped" : ""));
            auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/heartbeat.json").graph;
            if (is_grouped) REQUIRE (graph::apply (g, graph::CollapseNodes { "", { "beat", "felt" }, "block", "block" }));
            DeskStage w (std::move (g), 1280, 1000);
            w.canvas.commands().addModulatorOf ("strength", type);
            OnStage::settle();
            const auto made = first (w.graph(), is_grouped ? "block/beat.gain" : "beat.gain");
            CHECK (made.depth == Approx (0.1));
            CHECK_FALSE (hasErrors (problemsOf (w.graph(), catalogue())));
            const auto wire = std::ranges::find (w.graph().root.wires, made.wire, &graph::Wire::id);
            REQUIRE (wire != w.graph().root.wires.end());
            if (type == std::string ("motion.velocity")) CHECK (wire->gain == Json ("1 N*s/m"));
        }
}

TEST_CASE ("the status line names all that a modulator of a knob moves", "[app][modulation]")
{
    DeskStage w ("canvas_weave.json", 1280, 1000);
    w.canvas.commands().addModulatorOf ("weave", "signal.lfo");
    CHECK (w.status.text().contains ("lfo.out moves warp.amplitude, weft.amplitude around their values"));
    w.document.undo();

    Sketch s { w.graph() };
    s.node ("wave", "signal.lfo");
    REQUIRE (w.document.perform (graph::ReplaceGraph { std::make_shared<const graph::Graph> (s.graph) }));
    w.canvas.commands().joinControl ({ w.graph().root.find ("wave")->id, Role::output, "out" }, "weave");
    CHECK (w.status.text().contains ("wave.out moves warp.amplitude, weft.amplitude around their values"));
}

TEST_CASE ("the contact opens the gate of an envelope that modulates, and Problems name one that nothing opens", "[app][modulation][problems]")
{
    const auto gateOf = [] (const graph::Graph& g) {
        std::vector<std::string> sources;
        for (const auto& w : g.root.wires)
            if (graph::toText (w.to) == "envelope.gate") sources.push_back (graph::toText (w.from));
        return sources;
    };
    const auto isAtRest = [] (const graph::Graph& g) { return std::ranges::count (unfelt (g, catalogue()), "envelope/no_gate", &Message::id) == 1; };
    const auto touched = std::vector<std::string> { "touch.gain" };
    for (const auto& [preset, knob] : { std::pair { "bronze_bell.json", "warble" }, { "heartbeat.json", "strength" }, { "canvas_weave.json", "weave" } })
    {
        INFO (preset);
        DeskStage w (preset, 1280, 1000);
        const auto before = writeGraph (w.graph());
        w.canvas.commands().addModulatorOf (knob, "signal.envelope");
        CHECK (gateOf (w.graph()) == touched);   // of a window that is there, or of a new one
        CHECK_FALSE (isAtRest (w.graph()));
        CHECK_FALSE (hasErrors (problemsOf (w.graph(), catalogue())));
        w.document.undo();
        CHECK (writeGraph (w.graph()) == before);
    }

    // The contact comes from what the knob moves: the gate would be a loop.
    auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
    g.controls[0].to.push_back ({ "board.damping", 0.1, 0.5 });
    DeskStage w (std::move (g), 1280, 1000);
    w.canvas.commands().addModulatorOf ("roughness", "signal.envelope");
    CHECK (gateOf (w.graph()).empty());
    CHECK (isAtRest (w.graph()));
    CHECK_FALSE (hasErrors (problemsOf (w.graph(), catalogue())));
}

TEST_CASE ("a second modulator of a parameter adds to the first one, which keeps its depth", "[app][modulation]")
{
    Sketch s { wavy ("0.02") };
    s.node ("slow", "signal.lfo", { { "frequency", "1 Hz" } });
    DeskStage w (s.graph, 1280, 1000);
    auto& commands = w.canvas.commands();
    const auto port = [&] (const char* node, Role role, const char* id) {
        return w.canvas.scene().findPort (PortId { w.graph().root.find (node)->id, role, id });
    };
    commands.join (port ("slow", Role::output, "out"), port ("drag", Role::param, "mu"));
    const auto both = modulationsAt (w.graph(), "drag.mu", catalogue());
    REQUIRE (both.size() == 2);
    CHECK (both[0].depth == Approx (0.04));   // as it was
    CHECK (both[1].depth == Approx (0.04).epsilon (0.02));
    CHECK (compile (w.graph(), catalogue()).plan != nullptr);
}

TEST_CASE ("a knob of an added preset is modulated by its menu, by a cable and by the key W", "[app][modulation]")
{
    DeskStage w ("dry_wood.json", 1280, 1000);
    const auto added = loadGraph (TACTUS_SOURCE_DIR "/graphs/canvas_weave.json").graph;
    const auto open = w.graph();
    const auto roles = compose::roleMaps (open, added);
    auto made = compose::addPreset (open, added, { .roles = roles.front(), .parts = {}, .at = {} }, catalogue());
    REQUIRE (made);
    REQUIRE (w.document.perform (made->command));
    const auto& controls = w.graph().controls;
    const auto knob = std::ranges::find_if (controls, [&] (const auto& c) { return c.to.size() == 2 && c.to[0].path.starts_with (made->block + "/"); });
    REQUIRE (knob != controls.end());
    const auto set = *knob;
    const auto before = writeGraph (w.graph());
    const auto modulations = [&] {   // of both params that it sets, by the same wave
        const auto first = modulationsAt (w.graph(), set.to[0].path, catalogue()), second = modulationsAt (w.graph(), set.to[1].path, catalogue());
        return first.size() == 1 && second.size() == 1 && first[0].from == second[0].from;
    };

    juce::PopupMenu menu;
    w.select ("board");
    w.inspector.knobs().fillMenu (menu, static_cast<std::size_t> (knob - controls.begin()));
    for (juce::PopupMenu::MenuItemIterator i (menu, true); i.next();)
        if (i.getItem().text == "LFO") i.getItem().action();
    OnStage::settle();
    REQUIRE (modulations());
    CHECK (compile (w.graph(), catalogue()).plan != nullptr);
    w.document.undo();
    CHECK (writeGraph (w.graph()) == before);
    OnStage::settle();

    Sketch s { w.graph() };
    s.node ("wave", "signal.lfo");
    REQUIRE (w.document.perform (graph::ReplaceGraph { std::make_shared<const graph::Graph> (s.graph) }));
    const auto with_wave = writeGraph (w.graph());
    w.canvas.commands().joinControl ({ w.graph().root.find ("wave")->id, Role::output, "out" }, set.id);
    CHECK (modulations());
    w.document.undo();
    CHECK (writeGraph (w.graph()) == with_wave);

    std::function<void (const std::string&)> choose;
    std::vector<PaletteEntry> offered;
    w.canvas.onChoose = [&] (const auto&, auto search, auto chosen) {
        offered = search (set.name);
        choose = chosen;
    };
    w.select ("wave");
    w.canvas.commands().wireFromSelection();
    REQUIRE_FALSE (offered.empty());
    CHECK (offered.front().type == "wave.out -> " + set.name);
    choose (offered.front().type);
    CHECK (modulations());
}
