// SPDX-License-Identifier: MIT
#include "compile.hpp"

#include <tactus/graph/edit_check.hpp>

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

/// True if an edit may leave this behind: a node that is not finished, or of a type that the program knows.
bool isFine (const Message& m, const graph::Graph& g, const graph::KnownElsewhere& known_elsewhere)
{
    if (m.severity != Message::Severity::error || m.id == "node/no_role") return true;
    if (m.id != "node/unknown_type" || ! known_elsewhere) return false;
    const auto isKnown = [&] (const graph::Node* n) { return n != nullptr && known_elsewhere (n->type); };
    constexpr std::string_view list = "/nodes/", key = "/type";
    const auto begin = m.where.find (list) + list.size(), end = m.where.size() - key.size();
    const auto* patch = m.where.starts_with (list) ? &g.root : g.find (patchOf (m.where));
    return m.file.empty() && patch != nullptr && begin < end && isKnown (patch->find (m.where.substr (begin, end - begin)));
}
}   // namespace

}   // namespace tactus::plan

tactus::graph::FindProblems tactus::graph::problemsAgainst (const Catalogue& types, KnownElsewhere elsewhere)
{
    return [&types, elsewhere = std::move (elsewhere)] (const Graph& g) {
        std::vector<Problem> problems;
        for (auto& m : problemsOf (g, types))
            if (! plan::isFine (m, g, elsewhere))
            {
                auto place = plan::placeOf (m, g);
                problems.push_back ({ std::move (place), std::move (m) });
            }
        return problems;
    };
}
