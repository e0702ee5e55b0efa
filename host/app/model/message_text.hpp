// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/text/message.hpp>

#include <algorithm>
#include <string>

namespace tactus::host
{

/// A remedy without the parts that name options of the command line, which the window does not have. Parts end at a semicolon.
inline std::string withoutOptions (const std::string& remedy)
{
    std::string kept;
    for (std::size_t at = 0; at < remedy.size();)
    {
        const auto end = std::min (remedy.find ("; ", at), remedy.size());
        const auto part = remedy.substr (at, end - at);
        if (! part.starts_with ("--") && part.find (" --") == part.npos) kept += (kept.empty() ? "" : "; ") + part;
        at = end + 2;
    }
    return kept;
}

/// A message as the window shows it: "text; remedy".
inline std::string messageText (const Message& m)
{
    const auto remedy = withoutOptions (m.remedy);
    return remedy.empty() ? m.text : m.text + "; " + remedy;
}

}   // namespace tactus::host
