// SPDX-License-Identifier: MIT
#include "graph_part.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>
#include <unordered_map>
#include <unordered_set>

namespace tactus::plan
{

namespace
{
constexpr std::array end_roles { Role::input, Role::param };
constexpr std::array start_roles { Role::output };

/// Collects the names of nodes and the ids of wires that belong to the part.
class Collector
{
public:
    Collector (const graph::Graph& g, const Touched& t, const Catalogue& c, const GraphIndex& w, bool j) : graph (g), touched (t), types (c), wiring (w), exhausts (j || isManifold (t)) {}

    Part run()
    {
        for (const auto& [name, how] : touched.nodes)
            touchNode (name, how);
        for (const auto& wire : touched.wires)
            touchWire (wire);
        touchControls();
        touchPatches();
        return made();
    }

private:
    /// True if several things that belong together may have changed.
    static bool isManifold (const Touched& t)
    {
        return t.nodes.size() + static_cast<std::size_t> (std::ranges::count (t.wires, true, &Touched::Cable::is_added)) > 1;
    }

    /// A search for ports whose units belong together.
    struct Search
    {
        graph::Id except = 0;   // the new wire, which joins the ports of this search and others
        std::vector<std::string> open {};
        bool has_anchor = false;      // a port with a fixed unit belongs to it
        bool may_have_unit = false;   // a value with a unit, or a subgraph, belongs to it, or ports whose product has a unit
        bool is_mixed = false;        // some ports that were reached may have other units, so all must be reached
        std::unordered_set<std::string> seen {};

        bool isSettled (bool exhausts) const { return has_anchor && ! is_mixed && ! exhausts; }
        bool isUnknown() const { return open.empty() && ! has_anchor && ! may_have_unit && ! is_mixed; }
    };

    const graph::Graph& graph;
    const Touched& touched;
    const Catalogue& types;
    const GraphIndex& wiring;
    const bool exhausts;   // all ports whose units belong together are needed
    std::vector<const graph::Node*> nodes;
    std::vector<const graph::Wire*> wires;
    std::unordered_set<std::string> node_names;
    std::unordered_set<graph::Id> wire_ids;
    std::unordered_map<std::string, const NodeType*> found_types;
    std::unordered_map<const NodeType*, bool> of_one_unit;
    std::set<std::string> patches;   // subgraphs that the part needs

    const NodeType* typeOf (const graph::Node& n)
    {
        const auto [known, is_new] = found_types.try_emplace (n.type, nullptr);
        if (is_new) known->second = types.find (n.type);
        return known->second;
    }

    const PortSheet* rowAt (const graph::Node& n, const graph::Endpoint& e, std::span<const Role> roles)
    {
        if (const auto* type = typeOf (n))
            for (const auto role : roles)
                if (const auto* row = rowOf (*type, e.port, role)) return row;
        return nullptr;
    }

    const graph::Node* addNode (const std::string& name)
    {
        const auto* n = wiring.node (name);
        if (n == nullptr || ! node_names.insert (name).second) return n;
        nodes.push_back (n);
        addSubgraphOf (graph, *n);
        return n;
    }

    void addSubgraphOf (const graph::Graph& owner, const graph::Node& n)
    {
        if (! n.type.starts_with ("graph:")) return;
        const auto name = n.type.substr (6);
        const auto* patch = owner.find (name);
        if (patch == nullptr || ! patches.insert (name).second) return;
        for (const auto& inner : patch->nodes)
            addSubgraphOf (owner, inner);
    }

    void addWire (const graph::Wire& w)
    {
        if (! wire_ids.insert (w.id).second) return;
        wires.push_back (&w);
        addNode (firstName (w.from.node));
        addNode (firstName (w.to.node));
    }

    void addWire (graph::Id id)
    {
        if (const auto* w = wiring.wire (id)) addWire (*w);
    }

    //==============================================================================
    void touchNode (const std::string& name, Touched::How how)
    {
        const auto* n = addNode (name);
        if (n == nullptr) return;
        if (how == Touched::How::node)
        {
            const auto links = wiring.at (name);   // a copy: adding nodes may look up others
            for (const auto* list : { &links.in, &links.out })
                for (const auto id : *list)
                    if (const auto* w = wiring.wire (id))
                    {
                        addWire (*w);
                        addRivals (*w);
                    }
            addLoops (name, name);
        }
        if (how != Touched::How::node && (how == Touched::How::number || ! hasFreeParam (*n))) return;
        Search search;
        reach (name, search);
        if (how == Touched::How::node)
            for (const auto* w : std::vector (wires))
            {
                reachEnd (w->from, start_roles, search);
                reachEnd (w->to, end_roles, search);
            }
        search.is_mixed = true;   // the node may have had any unit before, so all of them are needed
        while (! search.open.empty())
            step (search);
    }

    /// True if a value with a unit can tell what a port of the node carries.
    bool hasFreeParam (const graph::Node& n)
    {
        const auto* type = typeOf (n);
        return n.isSubgraph() || (type != nullptr && ! std::ranges::all_of (type->params, [] (const auto& row) { return row.unit.kind == UnitRule::Kind::fixed; }));
    }

    void touchWire (const Touched::Cable& cable)
    {
        addNode (firstName (cable.from.node));
        addNode (firstName (cable.to.node));
        addWire (cable.id);
        Search from { .except = cable.id }, to { .except = cable.id };
        reachEnd (cable.from, start_roles, from);
        reachEnd (cable.to, end_roles, to);
        if (! cable.is_added)   // less is known without the wire, so only the sums at generic ports may become wrong
        {
            while (exhausts && ! (from.open.empty() && to.open.empty()))
                for (auto* search : { &from, &to })
                    if (! search->open.empty()) step (*search);
            return;
        }
        if (const auto* w = wiring.wire (cable.id))
        {
            addRivals (*w);
            if (w->delay == 0) addLoops (firstName (w->to.node), firstName (w->from.node));
        }
        // If both ends have a unit, these must be equal. If nothing gives the smaller side a unit, any fits.
        while (! (from.isSettled (exhausts) && to.isSettled (exhausts)) && ! (! exhausts && (from.isUnknown() || to.isUnknown())))
        {
            bool any = false;
            for (auto* search : { &from, &to })
                if (! search->open.empty() && ! search->isSettled (exhausts))
                {
                    step (*search);
                    any = true;
                }
            if (! any) break;
        }
    }

    /// The other wires into the port where a wire ends, unless they may be summed.
    void addRivals (const graph::Wire& w)
    {
        const auto* n = wiring.node (firstName (w.to.node));
        if (n == nullptr) return;
        const auto* row = rowAt (*n, w.to, end_roles);
        const auto sums = [] (Quantity q) { return q == Quantity::force || q == Quantity::torque || q == Quantity::hit; };
        if (row != nullptr && row->role == Role::input && row->unit.kind == UnitRule::Kind::fixed && (sums (row->unit.unit.quantity) || row->unit.adds_up)) return;
        for (const auto id : std::vector (wiring.at (n->name).in))
            if (const auto* other = wiring.wire (id); other != nullptr && (n->isSubgraph() || other->to.port == w.to.port)) addWire (*other);
    }

    /// True if all ports of a type that have no fixed unit have the same one, up to a factor. Then one of them tells what all carry.
    bool carriesOneUnit (const NodeType& type)
    {
        const auto [known, is_new] = of_one_unit.try_emplace (&type, true);
        if (! is_new) return known->second;
        int free = 0;
        for (const auto* rows : { &type.inputs, &type.params, &type.outputs })
            for (const auto& row : *rows)
                switch (row.unit.kind)
                {
                case UnitRule::Kind::fixed:
                    break;
                case UnitRule::Kind::open:
                    ++free;
                    break;
                case UnitRule::Kind::same:
                    if (std::ranges::any_of (std::array { Role::input, Role::param, Role::output }, [&] (Role role) {
                            const auto* like = rowOf (type, row.unit.a, role);
                            return like != nullptr && like->unit.kind == UnitRule::Kind::fixed;
                        }))
                        known->second = false;
                    break;
                default:
                    known->second = false;
                }
        return known->second = known->second && free == 1;
    }

    //==============================================================================
    /// The end of a wire is reached.
    void reachEnd (const graph::Endpoint& e, std::span<const Role> roles, Search& search)
    {
        const auto name = firstName (e.node);
        const auto* n = wiring.node (name);
        if (n == nullptr) return;
        const auto* row = n->isSubgraph() ? nullptr : rowAt (*n, e, roles);
        if (row == nullptr && ! n->isSubgraph()) return;
        if (row != nullptr && row->unit.kind == UnitRule::Kind::fixed)
            search.has_anchor = true;
        else
            reach (name, search);
    }

    void reach (const std::string& name, Search& search)
    {
        if (search.seen.insert (name).second) search.open.push_back (name);
    }

    /// Follows the wires at the generic ports of a node.
    void step (Search& search)
    {
        const auto name = search.open.back();
        search.open.pop_back();
        const auto* n = addNode (name);
        if (n == nullptr) return;
        const auto* type = typeOf (*n);
        const bool is_open = n->isSubgraph();
        if (type == nullptr && ! is_open) return;
        if (is_open) search.may_have_unit = search.is_mixed = true;
        if (type != nullptr) search.is_mixed = search.is_mixed || ! carriesOneUnit (*type);
        for (const auto& [key, value] : n->params.items())
            search.may_have_unit = search.may_have_unit || ! value.is_number();
        search.may_have_unit = search.may_have_unit || ! graph.controls.empty();

        const auto links = wiring.at (name);
        const auto follow = [&] (graph::Id id, bool inwards) {
            const auto* w = wiring.wire (id);
            if (w == nullptr || (! exhausts && id == search.except)) return;
            const auto* row = is_open ? nullptr : inwards ? rowAt (*n, w->to, end_roles)
                                                          : rowAt (*n, w->from, start_roles);
            if (! is_open && (row == nullptr || row->unit.kind == UnitRule::Kind::fixed)) return;
            addWire (*w);
            if (inwards)
                reachEnd (w->from, start_roles, search);
            else
                reachEnd (w->to, end_roles, search);
        };
        for (const auto id : links.in)
            follow (id, true);
        for (const auto id : links.out)
            follow (id, false);
    }

    //==============================================================================
    /// The names that a value reaches within the tick from a node, one wire further in each step.
    struct Front
    {
        bool forwards;
        std::vector<std::string> open {};
        std::unordered_set<std::string> seen {};
    };

    /// Calls `visit` with the node at the other end of each wire that binds.
    template <typename Visit>
    void forEachNext (const std::string& name, bool forwards, Visit visit)
    {
        const auto& links = wiring.at (name);
        for (const auto id : forwards ? links.out : links.in)
        {
            const auto* w = wiring.wire (id);
            if (w == nullptr || w->delay > 0) continue;
            const auto from = firstName (w->from.node);
            const auto* start = wiring.node (from);
            const auto* type = start != nullptr ? typeOf (*start) : nullptr;
            if (type != nullptr && type->peek != nullptr && ! start->bypass) continue;
            visit (forwards ? firstName (w->to.node) : from, *w);
        }
    }

    void advance (Front& front)
    {
        const auto name = front.open.back();
        front.open.pop_back();
        forEachNext (name, front.forwards, [&] (const std::string& next, const graph::Wire&) {
            if (front.seen.insert (next).second) front.open.push_back (next);
        });
    }

    /// If a value that leaves `start` gets to `goal` within the tick, adds all that lies between. For a loop, `start` is where a new wire
    /// ends, and `goal` is where it begins. The searches from both sides go on until they meet, or one has nothing left.
    void addLoops (const std::string& start, const std::string& goal)
    {
        Front onward { true, { start }, {} }, back { false, { goal }, {} };
        if (start != goal)
        {
            onward.seen.insert (start);
            back.seen.insert (goal);
        }
        const auto meet = [&] { return std::ranges::any_of (onward.seen, [&] (const auto& n) { return back.seen.contains (n); }); };
        bool has_met = false;
        while (! has_met && ! onward.open.empty() && ! back.open.empty())
        {
            for (auto* front : { &onward, &back })
            {
                const auto& other = front == &onward ? back : onward;
                const auto name = front->open.back();
                front->open.pop_back();
                forEachNext (name, front->forwards, [&] (const std::string& next, const graph::Wire&) {
                    if (front->seen.insert (next).second) front->open.push_back (next);
                    has_met = has_met || other.seen.contains (next);
                });
                if (has_met || front->open.empty()) break;
            }
        }
        if (! has_met && ! meet()) return;
        for (auto* front : { &onward, &back })
            while (! front->open.empty())
                advance (*front);
        for (const auto& name : onward.seen)
            if (back.seen.contains (name))
                forEachNext (name, true, [&] (const std::string& next, const graph::Wire& w) {
                    if (back.seen.contains (next)) addWire (w);
                });
    }

    //==============================================================================
    void touchControls()
    {
        for (const auto& control : graph.controls)
            if (touched.controls.contains (control.id))
                for (const auto& target : control.to)
                    touchNode (firstNameOfTarget (target), Touched::How::value);
    }

    static std::string firstNameOfTarget (const graph::Control::Target& t)
    {
        const auto begin = std::min (t.path.find_first_not_of (" \t\r\n"), t.path.size());
        return t.path.substr (begin, t.path.find_first_of ("[/.", begin) - begin);
    }

    /// Everything where a touched subgraph is used.
    void touchPatches()
    {
        if (touched.patches.empty()) return;
        auto all = touched.patches;
        for (bool grows = true; grows;)
        {
            grows = false;
            for (const auto& [name, patch] : graph.graphs)
                if (! all.contains (name) && std::ranges::any_of (patch.nodes, [&] (const auto& n) { return uses (n, all); })) grows = all.insert (name).second;
        }
        for (const auto& n : graph.root.nodes)
            if (uses (n, all)) touchNode (n.name, Touched::How::node);
        for (const auto& name : touched.patches)
            if (const auto* patch = graph.find (name); patch != nullptr && patches.insert (name).second)
                for (const auto& inner : patch->nodes)
                    addSubgraphOf (graph, inner);
    }

    static bool uses (const graph::Node& n, const std::set<std::string>& names) { return n.type.starts_with ("graph:") && names.contains (n.type.substr (6)); }

    //==============================================================================
    Part made() const
    {
        Part part;
        auto& g = part.graph;
        g.rate_hz = graph.rate_hz;
        g.folder = graph.folder;
        g.files = graph.files;
        g.devices = graph.devices;
        if (const auto plugins = graph.extra.find ("plugins"); plugins != graph.extra.end()) g.extra["plugins"] = *plugins;
        for (const auto* n : nodes)
            g.root.nodes.push_back (*n);
        for (const auto* w : wires)
        {
            g.root.wires.push_back (*w);
            part.numbers.push_back (wiring.placeOf (*w));
        }
        for (const auto& [name, patch] : graph.graphs)
            if (patches.contains (name)) g.graphs.emplace_back (name, patch);
        for (const auto& control : graph.controls)
        {
            auto copy = control;
            std::erase_if (copy.to, [&] (const auto& t) { return ! node_names.contains (firstNameOfTarget (t)); });
            if (! copy.to.empty()) g.controls.push_back (std::move (copy));
        }
        return part;
    }
};
}   // namespace

const PortSheet* rowOf (const NodeType& type, std::string_view port, Role role)
{
    const auto& rows = role == Role::input ? type.inputs : role == Role::param ? type.params
                                                                               : type.outputs;
    const auto row = std::ranges::find (rows, port, &PortSheet::id);
    return row == rows.end() ? nullptr : &*row;
}

void Part::giveNumbers (Message& m) const
{
    constexpr std::string_view list = "/wires/";
    if (! m.file.empty() || ! m.where.starts_with (list)) return;
    std::size_t number = 0;
    const auto [end, fault] = std::from_chars (m.where.data() + list.size(), m.where.data() + m.where.size(), number);
    if (fault != std::errc() || number >= numbers.size()) return;
    m.where.replace (list.size(), static_cast<std::size_t> (end - m.where.data()) - list.size(), std::to_string (numbers[number]));
}

Part partOf (const graph::Graph& g, const Touched& touched, const Catalogue& types, const GraphIndex& wiring, bool joins)
{
    return Collector { g, touched, types, wiring, joins }.run();
}

}   // namespace tactus::plan
