// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/desk_stage.hpp"

#include <host/app/layers/layers_panel.hpp>

#include <cstring>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::OnStage;

namespace
{
juce::Image panelPicture (juce::Component& root, const juce::String& title)
{
    INFO (title);
    auto* panel = OnStage::titledIn (root, title);
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
        OnStage::settle();
    }
    return false;
}

/// The picture of a panel that has stopped changing.
juce::Image settledPicture (juce::Component& root, const juce::String& title)
{
    auto picture = panelPicture (root, title);
    for (int i = 0; i < 100; ++i)
    {
        OnStage::settle (100);
        auto next = panelPicture (root, title);
        if (hasSamePixels (picture, next)) break;
        picture = std::move (next);
    }
    return picture;
}
}   // namespace

TEST_CASE ("after an undo, every panel shows what it showed before the edit", "[app][stale]")
{
    DeskStage w ("bronze_bell.json");
    auto& document = w.document;
    w.show<LayersPanel> (layersPanel);
    w.canvas.select ({ w.graph().root.find ("desk")->id });
    OnStage::settle();
    const std::vector<juce::String> panels { "Inspector", "Layers", "Canvas" };
    std::vector<juce::Image> before;
    for (const auto& p : panels)
        before.push_back (settledPicture (*w.stage, p));

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
        OnStage::settle();
        document.undo();
        w.canvas.select ({ w.graph().root.find ("desk")->id });
        OnStage::settle();
        for (std::size_t i = 0; i < panels.size(); ++i)
        {
            INFO (panels[i]);
            CHECK (showsAgain (*w.stage, panels[i], before[i]));
        }
    }
}
