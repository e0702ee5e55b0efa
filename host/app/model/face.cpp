// SPDX-License-Identifier: GPL-3.0-or-later
#include "face.hpp"

#include <tactus/graph/inside.hpp>
#include <tactus/graph/instances.hpp>

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
    ports.reserve (sheets.size());
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

Face placeholder (const graph::Patch& patch, const graph::Node& node)
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

/// The face of a node that is not a subgraph.
Face innermost (const graph::Patch& patch, const graph::Node& node, const Catalogue& catalogue)
{
    Face face;
    face.type = catalogue.find (node.type);
    if (face.type == nullptr) return placeholder (patch, node);
    const int entries = entriesOf (*face.type, node);
    face.inputs = portsOf (face.type->inputs, entries);
    face.params = portsOf (face.type->params, entries);
    face.outputs = portsOf (face.type->outputs, entries);
    return face;
}

/// The endpoint that a patch exposes as a port of a role. Null if it exposes nothing by this name.
const graph::Endpoint* exposed (const graph::Patch& patch, Role role, const std::string& id)
{
    const auto in = [&] (const std::vector<std::pair<std::string, graph::Endpoint>>& names) -> const graph::Endpoint* {
        const auto at = std::ranges::find (names, id, &std::pair<std::string, graph::Endpoint>::first);
        return at == names.end() ? nullptr : &at->second;
    };
    if (role == Role::output) return in (patch.expose.outputs);
    const auto* input = in (patch.expose.inputs);
    return input != nullptr ? input : in (patch.expose.params);
}

/// A port that a subgraph exposes, with what the port of the innermost node says. Only this one port is followed, so nesting costs a step for
/// each level.
FacePort exposedPort (graph::Inside inside, Role role, const std::string& name, const graph::Endpoint* end, const Catalogue& catalogue)
{
    FacePort port { role, name, {}, UnitRule (UnitRule::Kind::open), 1, nullptr };
    bool is_component = false;
    std::string_view path = end->node;   // the rest of it: an exposed port may be deeper inside
    for (int depth = 0; end != nullptr && depth < deepest_subgraph; ++depth)
    {
        const auto step = graph::firstStep (path);
        const auto* node = inside.patch->find (step.name);
        if (node == nullptr) break;
        const auto deeper = graph::insideOf (*inside.owner, *node);
        if (deeper)
        {
            inside = deeper;
            path = step.rest;
            if (! path.empty()) continue;
        }
        is_component |= end->component >= 0;
        if (deeper)
        {
            end = exposed (*deeper.patch, role, idOf (*end));
            if (end != nullptr) path = end->node;
            continue;
        }
        const auto face = innermost (*inside.patch, *node, catalogue);
        if (const auto* inner = role == Role::output ? face.startOf (*end) : face.endOf (*end))
        {
            port.about = inner->about;
            if (inner->unit.kind == UnitRule::Kind::fixed) port.unit = inner->unit;
            if (! is_component) port.width = inner->width;
            port.sheet = inner->sheet;
        }
        break;
    }
    return port;
}
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
    const auto inside = graph::insideOf (graph, node);
    if (! inside) return innermost (patch, node, catalogue);
    Face face;
    face.kind = Face::Kind::subgraph;
    const auto expose = [&] (const std::vector<std::pair<std::string, graph::Endpoint>>& names, Role role, std::vector<FacePort>& into) {
        for (const auto& [name, end] : names)
            into.push_back (exposedPort (inside, role, name, &end, catalogue));
    };
    expose (inside.patch->expose.inputs, Role::input, face.inputs);
    expose (inside.patch->expose.params, Role::param, face.params);
    expose (inside.patch->expose.outputs, Role::output, face.outputs);
    return face;
}

}   // namespace tactus::host
