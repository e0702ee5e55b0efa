// SPDX-License-Identifier: MIT
#pragma once

#include "engine.hpp"
#include "graph/graph.hpp"
#include "json.hpp"

#include <optional>
#include <string>
#include <string_view>

namespace tactus
{

/// What somebody typed after the = of NODE.PARAM=VALUE: a number, a list of numbers, or text with a unit or the name of a
/// choice. Text may be anything.
Json readValue (const std::string& text);

/// Turns a parameter of what runs, by a value as --set takes it: all of its components or none. Returns why not, if so.
/// Ids: port/unknown_node, param/unknown, param/shape, param/unknown_choice, param/value, param/unit, param/out_of_range.
/// [main thread]
std::optional<Message> turnParam (Engine&, const std::string& name, const Json& value);

/// Moves a control of the graph that runs, from 0 to 1, and with it all its targets. Ids: control/unknown, control/value.
/// [main thread]
std::optional<Message> turnControl (Engine&, const graph::Graph&, const std::string& id, double value);

/// Strikes an input that takes hits, at a speed in m/s: in all instances that the name stands for. Returns why not, if so.
/// Ids: those of findHits, hit/value. [main thread]
std::optional<Message> strike (Engine&, const std::string& name, double speed);

/// Nothing is struck faster than this: a hand's blow is below 20 m/s, and what is far beyond is a mistake.
inline constexpr double fastest_hit = 1000.0;   // m/s

}   // namespace tactus
