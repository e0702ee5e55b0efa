// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "stop_switch.hpp"

#include <host/platform/window_stop.hpp>
#include <juce_gui_basics/juce_gui_basics.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace tactus::host
{

/// Connects the stop keys of all windows of the program, and the STOP button of one of them, directly to a StopSwitch, so that a stop
/// does not wait for the message thread, where the system allows this: see WindowStop. [message thread]
class DirectStop
{
public:
    /// The switch must outlive this object.
    explicit DirectStop (StopSwitch& s) : pressed (s) {}

    /// From now on, a click on this part of the component is a stop. An empty part receives no clicks. Call this many times a second,
    /// because windows and components move. If direct stops do not work for a window, returns the reason, once per window.
    std::optional<Message> follow (juce::Component&, juce::Rectangle<int> part);

private:
    StopSwitch& pressed;
    void watchOthers();

    std::uintptr_t watched = 0;   // the window; 0: none yet
    std::unique_ptr<WindowStop> watch;
};

}   // namespace tactus::host
