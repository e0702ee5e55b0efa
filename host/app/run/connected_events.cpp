// SPDX-License-Identifier: GPL-3.0-or-later
#include "connected_events.hpp"

#if TACTUS_EVDEV
#include <host/drivers/evdev/event_device.hpp>
#endif

namespace tactus::host
{

std::vector<ConnectedEvents> connectedEvents()
{
    std::vector<ConnectedEvents> all;
#if TACTUS_EVDEV
    for (const auto& info : evdev::thisComputer().list())
        all.push_back ({ .name = info.name, .path = info.path, .trouble = info.may_open ? std::string() : evdev::howToPermit (info) });
#endif
    return all;
}

}   // namespace tactus::host
