// SPDX-License-Identifier: MIT
#include "vest_target.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
    tactus::fuzz::tryVest ({ reinterpret_cast<const char*> (data), size });
    return 0;
}
