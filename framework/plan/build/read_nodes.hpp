// SPDX-License-Identifier: MIT
#pragma once

#include "outside.hpp"

#include <vector>

namespace tactus::plan
{

/// By node: whether a wire or a record reads any of its outputs. Always true in a section with its own rate: there, outputs may
/// keep their values until the section runs again, and a later plan may read them.
std::vector<bool> readNodes (const Flat& flat, const Outside& outside);

}   // namespace tactus::plan
