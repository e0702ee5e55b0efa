// SPDX-License-Identifier: GPL-3.0-or-later
#include "binding_choice.hpp"

#include <host/app/text/filled.hpp>
#include <host/devices/hid/physics.hpp>
#include <host/devices/hid_link/force_feedback.hpp>
#include <host/devices/sessions/audio_settings.hpp>
#include <host/devices/sessions/numbers_device.hpp>
#include <host/devices/sessions/role_fits.hpp>

#include <tactus/run/device/gestures.hpp>
#include <tactus/run/device/make_device.hpp>

#include <algorithm>

namespace tactus::host
{

Json deviceOfBinding (Json binding)
{
    for (const auto* key : { "workspace", "guard" })
        binding.erase (key);
    const bool is_events = binding.is_object() && binding.value ("driver", Json()) == Json (event_driver);
    if (is_events || ! namesPlugin (binding))   // to the driver of a plugin of others, other keys may mean anything
        for (const auto* key : { "outputs", "inputs", "calibration", "max_rate" })
            binding.erase (key);
    return binding;
}

Json simulationOf (const hid::Profile& profile, const Json* before)
{
    auto sim = defaultDevice();
    if (before != nullptr && before->contains ("guard") && ! audio::isAudio (*before)) sim["guard"] = before->at ("guard");
    return withNumbers (std::move (sim), hid::numbersOf (profile));
}

std::vector<BindingChoice> bindingChoices (const Json* bound_now, std::span<const hid::ConnectedDevice> connected, const hid::LoadedProfiles& profiles,
                                           std::span<const hid::ConnectedDevice> without_profile, std::span<const ConnectedEvents> events,
                                           std::span<const OfferedDevice> offered)
{
    std::vector<BindingChoice> all { { TRANS ("as in the graph").toStdString(), Json() },
                                     { TRANS ("simulated tool").toStdString(), defaultDevice() },
                                     { juce::translate (sound_card).toStdString(), { { "driver", "audio" } } } };
    for (const auto& d : connected)
    {
        const auto fitting = hid::matching (profiles.profiles, d);
        if (fitting.empty()) continue;
        Json description { { "driver", "hid" }, { "profile", fitting.front()->id } };
        const auto alike = std::ranges::count_if (connected, [&] (const auto& other) { return hid::fit (*fitting.front(), other) > 0; });
        const bool needs_serial = alike > 1 && ! d.serial.empty();
        if (needs_serial) description["serial"] = d.serial;
        const auto& name = fitting.front()->name;
        BindingChoice choice { needs_serial ? filled (TRANS ("%1, serial %2"), name, d.serial).toStdString() : name, std::move (description) };
        if (std::ranges::count (all, choice) == 0) all.push_back (std::move (choice));
    }
    for (const auto& d : without_profile)
    {
        // With the serial number, because a calibration is that of one device.
        Json description { { "driver", "hid" }, { "profile", hid::pid_profile } };
        if (! d.serial.empty()) description["serial"] = d.serial;
        BindingChoice choice { filled (TRANS ("%1, force feedback"), d.product).toStdString(), std::move (description) };
        if (std::ranges::count (all, choice) == 0) all.push_back (std::move (choice));
    }
    for (const auto& d : events)
    {
        // By its name, because numbers of event devices change from start to start.
        const bool is_alone = ! d.name.empty() && std::ranges::count (events, d.name, &ConnectedEvents::name) == 1;
        const auto& port = is_alone ? d.name : d.path;
        const auto label = filled (TRANS ("%1, through the kernel"), is_alone ? d.name : d.name + " (" + d.path + ")");
        all.push_back ({ label.toStdString(), { { "driver", event_driver }, { "port", port } } });
    }
    for (const auto& d : offered)
    {
        const auto port = d.description.value ("port", d.description.at ("driver").asString());   // a driver may need no port
        auto label = filled (d.is_sure ? TRANS ("%1 at %2") : TRANS ("%2 as %1"), d.name, port);
        if (! d.may_open) label = filled (TRANS ("%1 (this user may not open it)"), label);
        all.push_back ({ label.toStdString(), d.description });
    }
    for (const auto& p : profiles.profiles)
        if (hid::isNumbersOnly (*p))
            all.push_back ({ filled (TRANS ("simulated %1"), p->name).toStdString(), deviceOfBinding (simulationOf (*p, nullptr)), p->id });
    for (const auto& g : gestures())
        all.push_back ({ filled (TRANS ("gesture %1"), g.id).toStdString(), { { "driver", "gesture" }, { "path", g.id } } });
    if (bound_now != nullptr)
    {
        const auto now = deviceOfBinding (*bound_now);
        if (std::ranges::none_of (all, [&] (const auto& c) { return c.description == now; }))
            all.push_back ({ nameOf (now), now });
    }
    return all;
}

}   // namespace tactus::host
