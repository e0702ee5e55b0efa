// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "face.hpp"
#include "patch.hpp"

#include <tactus/graph/edit.hpp>

#include <optional>
#include <string>

namespace tactus::host
{

/// A control sets a parameter to its own value while the node still stores another one. These edits keep the value in effect, so that no force jumps.

/// The value with which the graph runs for a parameter that controls name like this, in SI units. It may differ from the stored one, even without a
/// control: a subgraph node may override it. Empty if there is no such parameter, or if its instances have different values.
std::optional<double> valueInEffect (const graph::Graph&, const std::string& address, const Catalogue&);

/// The SI unit of a parameter that controls name like this, also if its wires and values decide it: "N", or "1" for a number without one. Empty if nothing
/// does, or if there is no such parameter.
std::string unitInEffect (const graph::Graph&, const std::string& address, const Catalogue&);

/// The graph with the values in effect stored in the nodes of a patch, so that a copy of them feels the same.
graph::Graph withValuesInEffect (const graph::Graph&, const SeenPatch&, const Catalogue&);

/// Removes a control. Its parameters keep what it sets them to, and in each snapshot what it set them to there.
graph::Command removeControl (const graph::Graph&, const std::string& control, const Catalogue&);

/// Removes a target from a control. Its parameter keeps what the control sets it to. Empty if there is no such target.
std::optional<graph::Command> removeTarget (const graph::Graph&, const std::string& control, const std::string& path, const Catalogue&);

/// Adds a parameter to a control; `now` is the value of the parameter. The control gets a part of the parameter's usual range, chosen so that the
/// value stays. A control without targets moves to the value instead. Empty if there is no such control.
std::optional<graph::Command> addTarget (const graph::Graph&, const std::string& control, const std::string& path, const Json& now, const PortSheet&);

}   // namespace tactus::host
