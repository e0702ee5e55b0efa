// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "face.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The two parts of the id of an array port's entry: 2 and "gain" for "gain[2]".
std::optional<std::size_t> entryOf (const std::string& id);
std::string baseOf (const std::string& id);

/// The value stored in the node, or null if there is none.
Json writtenValue (const graph::Node&, const FacePort&);

/// The value that applies if the node stores none: the one stored inside the subgraph, or the datasheet's default.
Json initialValue (const graph::Graph&, const graph::Node&, const FacePort&);

/// The value to store so that only the port's entry of a list changes. Empty means back to the default.
std::optional<Json> withValue (const graph::Node&, const FacePort&, const std::optional<Json>&);

/// The range a new control gets for a param: its usual range, widened to the current value, in the unit of the current value.
std::pair<Json, Json> sweepOf (const Json& now, const PortSheet&);

/// The widest part of that range in which a control at `at` (0 to 1) leaves the value as it is. It may run downwards, and goes beyond the
/// usual range if the value is at one end of it. Both ends are the value if the hard range leaves no other choice.
std::pair<Json, Json> sweepThrough (const Json& now, const PortSheet&, double at);

/// The params of a new source that give the param it is wired to what the param has now: an oscillator swings around it by a small part of it, a
/// constant is it. What has no offset swings around 0 by as much. Stays in the hard range of the param.
std::vector<std::pair<std::string, Json>> valuesOfSource (const Face& source, const Json& now, const PortSheet&);

/// The gain of a wire that modulates a param around its value `now`: a source that swings by one unit, or by its amplitude, moves the param by a tenth of
/// this value, or by a twentieth of its usual range if it is 0. With a speed, 0.1 m/s does so. Empty if the source is no modulator: an oscillator, an
/// envelope, a noise, a held sample or a speed; or if its unit does not fit. `carried`: the quantity of the output. `symbol`: the SI unit of the param, "" if
/// it is unknown. `depth`: how far it moves the param instead, in SI; 0: as above.
std::optional<Json> depthOf (const graph::Node& source, const Face& face, Quantity carried, const Json& now, const PortSheet&, const std::string& symbol,
                             double depth = 0.0);

}   // namespace tactus::host
