// SPDX-License-Identifier: GPL-3.0-or-later
#include "window_parts.hpp"
#include "panels.hpp"

#include <host/app/look/appearance.hpp>

#include <algorithm>

namespace tactus::host
{

WindowParts::WindowParts (const Catalogue& c, juce::Component& w, Files::Callbacks callbacks)
    : catalogue (c), window (w), files (edited, question, settings, std::move (callbacks)),
      playback (edited, c, sound, device_setup, [this] { files.beforeRun(); })
{
    palette.getProperties().set ("space above", SafetyStrip::height);   // STOP stays within reach
    menus.setComponentID (Look::menu_area);
    menus.setInterceptsMouseClicks (false, true);
    menus.setAlwaysOnTop (true);
}

void WindowParts::add()
{
    const auto attach = [this] (Tabs* tabs, Panel panel) {
        auto& component = *panel.component;
        if (tabs != nullptr) tabs->add (panel.name, std::move (panel.component));
        for (const auto& key : panel.keys)
            help.addKey (key.shown, key.help);
        panels.push_back ({ std::move (panel), component, tabs == nullptr });
    };
    [[maybe_unused]] Tabs *const left = &layout.left, *const bottom = &layout.bottom, *const over = nullptr;
#define TACTUS_ATTACH(place, make) attach (place, make (desk));
    TACTUS_PANELS (TACTUS_ATTACH)
#undef TACTUS_ATTACH
    window.addChildComponent (layout.pages);
    for (auto* c : std::initializer_list<juce::Component*> { &strip, &hand, left, bottom, &top, &patching, &inspector, &status })
        window.addAndMakeVisible (c);
    for (const auto& [name, edge] : layout.edges())
        window.addAndMakeVisible (*edge);
    for (auto* page : std::initializer_list<juce::Component*> { &templates, &palette, &welcome, &help, &tour })
        window.addChildComponent (page);
    for (const auto& p : panels)
        if (p.covers) window.addChildComponent (p.component);
    for (auto* above : std::initializer_list<juce::Component*> { &question, &shade })
        window.addChildComponent (above);
    window.addAndMakeVisible (menus);
}

const AttachedPanel* WindowParts::openCover() const
{
    const auto found = std::ranges::find_if (panels, [] (const AttachedPanel& p) { return p.covers && p.component.isVisible(); });
    return found == panels.end() ? nullptr : &*found;
}

void WindowParts::showHelp()
{
    const auto& selected = patching.selection();
    const auto* node = selected.size() == 1 ? patching.scene().find (*selected.begin()) : nullptr;
    node != nullptr ? help.showNode (node->type) : help.showKeys();
}

void WindowParts::applyTheme() { host::applyTheme (*window.getTopLevelComponent(), light ? Theme::light() : Theme::dark()); }

void WindowParts::applyFusion()
{
    const Fuser::Options how { .compiler = { .cache = FusionCompiler::usualCache() } };
    playback.run().fuse (settings.fuse ? std::optional (how) : std::nullopt);
}

bool WindowParts::hasBoundRole() const
{
    return std::ranges::any_of (rolesNamed (edited.graph()), [this] (const std::string& role) { return device_setup.movesTool (role); });
}

}   // namespace tactus::host
