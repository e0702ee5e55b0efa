// SPDX-License-Identifier: MIT
#include "graph_target.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
    tactus::fuzz::tryGraph ({ reinterpret_cast<const char*> (data), size });
    return 0;
}
