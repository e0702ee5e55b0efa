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

/// Connects the stop keys of a window and its STOP button to a StopSwitch, past the message thread, where the system allows that:
/// see WindowStop. [message thread]
class DirectStop
{
public:
    /// The switch must outlive this object.
    explicit DirectStop (StopSwitch& s) : pressed (s) {}

    /// From now on, a click on this part of the component stops; an empty part receives no click. Call it many times a second, because
    /// windows and components move. Returns why stops go through the message thread, once for each window where they do.
    std::optional<Message> follow (juce::Component&, juce::Rectangle<int> part);

private:
    StopSwitch& pressed;
    std::uintptr_t watched = 0;   // the window; 0: none yet
    std::unique_ptr<WindowStop> watch;
};

}   // namespace tactus::host
