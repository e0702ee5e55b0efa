// SPDX-License-Identifier: GPL-3.0-or-later
// Only the left button clicks: a right or middle click moves no force and changes nothing.
#include "host/app/support/window_rig.hpp"

#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::WindowRig;

namespace
{
void forButtons (juce::Component& in, const std::function<void (juce::Button&)>& f)
{
    if (auto* b = dynamic_cast<juce::Button*> (&in); b != nullptr && b->isShowing()) f (*b);
    for (auto* child : in.getChildren())
        forButtons (*child, f);
}
}   // namespace

TEST_CASE ("a right or middle click on any button changes nothing, except that any click on STOP stops", "[app][click]")
{
    for (const int button : { juce::ModifierKeys::rightButtonModifier, juce::ModifierKeys::middleButtonModifier })
    {
        WindowRig w ("dry_wood.json");
        w.key ("ctrl + 1");
        REQUIRE (w.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
        WindowRig::settle();
        const auto text = [&] { return writeGraph (w.graph()); };
        const auto before = text();
        const auto running = w.view->run().isRunning();
        std::vector<juce::Component::SafePointer<juce::Button>> all;
        forButtons (*w.view, [&] (juce::Button& b) { all.emplace_back (&b); });
        REQUIRE (all.size() > 20);
        for (const auto& b : all)
        {
            if (b == nullptr || ! b->isShowing() || b->getButtonText() == "STOP") continue;
            INFO (b->getButtonText() << " " << b->getTitle());
            w.stage->click (w.middleOf (*b), button);
            juce::PopupMenu::dismissAllActiveMenus();
            WindowRig::settle();
            CHECK (text() == before);
            CHECK (w.view->run().isRunning() == running);
        }
    }
}

TEST_CASE ("a right or middle click on a preset opens and runs nothing", "[app][click]")
{
    WindowRig w ("dry_wood.json");
    auto* search = w.titled ("Search presets");
    REQUIRE (search != nullptr);
    const auto below = w.stage->getLocalPoint (search, juce::Point<int> (40, search->getHeight()));
    for (int y = below.y + 8; y < below.y + 300; y += 12)
        for (const int button : { juce::ModifierKeys::rightButtonModifier, juce::ModifierKeys::middleButtonModifier })
        {
            w.stage->click (juce::Point<int> (below.x, y).toFloat(), button);
            WindowRig::settle();
            CHECK (w.graph().name == "Dry wood");
        }
    bool opens = false;   // what a left click there does
    for (int y = below.y + 8; y < below.y + 300 && ! opens; y += 12)
    {
        w.stage->click (juce::Point<int> (below.x, y).toFloat());
        WindowRig::settle();
        opens = w.graph().name != "Dry wood";
    }
    CHECK (opens);
}

TEST_CASE ("after a new graph is opened, what is typed is for the canvas and not for the search that had the keyboard", "[app][keys]")
{
    WindowRig w ("dry_wood.json");
    w.key ("ctrl + f");
    w.stage->type ("wood");
    WindowRig::settle();
    REQUIRE (WindowRig::focused() != &w.view->canvas());
    w.key ("ctrl + n");
    WindowRig::settle();
    REQUIRE (w.graph().root.nodes.empty());
    CHECK (WindowRig::focused() == &w.view->canvas());
    w.stage->key ("spacebar");
    WindowRig::settle();
    w.stage->type ("plane");
    WindowRig::settle();
    w.key ("return");
    REQUIRE (w.graph().root.nodes.size() == 1);
    CHECK (w.graph().root.nodes[0].type == "deform.plane");
    CHECK_FALSE (w.view->run().isRunning());
}
