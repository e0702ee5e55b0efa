// SPDX-License-Identifier: MIT
#pragma once

#include <host/code/generate/class/exported.hpp>

#include <cstddef>

namespace tactus::host
{

/// Bytes of RAM that an exported graph takes on a 64-bit computer with the C++ library of GCC. With 4-byte pointers or floats it takes less.
struct ObjectSize
{
    std::size_t nodes = 0, prepared = 0, roles = 0, parameters = 0, others = 0;
    std::size_t inputs = 0, outputs = 0;   ///< of the structs that the caller keeps

    std::size_t all() const noexcept { return nodes + prepared + roles + parameters + others; }
};

ObjectSize objectSize (const Exported&);

}   // namespace tactus::host
