// SPDX-License-Identifier: MIT
#include "event_devices.hpp"

#if TACTUS_EVDEV
#include <host/drivers/evdev/event_device.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <cstdio>
#endif

namespace tactus::host
{

#if TACTUS_EVDEV
namespace
{
using evdev::EventDeviceInfo;

template <typename Parts>
std::string namesOf (const Parts& parts)
{
    std::string text;
    for (const auto& part : parts)
        text += (text.empty() ? "" : " ") + part.name;
    return text;
}

std::vector<std::string> effectsOf (const EventDeviceInfo& d)
{
    std::vector<std::string> all;
    if (d.has_constant) all.emplace_back ("constant force");
    if (d.has_rumble) all.emplace_back ("rumble");
    return all;
}

std::string idsOf (const EventDeviceInfo& d)
{
    char text[16];
    std::snprintf (text, sizeof text, "%04x:%04x", d.vid, d.pid);
    return text;
}

std::string textOf (const EventDeviceInfo& d)
{
    std::string text = d.path + "   " + idsOf (d) + "   " + (d.name.empty() ? "unnamed" : printableName (d.name)) + "\n    force feedback:";
    const auto effects = effectsOf (d);
    for (std::size_t i = 0; i < effects.size(); ++i)
        text += (i == 0 ? " " : ", ") + effects[i];
    if (d.update_interval_s > 0.0) text += "; its port takes an update every " + numberText (1e3 * d.update_interval_s) + " ms at most";
    if (d.may_open) text += "; axes: " + namesOf (d.axes) + "; " + std::to_string (d.buttons.size()) + " buttons";
    return text + "\n    " + (d.may_open ? "may be opened: --device ROLE=evdev:" + d.path : "may not be opened by this user: " + evdev::howToPermit (d)) + "\n";
}

Json jsonOf (const EventDeviceInfo& d)
{
    Json axes = Json::array(), buttons = Json::array(), effects = Json::array();
    for (const auto& axis : d.axes)
        axes.push_back ({ { "name", axis.name }, { "minimum", axis.minimum }, { "maximum", axis.maximum } });
    for (const auto& button : d.buttons)
        buttons.push_back (button.name);
    for (const auto& effect : effectsOf (d))
        effects.push_back (effect);
    Json json { { "driver", "evdev" },
                { "path", d.path },
                { "name", d.name },
                { "vid", idsOf (d).substr (0, 4) },
                { "pid", idsOf (d).substr (5) },
                { "serial", d.serial },
                { "effects", std::move (effects) },
                { "axes", std::move (axes) },
                { "buttons", std::move (buttons) },
                { "update_interval_s", d.update_interval_s },
                { "may_open", d.may_open } };
    if (! d.may_open) json["remedy"] = evdev::howToPermit (d);
    return json;
}

}   // namespace

std::vector<ListedEvents> listEventDevices()
{
    std::vector<ListedEvents> all;
    for (const auto& info : evdev::thisComputer().list())
        all.push_back ({ .path = info.path, .may_open = info.may_open, .json = jsonOf (info), .text = textOf (info) });
    return all;
}

#else
std::vector<ListedEvents> listEventDevices()
{
    return {};
}
#endif

}   // namespace tactus::host
