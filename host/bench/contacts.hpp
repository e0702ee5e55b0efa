// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "variant.hpp"

#include <cstddef>
#include <memory>

namespace tactus::bench
{

/// A wall with friction and a grating for each of 64 contacts, as instances of one subgraph with different params. Each contact has
/// its own position, which follows the input. `lanes` as in CompileOptions.
std::unique_ptr<Variant> manyContacts (std::size_t lanes);

}   // namespace tactus::bench
