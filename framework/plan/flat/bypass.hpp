// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"
#include <tactus/plan/steps/ops.hpp>

#include <cstddef>
#include <functional>

namespace tactus::plan
{

/// Makes what runs in place of a bypassed node. Sets the outputs to which nothing is copied: to 1 if they are factors, else to 0.
/// `is_driven` tells whether a wire or feed drives an input component of the node; the components are counted from the node's first.
Bypass bypassOf (const FlatNode&, std::byte* outputs, const std::function<bool (std::size_t)>& is_driven);

}   // namespace tactus::plan
