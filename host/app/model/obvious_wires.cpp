// SPDX-License-Identifier: GPL-3.0-or-later
#include "obvious_wires.hpp"
#include "clip_graph.hpp"
#include "face.hpp"
#include "fragment.hpp"
#include "patch.hpp"

#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoints.hpp>

#include <algorithm>
#include <array>

namespace tactus::host::wiring
{

namespace
{
constexpr std::string_view window_type = "contact.window", hand_type = "device.position", motor_type = "device.force";

/// The rank of an output for an input, where more is better: the tool itself is best, then an output of the same name, then the resistance of a
/// surface as a load, then a sensor of the device. 0: not at all.
int rankOf (const graph::Node& node, const FacePort& out, const PortSheet& input)
{
    if (node.type == hand_type) return 4;
    if (out.id == input.id) return 3;
    if (input.id == "normal_force" && out.id == "resistance") return 2;
    return node.type.starts_with ("device.") ? 1 : 0;
}

bool isForce (const PortSheet& p, int width)
{
    return p.unit.kind == UnitRule::Kind::fixed && p.unit.unit.quantity == Quantity::force && p.width == width && ! p.list;
}

/// The inputs of a node that get a wire. A clip has one for each way to play it; a hit is the first of them.
bool isWired (const NodeType& type, const PortSheet& input) { return type.info.id != clip_type || input.id == "hit"; }

bool hasWireInto (const graph::Patch& patch, const std::string& node, std::string_view port)
{
    return std::ranges::any_of (patch.wires, [&] (const graph::Wire& w) { return w.to.node == node && w.to.port == port; });
}

bool hasWireFrom (const graph::Patch& patch, const std::string& node, std::string_view port)
{
    return std::ranges::any_of (patch.wires, [&] (const graph::Wire& w) { return w.from.node == node && w.from.port == port; });
}

/// The speed of the tool, from a new node. Empty if the patch has no position.
std::optional<graph::Endpoint> speedOfTool (const graph::Graph& g, const std::string& in, const std::set<std::string>& excluded, const Catalogue& catalogue,
                                            graph::Batch& batch)
{
    const auto& patch = *findPatch (g, in);
    const auto* type = catalogue.find ("motion.velocity");
    auto position = type == nullptr ? std::nullopt : sourceFor (type->inputs.front(), g, patch, excluded, catalogue);
    if (! position) return std::nullopt;
    graph::Node velocity;
    velocity.name = freeName (patch, {}, "velocity");
    velocity.type = "motion.velocity";
    const auto name = velocity.name;
    batch.commands.push_back (graph::AddNode { in, std::move (velocity) });
    batch.commands.push_back (graph::AddWire { in, wire (*std::move (position), endOf (name, type->inputs.front().id)) });
    return endOf (name, "speed");
}

/// The gain of the contact. Empty if the patch has no depth.
std::optional<graph::Endpoint> touchGain (const graph::Graph& g, const std::string& in, const std::set<std::string>& excluded, const Catalogue& catalogue,
                                          graph::Batch& batch)
{
    const auto& patch = *findPatch (g, in);
    const auto* window = catalogue.find (window_type);
    for (const auto& n : patch.nodes)
        if (n.type == window_type && ! excluded.contains (n.name)) return endOf (n.name, "gain");
    auto depth = window == nullptr ? std::nullopt : sourceFor (window->inputs.front(), g, patch, excluded, catalogue);
    if (! depth || depth->port != "depth") return std::nullopt;
    graph::Node touch;
    touch.name = freeName (patch, {}, "touch");
    touch.type = window_type;
    const auto name = touch.name;
    batch.commands.push_back (graph::AddNode { in, std::move (touch) });
    batch.commands.push_back (graph::AddWire { in, wire (std::move (*depth), endOf (name, "depth")) });
    return endOf (name, "gain");
}

/// Wires the resistance of a surface into a node that lacks its load. With its usual load, friction would be felt in the air.
void load (const graph::Node& node, const graph::Graph& g, const std::string& in, const Catalogue& catalogue, graph::Batch& batch)
{
    const auto& patch = *findPatch (g, in);
    const auto* type = catalogue.find (node.type);
    if (type == nullptr) return;
    for (const auto& input : type->inputs)
    {
        if (input.id != "normal_force" || hasWireInto (patch, node.name, input.id)) continue;
        auto from = sourceFor (input, g, patch, downstreamOf (patch, node.name), catalogue);
        if (from && from->port == "resistance") batch.commands.push_back (graph::AddWire { in, wire (std::move (*from), endOf (node.name, input.id)) });
    }
}

/// Wires the force of a node to a motor, unless it goes somewhere else already.
void drive (const graph::Node& motor, const graph::Node& node, const graph::Graph& g, const std::string& in, const Catalogue& catalogue, graph::Batch& batch)
{
    const auto& patch = *findPatch (g, in);
    const auto* type = catalogue.find (node.type);
    const auto out = type == nullptr || node.type.starts_with ("device.") ? std::nullopt : forceOutput (*type, true);
    if (! out || hasWireFrom (patch, node.name, out->port)) return;
    auto from = endOf (node.name, out->port);
    if (isTexture (node.type)) from = gated (std::move (from), out->is_vector, g, in, downstreamOf (patch, node.name), catalogue, batch);
    batch.commands.push_back (graph::AddWire { in, wire (std::move (from), endOf (motor.name, "force", -1, out->is_vector ? -1 : z_component)) });
}

/// Wires the position and the rotation of a hand to all that lacks them, and what rubs to a surface.
void guide (const graph::Node& hand, const graph::Graph& g, const std::string& in, const Catalogue& catalogue, graph::Batch& batch)
{
    const auto& patch = *findPatch (g, in);
    const auto own = faceOf (g, patch, hand, catalogue);
    for (const auto& n : patch.nodes)
    {
        const auto before = batch.commands.size();
        for (const auto& input : faceOf (g, patch, n, catalogue).inputs)
            if (const auto* out = own.find (Role::output, input.id); out != nullptr && out->width == input.width && out->quantity() == input.quantity()
                                                                     && ! hasWireInto (patch, n.name, input.id))
                batch.commands.push_back (graph::AddWire { in, wire (endOf (hand.name, out->id), endOf (n.name, input.id)) });
        if (batch.commands.size() > before) load (n, g, in, catalogue, batch);
    }
}
}   // namespace

graph::Endpoint endOf (const std::string& node, std::string_view port, int index, int component)
{
    return { node, std::string (port), index, component };
}

graph::Wire wire (graph::Endpoint from, graph::Endpoint to)
{
    graph::Wire w;
    w.from = std::move (from);
    w.to = std::move (to);
    return w;
}

std::set<std::string> downstreamOf (const graph::Patch& patch, const std::string& node)
{
    std::set<std::string> reached { node };
    for (bool more = true; more;)
    {
        more = false;
        for (const auto& w : patch.wires)
            if (reached.contains (graph::firstNameOf (w.from.node))) more = reached.insert (graph::firstNameOf (w.to.node)).second || more;
    }
    return reached;
}

std::optional<ForceOutput> forceOutput (const NodeType& type, bool vectors)
{
    if (type.info.id == clip_type) return ForceOutput { "value", false };
    const auto force = [&] (int width) {
        const auto at = std::ranges::find_if (type.outputs, [width] (const PortSheet& o) { return isForce (o, width); });
        return at == type.outputs.end() ? nullptr : &*at;
    };
    if (const auto* o = vectors ? force (3) : nullptr) return ForceOutput { std::string (o->id), true };
    if (const auto* o = force (1)) return ForceOutput { std::string (o->id), false };
    return {};
}

bool isTexture (std::string_view type) noexcept { return type.starts_with ("texture."); }

bool isNeeded (const NodeType& type, const PortSheet& input)
{
    constexpr std::array<std::string_view, 6> ids { "position", "depth", "angle", "hit", "speed", "normal_force" };
    const auto family = type.info.id.substr (0, type.info.id.find ('.'));
    const bool is_effect = family != "signal" && family != "device" && family != "vector" && family != "layer" && family != "filter";
    return is_effect && input.initial[0] == 0.0 && std::ranges::find (ids, input.id) != ids.end();
}

std::optional<graph::Endpoint> sourceFor (const PortSheet& input, const graph::Graph& g, const graph::Patch& patch, const std::set<std::string>& excluded,
                                          const Catalogue& catalogue)
{
    const auto fits = [&] (const FacePort& out) {
        const bool is_list = out.id.find ('[') != std::string::npos;
        return ! is_list && out.width == input.width && out.quantity() == input.unit.unit.quantity && out.quantity() != Quantity::any;
    };
    std::optional<graph::Endpoint> found;
    int best = 0;
    for (const auto& n : patch.nodes)
    {
        if (excluded.contains (n.name)) continue;
        const auto face = faceOf (g, patch, n, catalogue);
        for (const auto& out : face.outputs)
            if (const int rank = rankOf (n, out, input); fits (out) && rank > best)
            {
                best = rank;
                found = endOf (n.name, out.id);
            }
    }
    return found;
}

std::string wireInputs (const NodeType& type, const std::string& name, const graph::Graph& g, const std::string& in, const std::set<std::string>& excluded,
                        const Catalogue& catalogue, graph::Batch& batch)
{
    const auto& patch = *findPatch (g, in);
    std::string missing;
    for (const auto& input : type.inputs)
    {
        if (! isWired (type, input) || hasWireInto (patch, name, input.id)) continue;
        auto from = sourceFor (input, g, patch, excluded, catalogue);
        if (! from && input.id == "speed") from = speedOfTool (g, in, excluded, catalogue, batch);
        if (! from && input.id == "gate") from = touchGain (g, in, excluded, catalogue, batch);
        if (from)
            batch.commands.push_back (graph::AddWire { in, wire (std::move (*from), endOf (name, input.id)) });
        else if (missing.empty() && ! (input.width == 3 && input.id == "normal"))   // without one, it is up
            missing = filled (TRANS ("Wire something into %1: %2"), name + '.' + std::string (input.id), input.about).toStdString();
    }
    return missing;
}

graph::Endpoint gated (graph::Endpoint source, bool is_vector, const graph::Graph& g, const std::string& in, const std::set<std::string>& excluded,
                       const Catalogue& catalogue, graph::Batch& batch)
{
    auto gain = touchGain (g, in, excluded, catalogue, batch);
    if (! gain) return source;
    graph::Node product;
    product.name = freeName (*findPatch (g, in), {}, graph::firstNameOf (source.node) + "_felt");
    product.type = is_vector ? "vector.scale" : "signal.multiply";
    const auto name = product.name;
    batch.commands.push_back (graph::AddNode { in, std::move (product) });
    batch.commands.push_back (graph::AddWire { in, wire (std::move (source), is_vector ? endOf (name, "in") : endOf (name, "in", 0)) });
    batch.commands.push_back (graph::AddWire { in, wire (std::move (*gain), is_vector ? endOf (name, "gain") : endOf (name, "in", 1)) });
    return endOf (name, "out");
}

graph::Batch obviousWires (const graph::Graph& g, const std::string& in, const std::string& name, const Catalogue& catalogue)
{
    graph::Batch batch { NEEDS_TRANS ("connect"), {} };
    const auto* patch = findPatch (g, in);
    const auto* node = patch == nullptr ? nullptr : patch->find (name);
    const auto* type = node == nullptr ? nullptr : catalogue.find (node->type);
    if (type == nullptr) return batch;
    if (node->type == hand_type) guide (*node, g, in, catalogue, batch);
    if (node->type == motor_type)
    {
        auto so_far = g;   // with the windows that came with the wires before
        for (const auto& n : patch->nodes)
        {
            graph::Batch its { batch.name, {} };
            drive (*node, n, so_far, in, catalogue, its);
            if (! its.commands.empty()) load (n, so_far, in, catalogue, its);
            if (its.commands.empty() || ! graph::apply (so_far, its)) continue;
            std::ranges::move (its.commands, std::back_inserter (batch.commands));
        }
    }
    // What takes a force can stand between any force and the motor: only the user knows.
    if (node->type.starts_with ("device.") || std::ranges::any_of (type->inputs, [] (const PortSheet& i) { return isForce (i, 3); })) return batch;
    wireInputs (*type, name, g, in, downstreamOf (*patch, name), catalogue, batch);
    const auto motor = std::ranges::find (patch->nodes, motor_type, &graph::Node::type);
    const auto out = forceOutput (*type, true);
    const bool is_only_a_part = out && ! out->is_vector && ! isTexture (node->type) && ! node->type.starts_with ("vibration.");
    if (motor == patch->nodes.end()) return batch;
    if (! is_only_a_part) drive (*motor, *node, g, in, catalogue, batch);
    std::set<std::string> surfaces;   // that load the node. They would not push else
    for (const auto& command : batch.commands)
        if (const auto* added = std::get_if<graph::AddWire> (&command.edit); added != nullptr && added->wire.from.port == "resistance")
            surfaces.insert (added->wire.from.node);
    surfaces.erase (name);
    for (const auto& loading : surfaces)
        if (const auto* surface = patch->find (loading)) drive (*motor, *surface, g, in, catalogue, batch);
    return batch;
}

}   // namespace tactus::host::wiring
