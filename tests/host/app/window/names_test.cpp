// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of every control of the window.
#include "host/app/support/window_rig.hpp"

#include <tactus/file/graph_file.hpp>

#include <functional>
#include <vector>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

namespace
{
/// True if the component takes the keyboard, or is a control that a mouse uses.
bool isControl (const juce::Component& c)
{
    return c.getWantsKeyboardFocus() || dynamic_cast<const juce::Button*> (&c) != nullptr || dynamic_cast<const juce::Slider*> (&c) != nullptr
           || dynamic_cast<const juce::ComboBox*> (&c) != nullptr || dynamic_cast<const juce::TextEditor*> (&c) != nullptr;
}

/// What a screen reader says. One letter or a sign says nothing.
bool hasName (juce::Component& c)
{
    auto* handler = c.getAccessibilityHandler();
    const auto title = handler != nullptr ? handler->getTitle() : c.getTitle();
    return title.trim().length() > 1;
}

juce::String pathOf (const juce::Component& c)
{
    const auto name = c.getTitle().isNotEmpty() ? c.getTitle() : juce::String (typeid (c).name());
    return (c.getParentComponent() == nullptr ? juce::String() : pathOf (*c.getParentComponent()) + " / ") + name;
}

void checkNames (juce::Component& c)
{
    if (! c.isVisible() || c.getWidth() == 0) return;
    if (isControl (c) && c.isAccessible())
    {
        INFO (pathOf (c) << " at " << c.getScreenBounds().toString());
        CHECK (hasName (c));
    }
    if (dynamic_cast<juce::Slider*> (&c) != nullptr || dynamic_cast<juce::ComboBox*> (&c) != nullptr) return;   // their parts
    for (auto* child : c.getChildren())
        checkNames (*child);
}

void forButtons (juce::Component& in, const std::function<void (juce::Button&)>& f)
{
    if (auto* b = dynamic_cast<juce::Button*> (&in); b != nullptr && b->isShowing()) f (*b);
    for (auto* child : in.getChildren())
        forButtons (*child, f);
}
}   // namespace

TEST_CASE ("every control of the window has a name for screen readers", "[app][names]")
{
    SECTION ("on the welcome page")
    {
        WindowRig w;
        checkNames (*w.view);
    }
    SECTION ("with a graph")
    {
        WindowRig w ("bronze_bell.json");
        checkNames (*w.view);
        for (const char* tab : { "Layers", "Devices", "Problems", "Scopes", "History", "Presets" })
        {
            w.click (tab);
            checkNames (*w.view);
        }
        w.key ("F1");
        checkNames (*w.view);
    }
    SECTION ("with any of its nodes selected")
    {
        for (const char* preset : { "bronze_bell.json", "dry_wood.json", "layered_cloth.json", "denim.json" })
        {
            WindowRig w (preset);
            for (const auto& n : w.graph().root.nodes)
            {
                INFO (n.name);
                w.view->canvas().select ({ n.id });
                checkNames (w.view->part<Inspector>());
            }
            w.view->canvas().select ({ w.graph().root.wires.front().id });
            checkNames (w.view->part<Inspector>());
        }
    }
    SECTION ("with the palette open")
    {
        WindowRig w ("dry_wood.json");
        w.view->canvas().grabKeyboardFocus();
        w.key ("spacebar");
        checkNames (*w.view);
    }
}

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
