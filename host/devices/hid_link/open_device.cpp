// SPDX-License-Identifier: MIT
#include "open_device.hpp"
#include "force_feedback.hpp"
#include "hid_device.hpp"
#include "profile_library.hpp"
#include "wires.hpp"
#include <tactus/run/device/guard_limits.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/object_reader.hpp>

#include <host/base/platform/wire_file.hpp>
#include <host/devices/hid/physics.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host::hid
{
namespace
{
constexpr double default_ramp = 0.2;   // in s, for a profile that takes efforts but gives no ramp

struct DeviceRequest
{
    Wire wire = Wire::hid;
    std::string profile, serial;   // "" matches any
    std::string port;              // where the wire goes, unless it is HID
    std::optional<PidCalibration> calibration {};

    bool meansPid() const { return wire == Wire::hid && profile == pid_profile; }
    bool mayMeanPid() const { return wire == Wire::hid && (profile.empty() || meansPid()); }
};

DeviceRequest readRequest (const Json& description, Messages& messages)
{
    ObjectReader in (description, "", messages);
    for (const auto* key : { "driver", "about", "ui" })
        in.ignore (key);
    DeviceRequest wanted;
    wanted.wire = wireOf (description);
    if (wanted.wire != Wire::hid)
    {
        in.require ("profile", "write \"profile\": the id of the device's profile, because nothing else tells which device is at the other end");
        in.require ("port", wanted.wire == Wire::serial ? "write \"port\": \"/dev/ttyACM0\"" : "write \"port\": \"192.168.4.1:9750\"");
        wanted.port = in.text ("port");
        if (wanted.wire == Wire::udp && ! wanted.port.empty())
            if (const auto address = WireFile::checkUdp (wanted.port); ! address)
                messages.push_back (Message::error ("hid/address", "/port", address.error().text, address.error().remedy));
    }
    wanted.profile = in.text ("profile");
    if (wanted.wire == Wire::hid) wanted.serial = in.text ("serial");
    in.ignore ("guard");   // checked once the device is known, because its buttons are not known earlier
    in.ignore ("calibration");
    in.finish();
    if (wanted.profile == "auto") wanted.profile.clear();
    wanted.calibration = readCalibration (description, messages);
    if (wanted.calibration && ! wanted.mayMeanPid())
        messages.push_back (Message::error ("hid/calibration", "/calibration",
                                            "the profile " + quote (wanted.profile) + " already specifies how strong the device is",
                                            "leave the calibration out, or write \"profile\": \"pid\""));
    return wanted;
}

GuardLimits readGuard (const Json& description, const DeviceLayout& layout, Messages& messages)
{
    const auto guard = description.find ("guard");
    return guard == description.end() ? GuardLimits {} : readGuardLimits (*guard, "/guard", messages, layout);
}

std::shared_ptr<const Profile> findProfile (const std::string& id, const LoadedProfiles& all, Messages& messages)
{
    if (auto found = profileNamed (all, id)) return found;

    // The profile's file may exist but contain an error, or the folder may not be used.
    const auto broken = std::ranges::find_if (all.messages, [&] (const Message& m) {
        return m.severity == Message::Severity::error && std::filesystem::path (m.file).stem() == id;
    });
    const auto unused = std::ranges::find (all.messages, ownProfileFolder().string(), &Message::file);
    std::vector<std::string> names { "auto", std::string (pid_profile) };
    for (const auto& p : all.profiles)
        names.push_back (p->id);
    if (broken != all.messages.end())
        messages.push_back (Message::error ("hid/unknown_profile", "/profile",
                                            "the profile " + quote (id) + " has an error: " + broken->file + broken->where + ": " + broken->text,
                                            broken->remedy));
    else if (unused != all.messages.end())
        messages.push_back (Message::error ("hid/unknown_profile", "/profile",
                                            "there is no device profile " + quote (id) + "; " + unused->file + ": " + unused->text, unused->remedy));
    else
        messages.push_back (Message::error ("hid/unknown_profile", "/profile", "there is no device profile " + quote (id), suggestion (id, names)));
    return nullptr;
}

std::string driverOf (const Json& description)
{
    if (! description.is_object()) return {};
    const auto driver = description.find ("driver");
    return driver != description.end() && driver->is_string() ? driver->get<std::string>() : std::string();
}

/// Says that the profile cannot be used over this wire, if so.
void checkWire (const DeviceRequest& wanted, const Profile& profile, Messages& messages)
{
    if ((wanted.wire != Wire::serial || profile.wires.serial) && (wanted.wire != Wire::udp || profile.wires.udp)) return;
    const std::string name = wanted.wire == Wire::serial ? "serial" : "udp";
    messages.push_back (Message::error ("hid/wire", "/driver", "the profile " + quote (profile.id) + " has no wire " + quote (name),
                                        "add \"wires\": {\"" + name + "\": …} to the profile, if the device really has this wire"));
}

std::string namesOf (const std::vector<ConnectedDevice>& devices)
{
    std::string names;
    for (const auto& d : devices)
        addToList (names, (d.product.empty() ? "a device without a name" : d.product) + (d.serial.empty() ? "" : " (serial " + d.serial + ")")
                              + " at " + d.path);
    return names;
}

struct Match
{
    ConnectedDevice device;
    std::shared_ptr<const Profile> profile;
    int fit = 0;
};
}   // namespace

bool isHid (const Json& description) { return driverOf (description) == "hid" || wireOf (description) != Wire::hid; }

Wire wireOf (const Json& description)
{
    const auto driver = driverOf (description);
    if (driver == "serial") return Wire::serial;
    return driver == "udp" ? Wire::udp : Wire::hid;
}

bool isThere (const Json& description)
{
    if (wireOf (description) != Wire::serial) return true;
    const auto port = description.find ("port");
    return port != description.end() && port->is_string() && WireFile::isThere (port->asString());
}

std::vector<ConnectedDevice> eachOnce (const std::vector<ConnectedDevice>& listed, const LoadedProfiles& all)
{
    const auto bestFit = [&] (const ConnectedDevice& device) {
        int best = 0;
        for (const auto& profile : all.profiles)
            best = std::max (best, fit (*profile, device));
        return best;
    };
    std::vector<ConnectedDevice> once;
    for (const auto& device : listed)
    {
        const auto same = std::ranges::find (once, device.path, &ConnectedDevice::path);
        if (same == once.end())
            once.push_back (device);
        else if (bestFit (device) > bestFit (*same))
            *same = device;
    }
    return once;
}

FoundDevice findDevice (const Json& description, HidSystem& system, const LoadedProfiles& all)
{
    FoundDevice found;
    const auto wanted = readRequest (description, found.messages);
    const auto named = wanted.mayMeanPid() ? nullptr : findProfile (wanted.profile, all, found.messages);
    if (hasErrors (found.messages)) return found;

    const auto refuse = [&] (const char* id, std::string text, std::string remedy) {
        found.messages.push_back (Message::error (id, "", std::move (text), std::move (remedy)));
        return found;
    };

    const auto warnOf = [&] (const Profile& profile) {
        for (const auto& m : all.messages)
            if (! profile.file.empty() && m.file == profile.file && m.severity == Message::Severity::warning)
                found.messages.push_back (Message::warning (m.id, "", m.file + m.where + ": " + m.text, m.remedy));
    };

    if (named && isNumbersOnly (*named))
        return refuse ("hid/numbers_only", "Tactus cannot open a " + named->name + ": its profile holds only numbers",
                       "to simulate the device, write --device ROLE=" + named->id);
    if (wanted.wire != Wire::hid)
    {
        checkWire (wanted, *named, found.messages);
        if (hasErrors (found.messages)) return found;
        if (! isThere (description))
            return refuse ("hid/not_connected", "there is no port " + quote (wanted.port),
                           "plug the device in, and look for its port with: tactus devices");
        found.device.wire = wanted.wire;
        found.device.path = wanted.wire == Wire::serial ? lastingNameOf (wanted.port) : wanted.port;
        found.device.product = named->name;
        found.profile = named;
        warnOf (*named);
        return found;
    }

    const auto connected = eachOnce (system.connected(), all);
    std::vector<Match> matches;
    for (const auto& device : connected)
    {
        if (! wanted.serial.empty() && device.serial != wanted.serial) continue;
        const auto fitting = wanted.meansPid() ? std::vector<std::shared_ptr<const Profile>> {} : matching (all.profiles, device);
        auto profile = named;
        if (! profile && ! fitting.empty()) profile = fitting.front();
        if (const int how = profile ? fit (*profile, device) : 0; how > 0)
            matches.push_back ({ device, profile, how });
        else if (wanted.mayMeanPid() && hasForceFeedback (system, device))
            matches.push_back ({ device, nullptr, 1 });   // any profile that fits the device is more specific
    }
    if (matches.empty())
    {
        std::string what = named ? "no " + named->name + " is connected" : "no connected device matches any profile";
        if (wanted.meansPid()) what = "no device with force feedback is connected";
        const auto there = connected.empty() ? "no HID device is connected" : "connected: " + namesOf (connected);
        return refuse ("hid/not_connected", what + (wanted.serial.empty() ? "" : " with serial number " + wanted.serial),
                       "plug it in; " + there + " (see `tactus devices`). A board on a serial line is named with its port: serial:PROFILE@/dev/ttyACM0");
    }

    // One device may appear several times, with interfaces that fit more or less well. Equal serial numbers mean one device.
    std::ranges::stable_sort (matches, std::ranges::greater {}, &Match::fit);
    std::vector<ConnectedDevice> best;
    for (const auto& m : matches)
        if (m.fit == matches.front().fit) best.push_back (m.device);
    const auto& serial = best.front().serial;
    const bool is_one = best.size() == 1 || (! serial.empty() && std::ranges::all_of (best, [&] (const auto& d) { return d.serial == serial; }));
    if (! is_one)
        return refuse ("hid/several", "several devices fit: " + namesOf (best), "select one by its \"serial\"; if they have none, unplug all but one");

    found.device = std::move (matches.front().device);
    const auto& profile = matches.front().profile;
    if (profile && wanted.calibration)
        return refuse ("hid/calibration", "the profile " + profile->id + " already specifies how strong " + found.device.product + " is",
                       "leave the calibration out, or write \"profile\": \"pid\"");
    found.profile = profile ? profile : profileOf (system, found.device, wanted.calibration, found.messages);
    if (profile) warnOf (*profile);
    return found;
}

GuardLimits limitsOf (const Profile& profile, const GuardLimits& session)
{
    auto limits = profile.limits.guard;
    if (! profile.outputs.empty())
    {
        if (limits.ramp == 0.0) limits.ramp = default_ramp;
        if (limits.watchdog == GuardLimits::none) limits.watchdog = GuardLimits::default_watchdog;
    }
    return tightest (limits, session);
}

MadeDevice openDevice (const Json& description, const std::filesystem::path& folder, HidSystem& system, const LoadedProfiles& all)
{
    if (! isHid (description)) return makeDevice (description, folder);

    MadeDevice made;
    auto found = findDevice (description, system, all);
    made.messages = std::move (found.messages);
    if (! found.profile) return made;

    made.limits = limitsOf (*found.profile, readGuard (description, layoutOf (HidModel (found.profile)), made.messages));
    if (hasErrors (made.messages)) return made;
    auto opened = HidPort::open (system, found.device, found.profile);
    if (! opened)
    {
        made.messages.push_back (std::move (opened).error());
        made.messages.back().where.clear();
        return made;
    }
    made.about = found.profile->name + " at " + found.device.path + ".";
    made.device = std::make_unique<HidDevice> (std::move (*opened));
    return made;
}

Messages checkDevice (const Json& description, const std::filesystem::path& folder, const LoadedProfiles& all)
{
    if (! isHid (description)) return makeDevice (description, folder).messages;
    Messages messages;
    const auto wanted = readRequest (description, messages);
    const auto profile = wanted.mayMeanPid() || (wanted.wire != Wire::hid && wanted.profile.empty()) ? nullptr : findProfile (wanted.profile, all, messages);
    if (profile) checkWire (wanted, *profile, messages);
    readGuard (description, profile ? layoutOf (HidModel (profile)) : DeviceLayout {}, messages);
    if (! profile)   // any device, with any buttons, may be connected later
        std::erase_if (messages, [] (const Message& m) { return m.id == "device/unknown_button"; });
    return messages;
}

}   // namespace tactus::host::hid
