// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/window_rig.hpp"

#include <cstring>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

namespace
{
juce::Component* titled (juce::Component& c, const juce::String& title)
{
    if (c.isShowing() && c.getTitle() == title) return &c;
    for (auto* child : c.getChildren())
        if (auto* found = titled (*child, title)) return found;
    return nullptr;
}

juce::Image panelPicture (juce::Component& root, const juce::String& title)
{
    INFO (title);
    auto* panel = titled (root, title);
    REQUIRE (panel != nullptr);
    return panel->createComponentSnapshot (panel->getLocalBounds());
}

bool hasSamePixels (const juce::Image& a, const juce::Image& b)
{
    if (a.getBounds() != b.getBounds()) return false;
    const juce::Image::BitmapData x (a, juce::Image::BitmapData::readOnly), y (b, juce::Image::BitmapData::readOnly);
    for (int row = 0; row < x.height; ++row)
        if (std::memcmp (x.getLinePointer (row), y.getLinePointer (row), static_cast<std::size_t> (x.width * x.pixelStride)) != 0) return false;
    return true;
}

/// Waits until the panel looks like this. Timers update some parts of a panel, such as meters, so it may take a while.
bool showsAgain (juce::Component& root, const juce::String& title, const juce::Image& picture)
{
    for (int i = 0; i < 100; ++i)
    {
        if (hasSamePixels (picture, panelPicture (root, title))) return true;
        WindowRig::settle();
    }
    return false;
}

/// The picture of a panel that has stopped changing.
juce::Image settledPicture (juce::Component& root, const juce::String& title)
{
    auto picture = panelPicture (root, title);
    for (int i = 0; i < 100; ++i)
    {
        WindowRig::settle (100);
        auto next = panelPicture (root, title);
        if (hasSamePixels (picture, next)) break;
        picture = std::move (next);
    }
    return picture;
}
}   // namespace

TEST_CASE ("after an undo, every panel shows what it showed before the edit", "[app][stale]")
{
    WindowRig w ("bronze_bell.json");
    auto& document = w.view->document();
    w.click ("Layers");
    w.view->canvas().select ({ w.graph().root.find ("desk")->id });
    WindowRig::settle();
    const std::vector<juce::String> panels { "Inspector", "Layers", "Canvas" };
    std::vector<juce::Image> before;
    for (const auto& p : panels)
        before.push_back (settledPicture (*w.view, p));

    auto other = w.graph().controls[0];
    other.value = 0.1;
    auto louder = Json::array();
    for (const double g : { 0.1, 0.2, 0.3 })
        louder.push_back (g);
    const std::vector<graph::Command> edits {
        graph::SetParam { "", "desk", "ceiling", Json ("1 N") },
        graph::SetParam { "", "desk", "mute", louder },
        graph::SetSetting { "", "desk", "names", Json ("a, b, c") },
        graph::SetSetting { "", "desk", "inputs", Json (5) },
        graph::ChangeControl { other.id, other },
        graph::RemoveNode { "", "warble_felt" },
        graph::RenameNode { "", "ring", "sound" },
        graph::RemoveControl { "ring" },
        graph::RemoveNode { "", "desk" },
    };
    for (const auto& edit : edits)
    {
        INFO (nameOf (edit));
        REQUIRE (document.perform (edit));
        WindowRig::settle();
        document.undo();
        w.view->canvas().select ({ w.graph().root.find ("desk")->id });
        WindowRig::settle();
        for (std::size_t i = 0; i < panels.size(); ++i)
        {
            INFO (panels[i]);
            CHECK (showsAgain (*w.view, panels[i], before[i]));
        }
    }
}

TEST_CASE ("a new graph shows nothing of the one before it: neither its zoom nor what was said about its run", "[app][stale]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    auto& canvas = w.view->canvas();
    REQUIRE (canvas.view().zoom < 1.0f);
    const auto wait = [] (const auto& isSo) {
        for (int i = 0; i < 1000 && ! isSo(); ++i)
            WindowRig::settle (10);
        return isSo();
    };
    w.key ("F5");
    REQUIRE (wait ([&] { return w.view->run().isRunning(); }));
    w.key ("ctrl + n");
    REQUIRE (w.graph().root.nodes.empty());
    CHECK (canvas.view().zoom == 1.0f);
    w.key ("spacebar");
    w.stage->type ("plane");
    w.key ("return");
    const auto isSaid = [&] { return std::ranges::count (w.view->run().messages(), "watch/guard", &Message::id) > 0; };
    CHECK_FALSE (isSaid());   // the guard of the run that has ended does not matter any more
    REQUIRE (wait ([&] { return ! w.view->run().isRunning(); }));
    for (int i = 0; i < 20; ++i)   // while the timer of the window asks for other ports
        WindowRig::settle();
    CHECK_FALSE (isSaid());
}
