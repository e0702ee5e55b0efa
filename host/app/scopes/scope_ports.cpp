// SPDX-License-Identifier: GPL-3.0-or-later
#include "scope_ports.hpp"

#include <algorithm>

namespace tactus::host
{

namespace
{
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

/// The force that the hand gets, limited and faded by the guard; of the first instance if there are too many for one scope. Empty if no motor pushes.
std::string appliedForce (const std::vector<ScopePort>& ports)
{
    const auto* applied = find (ports, "device.force", Role::output, "applied");
    if (applied == nullptr) return {};
    return applied->instances > most_in_one_scope ? applied->first : applied->name;
}

bool isWired (const graph::Patch& patch, const std::string& node, const std::string& port)
{
    return std::ranges::any_of (patch.wires, [&] (const graph::Wire& w) { return w.to.node == node && w.to.port == port; });
}
}   // namespace

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
    ScopeSpec s;
    s.kind = kind;
    switch (kind)
    {
    case ScopeKind::time:
    case ScopeKind::spectrum:
    case ScopeKind::spectrogram:
        if (kind == ScopeKind::spectrogram) s.seconds = 5.0;
        if (const auto felt = appliedForce (ports); ! felt.empty()) s.ports.push_back (felt);
        break;
    case ScopeKind::over:
        s.seconds = 2.0;
        s.x = firstOf (ports, "device.position", Role::output, "position");
        for (const char* family : { "friction.", "cut.", "deform." })
            if (s.y.empty()) s.y = firstOf (ports, family, Role::output, "force");
        if (s.y.empty()) s.y = firstOf (ports, "device.force", Role::input, "force");
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
