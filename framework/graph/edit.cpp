// SPDX-License-Identifier: MIT
#include "edit.hpp"

#include "endpoint_text.hpp"
#include "graph_parts.hpp"
#include <tactus/graph/edit/edit_checks.hpp>
#include <tactus/graph/edit/exchange_member.hpp>
#include <tactus/graph/edit/find_wire.hpp>
#include <tactus/graph/edit/references.hpp>
#include <tactus/graph/edit/refusals.hpp>
#include <tactus/graph/edit/regroup.hpp>

#include <tactus/kit/at.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::graph
{
namespace
{
/// The command that undoes an edit, or why the edit was refused.
using Inverse = Result<Command>;

template <typename T>
typename std::vector<T>::iterator iteratorAt (std::vector<T>& list, Place place)
{
    return list.begin() + static_cast<std::ptrdiff_t> (std::min (place.value_or (list.size()), list.size()));
}

template <typename Iterator, typename List>
std::size_t placeOf (Iterator it, List& list)
{
    return at (it - list.begin());
}

//==============================================================================
class Editor
{
public:
    Editor (Graph& g, Checks c) : graph (g), checks (c) {}

    Inverse operator() (const AddNode& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        if (patch->find (c.node.name) != nullptr) return nameTaken ("a node", c.node.name);
        if (checked())
        {
            if (isUsed (c.node.id, graph)) return idTaken ("node", c.node.name);
            if (auto wrong = check (c.node); ! wrong.empty()) return wrong.front();
        }
        patch->nodes.insert (iteratorAt (patch->nodes, c.place), c.node);
        return RemoveNode { c.patch, c.node.name, true };
    }

    Inverse operator() (const RemoveNode& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        const auto it = std::ranges::find (patch->nodes, c.name, &Node::name);
        if (it == patch->nodes.end()) return noNode (c.patch, c.name);

        Batch back { nameOf (c), {} };
        back.commands.push_back (AddNode { c.patch, *it, placeOf (it, patch->nodes) });
        if (! c.only_node) std::ranges::move (dropReferences (graph, c.patch, c.name), std::back_inserter (back.commands));
        patch->nodes.erase (it);
        if (back.commands.size() == 1) return std::move (back.commands.front());
        return back;
    }

    Inverse operator() (const RenameNode& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        const auto it = std::ranges::find (patch->nodes, c.name, &Node::name);
        if (it == patch->nodes.end()) return noNode (c.patch, c.name);
        if (patch->find (c.to) != nullptr) return nameTaken ("a node", c.to);
        if (checked() && ! isId (c.to)) return badId (c.to);

        Batch back { nameOf (c), {} };
        back.commands.push_back (RenameNode { c.patch, c.to, c.name, true });
        if (! c.only_node) std::ranges::move (renameReferences (graph, c.patch, c.name, c.to), std::back_inserter (back.commands));
        it->name = c.to;
        if (checked() && anythingTwice (graph))
        {
            // The new name already occurs in a reference, to a node that does not exist.
            takeBack (back.commands);
            return Message::error ("edit/name_taken", {}, "a control or an override already refers to " + quote (c.to),
                                   "remove that target or override first, or choose another name");
        }
        if (back.commands.size() == 1) return std::move (back.commands.front());
        return back;
    }

    Inverse operator() (const SetParam& c)
    {
        return checked() && c.value && ! isId (c.param) ? badId (c.param) : setMember (c, &Node::params, &SetParam::param);
    }
    Inverse operator() (const SetSetting& c)
    {
        return checked() && c.value && ! isId (c.setting) ? badId (c.setting) : setMember (c, &Node::settings, &SetSetting::setting);
    }

    Inverse operator() (const SetOverride& c)
    {
        if (checked())
            if (const auto parsed = parseOverride (c.path); ! parsed)
                return Message::error ("graph/bad_path", {}, parsed.error().text, "write node.param, or [3]/node.param for one instance");
        return setMember (c, &Node::overrides, &SetOverride::path);
    }

    Inverse operator() (const SetNodeKey& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        auto* node = find (*patch, c.node);
        if (node == nullptr) return noNode (c.patch, c.node);
        if (c.key == "params" || c.key == "settings")
            return Message::error ("edit/bad_value", {}, "the entries of " + quote (c.key) + " are set one at a time", "use SetParam or SetSetting");
        if (c.key == "type" && ! c.value) return Message::error ("edit/bad_value", {}, "a node must have a type", "give a type; `tactus nodes` lists all types");
        if (checked() && c.value)
            if (auto wrong = checkNodeKey (c.key, *c.value); ! wrong.empty()) return wrong.front();

        SetNodeKey back { c.patch, c.node, c.key };
        const auto text = [&] (std::string& old) {
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
    Inverse operator() (const AddWire& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        if (checked())
        {
            if (isUsed (c.wire.id, graph)) return idTaken ("wire", toText (c.wire));
            if (auto wrong = problemWith (c.wire, *patch, c.patch)) return *wrong;
        }
        patch->wires.insert (iteratorAt (patch->wires, c.place), c.wire);
        return RemoveWire { c.patch, c.wire.id };
    }

    Inverse operator() (const RemoveWire& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        auto id = c.wire;
        if (! c.text.empty())
        {
            const auto found = findWire (graph, c.patch, c.text);
            if (! found) return found.error();
            id = *found;
        }
        const auto it = std::ranges::find (patch->wires, id, &Wire::id);
        if (it == patch->wires.end()) return noWire (c.patch);
        AddWire back { c.patch, std::move (*it), placeOf (it, patch->wires) };
        patch->wires.erase (it);
        return back;
    }

    Inverse operator() (const ChangeWire& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        const auto it = std::ranges::find (patch->wires, c.wire, &Wire::id);
        if (it == patch->wires.end()) return noWire (c.patch);
        if (checked())
            if (auto wrong = problemWith (c.to, *patch, c.patch)) return *wrong;
        ChangeWire back { c.patch, c.wire, std::exchange (*it, c.to) };
        it->id = c.wire;
        return back;
    }

    Inverse operator() (const ChangeExpose& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        if (checked())
        {
            if (auto wrong = check (c.to); ! wrong.empty()) return wrong.front();
            for (const auto* list : { &c.to.inputs, &c.to.outputs, &c.to.params })
                for (const auto& [id, end] : *list)
                    if (auto wrong = problemWith (end.node, *patch, c.patch)) return *wrong;
        }
        return ChangeExpose { c.patch, std::exchange (patch->expose, c.to) };
    }

    //==============================================================================
    Inverse operator() (const AddControl& c)
    {
        if (findControl (c.control.id) != graph.controls.end()) return nameTaken ("a control", c.control.id);
        if (checked())
            if (auto wrong = problemWith (c.control, graph)) return *wrong;
        graph.controls.insert (iteratorAt (graph.controls, c.place), c.control);
        return RemoveControl { c.control.id };
    }

    Inverse operator() (const RemoveControl& c)
    {
        const auto it = findControl (c.control);
        if (it == graph.controls.end()) return noControl (c.control);
        AddControl back { std::move (*it), placeOf (it, graph.controls) };
        graph.controls.erase (it);
        return back;
    }

    Inverse operator() (const ChangeControl& c)
    {
        const auto it = findControl (c.control);
        if (it == graph.controls.end()) return noControl (c.control);
        if (c.to.id != c.control && findControl (c.to.id) != graph.controls.end()) return nameTaken ("a control", c.to.id);
        if (checked())
            if (auto wrong = problemWith (c.to, graph)) return *wrong;
        return ChangeControl { c.to.id, std::exchange (*it, c.to) };
    }

    //==============================================================================
    Inverse operator() (const AddSubgraph& c)
    {
        if (graph.find (c.name) != nullptr) return nameTaken ("a subgraph", c.name);
        if (checked())
        {
            if (! isId (c.name)) return badId (c.name);
            if (auto wrong = check (c.patch); ! wrong.empty()) return wrong.front();
            auto ids = usedIds (graph);
            for (const auto& node : c.patch.nodes)
                if (! ids.insert (node.id).second) return idTaken ("node", node.name);
            for (const auto& wire : c.patch.wires)
                if (! ids.insert (wire.id).second) return idTaken ("wire", toText (wire));
        }
        graph.graphs.emplace (iteratorAt (graph.graphs, c.place), c.name, c.patch);
        return RemoveSubgraph { c.name };
    }

    Inverse operator() (const RemoveSubgraph& c)
    {
        const auto it = std::ranges::find (graph.graphs, c.name, [] (const auto& g) -> const std::string& { return g.first; });
        if (it == graph.graphs.end()) return noPatch (c.name);
        if (checked())
        {
            const auto users = usersOf (graph, c.name);
            if (! users.empty())
                return Message::error ("edit/in_use", {}, "the subgraph " + quote (c.name) + " is the type of " + users, "remove these nodes first");
        }
        AddSubgraph back { c.name, std::move (it->second), placeOf (it, graph.graphs) };
        graph.graphs.erase (it);
        return back;
    }

    Inverse operator() (const RenameSubgraph& c)
    {
        const auto it = std::ranges::find (graph.graphs, c.name, [] (const auto& g) -> const std::string& { return g.first; });
        if (it == graph.graphs.end()) return noPatch (c.name);
        if (graph.find (c.to) != nullptr || ! usersOf (graph, c.to).empty()) return subgraphTaken (c.to);
        if (checked() && ! isId (c.to)) return badId (c.to);
        it->first = c.to;
        const auto follow = [&] (Patch& patch) {
            for (auto& node : patch.nodes)
                if (node.type == "graph:" + c.name) node.type = "graph:" + c.to;
        };
        follow (graph.root);
        for (auto& [name, patch] : graph.graphs)
            follow (patch);
        return RenameSubgraph { c.to, c.name };
    }

    Inverse operator() (const CollapseNodes& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        for (const auto& name : c.nodes)
            if (patch->find (name) == nullptr) return noNode (c.patch, name);
        if (c.nodes.empty()) return Message::error ("edit/bad_value", {}, "there are no nodes to collapse", "name at least one node");
        if (patch->find (c.name) != nullptr) return nameTaken ("a node", c.name);
        if (graph.find (c.subgraph) != nullptr || ! usersOf (graph, c.subgraph).empty()) return subgraphTaken (c.subgraph);
        for (const auto& name : { c.name, c.subgraph })
            if (! isId (name)) return badId (name);
        return regrouped ([&] { return collapse (graph, c); });
    }

    Inverse operator() (const ExpandNode& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        if (patch->find (c.name) == nullptr) return noNode (c.patch, c.name);
        return regrouped ([&] { return expand (graph, c); });
    }

    Inverse operator() (const ReplaceGraph& c)
    {
        auto before = std::make_shared<Graph> (std::move (graph));
        graph = *c.to;
        return ReplaceGraph { std::move (before) };
    }

    //==============================================================================
    Inverse operator() (const SetDevice& c)
    {
        if (checked() && c.description)
        {
            if (! isId (c.role)) return badId (c.role);
            if (! c.description->is_object()) return Message::error ("file/wrong_kind", {}, "the description of a device should be an object, {…}", "write {\"driver\": \"sim\"}");
            if (auto fits = checkValue (*c.description); ! fits) return std::move (fits).error();
        }
        const auto it = std::ranges::find (graph.devices, c.role, [] (const auto& d) -> const std::string& { return d.first; });
        SetDevice back { c.role };
        if (it == graph.devices.end())
        {
            if (! c.description) return Message::error ("edit/unknown_device", {}, "there is no device for the role " + quote (c.role), "name a role under `devices`");
            graph.devices.emplace (iteratorAt (graph.devices, c.place), c.role, *c.description);
        }
        else if (c.description)
            back.description = std::exchange (it->second, *c.description);
        else
        {
            back.description = std::move (it->second);
            back.place = placeOf (it, graph.devices);
            graph.devices.erase (it);
        }
        return back;
    }

    Inverse operator() (const SetHeader& c)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        if (! c.patch.empty() && (c.name || c.about || c.tags || c.rate_hz))
            return Message::error ("edit/bad_value", {}, "a subgraph does not have its own name, description, tags or rate", "set them in the graph");
        if (checked())
        {
            if (c.rate_hz && ! (*c.rate_hz > 0.0 && std::isfinite (*c.rate_hz)))
                return Message::error ("file/bad_value", {}, "the rate should be a finite number of Hz above 0", "4000 suits most devices");
            if (c.ui && ! c.ui->is_null() && ! c.ui->is_object()) return Message::error ("file/wrong_kind", {}, "'ui' should be an object, {…}", "write {} for an empty one");
            if (c.ui)
                if (auto fits = checkValue (*c.ui); ! fits) return std::move (fits).error();
        }
        SetHeader back { c.patch };
        if (c.name) back.name = std::exchange (graph.name, *c.name);
        if (c.about) back.about = std::exchange (graph.about, *c.about);
        if (c.tags) back.tags = std::exchange (graph.tags, *c.tags);
        if (c.rate_hz) back.rate_hz = std::exchange (graph.rate_hz, *c.rate_hz);
        if (c.ui)   // the place of `ui` does not matter, because the writer puts it last
            back.ui = exchangeMember (c.patch.empty() ? graph.extra : patch->extra, "ui", c.ui->is_null() ? std::nullopt : c.ui, std::nullopt)
                          .value.value_or (Json());
        return back;
    }

    Inverse operator() (const Batch& c)
    {
        Batch back { c.name, {} };
        for (const auto& command : c.commands)
        {
            auto inverse = std::visit (Editor (graph, checks), command.edit);
            if (! inverse)
            {
                std::ranges::reverse (back.commands);
                takeBack (back.commands);
                return inverse;
            }
            back.commands.push_back (*std::move (inverse));
        }
        std::ranges::reverse (back.commands);
        return back;
    }

private:
    bool checked() const { return checks == Checks::all; }

    Patch* find (const std::string& name)
    {
        if (name.empty()) return &graph.root;
        const auto it = std::ranges::find (graph.graphs, name, [] (const auto& g) -> const std::string& { return g.first; });
        return it == graph.graphs.end() ? nullptr : &it->second;
    }

    static Node* find (Patch& patch, const std::string& name)
    {
        const auto it = std::ranges::find (patch.nodes, name, &Node::name);
        return it == patch.nodes.end() ? nullptr : &*it;
    }

    std::vector<Control>::iterator findControl (const std::string& id) { return std::ranges::find (graph.controls, id, &Control::id); }

    template <typename C>
    Inverse setMember (const C& c, Json Node::*object, std::string C::*key)
    {
        auto* patch = find (c.patch);
        if (patch == nullptr) return noPatch (c.patch);
        auto* node = find (*patch, c.node);
        if (node == nullptr) return noNode (c.patch, c.node);
        if (checked() && c.value)
            if (auto fits = checkValue (*c.value); ! fits) return std::move (fits).error();
        auto old = exchangeMember (node->*object, c.*key, c.value, c.place);
        return C { c.patch, c.node, c.*key, std::move (old.value), old.place };
    }

    /// Carries out an edit that touches a large part of the graph, completely or not at all.
    template <typename Edit>
    Inverse regrouped (Edit edit)
    {
        auto before = std::make_shared<Graph> (graph);
        auto done = edit();
        if (done && checked() && anythingTwice (graph))
            done = Message::error ("edit/name_taken", {}, "a control or an override would refer to the same parameter twice",
                                   "remove one of the two first");
        if (done) return ReplaceGraph { std::move (before) };
        graph = std::move (*before);
        return std::move (done).error();
    }

    /// Undoes a half-done edit.
    void takeBack (const std::vector<Command>& commands)
    {
        for (const auto& command : commands)
            (void)std::visit (Editor (graph, Checks::none), command.edit);
    }

    Graph& graph;
    Checks checks;
};
}   // namespace

Result<Command> apply (Graph& graph, const Command& command, Checks checks)
{
    return std::visit (Editor (graph, checks), command.edit);
}

}   // namespace tactus::graph
