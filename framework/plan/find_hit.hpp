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

/// Inputs for hits of a plan by the names people use: "ring.hit", "grain/ring.hit", "finger[3]/ring.hit"; of a subgraph with a
/// count, where the name does not say which, one in each instance. Never none.
/// Ids: hit/name, port/unknown_node, hit/unknown, hit/not_running. [main thread]
std::variant<std::vector<HitRef>, Message> findHits (const Plan&, std::string_view name);

/// The name under which findHits finds an input of an instance.
std::string nameOfHit (const Plan&, std::size_t instance, std::size_t input);

}   // namespace tactus::plan
