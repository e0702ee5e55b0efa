// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/edit.hpp>

#include <optional>
#include <string>

namespace tactus::host
{

/// A parameter that a control of the graph sets: which one, and from where to where.
struct Held
{
    std::string control, name;      ///< its id, and what people call it
    double low = 0.0, high = 0.0;   ///< SI
    double value = 0.0;             ///< SI; what the control makes of it now
    Json low_text;                  ///< as written, for its unit
};

/// By its path, as "drag.mu" or "desk.gain[0]"; nothing if no control sets it.
std::optional<Held> heldBy (const graph::Graph&, const std::string& path);

/// What moves the control so that the parameter has that value; nothing if the control does not reach so far.
std::optional<graph::Command> moveHeld (const graph::Graph&, const Held&, double to_si);

/// A target more for a control.
std::optional<graph::Command> addTarget (const graph::Graph&, const std::string& control, const std::string& path, Json low, Json high);

/// Without that target.
std::optional<graph::Command> removeTarget (const graph::Graph&, const std::string& control, const std::string& path);

/// A control of its own for a parameter, under a free id made of its name; it stands where the parameter is.
graph::Command newControlFor (const graph::Graph&, const std::string& path, const Json& low, const Json& high, double now_si);

/// A control without targets.
graph::Command newControl (const graph::Graph&);

}   // namespace tactus::host
