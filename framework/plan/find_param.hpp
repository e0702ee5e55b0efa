// SPDX-License-Identifier: MIT
#pragma once

#include "plan.hpp"

#include <framework/message.hpp>

#include <string_view>
#include <variant>

namespace tactus::plan
{

/// A parameter of a plan by the names people use: "drag.mu", "grain/wave.direction.x", "mix.gain[2]", and what a subgraph
/// shows as its own, "grain.roughness". Of a vector one component, of a list one entry. [main thread]
std::variant<ParamRef, Message> findParam (const Plan&, std::string_view name);

}   // namespace tactus::plan
