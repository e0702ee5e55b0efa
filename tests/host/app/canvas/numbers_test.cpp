// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers on a node.
#include "host/app/support/canvas_rig.hpp"

#include <host/app/model/quantity_text.hpp>
#include <tactus/run/turn.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

TEST_CASE ("a node shows six digits of a long number, and an edit of it that changes nothing keeps them all", "[app][canvas]")
{
    const auto [written, shown] = GENERATE (std::pair { Json ("569.343065693 mN"), "569.343 mN" }, std::pair { Json (0.123456789), "123.457 mN" },
                                            std::pair { Json ("0.30 N"), "0.30 N" }, std::pair { Json ("100 mN"), "100 mN" });
    CAPTURE (shown);
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    auto g = rig.graph();
    g.controls.clear();
    std::ranges::find (g.root.nodes, "grain", &graph::Node::name)->params["amplitude"] = written;
    rig.document.open (std::move (g), {}, "open");
    rig.canvas->frameStart();
    const auto value = rig.node ("grain").box.find (Role::param, "amplitude")->value;
    CHECK (value == shown);

    rig.hand().doubleClick (rig.value ("grain", "amplitude"));
    auto* editor = dynamic_cast<juce::TextEditor*> (rig.canvas->getChildComponent (0));
    REQUIRE (editor != nullptr);
    CHECK (editor->getText() == juce::String (value));
    const auto position = rig.document.history().position();
    editor->onReturnKey();
    CHECK (rig.graph().root.find ("grain")->params["amplitude"] == written);
    CHECK (rig.document.history().position() == position);
}

TEST_CASE ("every unit that is shown can be typed: what a node shows of a parameter reads back as the same value", "[app][canvas][units]")
{
    int seen = 0;
    for (const auto& type : catalogue())
        for (const auto& sheet : type.params)
        {
            if (! sheet.choices.empty() || sheet.width != 1) continue;
            FacePort port;
            port.sheet = &sheet;
            port.unit = sheet.unit;
            const auto& hard = sheet.limits.hard;
            for (const double v : { sheet.initial[0], sheet.limits.usual.min, sheet.limits.usual.max, 0.03, 3.0 })
            {
                if (! std::isfinite (v) || ! hard.contains (v)) continue;
                const auto shown = valueText (Json (v), port);
                const auto read = readQuantity (readValue (shown), sheet);
                INFO (type.info.id << "." << sheet.id << ": " << shown << (read ? std::string() : " | " + read.error().text));
                REQUIRE (read);
                CHECK (read->si() == Approx (v).epsilon (1e-5));
                CHECK (valueText (read->toJson(), port) == shown);
                CHECK (read->toText().find ("\xc2\xb7") == std::string::npos);   // files have "*"
                ++seen;
            }
        }
    CHECK (seen > 500);
}

TEST_CASE ("a damping on a node can be dragged, and typed with the unit that it shows", "[app][canvas][units]")
{
    CanvasRig rig { CanvasRig::preset ("templates/stroke") };
    const auto damping = [&] { return rig.graph().root.find ("wall")->params.at ("damping").asString(); };
    const auto at = rig.value ("wall", "damping");
    const auto place = rig.node ("wall").at;
    REQUIRE (damping() == "0.3 N*s/m");
    rig.hand().drag (at, at.translated (40.0f, 0.0f));
    CHECK (rig.node ("wall").at == place);
    CHECK (damping() != "0.3 N*s/m");

    rig.hand().doubleClick (rig.value ("wall", "damping"));
    auto* editor = dynamic_cast<juce::TextEditor*> (rig.canvas->getChildComponent (0));
    REQUIRE (editor != nullptr);
    const auto unit = editor->getText().fromFirstOccurrenceOf (" ", true, false);
    CHECK (unit == juce::String::fromUTF8 (" N\xc2\xb7s/m"));
    editor->setText ("0.45" + unit);
    editor->onReturnKey();
    CHECK (rig.hint == "");
    CHECK (damping() == "0.45 N*s/m");
}

TEST_CASE ("a number that is typed on a node without a unit is in the unit that the node shows, as in the inspector", "[app][canvas][units]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto typed = [&] (const char* param, const char* text) {
        rig.hand().doubleClick (rig.value ("drag", param));
        auto* editor = dynamic_cast<juce::TextEditor*> (rig.canvas->getChildComponent (0));
        REQUIRE (editor != nullptr);
        editor->setText (text);
        editor->onReturnKey();
        CHECK (rig.hint == "");
        return rig.graph().root.find ("drag")->params.at (param);
    };
    CHECK (typed ("d_max", "0.9") == Json ("0.9 mm"));
    CHECK (typed ("d_max", "80 um") == Json ("80 um"));
    CHECK (typed ("d_max", "70") == Json ("70 um"));
    CHECK (typed ("static_ratio", "1.4") == Json (1.4));
}

TEST_CASE ("a vector is typed on its node, with or without parentheses and commas", "[app][canvas]")
{
    const auto text = GENERATE (as<std::string> {}, "(0, 1, 0.5)", "0 1 0.5", "0, 1, 0.5");
    CAPTURE (text);
    CanvasRig rig { CanvasRig::preset ("templates/stroke") };
    const auto type = [&] (const std::string& typed) {
        rig.hand().doubleClick (rig.value ("wall", "normal"));
        auto* editor = dynamic_cast<juce::TextEditor*> (rig.canvas->getChildComponent (0));
        REQUIRE (editor != nullptr);
        CHECK (editor->getText().startsWith ("("));
        editor->setText (typed);
        editor->onReturnKey();
    };
    const auto normal = [&] {
        const auto& params = rig.graph().root.find ("wall")->params;
        return params.contains ("normal") ? params.at ("normal").dump() : std::string();
    };
    const auto before = normal();
    type ("(0, 1)");
    CHECK (normal() == before);
    CHECK (rig.hint.contains ("a vector has three components"));
    type (text);
    CHECK (Json::parse (normal()) == Json::array ({ 0.0, 1.0, 0.5 }));
}
