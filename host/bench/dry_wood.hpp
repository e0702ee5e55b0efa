// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "variant.hpp"

#include <memory>

namespace tactus::bench
{

/// The preset graphs/dry_wood.json as one would write it without a framework.
std::unique_ptr<Variant> dryWoodByHand();

}   // namespace tactus::bench
