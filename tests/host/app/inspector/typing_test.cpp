// SPDX-License-Identifier: GPL-3.0-or-later
// What is typed into a field counts as soon as a key or a button does something with the graph, without Return.
#include "host/app/support/window_rig.hpp"

#include <tactus/file/graph_file.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;

namespace
{
/// A window with a graph that may be saved.
struct GraphDesk
{
    TemporaryFolder folder;
    std::filesystem::path file = folder / "mine.json";
    std::unique_ptr<WindowRig> w;

    GraphDesk()
    {
        std::filesystem::copy_file (TACTUS_SOURCE_DIR "/graphs/dry_wood.json", file);
        w = std::make_unique<WindowRig> (file.string(), 1280, 1000);   // the row of a parameter is in view
        w->stage->grabKeyboardFocus();                                 // as the window system does when it shows the window
    }

    void select (const std::string& node) { w->view->canvas().select ({ w->graph().root.find (node)->id }); }
    graph::Graph saved() const { return loadGraph (file).graph; }

    /// Begins to type into the field with this title, and does not end it.
    void type (const juce::String& field, const juce::String& text)
    {
        w->clickTitled (field);
        w->key ("ctrl + a");
        w->stage->type (text);
    }

    static NumberField* numberIn (juce::Component& c, const juce::String& title)
    {
        if (auto* field = dynamic_cast<NumberField*> (&c); field != nullptr && field->isShowing() && field->getTitle() == title) return field;
        for (auto* child : c.getChildren())
            if (auto* found = numberIn (*child, title)) return found;
        return nullptr;
    }

    /// The same for a number, which a double click opens.
    void typeNumber (const juce::String& field, const juce::String& text)
    {
        auto* c = numberIn (*w->view, field);
        REQUIRE (c != nullptr);
        w->stage->doubleClick (w->middleOf (*c));
        WindowRig::settle();
        REQUIRE (dynamic_cast<juce::TextEditor*> (WindowRig::focused()) != nullptr);
        w->key ("ctrl + a");
        w->stage->type (text);
    }
};
}   // namespace

TEST_CASE ("Ctrl+S saves what is being typed into a field", "[app][keyboard][files]")
{
    GraphDesk d;
    auto& w = *d.w;
    SECTION ("the words about the graph, and one goes on to type")
    {
        d.type ("about", "It squeaks");
        w.key ("ctrl + s");
        CHECK (d.saved().about == "It squeaks");
        CHECK_FALSE (w.view->document().isChanged());
        w.key ("end");
        w.stage->type (" a lot");
        w.key ("ctrl + s");
        CHECK (d.saved().about == "It squeaks a lot");
        w.key ("escape");   // it does not take back what is saved
        CHECK (w.graph().about == "It squeaks a lot");
    }
    SECTION ("the name of a node")
    {
        d.select ("drag");
        WindowRig::settle();
        d.type ("Name of the node", "scrub");
        w.key ("ctrl + s");
        CHECK (d.saved().root.find ("scrub") != nullptr);
        CHECK (d.saved().root.find ("drag") == nullptr);
    }
    SECTION ("a number")
    {
        d.select ("board");
        WindowRig::settle();
        d.typeNumber ("Stiffness", "777 N/m");
        w.key ("ctrl + s");
        CHECK (d.saved().root.find ("board")->params.at ("stiffness") == "777 N/m");
        CHECK_FALSE (w.view->document().isChanged());
        WindowRig::settle();
        w.key ("escape");
        CHECK (w.graph().root.find ("board")->params.at ("stiffness") == "777 N/m");
    }
    SECTION ("a number that is refused stays as it was, in the field and in the file")
    {
        d.select ("board");
        WindowRig::settle();
        const auto before = d.saved().root.find ("board")->params;
        d.typeNumber ("Stiffness", "-3");
        w.key ("ctrl + s");
        CHECK (d.saved().root.find ("board")->params == before);
    }
}

TEST_CASE ("what is being typed into a field is an unsaved change, and never gets into the next graph", "[app][keyboard][files]")
{
    GraphDesk d;
    auto& w = *d.w;
    REQUIRE_FALSE (w.view->document().isChanged());
    d.type ("about", "It squeaks");
    w.key ("ctrl + n");
    REQUIRE (w.view->asked().isOpen());   // whether to save it
    SECTION ("saved")
    {
        w.key ("return");
        CHECK (d.saved().about == "It squeaks");
    }
    SECTION ("not saved")
    {
        w.key ("cursor right");
        w.key ("return");
        CHECK (d.saved().about != "It squeaks");
    }
    WindowRig::settle();
    CHECK (w.graph().root.nodes.empty());
    CHECK (w.graph().about.empty());
    CHECK_FALSE (w.view->document().isChanged());
}

TEST_CASE ("F5 starts the graph with what is being typed into a field", "[app][keyboard]")
{
    GraphDesk d;
    auto& w = *d.w;
    d.select ("board");
    WindowRig::settle();
    d.typeNumber ("Stiffness", "777 N/m");
    w.key ("F5");
    CHECK (w.graph().root.find ("board")->params.at ("stiffness") == "777 N/m");
    for (int i = 0; i < 1000 && ! w.view->run().isRunning(); ++i)
        WindowRig::settle (10);
    CHECK (w.view->run().isRunning());
    w.view->run().letGo();
}

TEST_CASE ("a button acts on what is being typed into a field", "[app][keyboard][undo]")
{
    GraphDesk d;
    auto& w = *d.w;
    d.select ("board");
    WindowRig::settle();
    const auto stiffness = [&] { return w.graph().root.find ("board")->params.value ("stiffness", Json()); };
    const auto before = stiffness();

    d.typeNumber ("Stiffness", "777 N/m");
    w.clickTitled ("Undo");   // undoes what was typed
    CHECK (stiffness() == before);

    d.typeNumber ("Stiffness", "888 N/m");
    w.key ("return");
    d.typeNumber ("Stiffness", "999 N/m");
    w.clickTitled ("Snapshot 1");
    CHECK (stiffness() == "999 N/m");
    d.typeNumber ("Stiffness", "555 N/m");
    w.key ("return");
    w.clickTitled ("Snapshot 1");
    CHECK (stiffness() == "999 N/m");   // it is in the snapshot
}

TEST_CASE ("a click on START right after a key in a field starts the graph with what is typed", "[app][keyboard]")
{
    GraphDesk d;
    auto& w = *d.w;
    d.select ("board");
    WindowRig::settle (1100);   // START ignores a click that comes within a second after it has appeared in place of STOP
    d.typeNumber ("Stiffness", "777 N/m");
    for (int i = 0; i < 60; ++i)
        w.stage->hold();   // and its clock must not be late, however long the window took to open
    auto* start = WindowRig::buttonIn (*w.view, "START");
    REQUIRE (start != nullptr);
    w.stage->click (w.middleOf (*start));   // before any message
    CHECK (waitFor ([&] { return w.view->run().isRunning(); }));
    CHECK (w.view->run().edited().root.find ("board")->params.at ("stiffness") == "777 N/m");
    w.view->run().letGo();
}

TEST_CASE ("one Esc in an open number field takes back what is typed, and gives the keyboard to the canvas", "[app][keyboard]")
{
    GraphDesk d;
    auto& w = *d.w;
    w.view->canvas().grabKeyboardFocus();
    w.key ("F5");
    d.select ("board");
    REQUIRE (waitFor ([&] { return w.view->run().isRunning(); }));
    const auto before = w.graph().root.find ("board")->params;
    d.typeNumber ("Stiffness", "777 N/m");
    w.key ("escape");
    WindowRig::settle();
    CHECK (WindowRig::focused() == &w.view->canvas());
    CHECK (w.graph().root.find ("board")->params == before);
    CHECK_FALSE (GraphDesk::numberIn (*w.view, "Stiffness")->isEditing());
    CHECK (w.view->run().isRunning());   // the key has closed the field, and stops nothing

    w.key ("return");   // the field that the keyboard has opened, too
    REQUIRE (dynamic_cast<NumberField*> (WindowRig::focused()) != nullptr);
    auto& field = dynamic_cast<NumberField&> (*WindowRig::focused());
    w.key ("return");
    w.stage->type ("3");
    REQUIRE (field.isEditing());
    w.key ("escape");
    WindowRig::settle();
    CHECK (WindowRig::focused() == &w.view->canvas());
    CHECK_FALSE (field.isEditing());
    CHECK (w.graph().root.find ("board")->params == before);
    w.view->run().letGo();
}

TEST_CASE ("what a node refuses is said over the pointer's hint, until Esc, another value or an undo", "[app][canvas][words]")
{
    WindowRig w ("templates/stroke.json");
    const auto place = [&] (const std::string& name, const std::string& param) {
        const auto& node = w.node (name);
        return w.onStage (node.at + juce::Point<float> (node.box.width - 20.0f, node.box.find (Role::param, param)->at.y));
    };
    const auto at = place ("wall", "damping");
    const auto type = [&] (const juce::String& text) {
        w.stage->doubleClick (at);
        WindowRig::settle();
        w.key ("ctrl + a");
        w.stage->type (text);
        w.key ("return");
        w.stage->move (at.translated (1.0f, 0.0f));
        WindowRig::settle();
    };
    type ("5 kg");
    CHECK (w.view->statusText().contains ("kg does not fit"));
    w.stage->move (place ("drag", "mu"));   // to see what the other numbers are
    WindowRig::settle();
    CHECK (w.view->statusText().contains ("kg does not fit"));
    w.key ("escape");
    CHECK_FALSE (w.view->statusText().contains ("kg"));

    type ("5 kg");
    CHECK (w.view->statusText().contains ("kg does not fit"));
    type ("0.5");
    CHECK_FALSE (w.view->statusText().contains ("kg"));
    type ("5 kg");
    w.stage->click (w.stage->getLocalPoint (&w.view->canvas(), juce::Point<float> (4.0f, 4.0f)));   // closes the field
    CHECK (w.view->statusText().contains ("kg does not fit"));
    w.key ("ctrl + z");
    CHECK_FALSE (w.view->statusText().contains ("kg"));
}

TEST_CASE ("what was undone is said over the hint about what is under the pointer, until the pointer is elsewhere", "[app][words][undo]")
{
    WindowRig w ("dry_wood.json");
    const auto moveTo = [&] (const std::string& name) {
        w.stage->move (w.onStage (w.node (name).at + juce::Point<float> (30.0f, 10.0f)));
        WindowRig::settle();
    };
    moveTo ("drag");
    REQUIRE (w.view->document().perform (graph::SetParam { "", "board", "stiffness", Json ("700 N/m") }));
    moveTo ("drag");
    const auto hint = w.view->statusText();
    CHECK (hint.contains ("friction"));
    w.key ("ctrl + z");
    WindowRig::settle (100);
    CHECK (w.view->statusText() == "Undone: board: Stiffness 2 N/mm -> 700 N/m");
    w.key ("ctrl + y");
    WindowRig::settle (100);
    CHECK (w.view->statusText().startsWith ("Redone: board: Stiffness"));
    moveTo ("motor");
    CHECK_FALSE (w.view->statusText().startsWith ("Redone"));
    CHECK (w.view->statusText() != hint);
    moveTo ("drag");
    CHECK (w.view->statusText() == hint);

    REQUIRE (w.view->document().perform (graph::SetParam { "", "board", "stiffness", Json ("800 N/m") }));
    w.view->document().goTo (w.view->document().history().position() - 2);
    CHECK (w.view->statusText() == "Undone: 2 steps");
    REQUIRE (w.view->document().perform (graph::SetParam { "", "board", "stiffness", Json ("900 N/m") }));
    CHECK (w.view->statusText() == hint);   // as before
}

TEST_CASE ("a click on the empty canvas applies what is being typed about the graph", "[app][keyboard]")
{
    GraphDesk d;
    auto& w = *d.w;
    w.view->canvas().select ({});
    WindowRig::settle();
    d.type ("about", "It squeaks");
    w.stage->click (w.stage->getLocalPoint (&w.view->canvas(), juce::Point<float> (4.0f, 4.0f)));
    WindowRig::settle();
    CHECK (w.graph().about == "It squeaks");
}
