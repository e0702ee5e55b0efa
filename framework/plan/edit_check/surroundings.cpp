// SPDX-License-Identifier: MIT
#include "surroundings.hpp"
#include <tactus/plan/rules/fan_in.hpp>

#include <algorithm>
#include <unordered_set>

namespace tactus::plan
{

namespace
{
const PortSheet* rowIn (const std::vector<PortSheet>& rows, std::string_view port)
{
    const auto row = std::ranges::find (rows, port, &PortSheet::id);
    return row == rows.end() ? nullptr : &*row;
}

bool isFixed (const PortSheet& row) { return row.unit.kind == UnitRule::Kind::fixed; }

/// True if all ports of a type that have no fixed unit have the same one, up to a factor. Then one of them tells what all carry.
bool carriesOneUnit (const NodeType& type)
{
    int open = 0;
    for (const auto* rows : { &type.inputs, &type.params, &type.outputs })
        for (const auto& row : *rows)
        {
            if (isFixed (row)) continue;
            if (row.unit.kind == UnitRule::Kind::open)
                ++open;
            else if (row.unit.kind != UnitRule::Kind::same)
                return false;
            for (const auto* others : { &type.inputs, &type.params, &type.outputs })
                if (const auto* like = rowIn (*others, row.unit.a); like != nullptr && isFixed (*like)) return false;
        }
    return open == 1;
}
}   // namespace

bool hasFixedUnits (const NodeType& type)
{
    const auto areFixed = [] (const auto& rows) { return std::ranges::all_of (rows, isFixed); };
    return areFixed (type.inputs) && areFixed (type.params) && areFixed (type.outputs);
}

/// A search for the unit at one end of a new wire, through ports whose units depend on each other.
struct Surroundings::Search
{
    int except;                 // the new wire
    std::vector<int> open {};   // nodes
    std::unordered_set<int> seen {};
    bool has_anchor = false;   // a port with a fixed unit is reached
    bool is_mixed = false;     // some ports that were reached may have other units, so all must be reached

    bool isSettled() const { return has_anchor && ! is_mixed; }
    bool isFree() const { return open.empty() && ! has_anchor && ! is_mixed; }   // any unit fits
};

void Surroundings::addNode (int n)
{
    if (nodes.insert (n).second) addSubgraph (node (n));
}

void Surroundings::addSubgraph (const graph::Node& n)
{
    if (! n.type.starts_with ("graph:")) return;
    const auto name = n.type.substr (6);
    const auto* patch = graph.find (name);
    if (patch == nullptr || ! patches.insert (name).second) return;
    for (const auto& inner : patch->nodes)
        addSubgraph (inner);
}

void Surroundings::addWire (int w)
{
    wires.insert (w);
    for (const int n : { index.start (w), index.end (w) })
        if (n != GraphIndex::none) addNode (n);
}

const PortSheet* Surroundings::rowAt (int n, const std::string& port, bool starts) const
{
    const auto* type = types.find (node (n).type);
    if (type == nullptr) return nullptr;
    if (starts) return rowIn (type->outputs, port);
    const auto* row = rowIn (type->inputs, port);
    return row != nullptr ? row : rowIn (type->params, port);
}

void Surroundings::addRivals (int w)
{
    const int to = index.end (w);
    const auto* row = rowAt (to, wire (w).to.port, false);
    if (row != nullptr && sumsWires (*row).value_or (false)) return;
    for (const int other : index.at (to).in)
        if (row == nullptr || wire (other).to.port == wire (w).to.port) addWire (other);
}

/// True if a value gets from one node to the other within the tick. Searches from both sides until they meet, or one has nothing left.
bool Surroundings::leads (int start, int goal) const
{
    struct Front
    {
        bool forwards;
        std::vector<int> open;
        std::unordered_set<int> seen;
    };
    Front onward { true, { start }, { start } }, back { false, { goal }, { goal } };
    const auto meets = [this] (Front& front, const Front& other) {
        const int n = front.open.back();
        front.open.pop_back();
        for (const int w : front.forwards ? index.at (n).out : index.at (n).in)
        {
            const int next = front.forwards ? index.end (w) : index.start (w);
            if (next == GraphIndex::none || wire (w).delay > 0) continue;
            if (other.seen.contains (next)) return true;
            if (front.seen.insert (next).second) front.open.push_back (next);
        }
        return false;
    };
    if (start == goal) return true;
    while (! onward.open.empty() && ! back.open.empty())
        if (meets (onward, back) || meets (back, onward)) return true;
    return false;
}

/// One end of a wire is reached.
void Surroundings::reach (int w, bool starts, Search& search) const
{
    const int n = starts ? index.start (w) : index.end (w);
    if (n == GraphIndex::none) return;
    const auto* row = rowAt (n, starts ? wire (w).from.port : wire (w).to.port, starts);
    if (row != nullptr && isFixed (*row))
        search.has_anchor = true;
    else if ((row != nullptr || node (n).isSubgraph()) && search.seen.insert (n).second)
        search.open.push_back (n);
}

/// Follows the wires at the generic ports of a node.
void Surroundings::step (Search& search)
{
    const int n = search.open.back();
    search.open.pop_back();
    addNode (n);
    const auto* type = types.find (node (n).type);
    const auto& params = node (n).params;   // null if there are none
    const auto isText = [] (const auto& member) { return ! member.second.is_number(); };
    const bool has_text = params.is_object() && std::ranges::any_of (params.asObject(), isText);
    if (type == nullptr || ! carriesOneUnit (*type) || has_text) search.is_mixed = true;

    for (const bool starts : { false, true })
        for (const int w : starts ? index.at (n).out : index.at (n).in)
        {
            if (w == search.except || ! wire (w).enabled.value_or (true)) continue;
            const auto* row = rowAt (n, starts ? wire (w).from.port : wire (w).to.port, starts);
            if (type != nullptr && (row == nullptr || isFixed (*row))) continue;
            addWire (w);
            reach (w, ! starts, search);
        }
}

bool Surroundings::addNewWire (int w)
{
    const int from = index.start (w), to = index.end (w);
    if (from == GraphIndex::none || to == GraphIndex::none || (wire (w).delay == 0 && leads (to, from))) return false;
    addWire (w);
    addRivals (w);
    Search start { .except = w }, end { .except = w };
    reach (w, true, start);
    reach (w, false, end);
    // If both ends have a unit, these must be equal. If nothing gives the smaller side a unit, any fits.
    bool goes_on = true;
    while (goes_on && ! start.isFree() && ! end.isFree())
    {
        goes_on = false;
        for (auto* search : { &start, &end })
            if (! search->open.empty() && ! search->isSettled())
            {
                step (*search);
                goes_on = true;
            }
    }
    return true;
}

graph::Graph Surroundings::made() const
{
    graph::Graph g;
    g.rate_hz = graph.rate_hz;
    g.folder = graph.folder;
    g.files = graph.files;
    g.devices = graph.devices;
    for (const int n : nodes)
        g.root.nodes.push_back (node (n));
    for (const int w : wires)
        g.root.wires.push_back (wire (w));
    for (const auto& name : patches)
        g.graphs.emplace_back (name, *graph.find (name));
    return g;
}

}   // namespace tactus::plan
