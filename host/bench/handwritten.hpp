// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "variant.hpp"

#include <memory>

namespace tactus::bench
{

/// The reference graph as one would write it without a framework: the kernels are called one after another, values are passed
/// in local variables, and sums and products are computed where they are needed.
std::unique_ptr<Variant> handwritten();

/// The same, followed by the guard of the preset's device, which exported code contains.
std::unique_ptr<Variant> handwrittenWithGuard();

}   // namespace tactus::bench
