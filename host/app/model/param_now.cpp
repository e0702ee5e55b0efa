// SPDX-License-Identifier: GPL-3.0-or-later
#include "param_now.hpp"
#include "param_value.hpp"
#include "quantity_text.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace tactus::host
{

namespace
{
/// With as many digits as a hand can mean.
double rounded (double v)
{
    char text[40];
    std::snprintf (text, sizeof text, "%.3g", v);
    return std::strtod (text, nullptr);
}

std::optional<Held> heldNow (const graph::Graph& g, const std::string& patch, const graph::Node& node, const FacePort& port) { return patch.empty() ? heldBy (g, node.name + '.' + port.id) : std::nullopt; }
}   // namespace

ParamNow paramNow (const graph::Graph& g, const std::string& patch, const graph::Node& node, const FacePort& port)
{
    const auto own = writtenValue (node, port);
    ParamNow now { own.is_null() ? initialValue (g, node, port) : own, ! own.is_null(), heldNow (g, patch, node, port) };
    if (! now.held || port.sheet == nullptr) return now;
    // In the unit of the ends that it moves between.
    const auto read = readQuantity (now.held->low_text, *port.sheet);
    const auto* unit = std::get_if<QuantityText> (&read);
    now.value = unit == nullptr ? Json (rounded (now.held->value)) : unit->moved (now.held->value).toJson();
    now.is_set = true;
    return now;
}

std::optional<graph::Command> changeParam (const graph::Graph& g, const std::string& patch, const graph::Node& node, const FacePort& port, const std::optional<Json>& value)
{
    const auto held = heldNow (g, patch, node, port);
    if (! held) return graph::SetParam { patch, node.name, baseOf (port.id), withValue (node, port, value) };
    const auto read = readQuantity (value.value_or (initialValue (g, node, port)), *port.sheet);
    const auto* q = std::get_if<QuantityText> (&read);
    return q == nullptr ? std::nullopt : moveHeld (g, *held, q->si());
}

std::string beyondReach (const graph::Graph& g, const graph::Node& node, const FacePort& port)
{
    const auto held = heldBy (g, node.name + '.' + port.id);
    return (held ? held->name : "The control") + " moves " + port.id + " only between the ends it has there; widen them, or release it with the right button in the inspector";
}

}   // namespace tactus::host
