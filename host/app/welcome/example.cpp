// SPDX-License-Identifier: GPL-3.0-or-later
#include "example.hpp"

#include <host/app/model/face.hpp>
#include <host/app/model/wire_rules.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr const char* role = "stylus";

/// Builds a graph node by node.
class Builder
{
public:
    explicit Builder (const Catalogue& c) : catalogue (c) {}

    graph::Graph graph;

    /// Adds a node, unless there is one of that name.
    void add (const std::string& name, const std::string& type)
    {
        if (graph.root.find (name) != nullptr) return;
        graph::Node node;
        node.name = name;
        node.type = type;
        if (type.starts_with ("device.")) node.role = role;
        graph.root.nodes.push_back (std::move (node));
    }

    void wire (const std::string& from_node, const std::string& from, const std::string& to_node, const FacePort& to)
    {
        graph::Wire w;
        w.from = { from_node, from };
        const auto bracket = to.id.find ('[');
        w.to = { to_node, to.id.substr (0, bracket), bracket == std::string::npos ? -1 : std::atoi (to.id.c_str() + bracket + 1) };
        graph.root.wires.push_back (std::move (w));
    }

    Face faceOf (const std::string& name) const { return host::faceOf (graph, graph.root, *graph.root.find (name), catalogue); }

private:
    const Catalogue& catalogue;
};

/// The source of an input.
struct Source
{
    const char* node;
    const char* port;
};

/// Chooses a source by the quantity of an input. Empty if the default value of the input is better.
std::optional<Source> sourceFor (const FacePort& input)
{
    const auto quantity = input.quantity();
    const bool takes_any = input.unit.kind != UnitRule::Kind::fixed;
    if (input.width == 3)
    {
        if (quantity == Quantity::length) return Source { "hand", "position" };
        if (quantity == Quantity::force) return Source { "wall", "force" };
        if (quantity == Quantity::speed) return Source { "motion", "velocity" };
        if (takes_any) return Source { "wall", "force" };
        return std::nullopt;
    }
    if (quantity == Quantity::length) return Source { "wall", "depth" };
    if (quantity == Quantity::force) return Source { "wall", "resistance" };
    if (quantity == Quantity::hit) return Source { "wall", "hit" };
    if (quantity == Quantity::speed) return Source { "motion", "speed" };
    if (quantity == Quantity::energy) return Source { "wall", "stored_energy" };
    if (takes_any) return Source { "wall", "resistance" };
    return std::nullopt;
}

constexpr const char* subject = "node";
}   // namespace

graph::Graph exampleOf (const NodeType& type, const Catalogue& catalogue)
{
    Builder b (catalogue);
    b.graph.name = filled (TRANS ("Example of %1"), type.info.id).toStdString();
    b.graph.about = std::string (type.info.summary);
    const Json hand { { "stiffness", "600 N/m" }, { "damping", "6 N*s/m" }, { "path", "stroke" } };
    const Json guard { { "max_force", "6 N" } };
    b.graph.devices.emplace_back (role, Json { { "driver", "sim" }, { "mass", "50 g" }, { "damping", "1 N*s/m" }, { "hand", hand }, { "guard", guard } });
    b.add ("hand", "device.position");
    b.add ("wall", "deform.plane");
    b.add (subject, std::string (type.info.id));
    b.add ("motor", "device.force");
    const auto wall = b.faceOf ("wall");
    b.wire ("hand", "position", "wall", *wall.find (Role::input, "position"));

    const auto face = b.faceOf (subject);
    for (const auto& input : face.inputs)
    {
        const auto source = sourceFor (input);
        if (! source) continue;
        if (source->node == std::string ("motion") && b.graph.root.find ("motion") == nullptr)
        {
            b.add ("motion", "motion.velocity");
            b.wire ("hand", "position", "motion", *b.faceOf ("motion").find (Role::input, "position"));
        }
        b.wire (source->node, source->port, subject, input);
    }

    // The first force output goes to the motor: a vector as it is, a scalar along z. An output with the unit of an input counts as a force,
    // because that input was wired to a force above.
    const auto motor = b.faceOf ("motor");
    const auto& into = *motor.find (Role::input, "force");
    const auto isForce = [&] (const FacePort& p, int width) {
        const bool follows = p.unit.kind == UnitRule::Kind::same && p.unit.unit.dimension == unit::gain.dimension;
        const auto* of = follows ? face.find (Role::input, std::string (p.unit.a) + (face.find (Role::input, p.unit.a) != nullptr ? "" : "[0]")) : nullptr;
        return p.width == width && (p.quantity() == Quantity::force || (of != nullptr && of->unit.kind != UnitRule::Kind::fixed));
    };
    bool felt = false;
    for (const auto& output : face.outputs)
        if (! felt && isForce (output, 3))
        {
            b.wire (subject, output.id, "motor", into);
            felt = true;
        }
    for (const auto& output : face.outputs)
        if (! felt && isForce (output, 1) && ! type.info.id.starts_with ("device."))
        {
            b.add ("up", "vector.join");
            b.wire (subject, output.id, "up", *b.faceOf ("up").find (Role::input, "z"));
            b.wire ("up", "out", "motor", into);
            felt = true;
        }
    b.wire ("wall", "force", "motor", into);
    return b.graph;
}

}   // namespace tactus::host
