// SPDX-License-Identifier: GPL-3.0-or-later
#include "osc_target.hpp"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
    tactus::fuzz::tryOsc ({ reinterpret_cast<const char*> (data), size });
    return 0;
}
