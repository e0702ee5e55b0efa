// SPDX-License-Identifier: MIT
#include "hardware.hpp"

#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/sessions/audio_settings.hpp>
#include <host/devices/sessions/choose_clock.hpp>
#include <tactus/text/message.hpp>

namespace tactus::host
{

namespace
{
MadeDevice refused (Message why)
{
    MadeDevice none;
    none.messages.push_back (std::move (why));
    return none;
}
}   // namespace

MadeDevice Hardware::open (const Json& description, const std::filesystem::path& folder, const std::string& role, const Plan& plan)
{
    if (isPluginDevice (description))
        return isThere() ? openPluginDevice (description)
                         : refused (Message::error ("device/real", "/driver", "this is a real device, which only `tactus play` and tactus-host can drive",
                                                    "give the role a simulated device instead: \"driver\": \"sim\""));
    if (! isThere()) return makeDevice (description, folder);   // refuses real devices
    if (! audio::isAudio (description)) return hid::openDevice (description, folder, system(), profiles());
    if (run_sound != nullptr) return run_sound->open (description, role, plan);
    return refused (Message::error ("audio/none", "/driver", "this program has no sound cards", "give the role another device"));
}

std::optional<double> Hardware::tickRate (const Json& description, bool may_wait) const
{
    if (! isThere() || ! hid::isHid (description)) return std::nullopt;   // profiles are read only if needed
    return tickRateOf (description, system(), profiles(), may_wait);
}

}   // namespace tactus::host
