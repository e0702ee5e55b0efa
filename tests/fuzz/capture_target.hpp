// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid_link/capture.hpp>

#include <cmath>
#include <cstdlib>
#include <string_view>

namespace tactus::fuzz
{

/// Reads the text as a capture. Either each line has a finite time and no more bytes than a report or a message, or the problem
/// has its line. Aborts otherwise.
inline void tryCapture (std::string_view text)
{
    const auto read = host::hid::readCapture (text);
    if (! read)
    {
        const auto& e = read.error();
        if (e.id.empty() || e.text.empty() || e.remedy.empty() || e.line < 1) std::abort();
        return;
    }
    if (read->driver.empty() != read->wire.has_value()) std::abort();
    const auto longest = read->wire ? host::hid::longest_report + 1 : text.size();
    for (const auto& line : read->lines)
        if (! std::isfinite (line.t) || line.bytes.size() > longest) std::abort();
}

}   // namespace tactus::fuzz
