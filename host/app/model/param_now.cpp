// SPDX-License-Identifier: GPL-3.0-or-later
#include "param_now.hpp"
#include "param_value.hpp"
#include "quantity_text.hpp"

#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
std::optional<ControlledParam> controlNow (const graph::Graph& g, const SeenPatch& patch, const graph::Node& node, const FacePort& port)
{
    const auto address = patch.address (node.name + '.' + port.id);
    return address.empty() ? std::nullopt : controlOf (g, address);
}
}   // namespace

bool drives (const graph::Wire& wire, const FacePort& param)
{
    const auto entry = entryOf (param.id);
    return ! wire.add && wire.enabled.value_or (true) && wire.to.port == baseOf (param.id) && wire.to.index == (entry ? static_cast<int> (*entry) : -1);
}

const graph::Wire* driverOf (const graph::Patch& patch, const std::string& node, const FacePort& param, int component)
{
    const auto isIt = [&] (const graph::Wire& w) {
        return w.to.node == node && (component < 0 || w.to.component < 0 || w.to.component == component) && drives (w, param);
    };
    const auto found = std::ranges::find_if (patch.wires, isIt);
    return found == patch.wires.end() ? nullptr : &*found;
}

juce::String drivenText (const std::string& output) { return filled (TRANS ("A wire from %1 sets this value. Delete the wire to set it here"), output); }

Json valueOf (const ControlledParam& controlled, const PortSheet& sheet)
{
    const auto low = readQuantity (controlled.low_text, sheet);
    return low ? low->moved (controlled.value).toJson() : Json (rounded (controlled.value));
}

ParamNow paramNow (const graph::Graph& g, const SeenPatch& patch, const graph::Node& node, const FacePort& port)
{
    const auto own = writtenValue (node, port);
    ParamNow now { own.is_null() ? initialValue (g, node, port) : own, ! own.is_null(), controlNow (g, patch, node, port) };
    if (! now.control || port.sheet == nullptr) return now;
    now.value = valueOf (*now.control, *port.sheet);
    now.is_set = true;
    return now;
}

std::optional<graph::Command> changeParam (const graph::Graph& g, const SeenPatch& patch, const graph::Node& node, const FacePort& port,
                                           const std::optional<Json>& value)
{
    const auto control = controlNow (g, patch, node, port);
    if (! control) return graph::SetParam { patch.name, node.name, baseOf (port.id), withValue (node, port, value) };
    const auto wanted = readQuantity (value.value_or (initialValue (g, node, port)), *port.sheet);
    return wanted ? moveControlFor (g, *control, wanted->si()) : std::nullopt;
}

std::string outOfRangeText (const graph::Graph& g, const SeenPatch& patch, const graph::Node& node, const FacePort& port)
{
    const auto control = controlNow (g, patch, node, port);
    const auto of = control ? filled (TRANS ("the new value of %1 is outside the range of the control %2"), port.id, control->name)
                            : filled (TRANS ("the new value of %1 is outside the range of its control"), port.id);
    return of.toStdString() + "; " + TRANS ("widen that range, or right-click the parameter in the inspector to release it").toStdString();
}

}   // namespace tactus::host
