// SPDX-License-Identifier: GPL-3.0-or-later
#include "face.hpp"

#include <tactus/graph/endpoints.hpp>
#include <tactus/graph/inside.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
/// The number of entries of a node's array ports.
int entriesOf (const NodeType& type, const graph::Node& node)
{
    for (const auto& sheet : type.settings)
        if (sheet.id == "inputs")
        {
            const auto given = node.settings.find ("inputs");
            const double n = given != node.settings.end() && given->is_number() ? given->get<double>() : std::get<double> (sheet.initial);
            return static_cast<int> (std::clamp (n, 0.0, static_cast<double> (list_capacity)));
        }
    return 0;
}

std::vector<FacePort> portsOf (const std::vector<PortSheet>& sheets, int entries)
{
    std::vector<FacePort> ports;
    for (const auto& s : sheets)
    {
        const FacePort port { s.role, std::string (s.id), std::string (s.about), s.unit, s.width, &s };
        if (! s.list)
            ports.push_back (port);
        else
            for (int i = 0; i < entries; ++i)
            {
                ports.push_back (port);
                ports.back().id += '[' + std::to_string (i) + ']';
            }
    }
    return ports;
}

/// The port's part of an endpoint, such as "in[2]".
std::string idOf (const graph::Endpoint& e) { return e.index < 0 ? e.port : e.port + '[' + std::to_string (e.index) + ']'; }

class FaceBuilder
{
public:
    explicit FaceBuilder (const Catalogue& c) : catalogue (c) {}

    Face make (const graph::Graph& graph, const graph::Patch& patch, const graph::Node& node, int depth) const
    {
        if (const auto inside = graph::insideOf (graph, node)) return subgraph (*inside.owner, *inside.patch, depth);

        Face face;
        face.type = catalogue.find (node.type);
        if (face.type == nullptr) return placeholder (patch, node);
        const int entries = entriesOf (*face.type, node);
        face.inputs = portsOf (face.type->inputs, entries);
        face.params = portsOf (face.type->params, entries);
        face.outputs = portsOf (face.type->outputs, entries);
        return face;
    }

private:
    const Catalogue& catalogue;

    Face subgraph (const graph::Graph& owner, const graph::Patch& inside, int depth) const
    {
        Face face;
        face.kind = Face::Kind::subgraph;
        if (depth >= deepest_subgraph) return face;
        expose (owner, inside, inside.expose.inputs, Role::input, depth, face.inputs);
        expose (owner, inside, inside.expose.params, Role::param, depth, face.params);
        expose (owner, inside, inside.expose.outputs, Role::output, depth, face.outputs);
        return face;
    }

    void expose (const graph::Graph& owner, const graph::Patch& inside, const std::vector<std::pair<std::string, graph::Endpoint>>& names, Role role,
                 int depth, std::vector<FacePort>& into) const
    {
        for (const auto& [name, end] : names)
        {
            FacePort port { role, name, {}, UnitRule (UnitRule::Kind::open), 1, nullptr };
            const auto slash = end.node.find ('/');
            if (const auto* node = inside.find (graph::firstNameOf (end.node)); node != nullptr && slash == std::string::npos)
            {
                const auto face = make (owner, inside, *node, depth + 1);
                const auto* inner = role == Role::output ? face.startOf (end) : face.endOf (end);
                if (inner != nullptr)
                {
                    port.about = inner->about;
                    port.unit = inner->unit.kind == UnitRule::Kind::fixed ? inner->unit : UnitRule (UnitRule::Kind::open);
                    port.width = end.component >= 0 ? 1 : inner->width;
                    port.sheet = inner->sheet;
                }
            }
            into.push_back (std::move (port));
        }
    }

    static Face placeholder (const graph::Patch& patch, const graph::Node& node)
    {
        Face face;
        face.kind = Face::Kind::placeholder;
        const auto add = [] (std::vector<FacePort>& ports, Role role, const std::string& id) {
            if (std::ranges::count (ports, id, &FacePort::id) == 0) ports.push_back ({ role, id, {}, UnitRule (UnitRule::Kind::open), 1, nullptr });
        };
        for (const auto& w : patch.wires)
        {
            if (w.to.node == node.name) add (face.inputs, Role::input, idOf (w.to));
            if (w.from.node == node.name) add (face.outputs, Role::output, idOf (w.from));
        }
        return face;
    }
};
}   // namespace

const FacePort* Face::find (Role role, std::string_view id) const noexcept
{
    const auto& ports = of (role);
    const auto port = std::ranges::find (ports, id, &FacePort::id);
    return port == ports.end() ? nullptr : &*port;
}

const std::vector<FacePort>& Face::of (Role role) const noexcept
{
    if (role == Role::input) return inputs;
    return role == Role::param ? params : outputs;
}

const FacePort* Face::startOf (const graph::Endpoint& e) const noexcept { return find (Role::output, idOf (e)); }

const FacePort* Face::endOf (const graph::Endpoint& e) const noexcept
{
    const auto id = idOf (e);
    const auto* in = find (Role::input, id);
    return in != nullptr ? in : find (Role::param, id);
}

Face faceOf (const graph::Graph& graph, const graph::Patch& patch, const graph::Node& node, const Catalogue& catalogue)
{
    return FaceBuilder (catalogue).make (graph, patch, node, 0);
}

}   // namespace tactus::host
