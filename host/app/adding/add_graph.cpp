// SPDX-License-Identifier: GPL-3.0-or-later
#include "add_graph.hpp"

#include <host/app/canvas/actions.hpp>
#include <host/app/compose/add_preset.hpp>
#include <host/app/compose/sinks.hpp>
#include <host/app/layers/mixer.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

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

void addLoaded (const Desk& desk, const graph::Graph& added, compose::AddOptions how, std::optional<juce::Point<float>> at)
{
    desk.canvas.leaveTo (0);
    if (at) how.at = freePlace (desk.canvas.scene(), *at).toDouble();
    const auto made = compose::addPreset (desk.canvas.commands().graphWithPlaces(), added, how, desk.types);
    if (! made) return desk.refuse (messageText (made.error()));
    const double before_hz = desk.document.graph().rate_hz;
    if (desk.canvas.commands().performPlaced (made->command).empty() && desk.document.graph().root.find (made->block) == nullptr) return;
    desk.turnToCanvas();
    desk.canvas.select ({ made->node });
    if (const auto* node = desk.canvas.scene().find (made->node)) desk.canvas.bringIntoView (node->bounds());
    takeFocus (desk.canvas);
    auto text = filled (TRANS ("Added %1 as a node, and as a layer of %2. One undo takes it away."), made->label, listText (made->layers));
    if (made->rate_hz != before_hz) text << " " << filled (TRANS ("The graph runs at %1 Hz now."), numberText (made->rate_hz));
    desk.notify (text);
}
}   // namespace

void addGraph (const Desk& desk, const fs::path& file, const compose::Parts& parts, std::optional<juce::Point<float>> at)
{
    endTyping();
    if (desk.document.graph().root.nodes.empty()) return desk.openGraph (file);
    const auto loaded = loadGraph (file);
    for (const auto& m : loaded.messages)
        if (m.severity == Message::Severity::error)
            return desk.tell (filled (TRANS ("Cannot add %1"), printableName (file.filename().string())), messageText (m) + ".");
    addGraph (desk, loaded.graph, parts, at);
}

void addGraph (const Desk& desk, const graph::Graph& added, const compose::Parts& parts, std::optional<juce::Point<float>> at)
{
    if (! desk.canvas.patch().empty()) at.reset();   // a place in the subgraph that the canvas shows
    const auto maps = compose::roleMaps (desk.document.graph(), added);
    if (maps.size() == 1) return addLoaded (desk, added, { maps.front(), parts, {} }, at);
    constexpr std::size_t most = 6;
    std::vector<Question::Choice> choices;
    for (std::size_t i = 0; i < std::min (most, maps.size()); ++i)
        choices.push_back (
            { textOf (maps[i], compose::rolesIn (added)), [&desk, added, map = maps[i], parts, at] { addLoaded (desk, added, { map, parts, {} }, at); } });
    choices.push_back ({ TRANS ("Cancel"), {} });
    desk.question.ask (filled (TRANS ("Where do you feel '%1'?"), printableName (added.name)),
                       TRANS ("Choose a device of this graph for each of its tools."), std::move (choices));
}

void pasteLayer (const Desk& desk, const graph::Graph& copied)
{
    auto lifted = copied;
    const auto isSink = [] (const graph::Node& n) { return ! compose::sinkPortsOf (n).empty(); };
    if (! compose::liftSinks (lifted) || std::ranges::any_of (lifted.root.nodes, isSink)) return addGraph (desk, copied);
    endTyping();
    Selection made;
    const auto layer = addCopiedLayer (desk.document.graph(), desk.canvas.patch(), desk.types, copied, made);
    if (! layer) return desk.refuse (messageText (layer.error()));
    if (! desk.canvas.commands().performBeside (layer->command, made)) return;
    desk.turnToCanvas();
    desk.canvas.select (made);
    takeFocus (desk.canvas);
    desk.notify (layer->missing.empty() ? TRANS ("Pasted as a layer. One undo takes it away.") : filled ("%1.", layer->missing));
}

void askForAdded (const Desk& desk)
{
    std::error_code failed;
    desk.chooseFile (false, fs::is_directory (ownFolder(), failed) ? ownFolder() : presetFolder(), [&desk] (const fs::path& file) { addGraph (desk, file); });
}

}   // namespace tactus::host
