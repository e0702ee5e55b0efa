// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/edit.hpp>

#include <optional>
#include <string>

namespace tactus::host
{

/// Null if the graph has no control with this id.
const graph::Control* findControl (const graph::Graph&, const std::string& id);

/// A parameter that a control of the graph drives, and its range.
struct ControlledParam
{
    std::string control, name;      ///< id and display name of the control
    std::string path;               ///< the target of the control: of a parameter that a subgraph exposes, perhaps the one inside
    double low = 0.0, high = 0.0;   ///< in SI units
    double value = 0.0;             ///< what the control sets it to now, in SI units
    Json low_text;                  ///< one end of the range as written in the file, to show values in its unit
};

/// Looks a parameter up by its path, such as "drag.mu" or "desk.gain[0]". Empty if no control drives it, nor the parameter inside that it exposes.
std::optional<ControlledParam> controlOf (const graph::Graph&, const std::string& path);

/// Moves the control so that the parameter gets this value. Empty if the value is out of the control's range.
std::optional<graph::Command> moveControlFor (const graph::Graph&, const ControlledParam&, double to_si);

/// Creates a control for one parameter, with a free id derived from the parameter's name. It starts at the current value.
graph::Command newControlFor (const graph::Graph&, const std::string& path, const Json& low, const Json& high, double now_si);

/// Creates a control without targets.
graph::Command newControl (const graph::Graph&);

}   // namespace tactus::host
