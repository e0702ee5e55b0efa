// SPDX-License-Identifier: MIT
#include "edit.hpp"

#include "references.hpp"
#include "regroup.hpp"
#include "text.hpp"

#include <framework/file/graph_parts.hpp>
#include <framework/file/json_text.hpp>
#include <framework/in_quotes.hpp>
#include <framework/refused.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_set>

namespace tactus::graph
{
namespace
{
using Result = std::variant<Command, Message>;

template <typename T>
typename std::vector<T>::iterator iteratorAt (std::vector<T>& list, Place place)
{
    return list.begin() + static_cast<std::ptrdiff_t> (std::min (place.value_or (list.size()), list.size()));
}

template <typename Iterator, typename List>
std::size_t placeOf (Iterator at, List& list)
{
    return static_cast<std::size_t> (at - list.begin());
}

struct Member
{
    std::optional<Json> value;
    Place place;
};

/// Sets a member of an object, at a place if it is new, or removes it. Returns what to set to have the old one back.
Member exchangeMember (Json& object, const std::string& key, const std::optional<Json>& value, Place place)
{
    auto& members = object.get_ref<Json::object_t&>();
    const auto at = std::ranges::find (members, key, [] (const auto& m) -> const std::string&
                                       { return m.first; });
    if (at != members.end() && value) return { std::exchange (at->second, *value), std::nullopt };
    if (at == members.end() && ! value) return {};

    // Keys of an ordered object cannot be moved, so it is built again around the place.
    const auto index = at != members.end() ? placeOf (at, members) : std::min (place.value_or (members.size()), members.size());
    Member old;
    auto changed = Json::object();
    std::size_t i = 0;
    for (auto& [k, v] : members)
    {
        if (i++ == index)
        {
            if (! value)
            {
                old = { std::move (v), index };
                continue;
            }
            append (changed, key, *value);
        }
        append (changed, k, std::move (v));
    }
    if (value && index == i) append (changed, key, *value);
    object = std::move (changed);
    return old;
}

/// A key that stands twice among the targets of a control or in an object.
bool hasTwice (const Control& control)
{
    std::set<std::string_view> paths;
    return std::ranges::any_of (control.to, [&] (const auto& target)
                                { return ! paths.insert (target.path).second; });
}

//==============================================================================
class Editor
{
public:
    Editor (Graph& g, Checks c) : graph (g), checks (c) {}

    Result operator() (const AddNode& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        if (patch->find (c.node.name) != nullptr) return taken ("a node", c.node.name);
        if (checked())
        {
            if (idsOf (graph).contains (c.node.id)) return idTaken ("node", c.node.name);
            if (auto wrong = check (c.node); ! wrong.empty()) return wrong.front();
        }
        patch->nodes.insert (iteratorAt (patch->nodes, c.place), c.node);
        return RemoveNode { c.patch, c.node.name, true };
    }

    Result operator() (const RemoveNode& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        const auto at = std::ranges::find (patch->nodes, c.name, &Node::name);
        if (at == patch->nodes.end()) return noNode (c.patch, c.name);

        Batch back { nameOf (c), {} };
        back.commands.push_back (AddNode { c.patch, *at, placeOf (at, patch->nodes) });
        if (! c.only_node) std::ranges::move (dropReferences (graph, c.patch, c.name), std::back_inserter (back.commands));
        patch->nodes.erase (at);
        if (back.commands.size() == 1) return std::move (back.commands.front());
        return back;
    }

    Result operator() (const RenameNode& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        const auto at = std::ranges::find (patch->nodes, c.name, &Node::name);
        if (at == patch->nodes.end()) return noNode (c.patch, c.name);
        if (patch->find (c.to) != nullptr) return taken ("a node", c.to);
        if (checked() && ! isId (c.to)) return badId (c.to);

        Batch back { nameOf (c), {} };
        back.commands.push_back (RenameNode { c.patch, c.to, c.name, true });
        if (! c.only_node) std::ranges::move (renameReferences (graph, c.patch, c.name, c.to), std::back_inserter (back.commands));
        at->name = c.to;
        if (checked() && anythingTwice())
        {
            // Something that was never there has been referred to by the new name.
            takeBack (back.commands);
            return refused ("edit/name_taken", "a control or an override refers to " + inQuotes (c.to) + " already", "remove that target first, or choose another name");
        }
        if (back.commands.size() == 1) return std::move (back.commands.front());
        return back;
    }

    Result operator() (const SetParam& c) { return checked() && c.value && ! isId (c.param) ? badId (c.param) : setMember (c, &Node::params, &SetParam::param); }
    Result operator() (const SetSetting& c) { return checked() && c.value && ! isId (c.setting) ? badId (c.setting) : setMember (c, &Node::settings, &SetSetting::setting); }

    Result operator() (const SetOverride& c)
    {
        if (const auto parsed = parseOverride (c.path); checked() && parsed.index() == 1) return refused ("graph/bad_path", std::get<std::string> (parsed), "write node.param, or [3]/node.param for one instance");
        return setMember (c, &Node::overrides, &SetOverride::path);
    }

    Result operator() (const SetNodeKey& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        auto* node = find (*patch, c.node);
        if (node == nullptr) return noNode (c.patch, c.node);
        if (c.key == "params" || c.key == "settings") return refused ("edit/bad_value", inQuotes (c.key) + " are set one by one", "use SetParam or SetSetting");
        if (c.key == "type" && ! c.value) return refused ("edit/bad_value", "a node cannot be without a type");
        if (checked() && c.value)
            if (auto wrong = checkNodeKey (c.key, *c.value); ! wrong.empty()) return wrong.front();

        SetNodeKey back { c.patch, c.node, c.key };
        const auto text = [&] (std::string& old)
        {
            if (! old.empty()) back.value = old;
            old = c.value ? c.value->get<std::string>() : "";
        };
        if (c.key == "type")
            text (node->type);
        else if (c.key == "role")
            text (node->role);
        else if (c.key == "bypass")
        {
            if (node->bypass) back.value = true;
            node->bypass = c.value && c.value->get<bool>();
        }
        else if (c.key == "roles")
        {
            if (! node->roles.is_null()) back.value = node->roles;
            node->roles = c.value.value_or (Json());
        }
        else if (c.key == "overrides")
        {
            back.value = node->overrides;
            node->overrides = c.value.value_or (Json::object());
        }
        else
        {
            auto old = exchangeMember (node->extra, c.key, c.value, c.place);
            back.value = std::move (old.value);
            back.place = old.place;
        }
        return back;
    }

    //==============================================================================
    Result operator() (const AddWire& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        if (checked())
        {
            if (idsOf (graph).contains (c.wire.id)) return idTaken ("wire", toText (c.wire));
            if (auto wrong = problem (*patch, c.patch, c.wire)) return *wrong;
        }
        patch->wires.insert (iteratorAt (patch->wires, c.place), c.wire);
        return RemoveWire { c.patch, c.wire.id };
    }

    Result operator() (const RemoveWire& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        const auto at = std::ranges::find (patch->wires, c.wire, &Wire::id);
        if (at == patch->wires.end()) return noWire (c.patch);
        AddWire back { c.patch, std::move (*at), placeOf (at, patch->wires) };
        patch->wires.erase (at);
        return back;
    }

    Result operator() (const ChangeWire& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        const auto at = std::ranges::find (patch->wires, c.wire, &Wire::id);
        if (at == patch->wires.end()) return noWire (c.patch);
        if (checked())
            if (auto wrong = problem (*patch, c.patch, c.to)) return *wrong;
        ChangeWire back { c.patch, c.wire, std::exchange (*at, c.to) };
        at->id = c.wire;
        return back;
    }

    Result operator() (const ChangeExpose& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        if (checked())
        {
            if (auto wrong = check (c.to); ! wrong.empty()) return wrong.front();
            for (const auto* list : { &c.to.inputs, &c.to.outputs, &c.to.params })
                for (const auto& [id, end] : *list)
                    if (auto wrong = problem (*patch, c.patch, end.node)) return *wrong;
        }
        return ChangeExpose { c.patch, std::exchange (patch->expose, c.to) };
    }

    //==============================================================================
    Result operator() (const AddControl& c)
    {
        if (findControl (c.control.id) != graph.controls.end()) return taken ("a control", c.control.id);
        if (checked())
            if (auto wrong = problem (c.control)) return *wrong;
        graph.controls.insert (iteratorAt (graph.controls, c.place), c.control);
        return RemoveControl { c.control.id };
    }

    Result operator() (const RemoveControl& c)
    {
        const auto at = findControl (c.control);
        if (at == graph.controls.end()) return noControl (c.control);
        AddControl back { std::move (*at), placeOf (at, graph.controls) };
        graph.controls.erase (at);
        return back;
    }

    Result operator() (const ChangeControl& c)
    {
        const auto at = findControl (c.control);
        if (at == graph.controls.end()) return noControl (c.control);
        if (c.to.id != c.control && findControl (c.to.id) != graph.controls.end()) return taken ("a control", c.to.id);
        if (checked())
            if (auto wrong = problem (c.to)) return *wrong;
        return ChangeControl { c.to.id, std::exchange (*at, c.to) };
    }

    //==============================================================================
    Result operator() (const AddSubgraph& c)
    {
        if (graph.find (c.name) != nullptr) return taken ("a subgraph", c.name);
        if (checked())
        {
            if (! isId (c.name)) return badId (c.name);
            if (auto wrong = check (c.patch); ! wrong.empty()) return wrong.front();
            auto ids = idsOf (graph);
            for (const auto& node : c.patch.nodes)
                if (! ids.insert (node.id).second) return idTaken ("node", node.name);
            for (const auto& wire : c.patch.wires)
                if (! ids.insert (wire.id).second) return idTaken ("wire", toText (wire));
        }
        graph.graphs.emplace (iteratorAt (graph.graphs, c.place), c.name, c.patch);
        return RemoveSubgraph { c.name };
    }

    Result operator() (const RemoveSubgraph& c)
    {
        const auto at = std::ranges::find (graph.graphs, c.name, [] (const auto& g) -> const std::string&
                                           { return g.first; });
        if (at == graph.graphs.end()) return noPatch (c.name);
        if (checked())
        {
            const auto users = usersOf (c.name);
            if (! users.empty()) return refused ("edit/in_use", "the subgraph " + inQuotes (c.name) + " is the type of " + users, "remove these nodes first");
        }
        AddSubgraph back { c.name, std::move (at->second), placeOf (at, graph.graphs) };
        graph.graphs.erase (at);
        return back;
    }

    Result operator() (const RenameSubgraph& c)
    {
        const auto at = std::ranges::find (graph.graphs, c.name, [] (const auto& g) -> const std::string&
                                           { return g.first; });
        if (at == graph.graphs.end()) return noPatch (c.name);
        if (graph.find (c.to) != nullptr || ! usersOf (c.to).empty()) return taken ("a subgraph, or a node of one,", c.to);
        if (checked() && ! isId (c.to)) return badId (c.to);
        at->first = c.to;
        const auto follow = [&] (Patch& patch)
        {
            for (auto& node : patch.nodes)
                if (node.type == "graph:" + c.name) node.type = "graph:" + c.to;
        };
        follow (graph.root);
        for (auto& [name, patch] : graph.graphs)
            follow (patch);
        return RenameSubgraph { c.to, c.name };
    }

    Result operator() (const CollapseNodes& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        for (const auto& name : c.nodes)
            if (patch->find (name) == nullptr) return noNode (c.patch, name);
        if (c.nodes.empty()) return refused ("edit/bad_value", "there are no nodes to collapse");
        if (patch->find (c.name) != nullptr) return taken ("a node", c.name);
        if (graph.find (c.subgraph) != nullptr || ! usersOf (c.subgraph).empty()) return taken ("a subgraph, or a node of one,", c.subgraph);
        for (const auto& name : { c.name, c.subgraph })
            if (! isId (name)) return badId (name);
        return regrouped ([&]
                          { return collapse (graph, c); });
    }

    Result operator() (const ExpandNode& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        if (patch->find (c.name) == nullptr) return noNode (c.patch, c.name);
        return regrouped ([&]
                          { return expand (graph, c); });
    }

    Result operator() (const ReplaceGraph& c)
    {
        auto before = std::make_shared<Graph> (std::move (graph));
        graph = *c.to;
        return ReplaceGraph { std::move (before) };
    }

    //==============================================================================
    Result operator() (const SetDevice& c)
    {
        if (checked() && c.description)
        {
            if (! isId (c.role)) return badId (c.role);
            if (! c.description->is_object()) return refused ("file/wrong_kind", "the description of a device should be an object, {…}");
            if (auto wrong = problemOf (*c.description)) return refused ("edit/bad_value", *wrong);
        }
        const auto at = std::ranges::find (graph.devices, c.role, [] (const auto& d) -> const std::string&
                                           { return d.first; });
        SetDevice back { c.role };
        if (at == graph.devices.end())
        {
            if (! c.description) return refused ("edit/unknown_device", "there is no device for the role " + inQuotes (c.role));
            graph.devices.emplace (iteratorAt (graph.devices, c.place), c.role, *c.description);
        }
        else if (c.description)
            back.description = std::exchange (at->second, *c.description);
        else
        {
            back.description = std::move (at->second);
            back.place = placeOf (at, graph.devices);
            graph.devices.erase (at);
        }
        return back;
    }

    Result operator() (const SetHeader& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        if (! c.patch.empty() && (c.name || c.about || c.tags || c.rate_hz)) return refused ("edit/bad_value", "a subgraph has no name, text, tags or rate of its own", "set them in the graph");
        if (checked())
        {
            if (c.rate_hz && ! (*c.rate_hz > 0.0 && std::isfinite (*c.rate_hz))) return refused ("file/bad_value", "the rate should be a finite number of Hz above 0", "4000 suits most devices");
            if (c.ui && ! c.ui->is_null() && ! c.ui->is_object()) return refused ("file/wrong_kind", "'ui' should be an object, {…}");
            if (c.ui)
                if (auto wrong = problemOf (*c.ui)) return refused ("edit/bad_value", *wrong);
        }
        SetHeader back { c.patch };
        if (c.name) back.name = std::exchange (graph.name, *c.name);
        if (c.about) back.about = std::exchange (graph.about, *c.about);
        if (c.tags) back.tags = std::exchange (graph.tags, *c.tags);
        if (c.rate_hz) back.rate_hz = std::exchange (graph.rate_hz, *c.rate_hz);
        if (c.ui)   // its place does not matter: it is written last
            back.ui = exchangeMember (c.patch.empty() ? graph.extra : patch->extra, "ui", c.ui->is_null() ? std::nullopt : c.ui, std::nullopt).value.value_or (Json());
        return back;
    }

    Result operator() (const Batch& c)
    {
        Batch back { c.name, {} };
        for (const auto& command : c.commands)
        {
            auto result = apply (graph, command, checks);
            if (auto* message = std::get_if<Message> (&result))
            {
                std::ranges::reverse (back.commands);
                takeBack (back.commands);
                return std::move (*message);
            }
            back.commands.push_back (std::move (std::get<Command> (result)));
        }
        std::ranges::reverse (back.commands);
        return back;
    }

private:
    bool checked() const { return checks == Checks::all; }

    Patch* find (const std::string& name)
    {
        if (name.empty()) return &graph.root;
        const auto at = std::ranges::find (graph.graphs, name, [] (const auto& g) -> const std::string&
                                           { return g.first; });
        return at == graph.graphs.end() ? nullptr : &at->second;
    }

    static Node* find (Patch& patch, const std::string& name)
    {
        const auto at = std::ranges::find (patch.nodes, name, &Node::name);
        return at == patch.nodes.end() ? nullptr : &*at;
    }

    std::vector<Control>::iterator findControl (const std::string& id) { return std::ranges::find (graph.controls, id, &Control::id); }

    template <typename C>
    Result setMember (const C& c, Json Node::*object, std::string C::*key)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        auto* node = find (*patch, c.node);
        if (node == nullptr) return noNode (c.patch, c.node);
        if (checked() && c.value)
            if (auto wrong = problemOf (*c.value)) return refused ("edit/bad_value", *wrong);
        auto old = exchangeMember (node->*object, c.*key, c.value, c.place);
        return C { c.patch, c.node, c.*key, std::move (old.value), old.place };
    }

    /// The nodes of a subgraph, but for those inside of it, as a sentence lists them.
    std::string usersOf (const std::string& subgraph) const
    {
        std::string users;
        const auto search = [&] (const std::string& name, const Patch& patch)
        {
            if (name == subgraph) return;
            for (const auto& node : patch.nodes)
                if (node.type == "graph:" + subgraph) users += (users.empty() ? "" : ", ") + (name.empty() ? "" : name + "/") + node.name;
        };
        search ("", graph.root);
        for (const auto& [name, patch] : graph.graphs)
            search (name, patch);
        return users;
    }

    /// Carries out an edit that touches much, all of it or nothing.
    template <typename Edit>
    Result regrouped (Edit edit)
    {
        auto before = std::make_shared<Graph> (graph);
        auto problem = edit();
        if (! problem && checked() && anythingTwice()) problem = refused ("edit/name_taken", "a control or an override would refer to one thing twice");
        if (! problem) return ReplaceGraph { std::move (before) };
        graph = std::move (*before);
        return std::move (*problem);
    }

    /// Carries out what undoes a half-done edit.
    void takeBack (const std::vector<Command>& commands)
    {
        for (const auto& command : commands)
            apply (graph, command, Checks::none);
    }

    //==============================================================================
    /// A node that a path begins with and that is not there.
    std::optional<Message> problem (const Patch& patch, const std::string& in, std::string_view path) const
    {
        const auto name = std::string (path.substr (0, path.find_first_of ("[/.")));
        if (patch.find (name) != nullptr) return std::nullopt;
        return noNode (in, name);
    }

    std::optional<Message> problem (const Patch& patch, const std::string& in, const Wire& wire) const
    {
        if (auto wrong = check (wire); ! wrong.empty()) return wrong.front();
        if (auto wrong = problem (patch, in, wire.from.node)) return wrong;
        return problem (patch, in, wire.to.node);
    }

    std::optional<Message> problem (const Control& control) const
    {
        if (auto wrong = check (control); ! wrong.empty()) return wrong.front();
        for (const auto& target : control.to)
            if (auto wrong = problem (graph.root, "", std::string_view (target.path).substr (std::min (target.path.size(), target.path.find_first_not_of (" \t\r\n"))))) return wrong;
        return std::nullopt;
    }

    bool anythingTwice() const
    {
        const auto in = [] (const Patch& patch)
        {
            return std::ranges::any_of (patch.nodes, [] (const Node& n)
                                        { return ! n.overrides.empty() && problemOf (n.overrides); });
        };
        return std::ranges::any_of (graph.controls, hasTwice) || in (graph.root)
               || std::ranges::any_of (graph.graphs, [&] (const auto& g)
                                       { return in (g.second); });
    }

    static std::unordered_set<Id> idsOf (const Graph& g)
    {
        std::unordered_set<Id> ids;
        const auto add = [&] (const Patch& patch)
        {
            for (const auto& node : patch.nodes)
                ids.insert (node.id);
            for (const auto& wire : patch.wires)
                ids.insert (wire.id);
        };
        add (g.root);
        for (const auto& [name, patch] : g.graphs)
            add (patch);
        return ids;
    }

    static std::string inside (const std::string& patch) { return patch.empty() ? "" : " in the subgraph " + inQuotes (patch); }
    static Message noPatch (const std::string& name) { return refused ("edit/unknown_patch", "there is no subgraph " + inQuotes (name)); }
    static Message noNode (const std::string& patch, const std::string& name) { return refused ("edit/unknown_node", "there is no node " + inQuotes (name) + inside (patch)); }
    static Message noWire (const std::string& patch) { return refused ("edit/unknown_wire", "the wire is not there any more" + inside (patch)); }
    static Message noControl (const std::string& id) { return refused ("edit/unknown_control", "there is no control " + inQuotes (id)); }
    static Message badId (const std::string& id) { return refused ("graph/bad_id", inQuotes (id) + " is not an id", "ids are small letters, digits and _, and begin with a letter"); }
    static Message taken (const std::string& what, const std::string& name) { return refused ("edit/name_taken", what + " called " + inQuotes (name) + " is there already", "choose another name"); }
    static Message idTaken (const std::string& what, const std::string& name) { return refused ("edit/id_taken", "the " + what + ' ' + inQuotes (name) + " has the id of another that is in the graph", "give a copy an id of its own with newId()"); }

    Graph& graph;
    Checks checks;
};
}   // namespace

Result apply (Graph& graph, const Command& command, Checks checks) { return std::visit (Editor (graph, checks), command.edit); }

}   // namespace tactus::graph
