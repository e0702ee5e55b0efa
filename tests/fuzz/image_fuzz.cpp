// SPDX-License-Identifier: MIT
#include "image_target.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
    tactus::fuzz::tryImage ({ reinterpret_cast<const char*> (data), size });
    return 0;
}
