// SPDX-License-Identifier: MIT
#include "inverse3_target.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
    tactus::fuzz::tryInverse3 ({ reinterpret_cast<const char*> (data), size });
    return 0;
}
