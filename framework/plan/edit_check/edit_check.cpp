// SPDX-License-Identifier: MIT
#include "surroundings.hpp"
#include <tactus/plan/rules/examine.hpp>

#include <tactus/graph/edit_check.hpp>
#include <tactus/node/node_fault.hpp>

#include <algorithm>
#include <charconv>

namespace tactus::plan
{

namespace
{
/// "grain" for "/graphs/grain/nodes/wave/type".
std::string_view patchOf (std::string_view where)
{
    constexpr std::string_view list = "/graphs/";
    return where.starts_with (list) ? where.substr (list.size(), where.find ('/', list.size()) - list.size()) : std::string_view();
}

/// Replaces the number of a wire in a JSON pointer by its id, so that the place stays the same when other wires come and go.
std::string placeOf (const Message& m, const graph::Graph& g)
{
    auto where = m.where;
    const auto patch = where.starts_with ("/graphs/") ? g.find (patchOf (where)) : &g.root;
    const auto list = where.starts_with ("/wires/") ? 0 : where.find ("/wires/");
    if (m.file.empty() && patch != nullptr && list != std::string::npos)
    {
        std::size_t number = 0;
        const auto begin = list + 7;
        const auto [end, fault] = std::from_chars (where.data() + begin, where.data() + where.size(), number);
        if (fault == std::errc() && number < patch->wires.size())
            where.replace (begin, static_cast<std::size_t> (end - where.data()) - begin, std::to_string (patch->wires[number].id));
    }
    return m.file + where;
}

/// True if all nodes of the graph keep their numbers when the command is carried out, so that some are at most added at the end.
bool keepsNumbers (const graph::Command& command)
{
    if (const auto* c = std::get_if<graph::AddNode> (&command.edit)) return c->patch.empty() && ! c->place;
    if (const auto* c = std::get_if<graph::AddWire> (&command.edit)) return c->patch.empty() && ! c->place;
    if (const auto* c = std::get_if<graph::RemoveWire> (&command.edit)) return c->patch.empty();
    return std::holds_alternative<graph::SetParam> (command.edit) || std::holds_alternative<graph::SetHeader> (command.edit);
}

/// True if no rule of compiling is about what the command changes.
bool changesNoRule (const graph::Command& command)
{
    constexpr std::array ruled { "type", "role", "roles", "bypass", "overrides", "count", "every", "times", "hold" };
    if (const auto* c = std::get_if<graph::SetNodeKey> (&command.edit)) return std::ranges::count (ruled, c->key) == 0;
    if (const auto* c = std::get_if<graph::SetHeader> (&command.edit)) return ! c->rate_hz;
    return std::holds_alternative<graph::RenameNode> (command.edit) || std::holds_alternative<graph::RenameSubgraph> (command.edit)
           || std::holds_alternative<graph::RemoveControl> (command.edit) || std::holds_alternative<graph::SetDevice> (command.edit)
           || std::holds_alternative<graph::ReplaceGraph> (command.edit);   // a graph that is loaded may have errors
}

/// Looks only at what a single edit touches. If that does not prove that the edit adds no error, the whole graph is checked.
class CompileCheck final : public graph::EditCheck
{
public:
    CompileCheck (const Catalogue& t, graph::KnownElsewhere k) : types (t), known_elsewhere (std::move (k)) {}

    void forget() override
    {
        index.forget();
        is_simple = false;
    }

    bool mayAddError (const graph::Graph& g, const graph::Command& command) override
    {
        if (std::holds_alternative<graph::ReplaceGraph> (command.edit)) forget();
        if (! keepsNumbers (command)) index.forget();
        if (const auto* c = std::get_if<graph::RemoveWire> (&command.edit)) index.remove (c->wire);
        if (changesNoRule (command) || (is_simple && std::visit (Proof { *this, g }, command.edit))) return false;
        index.forget();
        is_simple = true;   // until problems() finds otherwise
        return true;
    }

    std::vector<graph::Problem> problems (const graph::Graph& g) override
    {
        auto found = look (g);
        is_simple = is_simple && found.is_simple;
        std::vector<graph::Problem> problems;
        for (auto& m : found.messages)
            if (! isFine (m, g))
            {
                auto place = placeOf (m, g);
                problems.push_back ({ std::move (place), std::move (m) });
            }
        return problems;
    }

private:
    struct Look
    {
        Messages messages {};
        bool is_simple = false;   // there is only one rate, and the datasheets alone say where several wires are summed
    };

    const Catalogue& types;
    graph::KnownElsewhere known_elsewhere;
    GraphIndex index;
    bool is_simple = false;   // the whole graph surely is. Then an edit of a node or wire has no consequences far away

    Look look (const graph::Graph& g) const
    {
        try
        {
            auto found = plan::examine (g, types, { .rate_hz = g.rate_hz, .services = {} }, {}, nullptr, SettingFiles::left_out);
            auto& flat = found.flattened.flat;
            return { std::move (flat.messages), flat.sectionCount() == 1 && ! found.wires_decide };
        }
        catch (const NodeFault&)
        {
            return {};   // compile() reports it
        }
    }

    /// True if an edit may leave this behind: a node that is not finished, or of a type that the program knows.
    bool isFine (const Message& m, const graph::Graph& g) const
    {
        if (m.severity != Message::Severity::error || m.id == "node/no_role") return true;
        if (m.id != "node/unknown_type" || ! known_elsewhere) return false;
        const auto isKnown = [this] (const graph::Node* n) { return n != nullptr && known_elsewhere (n->type); };
        constexpr std::string_view list = "/nodes/", key = "/type";
        const auto begin = m.where.find (list) + list.size(), end = m.where.size() - key.size();
        const auto* patch = m.where.starts_with (list) ? &g.root : g.find (patchOf (m.where));
        return m.file.empty() && patch != nullptr && begin < end && isKnown (patch->find (m.where.substr (begin, end - begin)));
    }

    /// Returns true if a command that has been carried out on a simple graph surely adds no error.
    struct Proof
    {
        CompileCheck& check;
        const graph::Graph& graph;

        bool operator() (const graph::AddNode& c) const { return c.patch.empty() && isRight (c.node.name); }
        bool operator() (const graph::RemoveNode& c) const { return c.patch.empty() && exposesNothing(); }
        bool operator() (const graph::SetParam& c) const
        {
            const auto* n = c.patch.empty() ? graph.root.find (c.node) : nullptr;
            if (n == nullptr) return false;
            const auto* type = check.types.find (n->type);
            const bool tells_unit = c.value && ! c.value->is_number() && (type == nullptr || ! hasFixedUnits (*type));
            return ! tells_unit && isRight (c.node);
        }
        bool operator() (const graph::AddWire& c) const { return c.patch.empty() && isRight (c.wire.id); }
        bool operator() (const graph::RemoveWire& c) const { return c.patch.empty(); }
        bool operator() (const graph::ChangeWire& c) const { return c.patch.empty() && isRight (c.wire); }

        template <typename Other>
        bool operator() (const Other&) const
        {
            return false;
        }

    private:
        bool isRight (const Surroundings& around) const
        {
            const auto part = around.made();
            const auto found = check.look (part);
            return found.is_simple && std::ranges::all_of (found.messages, [&] (const Message& m) { return check.isFine (m, part); });
        }

        bool isRight (const std::string& node) const
        {
            check.index.follow (graph.root);
            Surroundings around { graph, check.index, check.types };
            around.addNode (check.index.node (node));
            return isRight (around);
        }

        bool isRight (graph::Id wire) const
        {
            const auto hasUnit = [] (const auto& target) { return ! target.low.is_number() || ! target.high.is_number(); };
            const auto tells_unit = [&] (const graph::Control& c) { return std::ranges::any_of (c.to, hasUnit); };
            if (std::ranges::any_of (graph.controls, tells_unit)) return false;
            check.index.follow (graph.root);
            const auto& wires = graph.root.wires;
            const auto found = wires.back().id == wire ? wires.end() - 1 : std::ranges::find (wires, wire, &graph::Wire::id);
            Surroundings around { graph, check.index, check.types };
            return around.addNewWire (static_cast<int> (found - wires.begin())) && isRight (around);
        }

        bool exposesNothing() const
        {
            const auto& e = graph.root.expose;
            return e.inputs.empty() && e.outputs.empty() && e.params.empty();
        }
    };
};
}   // namespace

}   // namespace tactus::plan

std::unique_ptr<tactus::graph::EditCheck> tactus::graph::makeEditCheck (const Catalogue& types, KnownElsewhere elsewhere)
{
    return std::make_unique<plan::CompileCheck> (types, std::move (elsewhere));
}
