// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/sessions/session_file.hpp>

#include <juce_core/juce_core.h>

namespace tactus::host
{

/// The differences between two sessions, in one line: "stylus: hid tactus_board, clock: timer". [main thread]
juce::String changeText (const DeviceSession& before, const DeviceSession& now);

}   // namespace tactus::host
