// SPDX-License-Identifier: GPL-3.0-or-later
#include "fixes.hpp"

#include <host/app/model/patch.hpp>
#include <tactus/run/device/make_device.hpp>

#include <algorithm>
#include <vector>

namespace tactus::host
{

namespace
{
/// Splits a JSON pointer such as "/nodes/drag/params/mu" into its parts, unescaped (RFC 6901).
std::vector<std::string> partsOf (const std::string& pointer)
{
    std::vector<std::string> parts;
    for (std::size_t at = 0; at < pointer.size();)
    {
        const auto end = std::min (pointer.find ('/', at + 1), pointer.size());
        auto& part = parts.emplace_back();
        for (std::size_t i = at + 1; i < end; ++i)
        {
            const bool escaped = pointer[i] == '~' && i + 1 < end;
            if (escaped) ++i;
            const char unescaped = pointer[i] == '1' ? '/' : '~';
            part += escaped ? unescaped : pointer[i];
        }
        at = end;
    }
    return parts;
}

const graph::Wire* wireOf (const graph::Graph& g, const Culprit& c)
{
    const auto* patch = findPatch (g, c.patch);
    if (patch == nullptr) return nullptr;
    const auto found = std::ranges::find (patch->wires, c.id, &graph::Wire::id);
    return found == patch->wires.end() ? nullptr : &*found;
}
}   // namespace

Culprit culpritOf (const graph::Graph& g, const Message& m)
{
    Culprit culprit;
    auto parts = partsOf (m.where);
    if (parts.size() > 2 && parts[0] == "graphs")
    {
        culprit.patch = parts[1];
        parts.erase (parts.begin(), parts.begin() + 2);
    }
    const auto* patch = findPatch (g, culprit.patch);
    if (patch == nullptr || ! m.file.empty() || parts.size() < 2) return culprit;
    if (parts[0] == "devices") culprit.role = parts[1];
    if (parts[0] == "nodes")
        if (const auto* node = patch->find (parts[1]))
        {
            culprit.id = node->id;
            culprit.node = node->name;
            if (parts.size() > 3 && parts[2] == "params") culprit.param = parts[3];
        }
    if (parts[0] == "wires" && ! parts[1].empty() && std::ranges::all_of (parts[1], [] (char c) { return c >= '0' && c <= '9'; }))
        if (const auto i = std::strtoull (parts[1].c_str(), nullptr, 10); i < patch->wires.size()) culprit.id = patch->wires[i].id;
    return culprit;
}

std::optional<Fix> fixOf (const graph::Graph& g, const Message& m)
{
    const auto culprit = culpritOf (g, m);
    const auto* wire = wireOf (g, culprit);
    if (m.id == "graph/loop" && wire != nullptr)
    {
        auto delayed = *wire;
        delayed.delay = std::max (1, wire->delay);
        return Fix { "Delay wire by a tick", graph::Batch { "break loop", { graph::ChangeWire { culprit.patch, culprit.id, std::move (delayed) } } } };
    }
    if (m.severity != Message::Severity::error) return std::nullopt;
    const auto& [patch, id, node, param, role] = culprit;
    if (wire != nullptr) return Fix { "Remove the wire", graph::Batch { "remove wire", { graph::RemoveWire { patch, id } } } };
    if (! param.empty()) return Fix { "Reset " + param, graph::Batch { "reset " + param, { graph::SetParam { patch, node, param } } } };
    if (m.id == "node/no_role")
    {
        const bool has_device = ! g.devices.empty();
        const auto name = has_device ? g.devices.front().first : std::string ("stylus");
        graph::Batch all { has_device ? "assign role" : "add stylus", {} };
        if (! has_device) all.commands.push_back (graph::SetDevice { name, defaultDevice() });
        all.commands.push_back (graph::SetNodeKey { patch, node, "role", Json (name) });
        return Fix { (has_device ? "Assign to " : "Add a ") + name, std::move (all) };
    }
    if (! node.empty() && m.id == "node/unknown_type") return Fix { "Remove the node", graph::Batch { "remove node", { graph::RemoveNode { patch, node } } } };
    return std::nullopt;
}

}   // namespace tactus::host
