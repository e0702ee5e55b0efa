// SPDX-License-Identifier: MIT
#include "connected_devices.hpp"
#include "event_devices.hpp"

#include <host/devices/hid/physics.hpp>
#include <host/devices/hid_link/force_feedback.hpp>
#include <host/devices/hid_link/hid_device.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/hid_link/udev_rule.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <utility>

namespace tactus::host
{

std::string hex4 (unsigned n)
{
    char text[8];
    std::snprintf (text, sizeof text, "%04x", n);
    return text;
}

std::string_view nameOf (hid::Bus bus)
{
    switch (bus)
    {
    case hid::Bus::usb:
        return "usb";
    case hid::Bus::bluetooth:
        return "bluetooth";
    default:
        return "unknown";
    }
}

/// The degree to which a profile has been verified on a real device.
std::string_view verifiedOf (const hid::Profile& p)
{
    const auto seen = [] (const auto& report) { return report.verified; };
    const auto all = std::ranges::all_of (p.inputs, seen) && std::ranges::all_of (p.outputs, seen);
    const auto any = std::ranges::any_of (p.inputs, seen) || std::ranges::any_of (p.outputs, seen);
    if (all) return "verified";
    return any ? "partly verified" : "not verified";
}

std::vector<Listed> listDevices (const hid::LoadedProfiles& profiles)
{
    std::vector<Listed> all;
    for (auto& device : hid::eachOnce (hid::thisComputer().connected(), profiles))
    {
        auto fitting = hid::matching (profiles.profiles, device);
        Messages unable;
        if (fitting.empty() && hid::hasForceFeedback (hid::thisComputer(), device))
            if (auto pid = hid::profileOf (hid::thisComputer(), device, std::nullopt, unable)) fitting.push_back (std::move (pid));
        const bool may_open = hid::thisComputer().mayOpen (device);
        std::erase_if (unable, [] (const Message& m) { return m.severity == Message::Severity::warning; });
        all.push_back ({ std::move (device), std::move (fitting), may_open, std::move (unable) });
    }
    return all;
}

Json jsonOf (const Listed& l)
{
    const auto& d = l.device;
    Json profiles = Json::array();
    for (const auto& p : l.profiles)
        profiles.push_back ({ { "id", p->id }, { "name", p->name }, { "verified", verifiedOf (*p) } });
    Json json { { "path", d.path },
                { "vid", hex4 (d.vid) },
                { "pid", hex4 (d.pid) },
                { "usage_page", hex4 (d.usage_page) },
                { "usage", hex4 (d.usage) },
                { "interface", d.interface_number },
                { "bus", nameOf (d.bus) },
                { "product", d.product },
                { "manufacturer", d.manufacturer },
                { "serial", d.serial },
                { "profiles", std::move (profiles) },
                { "may_open", l.may_open } };
    if (! l.may_open) json["udev_rule"] = hid::udevRule (d);
    return json;
}

Json jsonOf (const hid::SerialPort& p, const hid::LoadedProfiles& profiles)
{
    Json could_be = Json::array();
    for (const auto& profile : hid::profilesFor (p, profiles.profiles))
        could_be.push_back ({ { "id", profile->id }, { "name", profile->name } });
    return { { "driver", "serial" },
             { "port", p.path },
             { "vid", p.vid },
             { "pid", p.pid },
             { "product", p.product },
             { "may_open", p.may_open },
             { "profiles", std::move (could_be) } };
}

std::vector<std::shared_ptr<const hid::Profile>> knownByNumbers (const hid::LoadedProfiles& all)
{
    std::vector<std::shared_ptr<const hid::Profile>> known;
    std::ranges::copy_if (all.profiles, std::back_inserter (known), [] (const auto& p) { return hid::isNumbersOnly (*p); });
    return known;
}

Json numbersJsonOf (const hid::Profile& profile)
{
    Json physics = Json::object();
    const auto origin = [] (Json json, const auto& number) {
        if (! number.source.empty()) json["source"] = number.source;
        json["guess"] = number.guess;
        return json;
    };
    const auto numbers = hid::numbersOf (profile);
    for (const auto& row : deviceNumberRows())
        if (const auto& number = numbers.*row.member) physics[std::string (row.id)] = origin ({ { "value", number->value } }, *number);
    const auto corner = [] (const Vec3& v) { return Json { v.x(), v.y(), v.z() }; };
    if (const auto& box = numbers.workspace) physics["workspace"] = origin ({ { "min", corner (box->min) }, { "max", corner (box->max) } }, *box);
    return { { "profile", profile.id }, { "name", profile.name }, { "numbers_only", true }, { "physics", std::move (physics) } };
}

std::string numbersText (std::span<const std::shared_ptr<const hid::Profile>> profiles)
{
    std::string all;
    for (const auto& profile : profiles)
        addToList (all, printableName (profile->id) + " (" + printableName (profile->name) + ")");
    return all.empty() ? all : "devices known by their numbers only: " + all + "\n    simulate one, or check a graph with its numbers: --device ROLE=PROFILE\n";
}

Json listedJson (const hid::LoadedProfiles& profiles)
{
    Json all = Json::array();
    for (const auto& l : listDevices (profiles))
        all.push_back (jsonOf (l));
    for (const auto& port : hid::serialPorts())
        all.push_back (jsonOf (port, profiles));
    for (auto& l : listEventDevices())
        all.push_back (std::move (l.json));
    for (const auto& profile : knownByNumbers (profiles))
        all.push_back (numbersJsonOf (*profile));
    return all;
}

}   // namespace tactus::host
