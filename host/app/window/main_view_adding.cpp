// SPDX-License-Identifier: GPL-3.0-or-later
// Graphs that are added to the open one, as a node and a layer.
#include "main_view.hpp"

#include <host/app/canvas/actions.hpp>
#include <host/app/compose/sinks.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/key_text.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <array>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

struct PartChoice
{
    const char* name;
    bool compose::Parts::*only;   ///< null: all but walls
};

constexpr std::array<PartChoice, 4> part_choices { { { NEEDS_TRANS ("Add without its walls"), nullptr },
                                                     { NEEDS_TRANS ("Add only its friction"), &compose::Parts::friction },
                                                     { NEEDS_TRANS ("Add only its textures"), &compose::Parts::textures },
                                                     { NEEDS_TRANS ("Add only its vibrations"), &compose::Parts::vibrations } } };

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

/// "thumb on stylus, index on its own device" for the roles of a graph.
juce::String textOf (const compose::RoleMap& map, const std::vector<std::string>& roles)
{
    juce::StringArray all;
    for (const auto& role : roles)
    {
        const auto to = map.find (role);
        all.add (to == map.end() ? filled (TRANS ("%1 on its own device"), role) : filled (TRANS ("%1 on %2"), role, to->second));
    }
    return all.joinIntoString (", ");
}
}   // namespace

void MainView::addToGraph (const fs::path& file, const compose::Parts& parts, std::optional<juce::Point<float>> at)
{
    endTyping();
    if (edited.graph().root.nodes.empty()) return open (file);
    const auto loaded = loadGraph (file);
    for (const auto& m : loaded.messages)
        if (m.severity == Message::Severity::error)
            return tell (filled (TRANS ("Cannot add %1"), printableName (file.filename().string())), messageText (m) + ".");
    if (! patching.patch().empty()) at.reset();   // a place in the subgraph that the canvas shows
    const auto maps = compose::roleMaps (edited.graph(), loaded.graph);
    if (maps.size() == 1) return addLoaded (loaded.graph, { maps.front(), parts, {} }, at);
    constexpr std::size_t most = 6;
    std::vector<Question::Choice> choices;
    for (std::size_t i = 0; i < std::min (most, maps.size()); ++i)
        choices.push_back ({ textOf (maps[i], compose::rolesIn (loaded.graph)),
                             [this, g = loaded.graph, map = maps[i], parts, at] { addLoaded (g, { map, parts, {} }, at); } });
    choices.push_back ({ TRANS ("Cancel"), {} });
    question.ask (filled (TRANS ("Where do you feel '%1'?"), printableName (loaded.graph.name)),
                  TRANS ("Choose a device of this graph for each of its tools."), std::move (choices));
}

void MainView::addLoaded (const graph::Graph& added, compose::AddOptions how, std::optional<juce::Point<float>> at)
{
    patching.leaveTo (0);
    if (at) how.at = freePlace (patching.scene(), *at).toDouble();
    const auto made = compose::addPreset (patching.commands().graphWithPlaces(), added, how, catalogue);
    if (! made) return status.refuse (messageText (made.error()));
    const double before_hz = edited.graph().rate_hz;
    if (patching.commands().performPlaced (made->command).empty() && edited.graph().root.find (made->block) == nullptr) return;
    turnTo (patching);
    patching.select ({ made->node });
    if (const auto* node = patching.scene().find (made->node)) patching.bringIntoView (node->bounds());
    takeFocus (patching);
    auto text = filled (TRANS ("Added %1 as a node, and as a layer of %2. One undo takes it away."), made->label, listText (made->layers));
    if (made->rate_hz != before_hz) text << " " << filled (TRANS ("The graph runs at %1 Hz now."), numberText (made->rate_hz));
    status.notify (text);
}

void MainView::openPresetMenu (const Preset& p, bool is_own)
{
    juce::PopupMenu menu;
    menu.addItem (menuItem (TRANS ("Open"), keyText ("return"), [this, p, is_own] { openPreset (p, is_own); }));
    if (! edited.graph().root.nodes.empty() && p.problem.empty())
    {
        menu.addItem (menuItem (TRANS ("Add to this graph"), keyText ("ctrl + return"), [this, file = p.file] { addToGraph (file); }));
        const auto there = compose::partsOf (loadGraph (p.file).graph, catalogue);
        for (const auto& c : part_choices)
            if (makesSense (c, there))
                menu.addItem (menuItem (juce::translate (c.name), {}, [this, file = p.file, parts = partsFor (c)] { addToGraph (file, parts); }));
    }
    menu.showMenuAsync (juce::PopupMenu::Options().withParentComponent (this).withMousePosition());
}

void MainView::askForAdded()
{
    std::error_code failed;
    chooseFile (false, fs::is_directory (ownFolder(), failed) ? ownFolder() : presetFolder(), [this] (const fs::path& file) { addToGraph (file); });
}

}   // namespace tactus::host
