// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "variant.hpp"

#include <memory>

namespace tactus::bench
{

// What `tactus export` writes, compiled into the bench.
std::unique_ptr<Variant> exportedReference();   ///< graphs/padded_bench.json, with its guard
std::unique_ptr<Variant> exportedChain();       ///< the chain of a hundred one-poles

}   // namespace tactus::bench
