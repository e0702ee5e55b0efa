// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/wait_for.hpp"

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using host::test::waitFor;

namespace
{
juce::TextEditor* editorOn (const CanvasRig& rig)
{
    for (auto* child : rig.canvas->getChildren())
        if (auto* editor = dynamic_cast<juce::TextEditor*> (child)) return editor;
    return nullptr;
}
}   // namespace

TEST_CASE ("F2 renames the selected node where it is, and makes a name of what is typed", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.hand().click (rig.title ("drag"));
    const auto wires = rig.graph().root.wires.size();
    const auto rename = [&] (const char* to) {
        rig.hand().key ("F2");
        auto* editor = editorOn (rig);
        REQUIRE (editor != nullptr);
        editor->setText (to);
        editor->onReturnKey();
    };
    rename (" Dry Drag");
    CHECK (editorOn (rig) == nullptr);
    REQUIRE (rig.graph().root.find ("dry_drag") != nullptr);
    CHECK (rig.graph().root.wires.size() == wires);

    rename ("grain");   // taken: the text stays for another try
    REQUIRE (editorOn (rig) != nullptr);
    CHECK (rig.graph().root.find ("dry_drag") != nullptr);
    editorOn (rig)->onEscapeKey();
    CHECK (editorOn (rig) == nullptr);

    rig.hand().key ("ctrl + z");
    CHECK (rig.graph().root.find ("drag") != nullptr);
    CHECK (rig.document.history().names().size() == 1);
}

TEST_CASE ("the text of a note or of a region is in the graph while it is typed, as one step of the history", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const bool is_region = GENERATE (false, true);
    if (is_region) rig.hand().click (rig.title ("drag"));
    rig.hand().key ("n");
    REQUIRE (rig.canvas->scene().notes().at (0).isRegion() == is_region);
    const auto isText = [&] (const std::string& text) { return rig.canvas->scene().notes().at (0).text == text; };
    for (const char* text : { "a thought", "a thought, and another" })
    {
        REQUIRE (editorOn (rig) != nullptr);
        editorOn (rig)->setText (text);
        CHECK (waitFor ([&] { return isText (text); }));
    }
    CHECK (rig.document.history().names() == std::vector<std::string> { "add note", "edit note" });
    rig.hand().key ("tab");   // ends the editor
    CHECK (editorOn (rig) == nullptr);
    rig.document.undo();
    CHECK (isText (""));
}

TEST_CASE ("Esc keeps the text of a note, and leaves a value as it was", "[app][canvas]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    rig.hand().key ("n");
    REQUIRE (editorOn (rig) != nullptr);
    editorOn (rig)->setText ("a long thought");
    editorOn (rig)->onEscapeKey();
    REQUIRE (rig.canvas->scene().notes().size() == 1);
    CHECK (rig.canvas->scene().notes()[0].text == "a long thought");

    rig.hand().key ("F2");   // the note is selected
    REQUIRE (editorOn (rig) != nullptr);
    CHECK (editorOn (rig)->getText() == "a long thought");
    editorOn (rig)->onEscapeKey();

    const auto before = rig.text();
    rig.hand().doubleClick (rig.value ("drag", "d_max"));
    REQUIRE (editorOn (rig) != nullptr);
    editorOn (rig)->setText ("0.2 mm");
    editorOn (rig)->onEscapeKey();
    CHECK (rig.text() == before);
}
