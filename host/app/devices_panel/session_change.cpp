// SPDX-License-Identifier: GPL-3.0-or-later
#include "session_change.hpp"

#include <host/app/text/filled.hpp>
#include <host/devices/sessions/role_fits.hpp>

#include <set>
#include <string>

namespace tactus::host
{

juce::String changeText (const DeviceSession& before, const DeviceSession& now)
{
    const auto differs = [] (const Json* a, const Json* b) { return (a == nullptr) != (b == nullptr) || (a != nullptr && *a != *b); };
    std::set<std::string> roles;
    for (const auto* session : { &before, &now })
        for (auto& role : session->roles())
            roles.insert (std::move (role));
    juce::StringArray parts;
    for (const auto& role : roles)
        if (const auto* bound = now.binding (role); differs (before.binding (role), bound))
            parts.add (filled ("%1: %2", role, bound != nullptr ? fromUtf8 (nameOf (*bound)) : TRANS ("as in the graph")));
    if (before.clock() != now.clock()) parts.add (filled (TRANS ("clock: %1"), now.clock().empty() ? TRANS ("automatic") : fromUtf8 (now.clock())));
    if (differs (before.audio(), now.audio())) parts.add (TRANS ("the settings of the sound card"));
    return parts.isEmpty() ? TRANS ("settings that this window does not show") : parts.joinIntoString (", ");
}

}   // namespace tactus::host
