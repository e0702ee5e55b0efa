// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/platform/window_stop.hpp>
#include <host/devices/live/stop_switch.hpp>
#include <juce_gui_basics/juce_gui_basics.h>

#include <atomic>
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

    /// Sets whether Esc is a stop, as it is at first. If it is not, it closes something on the message thread. Shift+Esc always is one.
    void letEscStop (bool does) noexcept { esc_stops = does; }

private:
    void watchOthers();

    StopSwitch& pressed;
    std::atomic<bool> esc_stops { true };

    std::uintptr_t watched = 0;   // the window; 0: none yet
    std::unique_ptr<WindowStop> watch;
};

}   // namespace tactus::host
