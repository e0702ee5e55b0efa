// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "face.hpp"

#include <optional>
#include <string>
#include <utility>

namespace tactus::host
{

/// Which entry of an array port an id names: 2 of "gain[2]", or none; and the id without it.
std::optional<std::size_t> entryOf (const std::string& id);
std::string baseOf (const std::string& id);

/// What a param of a node says as written, null if nothing; and what it is then: what the inside of a subgraph says, or the
/// default of its datasheet.
Json writtenValue (const graph::Node&, const FacePort&);
Json initialValue (const graph::Graph&, const graph::Node&, const FacePort&);

/// What a param is to be written as, so that only its entry of a list changes. Nothing brings the default back.
std::optional<Json> withValue (const graph::Node&, const FacePort&, const std::optional<Json>&);

/// From where to where a control moves it, unless said: its usual range, in the unit of the value as it is.
std::pair<Json, Json> sweepOf (const Json& now, const PortSheet&);

}   // namespace tactus::host
