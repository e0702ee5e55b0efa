// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/sessions/device_session.hpp>
#include <host/devices/sessions/workspace.hpp>

#include <cstdlib>
#include <string_view>

namespace tactus::fuzz
{

/// Reads the text as a session. Either the session survives writing and reading unchanged, or it is refused, gives an empty
/// session, and each problem is reported with its location. Aborts otherwise.
inline void trySession (std::string_view text)
{
    const auto read = host::readSession (text);
    for (const auto& m : read.messages)
        if (m.id.empty() || m.text.empty() || m.line < 1 || m.column < 1) std::abort();
    if (hasErrors (read.messages))
    {
        if (! (read.session == host::DeviceSession {})) std::abort();
        return;
    }
    const auto written = host::writeSession (read.session);
    const auto again = host::readSession (written);
    if (hasErrors (again.messages) || host::writeSession (again.session) != written) std::abort();
    for (const auto& role : read.session.roles())
        if (const auto w = read.session.binding (role)->find ("workspace"); w != read.session.binding (role)->end())
        {
            Messages messages;
            const auto workspace = host::readWorkspace (*w, "", messages);
            const Mat3 one = workspace.axes * workspace.axes.transpose();
            if (! (workspace.scale > 0.0) || ! ((one - Mat3::Identity()).norm() < 1e-14)) std::abort();
        }
}

}   // namespace tactus::fuzz
