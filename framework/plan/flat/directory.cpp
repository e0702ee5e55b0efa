// SPDX-License-Identifier: MIT
#include "directory.hpp"

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/instances.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/list_text.hpp>

namespace tactus::plan
{

namespace
{
constexpr const char* component_names[] = { ".x", ".y", ".z" };

std::span<const Role> rolesOf (Side side) noexcept
{
    static constexpr Role all[] = { Role::output, Role::input, Role::param };
    switch (side)
    {
    case Side::start:
        return std::span (all).first (1);
    case Side::end:
        return std::span (all).last (2);
    case Side::param:
        return std::span (all).last (1);
    case Side::record:
        break;
    }
    return all;
}

const char* withArticle (Role role)
{
    if (role == Role::input) return "an input";
    return role == Role::param ? "a parameter" : "an output";
}

std::string nameOf (Side side)
{
    switch (side)
    {
    case Side::start:
        return "output";
    case Side::end:
        return "input or parameter";
    case Side::param:
        return "parameter";
    case Side::record:
        break;
    }
    return "port";
}

/// Looks up a port by name among the rows of a node, or among the ports that a subgraph exposes. Each step returns false if it
/// has reported a problem.
struct Finder
{
    Flat& flat;
    Origin origin;
    Side side;
    const graph::Endpoint& e;
    Ports& found;

    bool in (const Scope& scope, std::string_view path) const
    {
        const auto* named = scope.find (path);   // most paths are names
        const auto step = named != nullptr ? graph::PathStep { .name = path, .rest = {} } : graph::firstStep (path);
        if (named == nullptr) named = scope.find (step.name);
        if (named == nullptr) return unknownNode (scope, step.name);
        const auto& member = *named;
        if (member.node < 0 && member.instances.empty()) return true;
        if (! hasInstance (scope, member, step)) return false;

        if (member.node >= 0)
        {
            if (step.rest.empty()) return amongRows (member.node);
            flat.error ("port/not_a_subgraph", origin, "'" + scope.prefix + std::string (step.name) + "' is a node, so there is nothing inside it",
                        "address it as " + std::string (step.name) + "." + e.port);
            return false;
        }
        const auto inside = [&] (const Scope& s) {
            if (! step.rest.empty()) return in (s, step.rest);
            return s.stand_in >= 0 ? amongRows (s.stand_in) : amongExposed (s);
        };
        if (step.instance >= 0) return inside (*member.instances[at (step.instance)]);
        return std::ranges::all_of (member.instances, [&] (const auto& s) { return inside (*s); });
    }

private:
    bool unknownNode (const Scope& scope, std::string_view name) const
    {
        if (flat.isFull()) return false;
        std::vector<std::string> names;
        for (const auto& n : scope.patch->nodes)
            names.push_back (n.name);
        flat.error ("port/unknown_node", origin, "there is no node '" + scope.prefix + std::string (name) + "'" + didYouMean (name, names),
                    "nodes here: " + listed (names));
        return false;
    }

    bool hasInstance (const Scope& scope, const Scope::Member& member, const graph::PathStep& step) const
    {
        if (step.instance == graph::PathStep::unspecified || (member.counted && step.instance < static_cast<int> (member.instances.size()))) return true;
        const auto name = scope.prefix + std::string (step.name);
        if (member.counted)
            flat.error ("port/no_instance", origin,
                        "'" + name + "' has " + std::to_string (member.instances.size()) + " instances, counted from 0, but no ["
                            + std::to_string (step.instance) + "]",
                        "use a smaller number, or raise its `count`");
        else
            flat.error ("port/not_counted", origin, "'" + name + "' has no `count`, so it has no numbered instances",
                        "leave out the brackets after its name" + std::string (member.node >= 0 ? "" : ", or give it a `count`"));
        return false;
    }

    bool amongRows (int node) const
    {
        const auto& n = flat.node (node);
        for (const auto role : rolesOf (side))
        {
            const auto& rows = n.ports (role);
            const auto row = std::ranges::find (rows, e.port, &PortSheet::id);
            if (row != rows.end()) return narrow ({ node, role, static_cast<int> (row - rows.begin()), -1, -1 }, n, *row);
        }

        if (flat.isFull()) return false;
        if (side == Side::param && std::ranges::count (n.type->settings, e.port, &SettingSheet::id) > 0)
        {
            flat.error ("param/unknown", origin, "'" + n.path + "." + e.port + "' is a setting of " + std::string (n.type->info.id),
                        "write it under the `settings` of the node");
            return false;
        }

        std::vector<std::string> names;
        for (const auto role : rolesOf (side))
            for (const auto& row : n.ports (role))
                names.emplace_back (row.id);
        return unknownPort (n.path, std::string (n.type->info.id), names,
                            [&] (Role role) { return std::ranges::count (n.ports (role), e.port, &PortSheet::id) > 0; });
    }

    bool amongExposed (const Scope& inside) const
    {
        for (const auto role : rolesOf (side))
            for (const auto& x : inside.exposed)
                if (x.role == role && x.name == e.port)
                    return std::ranges::all_of (x.to, [&] (const PortRef& r) { return narrow (r, flat.node (r), flat.sheet (r)); });

        if (flat.isFull()) return false;
        std::vector<std::string> names;
        for (const auto role : rolesOf (side))
            for (const auto& x : inside.exposed)
                if (x.role == role) names.push_back (x.name);
        const auto has = [&] (Role role) {
            const auto isIt = [&] (const auto& x) { return x.role == role && x.name == e.port; };
            return std::ranges::any_of (inside.exposed, isIt);
        };
        return unknownPort (inside.prefix.substr (0, inside.prefix.size() - 1), "subgraph", names, has);
    }

    template <typename Has>
    bool unknownPort (const std::string& path, const std::string& type, const std::vector<std::string>& names, Has has) const
    {
        const auto& port = e.port;
        const std::string wanted = nameOf (side);
        for (const auto role : { Role::output, Role::input, Role::param })
            if (has (role))
            {
                flat.error ("port/wrong_side", origin,
                            "'" + path + "." + port + "' is " + withArticle (role) + ", not " + (wanted.starts_with ('p') ? "a " : "an ") + wanted,
                            side == Side::param && role == Role::input ? "wire something into the input, such as a signal.constant"
                                                                       : "'" + path + "' has: " + listed (names));
                return false;
            }
        flat.error (side == Side::param ? "param/unknown" : "port/unknown", origin,
                    "'" + path + "' (" + type + ") has no " + wanted + " '" + port + "'" + didYouMean (port, names), "it has: " + listed (names));
        return false;
    }

    /// Adds the port, narrowed to the index and component of the endpoint.
    bool narrow (PortRef r, const FlatNode& node, const PortSheet& sheet) const
    {
        if (e.index >= 0)
        {
            if (! sheet.list || r.index >= 0)
            {
                flat.error ("port/bad_index", origin, "'" + flat.nameOf (r) + "' is not an array port", "leave out [" + std::to_string (e.index) + "]");
                return false;
            }
            r.index = e.index;
        }
        if (sheet.list && r.index >= node.list_size)
        {
            flat.error ("port/bad_index", origin,
                        "'" + flat.nameOf (r) + "' does not exist: '" + node.path + "' has " + std::to_string (node.list_size) + " entries, counted from 0",
                        "raise its setting `inputs`, or use a smaller index");
            return false;
        }
        if (e.component >= 0)
        {
            if (sheet.width != 3 || r.component >= 0)
            {
                flat.error ("port/not_a_vector", origin, "'" + flat.nameOf (r) + "' is a scalar and has no component " + component_names[e.component],
                            "leave out " + std::string (component_names[e.component]));
                return false;
            }
            r.component = e.component;
        }
        found.push_back (r);
        return true;
    }
};
}   // namespace

std::string listed (const std::vector<std::string>& names)
{
    constexpr std::size_t most = 24;
    std::string all;
    for (std::size_t i = 0; i < std::min (names.size(), most); ++i)
        addToList (all, names[i]);
    if (names.size() > most) all += " and " + std::to_string (names.size() - most) + " more";
    return all.empty() ? "none" : all;
}

bool find (const graph::Endpoint& e, Side side, const Scope& scope, Origin origin, Flat& flat, Ports& found)
{
    found.clear();
    if (Finder { flat, origin, side, e, found }.in (scope, e.node)) return true;
    found.clear();
    return false;
}

bool find (std::string_view text, Side side, const Scope& scope, Origin origin, Flat& flat, Ports& found)
{
    const auto endpoint = graph::parseEndpoint (text);
    if (endpoint) return find (*endpoint, side, scope, origin, flat, found);
    found.clear();
    flat.error ("port/syntax", origin, endpoint.error().text, "name a port, such as drag.force or hand.position.x");
    return false;
}

std::vector<std::string> spelledOut (std::string_view path, const Scope& scope)
{
    const auto step = graph::firstStep (path);
    const auto* member = scope.find (step.name);
    const auto size = member == nullptr ? 0 : member->instances.size();
    if (size == 0 || (step.instance != graph::PathStep::unspecified && ! member->counted)) return { std::string (path) };

    std::vector<std::string> all;
    const bool every = step.instance < 0;
    const auto first = every ? 0 : at (step.instance), end = every ? size : std::min (size, first + 1);
    for (auto k = first; k < end; ++k)
    {
        auto name = std::string (step.name);
        if (member->counted) name += '[' + std::to_string (k) + ']';
        if (step.rest.empty())
            all.push_back (std::move (name));
        else
            for (const auto& rest : spelledOut (step.rest, *member->instances[k]))
                all.push_back (name + '/' + rest);
    }
    if (all.empty()) all.emplace_back (path);
    return all;
}

}   // namespace tactus::plan
