// SPDX-License-Identifier: MIT
#include "graph_part.hpp"
#include <tactus/plan/compile.hpp>

#include <tactus/graph/edit_check.hpp>

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

class CompileCheck final : public graph::EditCheck
{
public:
    CompileCheck (const Catalogue& t, graph::KnownElsewhere k) : types (t), known_elsewhere (std::move (k)) {}

    void follow (const graph::Command& command, const graph::Command& inverse) override { wiring.follow (command, inverse); }

    std::vector<graph::Problem> problems (const graph::Graph& g, const graph::Command& command, const graph::Command& inverse) override
    {
        const auto touched = touchedBy (command, inverse);
        if (touched.isNothing()) return {};
        wiring.see (g);
        if (touched.everything || wiring.mayHaveSections()) return listed (problemsOf (g, types), g);
        const auto part = partOf (g, touched, types, wiring, joins());
        auto messages = problemsOf (part.graph, types);
        for (auto& m : messages)
            part.giveNumbers (m);
        return listed (std::move (messages), g);
    }

private:
    const Catalogue& types;
    graph::KnownElsewhere known_elsewhere;
    GraphIndex wiring;
    int generation = 0;
    bool joins_generic = false;

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

    std::vector<graph::Problem> listed (Messages messages, const graph::Graph& g) const
    {
        std::vector<graph::Problem> problems;
        for (auto& m : messages)
            if (! isFine (m, g))
            {
                auto place = placeOf (m, g);
                problems.push_back ({ std::move (place), std::move (m) });
            }
        return problems;
    }

    /// True if somewhere the quantity of a generic port decides whether several wires may end there. Then a wire far away may change that.
    bool joins()
    {
        if (std::exchange (generation, wiring.generation()) != wiring.generation()) joins_generic = false;
        for (const auto& joint : wiring.takeJoints())
        {
            const auto* node = wiring.node (joint.node);
            const auto* type = node != nullptr ? types.find (node->type) : nullptr;
            const auto* row = type != nullptr ? rowOf (*type, joint.port, Role::input) : nullptr;
            const bool is_subgraph = node != nullptr && type == nullptr && node->type.find (':') != std::string::npos;
            joins_generic = joins_generic || is_subgraph || (row != nullptr && row->unit.kind != UnitRule::Kind::fixed && ! row->unit.adds_up);
        }
        return joins_generic || wiring.joinsInside();
    }
};
}   // namespace

}   // namespace tactus::plan

std::unique_ptr<tactus::graph::EditCheck> tactus::graph::makeEditCheck (const Catalogue& types, KnownElsewhere elsewhere)
{
    return std::make_unique<plan::CompileCheck> (types, std::move (elsewhere));
}
