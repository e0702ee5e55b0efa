// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/hand.hpp"

#include <host/app/inspector/blocks/number_field.hpp>
#include <host/app/inspector/settings/file_text.hpp>
#include <host/app/inspector/settings/law_shape.hpp>
#include <host/app/inspector/settings/setting_editor.hpp>
#include <host/app/model/controlled_param.hpp>
#include <host/app/model/param_value.hpp>
#include <host/base/assets/file_assets.hpp>
#include <tactus/graph/edit.hpp>
#include <tactus/graph/history.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

using namespace tactus;
using namespace tactus::host;

TEST_CASE ("a file is described, or its problem reported", "[inspector]")
{
    FileAssets assets;
    const std::string folder = TACTUS_SOURCE_DIR "/graphs";
    const auto mesh = describeFile ("assets/liver.obj", SettingSheet::Kind::surface, folder, assets);
    CHECK_FALSE (mesh.is_problem);
    CHECK (mesh.text.find ("vertices") != std::string::npos);
    const auto image = describeFile ("assets/leather.png", SettingSheet::Kind::image, folder, assets);
    CHECK (image.picture != nullptr);
    CHECK (image.text.find ("pixels") != std::string::npos);
    CHECK (describeFile ("assets/heartbeat.haptic", SettingSheet::Kind::table, folder, assets).text.find (" s long, 1 track") != std::string::npos);
    CHECK (describeFile ("assets/none.png", SettingSheet::Kind::image, folder, assets).is_problem);
    CHECK (describeFile ("assets/leather.py", SettingSheet::Kind::signal, folder, assets).is_problem);
    CHECK_FALSE (describeFile ("", SettingSheet::Kind::image, folder, assets).is_problem);
}

TEST_CASE ("a chosen file is stored relative to the graph", "[inspector]")
{
    const std::string folder = TACTUS_SOURCE_DIR "/graphs";
    CHECK (pathFrom (folder + "/assets/liver.obj", folder) == "assets/liver.obj");
    CHECK (pathFrom (TACTUS_SOURCE_DIR "/nodes/x.wav", folder) == "../nodes/x.wav");
    CHECK (pathFrom ("/somewhere/x.wav", "") == "/somewhere/x.wav");
}

TEST_CASE ("moving a control for a parameter sets its value, but only within the range", "[inspector]")
{
    CHECK (rc::check ([] {
        const double low = *rc::gen::inRange (-100, 100) * 0.1;
        const auto other = rc::gen::suchThat (rc::gen::inRange (-100, 100), [low] (int v) { return v * 0.1 != low; });
        const double high = *other * 0.1;
        graph::Graph g;
        graph::Node a;
        a.name = "a";
        g.root.nodes.push_back (a);
        graph::Control c;
        c.id = c.name = "c";
        c.to.push_back ({ "a.x", low, high });
        g.controls.push_back (c);
        graph::History history (std::move (g));
        const auto param = controlOf (history.graph(), "a.x");
        RC_ASSERT (param.has_value());
        const double wanted = low + (high - low) * *rc::gen::inRange (0, 1001) * 1e-3;
        const auto command = moveControlFor (history.graph(), *param, wanted);
        RC_ASSERT (command.has_value());
        RC_ASSERT (history.perform (*command).has_value());
        RC_ASSERT (std::abs (controlOf (history.graph(), "a.x")->value - wanted) < 1e-5 * std::abs (high - low));
        RC_ASSERT (! moveControlFor (history.graph(), *param, high + 0.1 * (high - low)));
    }));
}

TEST_CASE ("a law can be converted to any kind and agrees at 1 N", "[inspector]")
{
    Law spring;
    spring.kind = Law::Kind::power;
    spring.a = 2000.0;
    for (const auto& kind : lawKinds())
    {
        const auto law = lawOfKind (kind, spring);
        CHECK (lawKindOf (law) == kind);
        if (kind == "power") CHECK (law["power"][0].get<double>() == Approx (2000.0).epsilon (0.01));
        if (kind == "exponential")
        {
            const auto a = law["exponential"][0].get<double>(), b = law["exponential"][1].get<double>();
            CHECK (a * std::expm1 (b * 0.5e-3) == Approx (1.0).epsilon (0.02));
        }
        if (kind == "table") CHECK (law["table"][1][2].get<double>() == Approx (1.0).epsilon (0.01));
    }
}

TEST_CASE ("each new control has an id and a name of its own", "[inspector]")
{
    graph::Graph g;
    for (const char* node : { "drag", "wall", "skin" })
        REQUIRE (graph::apply (g, newControlFor (g, std::string (node) + ".break_away", 0.0, 1.0, 0.5), graph::Checks::none));
    for (int i = 0; i < 2; ++i)
        REQUIRE (graph::apply (g, newControl (g), graph::Checks::none));
    std::vector<std::string> ids, names;
    for (const auto& c : g.controls)
    {
        ids.push_back (c.id);
        names.push_back (c.name);
    }
    CHECK (ids == std::vector<std::string> { "break_away", "break_away_2", "break_away_3", "control", "control_2" });
    CHECK (names == std::vector<std::string> { "Break away", "Break away 2", "Break away 3", "Control", "Control 2" });
}

TEST_CASE ("a control gets the usual range of a parameter, in the unit it is written in", "[inspector]")
{
    PortSheet sheet { Role::param, "x", unit::metre, "", { .hard = { 0, inf }, .usual = { 1e-5, 1e-3 } }, {}, 1, false, 0, { 1e-4, 0, 0 } };
    const auto [low, high] = sweepOf (Json ("0.4 mm"), sheet);
    CHECK (low == "0.01 mm");
    CHECK (high == "1 mm");
    sheet.limits.usual = { 0, inf };
    CHECK (sweepOf (Json (0.2), sheet).second == 0.4);
}

TEST_CASE ("a number is dragged to the right and up, a tenth as far with Shift, and a press alone keeps all its digits", "[inspector]")
{
    const juce::ScopedJuceInitialiser_GUI juce_runs;
    Look look;
    juce::LookAndFeel::setDefaultLookAndFeel (&look);
    {
        const auto sheet = sheetOfNumber ("x", unit::newton, "", { .hard = { -10, 10 }, .usual = { 0, 2 } }, 0.0);   // 200 pixels are 2 N
        NumberField field (sheet);
        field.setBounds (0, 0, 120, 24);
        std::vector<bool> continues;
        field.onChange = [&] (const std::optional<Json>&, bool c) { continues.push_back (c); };
        host::test::Hand hand (field);
        const juce::Point<float> at (60.0f, 12.0f);
        const auto draggedBy = [&] (float x, float y, int keys = 0) {
            field.show (Json (1.0));
            continues.clear();
            hand.drag (at, at + juce::Point<float> (x, y), host::test::Hand::left (keys));
            CHECK (std::ranges::count (continues, false) == 1);   // one step
            return field.shown().si() - 1.0;
        };
        CHECK (draggedBy (50.0f, 0.0f) == Approx (0.5));
        CHECK (draggedBy (-50.0f, 0.0f) == Approx (-0.5));
        CHECK (draggedBy (0.0f, -50.0f) == Approx (0.5));
        CHECK (draggedBy (0.0f, 50.0f) == Approx (-0.5));
        CHECK (draggedBy (50.0f, 0.0f, juce::ModifierKeys::shiftModifier) == Approx (0.05));
        CHECK (draggedBy (0.0f, -50.0f, juce::ModifierKeys::shiftModifier) == Approx (0.05));

        field.show (Json (1.0));
        hand.press (at);   // Shift in the middle of a drag: no jump
        hand.dragTo (at + juce::Point<float> (50.0f, 0.0f));
        hand.dragTo (at + juce::Point<float> (50.0f, 0.0f), host::test::Hand::left (juce::ModifierKeys::shiftModifier));
        CHECK (field.shown().si() == Approx (1.5));
        hand.dragTo (at + juce::Point<float> (60.0f, 0.0f), host::test::Hand::left (juce::ModifierKeys::shiftModifier));
        CHECK (field.shown().si() == Approx (1.51));
        hand.release (at);

        field.show (Json (1.23456789));
        continues.clear();
        hand.press (at);
        hand.dragTo (at);
        hand.release (at);
        CHECK (continues.empty());
        CHECK (field.shown().si() == 1.23456789);
    }
    juce::LookAndFeel::setDefaultLookAndFeel (nullptr);
}
