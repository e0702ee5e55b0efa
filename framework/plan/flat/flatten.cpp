// SPDX-License-Identifier: MIT
#include "flatten.hpp"
#include "roles.hpp"
#include "sections.hpp"
#include <tactus/plan/rules/wire_fit.hpp>
#include <tactus/plan/settings/node_settings.hpp>
#include <tactus/plan/values.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/instances.hpp>
#include <tactus/graph/overrides.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::plan
{

namespace
{
constexpr int max_depth = 32;

// Measured costs of compiling, in units of work (work_unit_s).
constexpr double work_per_node = 800.0, work_of_a_search = 10'000.0;

/// Adds the node that replaces an instance of a bypassed subgraph. It has the exposed ports of the subgraph, and its outputs pass on
/// the inputs of the same name. `scope` is the patch of the subgraph node; `inside` is the expanded instance, which learns the
/// number of the new node.
void addBypassNode (const Scope& scope, const graph::Node& node, Origin here, bool muted, Scope& inside, int instance, Flat& flat)
{
    NodeType type {};
    type.info = { .id = "subgraph", .name = "Bypassed subgraph", .summary = "", .source = "" };
    std::size_t offset = 0;
    int list_size = 0;
    for (const auto& x : inside.exposed)
    {
        if (x.to.empty()) continue;
        const auto& to = x.to.front();
        auto row = flat.sheet (to);
        row.role = x.role;
        row.id = flat.made_names.emplace_back (x.name);
        if (row.unit.kind != UnitRule::Kind::fixed) row.unit = each_its_unit;
        row.width = flat.widthOf (to);
        row.list = row.list && to.index < 0;
        if (row.list) list_size = std::max (list_size, flat.node (to).list_size);
        if (x.role == Role::output)
        {
            row.offset = offset;
            offset += sizeof (double) * at (row.list ? list_capacity : row.width);
        }
        auto& params_or_outputs = x.role == Role::param ? type.params : type.outputs;
        (x.role == Role::input ? type.inputs : params_or_outputs).push_back (row);
    }
    type.outputs_size = std::max (offset, sizeof (double));
    type.outputs_align = alignof (double);
    flat.made_types.push_back (std::move (type));

    inside.stand_in = flat.nodeCount();
    auto& made = flat.nodes.emplace_back (FlatNode { .path = inside.prefix.substr (0, inside.prefix.size() - 1),
                                                     .identity = { scope.number, node.id, instance },
                                                     .type = &flat.made_types.back(),
                                                     .origin = here,
                                                     .bypass = true,
                                                     .muted = muted,
                                                     .section = scope.section });
    made.list_size = list_size;
    addValues (made, flat);
}

class Flattener
{
public:
    Flattener (const Catalogue& c, std::span<const Override> o, Assets* a, Flattened& r)
        : nodes (c), overrides (o), assets (a), result (r), flat (r.flat) { flat.catalogue = c; }

    void runAlone (const graph::Graph& g, const std::string& subgraph, const graph::Patch& patch)
    {
        result.top = std::make_unique<Scope>();
        result.top->owner = &g;
        result.top->patch = &patch;
        result.top->origin = at ({}, "graphs", subgraph);
        expand (*result.top, {}, false);
        reportTooLarge();
    }

    void run (const graph::Graph& g)
    {
        auto& top = result.top;
        top = std::make_unique<Scope>();
        top->owner = &g;
        top->patch = &g.root;
        flat.nodes.reserve (g.root.nodes.size());
        flat.wires.reserve (g.root.wires.size());
        expand (*top, {}, false);
        if (! hasToStop()) readControls (g);
        if (! hasToStop()) readOverrides();
        reportTooLarge();
    }

private:
    const Catalogue& nodes;
    std::span<const Override> overrides;
    Assets* assets;
    Flattened& result;
    Flat& flat;
    std::vector<const graph::Patch*> open;      // the patches being expanded, outermost first
    Origin all_nodes = flat.at ({}, "nodes");   // the list `nodes` of the graph itself
    std::optional<Origin> too_large;            // the place where the graph became too large
    Message why_too_large;
    std::unordered_set<std::string> roles_seen;
    Ports starts, ends;                    // ports of the wire or value being read
    const NodeType* last_type = nullptr;   // of the node that was added last

    // These take views, because the Place that they make keeps pointing to the name.
    Origin at (Origin around, std::string_view name) { return flat.at (around, name); }
    Origin at (Origin around, std::string_view name, std::string_view inner) { return flat.at (around, name, inner); }

    void expand (Scope& scope, const Roles& roles, bool muted)
    {
        open.push_back (scope.patch);
        result.used.insert (scope.patch);
        scope.members.resize (scope.patch->nodes.size());
        const auto list = at (scope.origin, "nodes");
        for (const auto& node : scope.patch->nodes)
        {
            if (isTooLarge (all_nodes, 1) || flat.isFull()) break;
            const auto here = at (list, node.name);
            if (! node.origin.empty()) flat.origins.emplace (node.id, node.origin);
            auto& member = scope.members[scope.names.add (node.name)];
            if (node.type.starts_with ("graph:") || node.type.starts_with ("file:"))
                addSubgraph (scope, node, here, roles, muted, member);
            else
            {
                refuseSection (node, scope.prefix, here, flat);
                addNode (scope, node, here, roles, muted, member);
            }
        }
        if (! hasToStop())   // otherwise some of the nodes that names refer to are missing
        {
            expose (scope);
            addWires (scope, muted);
        }
        open.pop_back();
    }

    bool hasToStop() const noexcept { return too_large || flat.spent.is_over; }

    void reportTooLarge()
    {
        if (! too_large || flat.spent.is_over) return;
        flat.spent.is_over = true;
        flat.error (why_too_large.id, *too_large, why_too_large.text, why_too_large.remedy);
    }

    /// Call this before adding nodes, wires or assignments, because nested subgraphs and instances multiply them.
    bool isTooLarge (Origin here, std::size_t more_nodes = 0, std::size_t more_wires = 0)
    {
        const auto needed_nodes = flat.spent.nodes + static_cast<double> (flat.nodes.size() + flat.scopes.size() + more_nodes);
        const auto needed_wires = flat.spent.wires + static_cast<double> (std::max (flat.wires.size(), flat.assignments.size()) + more_wires);
        if (needed_nodes <= budgets().nodes && needed_wires <= budgets().wires) return hasToStop();
        const auto check = [&] (double Budgets::*which, double count) {
            if (hasToStop() || count <= budgets().*which) return;
            too_large = here;
            why_too_large =
                overBudget ("graph/too_large", which, "with its subgraphs expanded, the graph", count, "use a subgraph fewer times, or with fewer instances");
        };
        check (&Budgets::nodes, needed_nodes);
        check (&Budgets::wires, needed_wires);
        return hasToStop();
    }

    /// The remedy for an unknown node type. The graph may name the plugin, under the id of the type or its family.
    static std::string whatToInstall (const graph::Graph& g, const std::string& type)
    {
        const std::string fate = "it is kept as a placeholder whose outputs are 0; ";
        if (const auto plugins = g.extra.find ("plugins"); plugins != g.extra.end() && plugins->is_object())
            for (const auto& key : { type, type.substr (0, type.find ('.')) })
                if (const auto named = plugins->find (key); named != plugins->end() && named->is_string())
                    return fate + "install the plugin " + quote (named->get<std::string>());
        return fate + "`tactus nodes` lists all types";
    }

    /// " (did you mean 'deform.plane'?)" for "plane"; "graph:grain" for the name of a subgraph; or "".
    std::string typeMeant (const graph::Graph& g, const std::string& type) const
    {
        if (type.empty()) return {};
        if (g.find (type) != nullptr) return " (did you mean 'graph:" + type + "'?)";
        std::vector<std::string> ids;
        for (const auto& t : nodes)
        {
            if (t.info.id.ends_with ('.' + type)) return " (did you mean '" + std::string (t.info.id) + "'?)";
            ids.emplace_back (t.info.id);
        }
        return didYouMean (type, ids);
    }

    /// Nodes of one type are often next to each other.
    const NodeType* typeOf (const graph::Node& node)
    {
        if (last_type == nullptr || last_type->info.id != node.type) last_type = nodes.find (node.type);
        return last_type;
    }

    void addNode (Scope& scope, const graph::Node& node, Origin here, const Roles& roles, bool muted, Scope::Member& member)
    {
        const auto* type = typeOf (node);
        if (! flat.spend (type == nullptr ? work_of_a_search : work_per_node, 0.0, here)) return;
        if (type == nullptr)
        {
            flat.error ("node/unknown_type", at (here, "type"),
                        "'" + scope.prefix + node.name + "' has the unknown type '" + node.type + "'" + typeMeant (*scope.owner, node.type),
                        whatToInstall (*scope.owner, node.type));
            return;
        }

        if (node.extra.contains ("count"))
            flat.error ("node/needless_count", at (here, "count"),
                        "'" + scope.prefix + node.name + "' (" + node.type + ") is not a subgraph, and only subgraphs have several instances",
                        "collapse it to a subgraph and give the subgraph the `count`, or remove the `count`");

        member.node = flat.nodeCount();
        auto& made = flat.nodes.emplace_back();   // filled in there, because a graph may have many nodes
        made.path = scope.prefix.empty() ? node.name : scope.prefix + node.name;
        made.identity = { scope.number, node.id };
        made.type = type;
        made.origin = here;
        made.bypass = node.bypass;
        made.muted = muted;
        made.section = scope.section;
        readRole (node, here, roles, made, flat);
        countRole (made, here);
        readSettings (node, here, assets, scope.owner->folder, made, flat);
        addValues (made, flat);
        for (const auto& [key, value] : node.params.items())
            assignOwn (scope, node, here, member.node, key, value);
    }

    /// A key in the params of a node is nearly always a row of its datasheet. Any other key, such as "gain[2]" or a mistake, is read
    /// as an address.
    void assignOwn (const Scope& scope, const graph::Node& node, Origin here, int number, const std::string& key, const Json& value)
    {
        const auto& rows = flat.node (number).type->params;
        const auto row = std::ranges::find (rows, key, &PortSheet::id);
        if (row == rows.end() || ! graph::isId (node.name)) return assign (scope, node.name + "." + key, value, at (here, "params", key));

        // A valid plain number has no unit to check and is not unusual, and all other values for the param are processed later.
        const int port = static_cast<int> (row - rows.begin());
        const bool is_plain = value.is_number() && row->width == 1 && ! row->list && row->choices.empty() && isFinite (value.get<double>())
                              && row->limits.hard.contains (value.get<double>()) && ! isFarFromUsual (*row, value.get<double>());
        if (is_plain)
            flat.param (number, tactus::at (port))[0] = value.get<double>();
        else
            flat.assignments.push_back ({ { number, Role::param, port }, &value, &value, 0.0, at (here, "params", key) });
    }

    void countRole (const FlatNode& made, Origin here)
    {
        if (made.type->bind == nullptr || ! roles_seen.insert (made.role).second) return;
        if (const auto count = static_cast<double> (roles_seen.size()); count > budgets().roles && ! hasToStop())
        {
            too_large = here;
            why_too_large = overBudget ("graph/too_large", &Budgets::roles, "the graph", count, "let device nodes share roles");
        }
    }

    void addSubgraph (Scope& scope, const graph::Node& node, Origin here, const Roles& roles, bool muted, Scope::Member& member)
    {
        Scope first;
        if (! findSubgraph (scope, node, here, first)) return;

        if (open.size() >= max_depth)
        {
            if (! flat.spend (work_of_a_search, 0.0, here)) return;
            flat.error ("graph/too_deep", at (here, "type"), "'" + scope.prefix + node.name + "' is nested " + std::to_string (max_depth) + " subgraphs deep",
                        "nest the subgraphs less deeply");
            return;
        }
        if (std::ranges::count (open, first.patch) > 0)
        {
            flat.error ("graph/recursive", at (here, "type"), "'" + scope.prefix + node.name + "' contains itself through '" + node.type + "'",
                        "a subgraph can contain other subgraphs, but not one that contains it");
            return;
        }
        const auto count = graph::countOf (node);
        if (count == 0)
        {
            flat.error ("node/bad_count", at (here, "count"), "the `count` of '" + scope.prefix + node.name + "' is " + shown (node.extra.at ("count")),
                        "give a whole number from 1 to " + std::to_string (graph::most_instances) + "; without a `count` it is 1");
            return;
        }
        checkRoles (node, scope.prefix + node.name, here, *first.patch, count.value_or (1), flat);

        if (count && isTooLarge (at (here, "count"), tactus::at (*count) * (first.patch->nodes.size() + 1))) return;
        member.counted = count.has_value();
        const double work = work_per_node + work_per_value * static_cast<double> (node.roles.items().size() + roles.size());
        for (int k = 0; k < count.value_or (1) && ! isTooLarge (all_nodes) && ! flat.isFull(); ++k)
        {
            if (! flat.spend (work, 0.0, here)) break;
            auto inside = std::make_unique<Scope>();
            inside->owner = first.owner;
            inside->patch = first.patch;
            inside->origin = first.origin;
            inside->prefix = scope.prefix + node.name + (count ? "[" + std::to_string (k) + "]/" : "/");
            inside->number = static_cast<int> (flat.scopes.size());
            flat.scopes.push_back ({ scope.number, node.id, k });
            inside->section = openSection (node, scope.section, inside->prefix.substr (0, inside->prefix.size() - 1), here, flat);
            expand (*inside, rolesInside (node, roles, k), muted || node.bypass);
            member.instances.push_back (std::move (inside));
        }

        for (const auto& [key, value] : node.params.items())
            assign (scope, node.name + "." + key, value, at (here, "params", key));
        giveOverrides (scope, node, here);
        if (node.bypass)
            for (std::size_t k = 0; k < member.instances.size(); ++k)
                addBypassNode (scope, node, here, muted, *member.instances[k], static_cast<int> (k), flat);
    }

    void giveOverrides (const Scope& scope, const graph::Node& node, Origin here)
    {
        for (const auto* entry : graph::byPrecedence (node.overrides))
        {
            const auto& [key, value] = *entry;
            const auto origin = at (here, "overrides", key);
            auto inner = graph::parseOverride (key);
            if (inner)
            {
                inner->node.insert (0, node.name + (inner->node.starts_with ('[') ? "" : "/"));
                assign (scope, *inner, value, origin);
            }
            else
                flat.error ("param/name", origin, inner.error().text, "name a parameter, such as drag.mu");
        }
    }

    bool findSubgraph (const Scope& scope, const graph::Node& node, Origin here, Scope& inside)
    {
        const auto name = std::string_view (node.type).substr (node.type.find (':') + 1);
        if (node.type.starts_with ("graph:"))
        {
            inside.owner = scope.owner;
            inside.patch = scope.owner->find (name);
            inside.origin = at (fileOf (scope.origin), "graphs", name);
            const auto graphs = static_cast<double> (scope.owner->graphs.size());   // all of them are compared
            if (! flat.spend (inside.patch == nullptr ? work_per_value * graphs : graphs, 0.0, here)) return false;
            std::vector<std::string> names;
            if (inside.patch == nullptr)
                for (const auto& [id, patch] : scope.owner->graphs)
                    names.push_back (id);
            if (inside.patch == nullptr)
                flat.error ("graph/unknown_subgraph", at (here, "type"),
                            "there is no subgraph '" + std::string (name) + "' under `graphs`" + didYouMean (name, names), "subgraphs here: " + listed (names));
        }
        else if (const auto file = scope.owner->files.find (std::string (name)); file != scope.owner->files.end())
        {
            inside.owner = file->second.get();
            inside.patch = &inside.owner->root;
            inside.origin = flat.inFile (file->first);
        }
        else
            flat.error ("graph/unknown_file", at (here, "type"), "the subgraph file '" + std::string (name) + "' was not loaded",
                        "check the path; it is relative to the file that names it");
        return inside.patch != nullptr;
    }

    void expose (Scope& scope)
    {
        const auto add = [&] (Role role, Side side, const char* key, const auto& entries) {
            for (const auto& [name, endpoint] : entries)
            {
                auto& shown = scope.exposed.emplace_back (Scope::Exposed { role, name, {} });
                find (endpoint, side, scope, at (at (scope.origin, "expose", key), name), flat, shown.to);
            }
        };
        add (Role::input, Side::end, "inputs", scope.patch->expose.inputs);
        add (Role::output, Side::start, "outputs", scope.patch->expose.outputs);
        add (Role::param, Side::param, "params", scope.patch->expose.params);
    }

    void addWires (const Scope& scope, bool muted)
    {
        const auto list = at (scope.origin, "wires");
        for (std::size_t i = 0; i < scope.patch->wires.size(); ++i)
        {
            const auto& wire = scope.patch->wires[i];
            const auto origin = flat.entry (list, static_cast<int> (i));
            if (! wire.origin.empty()) flat.origins.emplace (wire.id, wire.origin);
            const bool starts_somewhere = find (wire.from, Side::start, scope, origin, flat, starts);
            if (! find (wire.to, Side::end, scope, origin, flat, ends) || ! starts_somewhere) continue;

            FlatWire w { .from = {},
                         .to = {},
                         .delay = wire.delay,
                         .add = wire.add,
                         .origin = origin,
                         .written = &wire,
                         .identity = { scope.number, wire.id },
                         .section = scope.section };
            const bool is_active = readGain (wire, w, flat) && ! muted && wire.enabled.value_or (true);
            addEach (w, is_active);
        }
    }

    /// Adds wires from all starts to all ends.
    void addEach (FlatWire& w, bool is_active)
    {
        const auto from = std::max (starts.size(), std::size_t { 1 });
        if (isTooLarge (w.origin, 0, from * ends.size())) return;
        for (const auto& to : ends)
            for (std::size_t k = 0; k < from; ++k)
            {
                w.to = to;
                if (! starts.empty()) w.from = starts[k];
                w.crosses = (w.from && flat.node (*w.from).section != w.section) || flat.node (to).section != w.section;
                if (! wireFits (w, flat) || ! is_active) continue;
                flat.wires.push_back (w);
            }
    }

    void assign (const Scope& scope, std::string_view name, const Json& value, Origin origin)
    {
        if (const auto e = parameter (name, origin)) assign (scope, *e, value, origin);
    }

    void assign (const Scope& scope, const graph::Endpoint& e, const Json& value, Origin origin)
    {
        if (hasToStop()) return;
        find (e, Side::param, scope, origin, flat, ends);
        if (isTooLarge (origin, 0, ends.size())) return;
        for (const auto& to : ends)
            flat.assignments.push_back ({ to, &value, &value, 0.0, origin });
    }

    std::optional<graph::Endpoint> parameter (std::string_view name, Origin origin)
    {
        auto parsed = graph::parseEndpoint (name);
        if (parsed) return *std::move (parsed);
        flat.error ("param/name", origin, parsed.error().text, "name a parameter, such as drag.mu");
        return {};
    }

    void readControls (const graph::Graph& g)
    {
        for (const auto& control : g.controls)
        {
            const auto origin = at ({}, "controls", control.id);
            auto value = control.value;
            for (const auto& o : overrides)
                if (o.name == control.id)
                {
                    if (const auto read = readNumber (o.value))
                        value = read->value;
                    else
                        flat.error ("control/value", origin, "control '" + control.id + "': " + read.error().text, "give a number from 0 to 1");
                }
            if (! (value >= 0.0 && value <= 1.0))
                flat.error ("control/value", at (origin, "value"), "control '" + control.id + "' is out of its range", "give a number from 0 to 1");

            for (const auto& t : control.to)
            {
                const auto here = at (at (origin, "to"), t.path);
                const auto e = parameter (t.path, here);
                if (! e) continue;
                find (*e, Side::param, *result.top, here, flat, ends);
                if (isTooLarge (here, 0, ends.size())) return;
                for (const auto& to : ends)
                    flat.assignments.push_back ({ to, &t.low, &t.high, value, here });
            }
        }
    }

    void readOverrides()
    {
        const auto& controls = result.top->owner->controls;
        for (const auto& o : overrides)
            if (std::ranges::count (controls, o.name, &graph::Control::id) == 0 && ! isMisspeltControl (o.name))
                assign (*result.top, o.name, o.value, flat.asIs ({}, "--set " + o.name));
    }

    /// A name without a dot can only be that of a control.
    bool isMisspeltControl (const std::string& name)
    {
        const auto& controls = result.top->owner->controls;
        if (controls.empty() || name.find ('.') != std::string::npos) return false;
        std::vector<std::string> ids;
        for (const auto& control : controls)
            ids.push_back (control.id);
        flat.error ("control/unknown", flat.asIs ({}, "--set " + name), "there is no control " + quote (name) + didYouMean (name, ids),
                    "controls here: " + listed (ids) + "; or name a parameter, such as drag.mu");
        return true;
    }
};
}   // namespace

Flattened flatten (const graph::Graph& g, const Catalogue& catalogue, std::span<const Override> overrides, Assets* assets, SettingFiles files)
{
    Flattened result;
    result.flat.reads_files = files == SettingFiles::read;
    Flattener { catalogue, overrides, assets, result }.run (g);
    readParams (result.flat);
    return result;
}

Flattened flattenUnused (const graph::Graph& g, const std::string& subgraph, const graph::Patch& patch, const Catalogue& catalogue, Assets* assets,
                         const Spent& spent, SettingFiles files)
{
    Flattened result;
    result.flat.reads_files = files == SettingFiles::read;
    result.flat.spent = spent;
    Flattener { catalogue, {}, assets, result }.runAlone (g, subgraph, patch);
    readParams (result.flat);
    return result;
}

}   // namespace tactus::plan
