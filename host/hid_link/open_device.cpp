// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/devices/fields.hpp>
#include <host/devices/guard_limits.hpp>
#include <host/devices/problem.hpp>
#include <host/hid_link/force_feedback.hpp>
#include <host/hid_link/hid_device.hpp>
#include <host/hid_link/open_device.hpp>

#include <framework/in_quotes.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host::hid
{
namespace
{
// For a profile that takes efforts and does not say.
constexpr double usual_ramp = 0.2;       // s
constexpr double usual_watchdog = 0.1;   // s

struct Wanted
{
    std::string profile, serial;   // "": any
    std::optional<PidCalibration> calibration {};

    bool meansPid() const { return profile == pid_profile; }
    bool mayMeanPid() const { return profile.empty() || meansPid(); }
};

Wanted readWanted (const Json& description, Messages& messages)
{
    Fields in (description, "", messages);
    for (const auto* key : { "driver", "about", "ui" })
        in.ignore (key);
    Wanted wanted;
    wanted.profile = in.text ("profile");
    wanted.serial = in.text ("serial");
    in.ignore ("guard");   // whose buttons only the device knows
    in.ignore ("calibration");
    in.finish();
    if (wanted.profile == "auto") wanted.profile.clear();
    wanted.calibration = readCalibration (description, messages);
    if (wanted.calibration && ! wanted.mayMeanPid())
        messages.push_back (problem ("hid/calibration", "/calibration", "the profile " + inQuotes (wanted.profile) + " says how strong the device is", "leave the calibration out, or write \"profile\": \"pid\""));
    return wanted;
}

GuardLimits readGuard (const Json& description, const DeviceLayout& layout, Messages& messages)
{
    const auto guard = description.find ("guard");
    return guard == description.end() ? GuardLimits {} : readGuardLimits (*guard, "/guard", messages, layout);
}

std::shared_ptr<const Profile> profileNamed (const std::string& id, const LoadedProfiles& all, Messages& messages)
{
    const auto it = std::ranges::find (all.profiles, id, [] (const auto& p)
                                       { return p->id; });
    if (it != all.profiles.end()) return *it;

    // Perhaps it is there and cannot be read.
    const auto broken = std::ranges::find_if (all.messages, [&] (const Message& m)
                                              { return m.severity == Message::Severity::error && std::filesystem::path (m.file).stem() == id; });
    std::vector<std::string> names { "auto", std::string (pid_profile) };
    for (const auto& p : all.profiles)
        names.push_back (p->id);
    if (broken != all.messages.end())
        messages.push_back (problem ("hid/unknown_profile", "/profile", "the profile " + inQuotes (id) + " has an error: " + broken->file + broken->where + ": " + broken->text, broken->remedy));
    else
        messages.push_back (problem ("hid/unknown_profile", "/profile", "there is no device profile " + inQuotes (id), suggestion (id, names)));
    return nullptr;
}

std::string namesOf (const std::vector<ConnectedDevice>& devices)
{
    std::string names;
    for (const auto& d : devices)
        names += (names.empty() ? "" : ", ") + (d.product.empty() ? "a device without a name" : d.product) + (d.serial.empty() ? "" : " (serial " + d.serial + ")") + " at " + d.path;
    return names;
}

struct Match
{
    ConnectedDevice device;
    std::shared_ptr<const Profile> profile;
    int fit = 0;
};
}   // namespace

bool isHid (const Json& description)
{
    if (! description.is_object()) return false;
    const auto driver = description.find ("driver");
    return driver != description.end() && *driver == "hid";
}

std::vector<ConnectedDevice> eachOnce (const std::vector<ConnectedDevice>& listed, const LoadedProfiles& all)
{
    const auto bestFit = [&] (const ConnectedDevice& device)
    {
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
    const auto wanted = readWanted (description, found.messages);
    const auto named = wanted.mayMeanPid() ? nullptr : profileNamed (wanted.profile, all, found.messages);
    if (hasErrors (found.messages)) return found;

    const auto refuse = [&] (const char* id, std::string text, std::string remedy)
    {
        found.messages.push_back (problem (id, "", std::move (text), std::move (remedy)));
        return found;
    };

    const auto connected = eachOnce (system.connected(), all);
    std::vector<Match> matches;
    for (const auto& device : connected)
    {
        if (! wanted.serial.empty() && device.serial != wanted.serial) continue;
        const auto fitting = wanted.meansPid() ? std::vector<std::shared_ptr<const Profile>> {} : matching (all.profiles, device);
        const auto profile = named ? named : fitting.empty() ? nullptr
                                                             : fitting.front();
        if (const int how = profile ? fit (*profile, device) : 0; how > 0)
            matches.push_back ({ device, profile, how });
        else if (wanted.mayMeanPid() && hasForceFeedback (system, device))
            matches.push_back ({ device, nullptr, 1 });   // any profile that knows the device says more
    }
    if (matches.empty())
    {
        const auto what = wanted.meansPid() ? std::string ("no device with force feedback is connected") : named ? "no " + named->name + " is connected"
                                                                                                                 : std::string ("no device is connected that a profile fits");
        const auto there = connected.empty() ? "there is no HID device at all" : "there are: " + namesOf (connected);
        return refuse ("hid/not_connected", what + (wanted.serial.empty() ? "" : " with serial number " + wanted.serial), "plug it in; " + there + " (see `tactus devices`)");
    }

    // One device may appear several times, with interfaces that fit more or less; its serial number says that it is one.
    std::ranges::stable_sort (matches, std::ranges::greater {}, &Match::fit);
    std::vector<ConnectedDevice> best;
    for (const auto& m : matches)
        if (m.fit == matches.front().fit) best.push_back (m.device);
    const auto& serial = best.front().serial;
    const bool is_one = best.size() == 1 || (! serial.empty() && std::ranges::all_of (best, [&] (const auto& d)
                                                                                      { return d.serial == serial; }));
    if (! is_one) return refuse ("hid/several", "several devices would do: " + namesOf (best), "say which by \"serial\"; of those that have none, unplug all but one");

    found.device = std::move (matches.front().device);
    const auto& profile = matches.front().profile;
    if (profile && wanted.calibration)
        return refuse ("hid/calibration", "the profile " + profile->id + " says how strong " + found.device.product + " is", "leave the calibration out, or write \"profile\": \"pid\"");
    found.profile = profile ? profile : profileOf (system, found.device, wanted.calibration, found.messages);
    return found;
}

GuardLimits limitsOf (const Profile& profile, const GuardLimits& session)
{
    auto limits = profile.limits.guard;
    if (! profile.outputs.empty())
    {
        if (limits.ramp == 0.0) limits.ramp = usual_ramp;
        if (limits.watchdog == GuardLimits::none) limits.watchdog = usual_watchdog;
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
    if (auto* message = std::get_if<Message> (&opened))
    {
        message->where.clear();
        made.messages.push_back (std::move (*message));
        return made;
    }
    made.about = found.profile->name + " at " + found.device.path + ".";
    made.device = std::make_unique<HidDevice> (std::move (std::get<std::unique_ptr<HidPort>> (opened)));
    return made;
}

Messages checkDevice (const Json& description, const std::filesystem::path& folder, const LoadedProfiles& all)
{
    if (! isHid (description)) return makeDevice (description, folder).messages;
    Messages messages;
    const auto wanted = readWanted (description, messages);
    const auto profile = wanted.mayMeanPid() ? nullptr : profileNamed (wanted.profile, all, messages);
    readGuard (description, profile ? layoutOf (HidModel (profile)) : DeviceLayout {}, messages);
    if (! profile)   // any device may come, with any buttons
        std::erase_if (messages, [] (const Message& m)
                       { return m.id == "device/unknown_button"; });
    return messages;
}

}   // namespace tactus::host::hid
