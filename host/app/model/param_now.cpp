// SPDX-License-Identifier: GPL-3.0-or-later
#include "param_now.hpp"
#include "param_value.hpp"
#include "quantity_text.hpp"

namespace tactus::host
{

namespace
{
std::optional<ControlledParam> controlNow (const graph::Graph& g, const std::string& patch, const graph::Node& node, const FacePort& port)
{
    return patch.empty() ? controlOf (g, node.name + '.' + port.id) : std::nullopt;
}
}   // namespace

Json valueOf (const ControlledParam& controlled, const PortSheet& sheet)
{
    const auto low = readQuantity (controlled.low_text, sheet);
    return low ? low->moved (controlled.value).toJson() : Json (rounded (controlled.value));
}

ParamNow paramNow (const graph::Graph& g, const std::string& patch, const graph::Node& node, const FacePort& port)
{
    const auto own = writtenValue (node, port);
    ParamNow now { own.is_null() ? initialValue (g, node, port) : own, ! own.is_null(), controlNow (g, patch, node, port) };
    if (! now.control || port.sheet == nullptr) return now;
    now.value = valueOf (*now.control, *port.sheet);
    now.is_set = true;
    return now;
}

std::optional<graph::Command> changeParam (const graph::Graph& g, const std::string& patch, const graph::Node& node, const FacePort& port,
                                           const std::optional<Json>& value)
{
    const auto control = controlNow (g, patch, node, port);
    if (! control) return graph::SetParam { patch, node.name, baseOf (port.id), withValue (node, port, value) };
    const auto wanted = readQuantity (value.value_or (initialValue (g, node, port)), *port.sheet);
    return wanted ? moveControlFor (g, *control, wanted->si()) : std::nullopt;
}

std::string outOfRangeText (const graph::Graph& g, const graph::Node& node, const FacePort& port)
{
    const auto control = controlOf (g, node.name + '.' + port.id);
    return "the new value of " + port.id + " is outside the range of " + (control ? "the control " + control->name : "its control")
           + "; widen that range, or right-click the parameter in the inspector to release it";
}

}   // namespace tactus::host
