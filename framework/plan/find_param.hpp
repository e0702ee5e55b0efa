// SPDX-License-Identifier: MIT
#pragma once

#include "plan.hpp"

#include <framework/message.hpp>

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tactus::plan
{

/// A parameter of a plan by the names people use: "drag.mu", "grain/wave.direction.x", "mix.gain[2]", "finger[3]/drag.mu",
/// and what a subgraph shows as its own, "grain.roughness". Of a vector one component, of a list one entry; of a subgraph
/// with a count, where the name does not say which, one in each instance. Never none. [main thread]
std::variant<std::vector<ParamRef>, Message> findParams (const Plan&, std::string_view name);

/// The name under which findParams finds a knob of an instance. [main thread]
std::string nameOf (const Plan&, std::size_t instance, std::size_t knob);

}   // namespace tactus::plan
