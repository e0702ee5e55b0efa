// SPDX-License-Identifier: GPL-3.0-or-later
#include "scope_ports.hpp"

#include <tactus/graph/inside.hpp>
#include <tactus/graph/instances.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr int most_nodes = 20000;              // twice as many as a processor core computes in a tick
constexpr std::size_t most_in_one_scope = 4;   // instances of a port

struct PortCollector
{
    const Catalogue& catalogue;
    std::vector<ScopePort> all;
    std::vector<const graph::Patch*> open {};   // those that contain the patch; a broken graph may contain itself
    int nodes = 0;

    /// `prefix` begins the names of the ports, and `first` their names in the first instances.
    void patch (const graph::Graph& g, const graph::Patch& p, const std::string& prefix, const std::string& first, std::size_t instances)
    {
        if (open.size() > deepest_subgraph || std::ranges::count (open, &p) > 0) return;
        open.push_back (&p);
        for (const auto& node : p.nodes)
        {
            if (++nodes > most_nodes) break;
            const auto count = static_cast<std::size_t> (std::max (1, graph::countOf (node).value_or (1)));
            const auto path = prefix + node.name, in_first = first + node.name + (count > 1 ? "[0]" : "");
            const auto face = faceOf (g, p, node, catalogue);
            for (const auto* ports : { &face.outputs, &face.inputs, &face.params })
                for (const auto& port : *ports)
                    if (! port.isChoice())
                        all.push_back ({ path + "." + port.id, path, node.id, node.type, port, in_first + "." + port.id, instances * count });
            if (const auto inside = graph::insideOf (g, node)) patch (*inside.owner, *inside.patch, path + "/", in_first + "/", instances * count);
        }
        open.pop_back();
    }
};

bool isOutput (const ScopePort& p, std::string_view id) { return p.port.role == Role::output && p.port.id == id; }

bool reportsEnergy (const ScopePort& p)
{
    const bool is_subgraph = p.type.empty() || p.type.starts_with ("graph:") || p.type.starts_with ("file:");
    return ! is_subgraph && (isOutput (p, "stored_energy") || isOutput (p, "dissipated_energy"));
}

/// The first port with this role and id of a node whose type starts with `type`; null if there is none.
const ScopePort* find (const std::vector<ScopePort>& ports, std::string_view type, Role role, std::string_view id)
{
    const auto isIt = [&] (const ScopePort& p) { return p.type.starts_with (type) && p.port.role == role && p.port.id == id; };
    const auto at = std::ranges::find_if (ports, isIt);
    return at == ports.end() ? nullptr : &*at;
}

/// Its name in the first instance; empty if there is none.
std::string firstOf (const std::vector<ScopePort>& ports, std::string_view type, Role role, std::string_view id)
{
    const auto* port = find (ports, type, role, id);
    return port == nullptr ? std::string() : port->first;
}

/// True for nodes whose state is 1 for stuck and 2 for sliding.
bool tellsSliding (std::string_view type) { return type.starts_with ("friction.") || type == "deform.surface"; }

bool isWired (const graph::Patch& patch, const std::string& node, const std::string& port)
{
    return std::ranges::any_of (patch.wires, [&] (const graph::Wire& w) { return w.to.node == node && w.to.port == port; });
}
}   // namespace

std::vector<ScopePort> scopePorts (const graph::Graph& g, const Catalogue& c)
{
    PortCollector walk { c, {} };
    walk.patch (g, g.root, {}, {}, 1);
    return std::move (walk.all);
}

std::vector<std::string> energyPorts (const std::vector<ScopePort>& ports)
{
    std::vector<std::string> all;
    for (const auto& p : ports)
        if (reportsEnergy (p)) all.push_back (p.name);
    return all;
}

std::string stateFor (const std::string& port, const std::vector<ScopePort>& ports)
{
    const auto path = port.substr (0, port.find ('.'));
    for (const auto& p : ports)
        if (isOutput (p, "state") && tellsSliding (p.type) && isPartOf (path + ".state", p.name)) return path + ".state";
    return firstOf (ports, "friction.", Role::output, "state");
}

PortNames::PortNames (const std::vector<ScopePort>& ports)
{
    for (const auto& p : ports)
        sorted.push_back (p.name);
    std::ranges::sort (sorted);
}

bool PortNames::has (const std::string& port) const
{
    const auto node = port.substr (0, port.find_first_of ("[/."));   // of the whole graph; it begins the names of all ports that match
    for (const char end : { '.', '/', '[' })
    {
        const auto stem = node + end;
        for (auto at = std::ranges::lower_bound (sorted, stem); at != sorted.end() && at->starts_with (stem); ++at)
            if (isPartOf (port, *at) || isPartOf (*at, port)) return true;
    }
    return false;
}

ScopeSpec suggestedScope (ScopeKind kind, const graph::Graph& g, const Catalogue& c)
{
    const auto ports = scopePorts (g, c);
    const auto* motor = find (ports, "device.force", Role::input, "force");
    ScopeSpec s;
    s.kind = kind;
    switch (kind)
    {
    case ScopeKind::time:
    case ScopeKind::spectrum:
    case ScopeKind::spectrogram:
        if (kind == ScopeKind::spectrogram) s.seconds = 5.0;
        if (motor != nullptr) s.ports.push_back (motor->instances > most_in_one_scope ? motor->first : motor->name);
        break;
    case ScopeKind::over:
        s.seconds = 2.0;
        s.x = firstOf (ports, "device.position", Role::output, "position");
        for (const char* family : { "friction.", "cut.", "deform." })
            if (s.y.empty()) s.y = firstOf (ports, family, Role::output, "force");
        if (s.y.empty() && motor != nullptr) s.y = motor->first;
        s.state = stateFor (s.y, ports);
        break;
    case ScopeKind::energy:
        s.seconds = 5.0;
        s.x = firstOf (ports, "device.position", Role::output, "position");
        s.y = firstOf (ports, "device.force", Role::output, "applied");
        break;
    case ScopeKind::tool:
        const auto deflection = firstOf (ports, "friction.", Role::output, "deflection");
        s.node = deflection.substr (0, deflection.find ('.'));
        s.has_normal = s.node.find ('/') == std::string::npos && isWired (g.root, s.node, "normal");
        break;
    }
    return s;
}

std::vector<ScopeSpec> suggestedScopes (const graph::Graph& g, const Catalogue& c)
{
    std::vector<ScopeSpec> all;
    if (auto time = suggestedScope (ScopeKind::time, g, c); ! time.ports.empty()) all.push_back (std::move (time));
    if (auto over = suggestedScope (ScopeKind::over, g, c); ! over.x.empty() && ! over.y.empty()) all.push_back (std::move (over));
    const auto ports = scopePorts (g, c);
    const auto* hand = find (ports, "device.position", Role::output, "position");
    std::size_t energies = 0;
    for (const auto& p : ports)
        if (reportsEnergy (p)) energies += p.instances;
    if (energies == 0 || energies > most_energies || hand == nullptr || hand->instances > 1) return all;
    if (auto energy = suggestedScope (ScopeKind::energy, g, c); ! energy.x.empty() && ! energy.y.empty()) all.push_back (std::move (energy));
    return all;
}

void follow (ScopeModel& model, const std::vector<ScopePort>& before, const std::vector<ScopePort>& after)
{
    const auto idOf = [&] (const std::string& path) -> graph::Id {
        const auto at = std::ranges::find (before, path, &ScopePort::path);
        return at == before.end() ? 0 : at->node;
    };
    const auto moved = [&] (std::string& path) {
        if (path.empty() || std::ranges::find (after, path, &ScopePort::path) != after.end()) return;
        if (const auto id = idOf (path))
            if (const auto at = std::ranges::find (after, id, &ScopePort::node); at != after.end()) path = at->path;
    };
    const auto port = [&] (std::string& name) {
        const auto dot = name.find ('.');
        if (dot == std::string::npos) return;
        auto path = name.substr (0, dot);
        moved (path);
        name = path + name.substr (dot);
    };
    for (const auto& s : model.scopes)
    {
        for (auto& p : s->ports)
            port (p);
        for (auto* p : { &s->x, &s->y, &s->state })
            port (*p);
        moved (s->node);
    }
}

}   // namespace tactus::host
