// SPDX-License-Identifier: GPL-3.0-or-later
// The list of presets in the window.
#include "browser.hpp"

#include <host/app/adding/add_graph.hpp>
#include <host/app/desk/panel.hpp>
#include <host/app/look/key_text.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/file/graph_file.hpp>

#include <array>
#include <map>
#include <memory>

namespace tactus::host
{

namespace
{
struct PartChoice
{
    const char *name, *named;     ///< in the menu of a preset, and with the name of the preset
    bool compose::Parts::*only;   ///< null: all but walls
};

constexpr std::array<PartChoice, 4> part_choices {
    { { NEEDS_TRANS ("Add without its walls"), NEEDS_TRANS ("Add %1: all but its walls"), nullptr },
      { NEEDS_TRANS ("Add only its friction"), NEEDS_TRANS ("Add %1: friction only"), &compose::Parts::friction },
      { NEEDS_TRANS ("Add only its textures"), NEEDS_TRANS ("Add %1: textures only"), &compose::Parts::textures },
      { NEEDS_TRANS ("Add only its vibrations"), NEEDS_TRANS ("Add %1: vibrations only"), &compose::Parts::vibrations } }
};

compose::Parts partsFor (const PartChoice& c)
{
    if (c.only == nullptr) return compose::withoutWalls();
    auto parts = compose::Parts::none();
    parts.*c.only = true;
    return parts;
}

/// True if the choice leaves something of a graph out, and something in.
bool makesSense (const PartChoice& c, const compose::Parts& there)
{
    if (c.only != nullptr && ! (there.*c.only)) return false;
    const int count = there.walls + there.friction + there.textures + there.vibrations + there.others;
    return count > 1 && (c.only != nullptr || there.walls);
}

bool isAnythingOpen (const Desk& desk) { return ! desk.document.graph().root.nodes.empty(); }

void openMenu (const Desk& desk, PresetBrowser& list, const Preset& p)
{
    juce::PopupMenu menu;
    const auto add = [&] (const juce::String& text, const juce::String& keys, std::function<void()> act) {
        juce::PopupMenu::Item item (text);
        item.shortcutKeyDescription = keys;
        item.action = [safe = juce::Component::SafePointer (&list), act = std::move (act)] {   // called later, when the window may be gone
            if (safe != nullptr) act();
        };
        menu.addItem (item);
    };
    add (TRANS ("Open"), keyText ("return"), [&desk, file = p.file] { desk.openGraph (file); });
    if (isAnythingOpen (desk) && p.problem.empty())
    {
        add (TRANS ("Add to this graph"), keyText ("ctrl + return"), [&desk, file = p.file] { addGraph (desk, file); });
        const auto there = compose::partsOf (loadGraph (p.file).graph, desk.types);
        for (const auto& c : part_choices)
            if (makesSense (c, there)) add (juce::translate (c.name), {}, [&desk, file = p.file, parts = partsFor (c)] { addGraph (desk, file, parts); });
    }
    menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (list).withMousePosition());
}

/// The parts of presets, each read once.
using KnownParts = std::map<std::filesystem::path, compose::Parts>;

/// The presets that can be added to the graph, whole or in part. An empty graph gives way to a preset.
std::vector<Panel::Action> actionsOf (const Desk& desk, const PresetBrowser& list, KnownParts& known)
{
    std::vector<Panel::Action> all;
    const bool is_empty = ! isAnythingOpen (desk);
    const auto about = is_empty ? TRANS ("A preset to open") : TRANS ("A preset, as a node and a layer");
    for (const auto& p : list.shipped())
    {
        if (! p.problem.empty()) continue;
        if (is_empty)
        {
            all.push_back ({ filled (TRANS ("Open %1"), p.name), about, [&desk, file = p.file] { desk.openGraph (file); } });
            continue;
        }
        all.push_back ({ filled (TRANS ("Add %1"), p.name), about, [&desk, file = p.file] { addGraph (desk, file); } });
        auto there = known.find (p.file);
        if (there == known.end()) there = known.emplace (p.file, compose::partsOf (loadGraph (p.file).graph, desk.types)).first;
        for (const auto& c : part_choices)
            if (makesSense (c, there->second))
                all.push_back ({ filled (juce::translate (c.named), p.name), about,
                                 [&desk, file = p.file, parts = partsFor (c)] { addGraph (desk, file, parts); } });
    }
    return all;
}
}   // namespace

Panel presetsPanel (Desk& desk)
{
    auto made = std::make_unique<PresetBrowser> (desk.types, desk.settings, desk.pictures);
    auto* list = made.get();
    list->onOpen = [&desk] (const Preset& p, bool) { desk.openGraph (p.file); };
    list->onAdd = [&desk] (const Preset& p) { addGraph (desk, p.file); };
    list->onMenu = [&desk, list] (const Preset& p, bool) { openMenu (desk, *list, p); };
    list->onSettings = [&desk] { desk.settingsChanged(); };
    list->onLeave = [&desk] { desk.leave(); };
    list->onPreview = [&desk] (const std::filesystem::path& file) { desk.preview (file); };
    list->onPreviewEnd = [&desk] { desk.endPreview(); };
    desk.presets = [list] { return list->shipped(); };
    const auto search = [&desk, list] {
        desk.reveal (*list);
        list->beginSearch();
    };
    return { .name = TRANS ("Presets"),
             .component = std::move (made),
             .keys = { { "ctrl + f", NEEDS_TRANS ("Ctrl+F"), NEEDS_TRANS ("searches the presets"), search },
                       { "", NEEDS_TRANS ("Ctrl+Return"), NEEDS_TRANS ("in the presets, adds the selected one to the graph, as a node and a layer") } },
             .actions = [&desk, list, known = std::make_shared<KnownParts>()] { return actionsOf (desk, *list, *known); },
             .reload = [list] { list->reload(); },
             .refresh = [list] { list->refresh(); },
             .restore = [&desk, list] { list->showOpen (desk.document.file().empty() ? desk.document.preset() : desk.document.file()); } };
}

}   // namespace tactus::host
