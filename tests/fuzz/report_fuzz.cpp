// SPDX-License-Identifier: MIT
#include "report_target.hpp"

#include <host/devices/hid/profile_reader.hpp>

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput (const std::uint8_t* data, std::size_t size)
{
    static const auto loaded = tactus::host::hid::loadProfiles (TACTUS_SOURCE_DIR "/host/devices/profiles");
    if (loaded.profiles.empty()) std::abort();
    for (const auto& profile : loaded.profiles)
        tactus::fuzz::tryReport (profile, { reinterpret_cast<const char*> (data), size });
    return 0;
}
