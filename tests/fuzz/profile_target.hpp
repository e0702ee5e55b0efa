// SPDX-License-Identifier: MIT
#pragma once

#include "report_target.hpp"

#include <host/devices/hid/profile_reader.hpp>

namespace tactus::fuzz
{

/// Reads the text as a device profile. Either the profile accepts any report, or reading reports problems, each with its location.
/// Aborts otherwise.
inline void tryProfile (std::string_view text)
{
    const auto loaded = host::hid::readProfileText (text);
    if (loaded.profile == nullptr && ! hasErrors (loaded.messages)) std::abort();
    for (const auto& m : loaded.messages)
        if (m.id.empty() || m.text.empty() || m.line < 1 || m.column < 1) std::abort();
    if (loaded.profile) tryReport (loaded.profile, text);
}

}   // namespace tactus::fuzz
