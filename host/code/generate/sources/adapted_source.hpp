// SPDX-License-Identifier: MIT
#pragma once

#include "sources.hpp"

#include <string>

namespace tactus::host
{

/// A source file as exported code contains it: with the containers of framework/run/generated/exported_memory.hpp instead of those of the C++
/// library, which take their memory from a heap.
std::string adapted (const SourceFile&);

}   // namespace tactus::host
