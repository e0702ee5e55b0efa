// SPDX-License-Identifier: GPL-3.0-or-later
#include "add_preset.hpp"
#include "banks.hpp"

#include <host/app/model/fragment.hpp>
#include <host/app/storage/carry_files.hpp>
#include <host/app/text/filled.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/list_text.hpp>

#include <algorithm>
#include <memory>
#include <set>

namespace tactus::host::compose
{

namespace
{
/// An id of a graph file for the name of a graph: "dry_wood" for "Dry wood".
std::string idFor (const std::string& name)
{
    std::string id;
    for (const char c : juce::String::fromUTF8 (name.c_str()).trim().toLowerCase().toStdString())
        id += (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ? c : '_';
    id.erase (0, id.find_first_not_of ("_0123456789"));
    return graph::isId (id) ? id : "added";
}

std::string freeAmong (const std::set<std::string>& taken, const std::string& wanted) { return freeName ({}, taken, wanted); }

std::set<std::string> subgraphsOf (const graph::Graph& g)
{
    std::set<std::string> names;
    for (const auto& [name, patch] : g.graphs)
        names.insert (name);
    return names;
}

/// " (friction)" for a part of a graph. Empty for all of it.
std::string partText (const Parts& parts)
{
    if (parts.isAll()) return {};
    if (parts == withoutWalls()) return " (" + TRANS ("no walls").toStdString() + ")";
    const std::pair<bool Parts::*, const char*> kinds[] { { &Parts::walls, NEEDS_TRANS ("walls") },
                                                          { &Parts::friction, NEEDS_TRANS ("friction") },
                                                          { &Parts::textures, NEEDS_TRANS ("textures") },
                                                          { &Parts::vibrations, NEEDS_TRANS ("vibrations") },
                                                          { &Parts::others, NEEDS_TRANS ("others") } };
    std::vector<std::string> kept;
    for (const auto& [kind, name] : kinds)
        if (parts.*kind) kept.push_back (juce::translate (name).toStdString());
    return " (" + listText (kept) + ")";
}

/// Moves the subgraphs of the added graph into the open one, under free names.
void moveSubgraphs (graph::Graph& into, graph::Graph& added, std::set<std::string>& taken)
{
    std::map<std::string, std::string> renamed;
    for (const auto& [name, patch] : added.graphs)
    {
        const auto& to = renamed[name] = freeAmong (taken, name);
        taken.insert (to);
    }
    const auto adapt = [&] (graph::Patch& patch) {
        for (auto& n : patch.nodes)
            if (n.type.starts_with ("graph:"))
                if (const auto to = renamed.find (n.type.substr (6)); to != renamed.end()) n.type = "graph:" + to->second;
        renewIds (patch);
    };
    adapt (added.root);
    for (auto& [name, patch] : added.graphs)
    {
        adapt (patch);
        into.graphs.emplace_back (renamed[name], std::move (patch));
    }
}

/// The controls of the added graph, which now lead into the block. If a name is taken, the label of the block is added to it.
void moveControls (graph::Graph& into, const graph::Graph& added, const std::string& block, const std::string& label)
{
    std::set<std::string> ids, names;
    for (const auto& c : into.controls)
    {
        ids.insert (c.id);
        names.insert (c.name);
    }
    for (auto c : added.controls)
    {
        c.id = freeAmong (ids, c.id);
        if (names.contains (c.name)) c.name += " (" + label + ")";
        for (auto& t : c.to)
            t.path = block + '/' + t.path;
        ids.insert (c.id);
        names.insert (c.name);
        into.controls.push_back (std::move (c));
    }
}

/// Copies the sources of the values, under the new names of the nodes.
void moveSources (graph::Graph& into, const graph::Graph& added, const std::string& block)
{
    const auto ui = added.extra.find ("ui");
    const auto sources = ui == added.extra.end() || ! ui->is_object() ? Json() : ui->value ("sources", Json());
    if (! sources.is_object() || sources.empty()) return;
    auto& all = into.extra["ui"];
    if (! all.is_object()) all = Json::object();
    auto& known = all["sources"];
    if (! known.is_object()) known = Json::object();
    for (const auto& [name, said] : sources.asObject())
        known[block + '/' + name] = said;
}

/// The inside of the block: the added graph without what belongs to a whole graph.
graph::Patch insideOf (const graph::Graph& added)
{
    auto inside = added.root;
    const auto ui = added.extra.find ("ui");
    if (ui != added.extra.end() && ui->is_object())
        if (const auto notes = ui->find ("notes"); notes != ui->end()) inside.extra["ui"] = Json { { "notes", *notes } };
    return inside;
}

/// The roles of the block: those of the open graph, or new ones with the devices of the added graph.
std::map<std::string, std::string> placeRoles (graph::Graph& into, const graph::Graph& added, const RoleMap& wanted)
{
    std::set<std::string> taken;
    for (const auto& role : rolesIn (into))
        taken.insert (role);
    for (const auto& [role, device] : into.devices)
        taken.insert (role);
    std::map<std::string, std::string> to;
    for (const auto& role : rolesIn (added))
    {
        if (const auto w = wanted.find (role); w != wanted.end())
        {
            to[role] = w->second;
            continue;
        }
        to[role] = freeAmong (taken, role);
        taken.insert (to[role]);
        if (const auto* device = added.device (role)) into.devices.emplace_back (to[role], *device);
    }
    return to;
}
}   // namespace

std::vector<RoleMap> roleMaps (const graph::Graph& open, const graph::Graph& added)
{
    const auto mine = rolesIn (open), theirs = rolesIn (added);
    if (mine.empty() || theirs.empty()) return { {} };
    std::vector<RoleMap> maps;
    const auto offer = [&] (RoleMap map) {
        if (std::ranges::count (maps, map) == 0) maps.push_back (std::move (map));
    };
    if (mine.size() == 1 && theirs.size() == 1) return { { { theirs[0], mine[0] } } };
    RoleMap same, in_order;
    for (std::size_t i = 0; i < theirs.size(); ++i)
    {
        if (std::ranges::count (mine, theirs[i]) > 0) same[theirs[i]] = theirs[i];
        if (i < mine.size()) in_order[theirs[i]] = mine[i];
    }
    if (same.size() == theirs.size()) offer (same);
    offer (in_order);
    for (const auto& role : mine)   // all of them on one device
    {
        RoleMap all;
        for (const auto& r : theirs)
            all[r] = role;
        offer (std::move (all));
    }
    offer ({});   // all with their own devices
    return maps;
}

Result<AddedPreset> addPreset (const graph::Graph& open, graph::Graph added, const AddOptions& how, const Catalogue& catalogue)
{
    const auto called = added.name.empty() ? TRANS ("Added graph").toStdString() : added.name;
    added = carriedTo (open.folder, added, std::vector<std::filesystem::path> {}).graph;
    if (auto lifted = liftSinks (added); ! lifted) return lifted.error();
    if (! how.parts.isAll()) keepOnly (added, how.parts, catalogue);

    const auto after = std::make_shared<graph::Graph> (open);
    if (auto mixed = mixAll (*after, catalogue); ! mixed) return mixed.error();
    const auto roles = placeRoles (*after, added, how.roles);
    auto inside = insideOf (added);
    auto sinks = takeSinks (inside);
    if (! sinks) return sinks.error();
    if (sinks->empty() && ! how.parts.isAll())
        return Message::error ("compose/no_part", {}, filled (TRANS ("%1 has no effect of this kind"), called).toStdString(),
                               TRANS ("add all of it").toStdString());
    if (sinks->empty())
        return Message::error ("compose/no_motor", {}, filled (TRANS ("nothing added from %1 goes to a motor, so it cannot be a layer"), called).toStdString(),
                               TRANS ("wire its forces to a motor first").toStdString());

    auto taken = subgraphsOf (*after);
    graph::Node block;
    std::set<std::string> names = taken;
    block.name = freeName (after->root, names, idFor (called));
    block.type = "graph:" + block.name;
    taken.insert (block.name);
    added.root = std::move (inside);
    moveSubgraphs (*after, added, taken);
    for (const auto& [role, to] : roles)
        if (role != to) block.roles[role] = to;
    if (how.at) block.extra["ui"] = Json { { "at", Json::array ({ how.at->x, how.at->y }) } };

    AddedPreset made { graph::Batch {}, block.name, block.id, called, {}, std::max (open.rate_hz, added.rate_hz) };
    const auto number = block.name.substr (std::min (block.name.size(), idFor (called).size()));   // "_2" for a second one
    if (number.starts_with ('_')) made.label += ' ' + number.substr (1);
    moveControls (*after, added, block.name, made.label);
    made.label += partText (how.parts);
    moveSources (*after, added, block.name);
    after->files.insert (added.files.begin(), added.files.end());
    after->rate_hz = made.rate_hz;
    after->graphs.emplace_back (block.name, std::move (added.root));
    after->root.nodes.push_back (std::move (block));
    for (const auto& s : *sinks)
    {
        const auto at = roles.find (s.sink.role);
        const auto sink = sinkFor (after->root, s, at == roles.end() ? s.sink.role : at->second);
        auto bank = bankBefore (after->root, sink, s.port, catalogue);
        if (! bank) return bank.error();
        if (auto strip = addStrip (after->root, *bank, { made.block, s.output }, made.label, catalogue); ! strip) return strip.error();
        if (std::ranges::count (made.layers, *bank) == 0) made.layers.push_back (*bank);
    }
    made.command = graph::Batch { filled (NEEDS_TRANS ("add %1"), called).toStdString(), { graph::ReplaceGraph { after } } };
    return made;
}

}   // namespace tactus::host::compose
