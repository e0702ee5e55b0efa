// SPDX-License-Identifier: MIT
#include "directory.hpp"

#include <framework/graph/text.hpp>
#include <framework/near_miss.hpp>

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

const char* withArticle (Role role) { return role == Role::input ? "an input" : role == Role::param ? "a parameter"
                                                                                                    : "an output"; }

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

/// Looks a port up by name among the rows of a node, or among what a subgraph exposes.
struct Finder
{
    Flat& flat;
    Origin origin;
    Side side;

    std::optional<PortRef> in (const Scope& scope, const graph::Endpoint& e) const
    {
        const auto slash = e.node.find ('/');
        const auto head = std::string_view (e.node).substr (0, slash);
        const auto member = scope.find (head);
        if (member == nullptr)
        {
            if (flat.isFull()) return {};
            if (head.find ('[') != std::string::npos)
                flat.error ("graph/not_yet", origin, "'" + scope.prefix + std::string (head) + "' addresses one of several instances, which this version does not run", "give each a node of its own");
            else
            {
                std::vector<std::string> names;
                for (const auto& n : scope.patch->nodes)
                    names.push_back (n.name);
                flat.error ("port/unknown_node", origin, "there is no node '" + scope.prefix + std::string (head) + "'" + didYouMean (head, names), "nodes here: " + listed (names));
            }
            return {};
        }

        const auto& [node, inside] = *member;
        if (slash != std::string::npos)
        {
            if (inside) return in (*inside, { e.node.substr (slash + 1), e.port, e.index, e.component });
            if (node >= 0)
                flat.error ("port/not_a_subgraph", origin, "'" + scope.prefix + std::string (head) + "' is a node, so nothing lies inside it", "address it as " + std::string (head) + "." + e.port);
            return {};
        }
        if (node >= 0) return amongRows (node, e);
        return inside ? amongExposed (*inside, e) : std::nullopt;
    }

private:
    std::optional<PortRef> amongRows (int node, const graph::Endpoint& e) const
    {
        const auto& n = flat.nodes[static_cast<std::size_t> (node)];
        for (const auto role : rolesOf (side))
        {
            const auto& rows = n.ports (role);
            const auto row = std::ranges::find (rows, e.port, &PortSheet::id);
            if (row != rows.end())
                return narrow ({ node, role, static_cast<int> (row - rows.begin()), -1, -1 }, e);
        }

        if (flat.isFull()) return {};
        if (side == Side::param && std::ranges::count (n.type->settings, e.port, &SettingSheet::id) > 0)
        {
            flat.error ("param/unknown", origin, "'" + n.path + "." + e.port + "' is a setting of " + std::string (n.type->info.id), "move it to settings");
            return {};
        }

        std::vector<std::string> names;
        for (const auto role : rolesOf (side))
            for (const auto& row : n.ports (role))
                names.emplace_back (row.id);
        unknownPort (n.path, std::string (n.type->info.id), e.port, names, [&] (Role role)
                     { return std::ranges::count (n.ports (role), e.port, &PortSheet::id) > 0; });
        return {};
    }

    std::optional<PortRef> amongExposed (const Scope& inside, const graph::Endpoint& e) const
    {
        for (const auto role : rolesOf (side))
            for (const auto& x : inside.exposed)
                if (x.role == role && x.name == e.port)
                    return x.to ? narrow (*x.to, e) : std::nullopt;

        std::vector<std::string> names;
        for (const auto role : rolesOf (side))
            for (const auto& x : inside.exposed)
                if (x.role == role) names.push_back (x.name);
        unknownPort (inside.prefix.substr (0, inside.prefix.size() - 1), "subgraph", e.port, names, [&] (Role role)
                     { return std::ranges::any_of (inside.exposed, [&] (const auto& x)
                                                   { return x.role == role && x.name == e.port; }); });
        return {};
    }

    template <typename Has>
    void unknownPort (const std::string& path, const std::string& type, const std::string& port, const std::vector<std::string>& names, Has has) const
    {
        const std::string wanted = nameOf (side);
        for (const auto role : { Role::output, Role::input, Role::param })
            if (has (role))
            {
                flat.error ("port/wrong_side", origin, "'" + path + "." + port + "' is " + withArticle (role) + ", not " + (wanted.starts_with ('p') ? "a " : "an ") + wanted, side == Side::param && role == Role::input ? "wire something into it, such as a signal.constant" : "it has: " + listed (names));
                return;
            }
        flat.error (side == Side::param ? "param/unknown" : "port/unknown", origin, "'" + path + "' (" + type + ") has no " + wanted + " '" + port + "'" + didYouMean (port, names), "it has: " + listed (names));
    }

    /// Applies the index and component of an endpoint to the port it names.
    std::optional<PortRef> narrow (PortRef r, const graph::Endpoint& e) const
    {
        const auto& sheet = flat.sheet (r);
        const auto& node = flat.node (r);
        if (e.index >= 0)
        {
            if (! sheet.list || r.index >= 0)
            {
                flat.error ("port/bad_index", origin, "'" + flat.nameOf (r) + "' is not an array port", "leave out [" + std::to_string (e.index) + "]");
                return {};
            }
            r.index = e.index;
        }
        if (sheet.list && r.index >= node.list_size)
        {
            flat.error ("port/bad_index", origin, "'" + flat.nameOf (r) + "' does not exist: '" + node.path + "' has " + std::to_string (node.list_size) + " entries, counted from 0", "raise its setting `inputs`, or use a smaller index");
            return {};
        }
        if (e.component >= 0)
        {
            if (sheet.width != 3 || r.component >= 0)
            {
                flat.error ("port/not_a_vector", origin, "'" + flat.nameOf (r) + "' is a scalar and has no component " + component_names[e.component], "leave out " + std::string (component_names[e.component]));
                return {};
            }
            r.component = e.component;
        }
        return r;
    }
};
}   // namespace

std::string listed (const std::vector<std::string>& names)
{
    constexpr std::size_t most = 24;
    std::string all;
    for (std::size_t i = 0; i < std::min (names.size(), most); ++i)
        all += (all.empty() ? "" : ", ") + names[i];
    if (names.size() > most) all += " and " + std::to_string (names.size() - most) + " more";
    return all.empty() ? "none" : all;
}

std::optional<PortRef> find (const graph::Endpoint& e, Side side, const Scope& scope, Origin origin, Flat& flat)
{
    return Finder { flat, origin, side }.in (scope, e);
}

std::optional<PortRef> find (std::string_view text, Side side, const Scope& scope, Origin origin, Flat& flat)
{
    const auto parsed = graph::parseEndpoint (text);
    if (const auto* endpoint = std::get_if<graph::Endpoint> (&parsed)) return find (*endpoint, side, scope, origin, flat);
    flat.error ("port/syntax", origin, std::get<std::string> (parsed), "name a port, as in drag.force or hand.position.x");
    return {};
}

}   // namespace tactus::plan
