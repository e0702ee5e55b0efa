// SPDX-License-Identifier: MIT
#include "units_target.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
    tactus::fuzz::tryUnits ({ reinterpret_cast<const char*> (data), size });
    return 0;
}
