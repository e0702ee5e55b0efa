// SPDX-License-Identifier: MIT
#pragma once

#include "catalogue.hpp"

namespace tactus
{

/// True if a node with its default params and settings claims that it generates no energy over any closed path. [main thread]
inline bool claimsPassive (const NodeType& type)
{
    if (type.claims == nullptr) return false;
    const auto node = type.make();
    if (type.prepare != nullptr) type.prepare (node.get(), {});
    return type.claims (node.get()).passive;
}

}   // namespace tactus
