// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"
#include <tactus/graph/graph.hpp>
#include <tactus/text/json.hpp>

#include <tactus/plan/flat/flatten.hpp>
#include <tactus/text/result.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace tactus
{

/// Reads the text after the = of NODE.PARAM=VALUE: a number, a list of numbers, text with a unit, or the name of a choice. Text may be quoted,
/// as in JSON. Accepts any text.
Json readValue (const std::string& text);

/// Reads NODE.PARAM=VALUE. Ids: param/no_value.
Result<plan::Override> readOverride (const std::string& text);

/// Sets a parameter of a running graph to a value as in --set: either all of its components or none. Ids: port/unknown_node,
/// param/unknown, param/shape, param/unknown_choice, param/value, param/unit, param/out_of_range. [main thread]
Result<> turnParam (Engine&, const std::string& name, const Json& value);

/// A control by its id. Ids: control/unknown.
Result<const graph::Control*> findControl (const graph::Graph&, const std::string& id);

/// Says that a value is none for this control: id control/value.
Message beyondControl (const std::string& id);

/// Moves a control of a running graph (0 to 1), and with it all its targets. Ids: control/unknown, control/value. [main
/// thread]
Result<> turnControl (Engine&, const graph::Graph&, const std::string& id, double value);

/// Triggers a hit input at a speed in m/s, in all instances that the name covers. Ids: those of findHits, hit/value.
/// [main thread]
Result<> strike (Engine&, const std::string& name, double speed);

/// Faster hits are refused: a blow by hand is slower than 20 m/s, so a much higher speed is a mistake.
inline constexpr double fastest_hit = 1000.0;   // in m/s

}   // namespace tactus
