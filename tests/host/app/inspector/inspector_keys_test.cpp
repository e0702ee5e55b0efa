// SPDX-License-Identifier: GPL-3.0-or-later
// The keyboard in the inspector, and what is typed there.
#include "host/app/support/desk_stage.hpp"

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::waitFor;

TEST_CASE ("a key that erases or moves is for the value that has the focus, not for the selected node", "[app][keyboard]")
{
    DeskStage w ("dry_wood.json");
    const auto board = [&]() -> const graph::Node& { return *w.graph().root.find ("board"); };
    const auto params = board().params, at = board().extra;   // and where it is
    w.canvas.select ({ board().id });
    DeskStage::settle();
    w.key ("return");   // to its first value
    w.key ("cursor right");
    CHECK (board().params != params);
    CHECK (board().extra == at);
    w.key ("cursor left");
    CHECK (board().extra == at);

    for (const char* key : { "backspace", "delete" })
    {
        w.key (key);   // begins to type
        REQUIRE (w.graph().root.find ("board") != nullptr);
        w.stage->type ("900");
        w.key ("return");
        CHECK (board().params.dump().find ("900") != std::string::npos);
        w.key (key);
        w.key ("escape");
        REQUIRE (w.graph().root.find ("board") != nullptr);
        CHECK (board().params.dump().find ("900") != std::string::npos);
        w.key ("return");
        REQUIRE (w.graph().root.find ("board") != nullptr);
    }
}

TEST_CASE ("the words about a graph are in it while they are typed", "[app][keyboard][files]")
{
    DeskStage w ("dry_wood.json");
    const auto before = w.graph().about;
    const auto type = [&] (const juce::String& text) {
        w.clickTitled ("about");
        w.key ("ctrl + a");
        w.stage->type (text);
    };
    const auto steps = w.document.history().position();
    type ("It squeaks");
    CHECK (waitFor ([&] { return w.graph().about == "It squeaks"; }));
    w.stage->type (" ");
    w.stage->type ("a lot");
    CHECK (waitFor ([&] { return w.graph().about == "It squeaks a lot"; }));
    CHECK (w.document.history().position() == steps + 1);
    w.key ("escape");
    CHECK (w.graph().about == "It squeaks a lot");
    w.key ("ctrl + z");
    CHECK (w.graph().about == before);

    // Another edit is now where that of the text was, and is no part of the next one.
    REQUIRE (w.document.perform (graph::SetParam { "", "drag", "mu", Json (0.7) }));
    CHECK (w.document.history().position() == steps + 1);
    type ("It hums");
    w.key ("return");
    CHECK (w.graph().about == "It hums");
    w.key ("ctrl + z");
    CHECK (w.graph().about == before);
    CHECK (w.graph().root.find ("drag")->params.at ("mu") == 0.7);
}
