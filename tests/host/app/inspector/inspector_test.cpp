// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/seen_text.hpp"
#include "rig.hpp"

#include <host/app/inspector/blocks/limit_block.hpp>
#include <host/app/inspector/blocks/plot_block.hpp>
#include <host/app/inspector/blocks/table_row.hpp>
#include <host/app/model/controlled_param.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/plan/compile.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;
using tactus::test::InspectorRig;

namespace
{
/// Presses the button with that caption.
bool press (const InspectorRig& rig, const std::string& caption)
{
    for (auto* b : rig.all<ToolButton>())
        if (b->getButtonText().toStdString() == caption && b->onClick)
        {
            b->onClick();
            return true;
        }
    return false;
}

void write (TextField* field, const std::string& text)
{
    REQUIRE (field != nullptr);
    field->setText (text, false);
    field->onReturnKey();   // which may delete the field
}
}   // namespace

TEST_CASE ("every node of every preset can be inspected, and nothing is wider than the panel", "[inspector]")
{
    for (const auto& entry : std::filesystem::directory_iterator (TACTUS_SOURCE_DIR "/graphs"))
    {
        if (entry.path().extension() != ".json") continue;
        InspectorRig rig (entry.path().filename().string());
        CHECK (rig.fits());
        for (const auto& n : rig.document->graph().root.nodes)
        {
            INFO (entry.path().filename() << ' ' << n.name);
            rig.select (n.name);
            CHECK (rig.inspector->shown().size() > 2);
            CHECK (rig.fits());
            rig.inspector->setHelp (true);
            CHECK (rig.fits());
            rig.inspector->setHelp (false);
        }
        for (const auto& [name, patch] : rig.document->graph().graphs)
            for (const auto& n : patch.nodes)
            {
                rig.inspector->inspect (name, { n.id });
                CHECK (rig.fits());
            }
        CHECK_FALSE (rig.document->isChanged());   // inspecting changes nothing
    }
}

TEST_CASE ("every type of the catalogue can be inspected", "[inspector]")
{
    graph::Graph g;
    int i = 0;
    for (const auto& t : catalogue())
    {
        graph::Node n;
        n.name = "n" + std::to_string (i++);
        n.type = std::string (t.info.id);
        g.root.nodes.push_back (n);
    }
    InspectorRig rig (std::move (g));
    for (const auto& n : rig.document->graph().root.nodes)
    {
        INFO (n.type);
        rig.select (n.name);
        CHECK (rig.fits());
        CHECK (rig.inspector->createComponentSnapshot (rig.inspector->getLocalBounds()).isValid());
    }
}

TEST_CASE ("a value can be typed with its unit, and is refused with a reason outside the hard range", "[inspector]")
{
    InspectorRig rig ("dry_wood.json");
    std::string name;
    for (const auto& n : rig.document->graph().root.nodes)
        if (n.type == "friction.elasto_plastic") name = n.name;
    rig.select (name);
    auto* field = rig.in<NumberField> ("d_max");
    REQUIRE (field != nullptr);
    field->type ("0.25 mm");
    const auto written = rig.node (name).params["d_max"];
    if (! controlOf (rig.document->graph(), name + ".d_max")) CHECK (written == "0.25 mm");
    field->type ("-3");
    CHECK (rig.hints.size() == 1);
    field->type ("3 s");
    CHECK (rig.hints.size() == 2);
    CHECK (rig.node (name).params["d_max"] == written);
}

TEST_CASE ("a field opens on Return or a digit, applies on Return and cancels on Esc", "[inspector]")
{
    const juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;
    juce::LookAndFeel::setDefaultLookAndFeel (&look);
    {
        const auto sheet = sheetOfNumber ("x", unit::metre, "", { .hard = { 0, 1 }, .usual = { 0, 0.1 } }, 0.01);
        NumberField field (sheet);
        field.setBounds (0, 0, 120, 24);
        field.show (Json ("5 mm"));
        std::vector<std::string> values;
        field.onChange = [&] (std::optional<Json> v, bool) { values.push_back (v ? v->dump() : "default"); };

        CHECK_FALSE (field.keyPressed (juce::KeyPress ('7', juce::ModifierKeys::ctrlModifier, '7')));   // a command of the window
        CHECK (field.keyPressed (juce::KeyPress ('7', {}, '7')));
        REQUIRE (field.isEditing());
        auto* editor = dynamic_cast<juce::TextEditor*> (field.getChildComponent (0));
        REQUIRE (editor != nullptr);
        editor->keyPressed (juce::KeyPress ('5', {}, '5'));
        CHECK (editor->getText() == "75");
        editor->onReturnKey();
        CHECK_FALSE (field.isEditing());
        CHECK (values == std::vector<std::string> { "\"75 mm\"" });   // in the unit shown

        field.keyPressed (juce::KeyPress (juce::KeyPress::returnKey));
        REQUIRE (field.isEditing());
        editor = dynamic_cast<juce::TextEditor*> (field.getChildComponent (field.getNumChildComponents() - 1));
        editor->setText ("9 mm");
        editor->onEscapeKey();
        CHECK_FALSE (field.isEditing());
        CHECK (values.size() == 1);

        CHECK (field.keyPressed (juce::KeyPress (juce::KeyPress::upKey)));
        CHECK (values.size() == 2);
        CHECK (field.shown().si() > 7e-3);
        CHECK_FALSE (field.keyPressed (juce::KeyPress (juce::KeyPress::tabKey)));
    }
    juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
}

TEST_CASE ("what a field refuses stays in it, in red and with the reason next to it, until it is corrected", "[inspector]")
{
    const juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;
    juce::LookAndFeel::setDefaultLookAndFeel (&look);
    {
        const auto sheet = sheetOfNumber ("x", unit::metre, "", { .hard = { 0, 1 }, .usual = { 0, 0.1 } }, 0.01);
        juce::Component window;
        NumberField field (sheet);
        window.setBounds (0, 0, 400, 200);
        field.setBounds (200, 20, 120, 24);
        window.addAndMakeVisible (field);
        field.setTooltip ("a length");
        field.show (Json ("5 mm"));
        int changes = 0;
        field.onChange = [&] (const std::optional<Json>&, bool) { ++changes; };
        const auto editor = [&] { return dynamic_cast<juce::TextEditor*> (field.getChildComponent (field.getNumChildComponents() - 1)); };

        field.openEditor();
        editor()->setText ("5 mmm");
        editor()->onReturnKey();
        REQUIRE (field.isEditing());
        CHECK (editor()->getText() == "5 mmm");
        CHECK (editor()->findColour (juce::TextEditor::focusedOutlineColourId) == look.theme().stop);
        CHECK (field.whyRefused().isNotEmpty());
        REQUIRE (window.getNumChildComponents() == 2);   // the reason
        CHECK (window.getLocalBounds().contains (window.getChildComponent (1)->getBounds()));
        CHECK_FALSE (window.getChildComponent (1)->getBounds().intersects (field.getBounds()));

        editor()->onFocusLost();
        CHECK_FALSE (field.isEditing());
        CHECK (field.refused() == "5 mmm");
        CHECK (field.getTooltip() == field.whyRefused());
        CHECK (window.getNumChildComponents() == 1);
        field.show (Json ("5 mm"));   // nothing else has changed
        CHECK (field.refused() == "5 mmm");

        field.openEditor();
        CHECK (editor()->getText() == "5 mmm");
        editor()->setText ("6 mm");
        editor()->onReturnKey();
        CHECK_FALSE (field.isEditing());
        CHECK (field.refused().isEmpty());
        CHECK (field.getTooltip() == "a length");
        CHECK (changes == 1);

        field.openEditor();
        editor()->setText ("-1 m");
        editor()->onReturnKey();
        CHECK (field.refused() == "-1 m");
        editor()->onEscapeKey();
        CHECK (field.refused().isEmpty());
        CHECK (field.shown().toText() == "6 mm");
        field.type ("2 m");
        CHECK (field.refused() == "2 m");
        field.show (Json ("7 mm"));   // an undo
        CHECK (field.refused().isEmpty());
    }
    juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
}

TEST_CASE ("editing a driven parameter moves its control, and releasing it keeps the value", "[inspector]")
{
    InspectorRig rig ("layered_cloth.json");
    rig.select ("drag");
    REQUIRE (controlOf (rig.document->graph(), "drag.d_max"));
    auto* field = rig.in<NumberField> ("d_max");
    REQUIRE (field != nullptr);
    CHECK (field->shown().si() == Approx (0.8e-3));
    field->type ("1.15 mm");
    CHECK (rig.document->graph().controls[1].value == Approx (0.75));
    CHECK (rig.node ("drag").params["d_max"] == "0.8 mm");
    field->type ("9 mm");
    CHECK (rig.hints.size() == 1);
    CHECK (rig.document->graph().controls[1].value == Approx (0.75));
    CHECK (field->shown().si() == Approx (1.15e-3));

    const auto face = faceOf (rig.document->graph(), rig.document->graph().root, rig.node ("drag"), catalogue());
    const auto before = rig.document->history().names().size();
    release (*rig.document, {}, "drag", *face.find (Role::param, "d_max"), catalogue());
    CHECK_FALSE (controlOf (rig.document->graph(), "drag.d_max"));
    CHECK (rig.node ("drag").params["d_max"] == "1.15 mm");
    CHECK (rig.document->history().names().size() == before + 1);
}

TEST_CASE ("a parameter can be assigned to a control with its usual range, or to a new one at its current value", "[inspector]")
{
    InspectorRig rig ("layered_cloth.json");
    const auto port = [&] (const char* id) {
        const auto face = faceOf (rig.document->graph(), rig.document->graph().root, rig.node ("drag"), catalogue());
        return *face.find (Role::param, id);
    };
    controlBy (*rig.document, {}, "drag", port ("mu"), "drape", catalogue());
    REQUIRE (rig.document->graph().controls[1].to.size() == 2);
    CHECK (rig.document->graph().controls[1].to[1].path == "drag.mu");
    controlBy (*rig.document, {}, "drag", port ("break_away"), "", catalogue());
    REQUIRE (rig.document->graph().controls.size() == 3);
    const auto& made = rig.document->graph().controls[2];
    CHECK (made.id == "break_away");
    CHECK (made.name == "Break away");
    const auto param = controlOf (rig.document->graph(), "drag.break_away");
    REQUIRE (param);
    CHECK (param->value == Approx (0.7));
    CHECK (compile (rig.document->graph(), catalogue()).plan != nullptr);
}

TEST_CASE ("an exposed param can be set from outside, and defaults to the value inside", "[inspector]")
{
    auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/layered_cloth.json").graph;
    g.controls.clear();
    for (auto& n : g.graphs.front().second.nodes)
        if (n.name == "warp") n.params["amplitude"] = "70 mN";
    InspectorRig rig (std::move (g));
    rig.select ("threads");
    auto* warp = rig.in<NumberField> ("warp");
    REQUIRE (warp != nullptr);
    CHECK (warp->shown().toText() == "40 mN");
    warp->type ("55 mN");
    CHECK (rig.node ("threads").params["warp"] == "55 mN");
    CHECK (compile (rig.document->graph(), catalogue()).plan != nullptr);

    warp->onChange (std::nullopt, false);
    CHECK_FALSE (rig.node ("threads").params.contains ("warp"));
    CHECK (warp->shown().toText() == "70 mN");   // the value inside the subgraph

    rig.in<NumberField> ("count")->type ("3");
    CHECK (rig.node ("threads").extra["count"] == 3);
}

TEST_CASE ("an override changes a value inside a subgraph for one node only", "[inspector]")
{
    InspectorRig rig ("layered_cloth.json");
    rig.select ("threads");
    write (rig.in<TextField> ("add override"), "warp.spatial_frequency = 650 1/m");
    CHECK (rig.node ("threads").overrides["warp.spatial_frequency"] == "650 1/m");
    CHECK (compile (rig.document->graph(), catalogue()).plan != nullptr);
    write (rig.in<TextField> ("warp.spatial_frequency"), "600");
    CHECK (rig.node ("threads").overrides["warp.spatial_frequency"] == 600);
    write (rig.in<TextField> ("warp.spatial_frequency"), "");
    CHECK (rig.node ("threads").overrides.empty());
    write (rig.in<TextField> ("add override"), "nonsense");
    CHECK (rig.hints.size() == 1);
}

TEST_CASE ("a mode can be added, changed and removed, and the plot follows", "[inspector]")
{
    InspectorRig rig ("bronze_bell.json");
    rig.select ("warble");
    CHECK (rig.all<TableRow>().size() == 2);
    REQUIRE (press (rig, "+ mode"));
    CHECK (rig.all<TableRow>().size() == 3);
    CHECK (rig.node ("warble").settings["modes"][2] == rig.node ("warble").settings["modes"][1]);

    std::vector<NumberField*> cells;
    InspectorRig::collect (*rig.all<TableRow>()[2], cells);
    REQUIRE (cells.size() == 3);
    cells[0]->type ("400");
    CHECK (rig.node ("warble").settings["modes"][2]["frequency"] == "400 Hz");
    const auto plot = *rig.all<PlotBlock>().front()->plot();
    CHECK (plot.x == std::vector<double> { 228.0, 275.0, 400.0 });

    REQUIRE (press (rig, "\xc3\x97"));   // the cross of the first row
    CHECK (rig.node ("warble").settings["modes"].size() == 2);
    CHECK (rig.node ("warble").settings["modes"][1]["frequency"] == "400 Hz");
    for (int i = 0; i < 3; ++i)
        rig.document->undo();
    CHECK_FALSE (rig.document->isChanged());
    CHECK (rig.all<TableRow>().size() == 2);
}

TEST_CASE ("a law keeps about the same stiffness when its kind changes, and is plotted with units", "[inspector]")
{
    InspectorRig rig ("bronze_bell.json");
    rig.select ("blow");
    const auto before = *rig.all<PlotBlock>().front()->plot();
    CHECK (before.x_unit == "m");
    CHECK (before.y_unit == "N");
    auto* kind = rig.in<juce::ComboBox> ("kind");
    REQUIRE (kind != nullptr);
    for (const int id : { 3, 4, 2 })   // exponential, table, power
    {
        kind = rig.in<juce::ComboBox> ("kind");
        kind->setSelectedId (id, juce::sendNotificationSync);
        const auto drawn = *rig.all<PlotBlock>().front()->plot();
        REQUIRE_FALSE (drawn.x.empty());
        // At the deflection where the first law gave 1 N, it still gives about 1 N.
        const double at = std::pow (1.0 / 500000.0, 1.0 / 1.5);
        std::size_t nearest = 0;
        for (std::size_t i = 0; i < drawn.x.size(); ++i)
            if (std::abs (drawn.x[i] - at) < std::abs (drawn.x[nearest] - at)) nearest = i;
        CHECK (drawn.y[nearest] == Approx (1.0).epsilon (0.15));
        CHECK (compile (rig.document->graph(), catalogue()).plan != nullptr);
    }
    auto* k = rig.in<NumberField> ("k");
    REQUIRE (k != nullptr);
    k->type ("2000");
    CHECK (rig.node ("blow").settings["stiffness"]["power"][0] == 2000.0);
}

TEST_CASE ("the description of a device is shown value by value, not as JSON, and values can be added and removed", "[inspector]")
{
    InspectorRig rig ("dry_wood.json");
    rig.select ("motor");
    for (const auto* field : rig.all<juce::TextEditor>())
        CHECK_FALSE (field->getText().containsAnyOf ("{}[]\""));
    const auto device = [&] { return rig.document->graph().devices[0].second; };
    CHECK (rig.in<TextField> ("hand offset")->getText() == "0 mm, 0 mm, -1 mm");
    write (rig.in<TextField> ("hand offset"), "0 mm, 2 mm, -1 mm");
    CHECK (device()["hand"]["offset"] == Json::array ({ "0 mm", "2 mm", "-1 mm" }));
    write (rig.in<TextField> ("add value"), "hand start = 0.5");
    CHECK (device()["hand"]["start"] == 0.5);
    write (rig.in<TextField> ("hand start"), "");
    CHECK_FALSE (device()["hand"].contains ("start"));
    write (rig.in<TextField> ("add value"), "nonsense");
    CHECK (rig.hints.back().find ("mass = 50 g") != std::string::npos);
    CHECK (device()["hand"].contains ("stiffness"));
}

TEST_CASE ("the inspector of a subgraph explains count, every, times and overrides", "[inspector]")
{
    InspectorRig rig ("layered_cloth.json");
    const auto subgraph = std::ranges::find_if (rig.document->graph().root.nodes, [] (const auto& n) { return n.type.starts_with ("graph:"); });
    REQUIRE (subgraph != rig.document->graph().root.nodes.end());
    rig.select (subgraph->name);
    rig.inspector->setSize (304, 3000);
    juce::String all;
    for (const auto& t : host::test::readTexts (*rig.inspector))
        all << t.text << ' ';
    for (const auto* word : { "count: how many copies", "every: they run only", "times: they run n times", "An override gives" })
    {
        INFO (word);
        CHECK (all.contains (word));
    }
}

TEST_CASE ("roles, devices and the graph's header can be edited", "[inspector]")
{
    InspectorRig rig ("bronze_bell.json");
    rig.select ("motor");
    write (rig.in<TextField> ("mass"), "80 g");
    CHECK (rig.document->graph().devices[0].second["mass"] == "80 g");
    write (rig.in<TextField> ("hand stiffness"), "700");
    CHECK (rig.document->graph().devices[0].second["hand"]["stiffness"] == 700);
    rig.document->undo();
    rig.document->undo();
    CHECK_FALSE (rig.document->isChanged());

    rig.inspector->inspect ({}, {});
    write (rig.in<TextField> ("name"), "Gong");
    CHECK (rig.document->graph().name == "Gong");
    write (rig.in<TextField> ("tags"), "metal, loud ,");
    CHECK (rig.document->graph().tags == std::vector<std::string> { "metal", "loud" });
    rig.in<NumberField> ("rate")->type ("4000");
    CHECK (rig.document->graph().rate_hz == 4000.0);
    REQUIRE (press (rig, "+ control"));
    CHECK (rig.document->graph().controls.size() == 5);
}

TEST_CASE ("a wire can be re-plugged, delayed, scaled and disabled", "[inspector]")
{
    InspectorRig rig ("bronze_bell.json");
    const auto wire = [&]() -> const graph::Wire& { return rig.document->graph().root.wires.front(); };
    rig.inspector->inspect ({}, { wire().id });
    rig.in<NumberField> ("delay")->type ("2");
    CHECK (wire().delay == 2);
    write (rig.in<TextField> ("gain"), "0.5");
    CHECK (wire().gain == 0.5);
    write (rig.in<TextField> ("gain"), "");
    CHECK (wire().gain.is_null());
    rig.in<ToolButton> ("enabled")->onClick();
    CHECK (wire().enabled == false);
    rig.in<ToolButton> ("enabled")->onClick();
    CHECK_FALSE (wire().enabled);
    write (rig.in<TextField> ("to"), "touch.depth");
    CHECK (graph::toText (wire().to) == "touch.depth");
    write (rig.in<TextField> ("to"), "no port");
    CHECK (rig.hints.size() == 1);
    CHECK (graph::toText (wire().to) == "touch.depth");
}

TEST_CASE ("a node can be renamed, but not to a name that is taken", "[inspector]")
{
    InspectorRig rig ("bronze_bell.json");
    rig.select ("ring");
    write (rig.all<TextField>().front(), "hum");
    REQUIRE (rig.document->graph().root.find ("hum") != nullptr);
    CHECK (rig.all<TextField>().front()->getText() == "hum");
    write (rig.all<TextField>().front(), "blow");
    CHECK (rig.document->graph().root.find ("hum") != nullptr);
    CHECK (rig.all<TextField>().front()->getText() == "hum");
    REQUIRE (press (rig, "bypass"));
    CHECK (rig.node ("hum").bypass);
    REQUIRE (press (rig, "?"));
    CHECK (rig.inspector->showsHelp());
}

TEST_CASE ("a setting can be edited as JSON", "[inspector]")
{
    InspectorRig rig ("bronze_bell.json");
    rig.select ("warble");
    REQUIRE (press (rig, "JSON"));
    TextField* text = nullptr;
    for (auto* f : rig.all<TextField>())
        if (f->isMultiLine()) text = f;
    write (text, R"([{"frequency": 100, "decay": 10, "amplitude": 1}])");
    CHECK (rig.node ("warble").settings["modes"].size() == 1);
    REQUIRE (press (rig, "reset"));
    CHECK_FALSE (rig.node ("warble").settings.contains ("modes"));
}

TEST_CASE ("of a long value as JSON, the inspector shows the beginning and its length, and all of it on demand, with spaces to break its lines at",
           "[inspector]")
{
    InspectorRig rig ("nodule_under_skin.json");
    rig.select ("skin");
    const auto field = [&] {
        TextField* shown = nullptr;
        for (auto* f : rig.all<TextField>())
            if (f->getText().startsWithChar ('{') && f->getParentComponent()->isVisible()) shown = f;
        REQUIRE (shown != nullptr);
        return shown;
    };
    REQUIRE (press (rig, "JSON"));
    const auto before = rig.node ("skin").settings["surface"];
    REQUIRE (before.dump().size() > 10'000);
    CHECK (field()->isReadOnly());
    CHECK (field()->getText().length() <= 2002);
    field()->apply();   // as when it loses the keyboard
    CHECK_FALSE (rig.document->isChanged());

    std::string offer;
    for (const auto* b : rig.all<ToolButton>())
        if (b->getButtonText().startsWith ("Edit all") && b->isVisible()) offer = b->getButtonText().toStdString();
    REQUIRE (press (rig, offer));
    const auto whole = field()->getText();
    CHECK (offer == "Edit all " + std::to_string (whole.length()) + " characters");
    CHECK_FALSE (field()->isReadOnly());
    CHECK (Json::parse (whole.toStdString()) == before);
    int longest = 0;
    for (const auto& word : juce::StringArray::fromTokens (whole, " ", {}))
        longest = std::max (longest, word.length());
    CHECK (longest < 40);   // JUCE lays out a longer word again for each of its lines
    write (field(), whole.replace ("\"mu\": ", "\"mu\":  ").toStdString());
    CHECK (rig.node ("skin").settings["surface"] == before);
    write (field(), R"({"mesh": "a \"new\", one: of\\", "mu": 0.5})");
    CHECK (rig.node ("skin").settings["surface"]["mesh"] == "a \"new\", one: of\\");
    CHECK (field()->getText() == R"({"mesh": "a \"new\", one: of\\", "mu": 0.5})");
}

TEST_CASE ("a mesh that is chosen for a surface without curves brings the curves of the default surface, so that it can be felt", "[inspector]")
{
    InspectorRig rig ("liver.json");
    const auto liver = std::ranges::find (rig.document->graph().root.nodes, "deform.surface", &graph::Node::type)->name;
    const auto mesh = rig.node (liver).settings["surface"]["mesh"].get<std::string>();
    REQUIRE (rig.document->perform (graph::SetSetting { {}, liver, "surface", std::nullopt }));
    rig.select (liver);
    TextField* field = nullptr;
    for (auto* f : rig.all<TextField>())
        if (f->getTooltip().startsWith ("OBJ, OFF")) field = f;
    REQUIRE (field != nullptr);
    write (field, mesh);
    const auto set = rig.node (liver).settings["surface"];
    CHECK (set["mesh"] == mesh);
    REQUIRE (set.contains ("curves"));
    CHECK (set["curves"][0][2] == Json::parse (R"({ "power": [1000, 1] })"));
    CHECK (set["mu"] == 0.5);
    rig.document->undo();
    CHECK_FALSE (rig.node (liver).settings.contains ("surface"));   // one step
}

TEST_CASE ("a law is plotted as one line across the plot", "[inspector]")
{
    const juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;
    Law law;
    law.kind = Law::Kind::power;
    law.a = 1000.0;
    juce::Image image (juce::Image::ARGB, 260, 130, true);
    {
        juce::Graphics g (image);
        paintPlot (g, { 0.0f, 0.0f, 260.0f, 130.0f }, plotOf (law, unit::metre, unit::newton), look);
    }
    const auto ink = look.theme().of (Quantity::force);
    int columns = 0;
    for (int x = 0; x < image.getWidth(); ++x)
        for (int y = 0; y < image.getHeight(); ++y)
            if (image.getPixelAt (x, y) == ink)
            {
                ++columns;
                break;
            }
    CHECK (columns > 150);
}

TEST_CASE ("the inspector says how steep the contact of the selected node may become", "[app][inspector][limits]")
{
    using check::Verdict;
    InspectorRig rig { "granite_wall.json" };
    rig.select ("wall");
    const auto block = [&] {
        const auto all = rig.all<LimitBlock>();
        REQUIRE (all.size() == 1);
        return all.front();
    };
    CHECK (block()->getHeight() == 0);
    rig.inspector->showLimits ({ { "wall", "Simulated", Verdict::passive, 1.5, 0.0 }, { "other", "Simulated", Verdict::stable, 0.5, 2.0 } });
    const int one = block()->getHeight();
    CHECK (one > 0);
    rig.inspector->showLimits ({ { "wall", "Simulated", Verdict::passive, 1.5, 0.0 }, { "wall/inner", "Simulated", Verdict::stable, 0.5, 2.0 } });
    CHECK (block()->getHeight() > one);
    const auto text = [] (Verdict verdict, double passive, double stable) { return LimitBlock::textOf ({ "wall", "A", verdict, passive, stable }); };
    CHECK (text (Verdict::passive, 2.0, 0.0).startsWith ("Passive on A, up to 2 times"));
    CHECK (text (Verdict::passive_here, 2.0, 0.0).startsWith ("Passive on A along this motion"));
    CHECK (text (Verdict::stable, 0.5, 2.0).startsWith ("Stable on A with usual hands. The linear loop (no bounces) is stable up to 2 times this stiffness"));
    CHECK (text (Verdict::stable, 0.5, 0.75).startsWith ("It comes to rest in a trial with A"));   // dry friction holds it
    CHECK (text (Verdict::unstable, 0.5, 0.75).startsWith ("It swings on A"));
    CHECK (text (Verdict::unstable, 0.5, 2.0).startsWith ("The contact does not come to rest in a trial with A"));   // it bounces
    CHECK (LimitBlock::textOf ({ "wall", "A", Verdict::unstable, 0.5, 1.5, "drag" })
           == "drag swings on A, but wall does not: its linear loop (no bounces) rests up to 1.5 times this stiffness and damping; passive up to 0.5 times");
    rig.inspector->showLimits ({});
    CHECK (block()->getHeight() == 0);
}

TEST_CASE ("the bar of a contact is red only where its sentence says that it swings", "[app][inspector]")
{
    using check::Verdict;
    const auto parts = [] (Verdict verdict, double passive, double stable) { return LimitBlock::partsOf ({ "wall", "A", verdict, passive, stable }); };
    constexpr double none = std::numeric_limits<double>::infinity();
    const auto is = [] (const LimitBlock::Parts& p, double passive, double stable, double swings) {
        return p.passive == passive && p.stable == stable && p.swings == swings && p.end > 1.0;
    };
    CHECK (is (parts (Verdict::passive, 2.0, 4.0), 2.0, 2.0, none));   // the sentence has only the first limit
    CHECK (is (parts (Verdict::passive_here, none, 0.0), none, none, none));
    CHECK (is (parts (Verdict::stable, 0.5, 2.0), 0.5, 2.0, 2.0));
    CHECK (is (parts (Verdict::stable, 0.15, 0.75), 0.15, 1.0, none));   // it came to rest in a trial, so the mark is not in red
    CHECK (is (parts (Verdict::unstable, 0.5, 0.75), 0.5, 0.75, 0.75));
    CHECK (is (parts (Verdict::unstable, 0.5, 2.0), 0.5, 0.5, 1.0));   // only the trial shows it
    CHECK (is (parts (Verdict::unstable, 1.5, 0.0), 0.0, 0.0, 1.0));
    CHECK (is (LimitBlock::partsOf ({ "wall", "A", Verdict::unstable, 0.5, 1.5, "drag" }), 0.5, 1.5, 1.5));   // drag swings, and wall does not
    CHECK (is (parts (Verdict::broken, 0.5, 0.0), 0.5, 0.5, none));
    CHECK (LimitBlock::textOf ({ "wall", "A", Verdict::unstable, 0.5, 2.0 }).contains ("passive up to 0.5"));
}
