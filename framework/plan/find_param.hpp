// SPDX-License-Identifier: MIT
#pragma once

#include "plan.hpp"

#include <tactus/text/result.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace tactus::plan
{

/// Finds parameters of a plan by name: "drag.mu", "grain/wave.direction.x", "mix.gain[2]", "finger[3]/drag.mu", or
/// "grain.roughness" if a subgraph exposes it. A name refers to one component of a vector and one entry of a list. For a
/// subgraph with a count, a name without an instance refers to the parameter in every instance. The result is never empty.
/// Errors: param/name, port/unknown_node, param/unknown, param/shape. [main thread]
Result<std::vector<ParamRef>> findParams (const Plan&, std::string_view name);

/// The name by which findParams finds this knob of this instance. [main thread]
std::string nameOf (const Flat&, std::size_t instance, std::size_t knob);
inline std::string nameOf (const Plan& plan, std::size_t instance, std::size_t knob) { return nameOf (plan.flat(), instance, knob); }

}   // namespace tactus::plan
