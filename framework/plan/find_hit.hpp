// SPDX-License-Identifier: MIT
#pragma once

#include "plan.hpp"

#include <tactus/text/result.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace tactus::plan
{

/// Finds hit inputs of a plan by name: "ring.hit", "grain/ring.hit", "finger[3]/ring.hit". For a subgraph with a count, a name
/// without an instance refers to the input in every instance. The result is never empty.
/// Errors: hit/name, port/unknown_node, hit/unknown, hit/not_running. [main thread]
Result<std::vector<HitRef>> findHits (const Plan&, std::string_view name);

/// The name by which findHits finds this input of this instance.
std::string nameOfHit (const Plan&, std::size_t instance, std::size_t input);

}   // namespace tactus::plan
