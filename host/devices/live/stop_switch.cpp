// SPDX-License-Identifier: MIT
#include "stop_switch.hpp"

#include <tactus/text/message.hpp>

namespace tactus::host
{

bool StopSwitch::isWithinPause (Time since, Time at) noexcept
{
    return since != never && at < since + std::chrono::duration_cast<std::chrono::steady_clock::duration> (pause).count();
}

Result<> StopSwitch::mayRearm (std::chrono::steady_clock::time_point asked) const
{
    if (isWithinPause (pressed_at.load(), asked.time_since_epoch().count()))
        return Message::error ("run/rearm_too_early", {}, "the emergency stop was pressed less than a second ago",
                               "wait a second, make sure that forces may safely return, and rearm again");
    if (isWithinPause (rearmed_at.load(), now()))
        return Message::error ("run/rearm_too_early", {}, "the last rearm was less than a second ago", "find out what stops the run, then rearm again");
    return {};
}

Result<> StopSwitch::mayStart() const
{
    const auto seen = answered.load();
    if (seen == personStops()) return {};
    return Message::error ("run/stopped_by_person", {},
                           seen == 0 ? "no person has started the run yet" : "a person has stopped the run, and only a person starts it again",
                           "at the device, press START or REARM in the window, or R in the terminal of play");
}

}   // namespace tactus::host
