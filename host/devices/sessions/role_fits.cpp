// SPDX-License-Identifier: MIT
#include "role_fits.hpp"

#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/hid_link/force_feedback.hpp>
#include <host/devices/sessions/check_audio.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
std::string textAt (const Json& object, const char* key)
{
    if (! object.is_object()) return {};
    const auto found = object.find (key);
    return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// The profile of a device, if the device matches the description; else null.
std::shared_ptr<const hid::Profile> profileFor (const Json& description, const hid::ConnectedDevice& device, const hid::LoadedProfiles& all)
{
    const auto serial = textAt (description, "serial"), wanted = textAt (description, "profile");
    if (! serial.empty() && device.serial != serial) return nullptr;
    if (wanted.empty() || wanted == "auto")
    {
        const auto fitting = hid::matching (all.profiles, device);
        return fitting.empty() ? nullptr : fitting.front();
    }
    const auto profile = hid::profileNamed (all, wanted);
    return profile && hid::fit (*profile, device) > 0 ? profile : nullptr;
}
}   // namespace

std::string nameOf (const Json& description)
{
    auto name = textAt (description, "driver");
    for (const auto* key : { "profile", "path", "port" })
        if (const auto text = textAt (description, key); ! text.empty()) name += " " + text;
    if (description.is_object() && name == "sim" && description.contains ("hand"))
        if (const auto path = textAt (description["hand"], "path"); ! path.empty()) name += " with a hand that follows " + path;
    if (const auto serial = textAt (description, "serial"); ! serial.empty()) name += ", serial " + serial;
    return name.empty() ? "nothing" : name;
}

bool namesPlugin (const Json& description)
{
    const auto driver = textAt (description, "driver");
    return ! driver.empty() && ! isBuiltInDriver (driver);
}

std::optional<bool> isConnected (const Json& description, std::span<const hid::ConnectedDevice> connected, const hid::LoadedProfiles& all)
{
    if (hid::wireOf (description) != hid::Wire::hid) return hid::isThere (description) ? std::nullopt : std::optional (false);
    return std::ranges::any_of (connected, [&] (const auto& device) { return profileFor (description, device, all) != nullptr; });
}

Messages checkDescription (const Json& description, const std::filesystem::path& folder, const hid::LoadedProfiles& all)
{
    if (isPluginDevice (description)) return checkPluginDevice (description);
    return audio::isAudio (description) ? audio::checkAudio (description) : hid::checkDevice (description, folder, all);
}

Messages checkBinding (const Json& binding, const std::filesystem::path& folder, const hid::LoadedProfiles& all)
{
    Messages messages;
    auto description = binding;
    if (description.is_object())
        if (const auto w = description.find ("workspace"); w != description.end())
        {
            readWorkspace (*w, "/workspace", messages);
            description.erase ("workspace");
        }
    auto more = checkDescription (description, folder, all);
    std::ranges::move (more, std::back_inserter (messages));
    return messages;
}

std::vector<RoleFit> fitsOf (const std::vector<RoleNeeds>& all_needs, const graph::Graph& g, const LoadedSession& session, const hid::LoadedProfiles& all,
                             std::span<const hid::ConnectedDevice> connected)
{
    std::vector<RoleFit> fits;
    for (const auto& [role, needs] : all_needs)
    {
        auto& fit = fits.emplace_back (RoleFit { .role = role, .needs = needs });
        std::filesystem::path folder = g.folder;
        fit.description = { { "driver", "sim" } };
        if (auto bound = bindingOf (session, role))
        {
            fit.from = RoleFit::From::session;
            fit.description = std::move (bound->description);
            fit.workspace = bound->workspace;
            fit.messages = std::move (bound->messages);
            folder = bound->folder;
        }
        else if (const auto* described = g.device (role))
        {
            fit.from = isSimulated (*described) ? RoleFit::From::graph : RoleFit::From::none;
            fit.description = describedByGraph (described, role, fit.messages);
            for (auto& m : fit.messages)
                m.where.clear();   // it is about the whole description
        }

        // A graph chooses no driver, so none is loaded for what it describes.
        Messages wrong;
        if (fit.from != RoleFit::From::session)
            wrong = makeDevice (fit.description, folder).messages;
        else if (! isPluginDevice (fit.description))
            wrong = checkDescription (fit.description, folder, all);
        std::ranges::move (wrong, std::back_inserter (fit.messages));
        fit.there = partsOf (fit.description, folder, all);
        if (hid::isHid (fit.description))
        {
            if (const auto profile = hid::profileNamed (all, textAt (fit.description, "profile")))
            {
                if (fit.needs.position) fit.along = movesAlong (*profile, fit.workspace.axes);
                if (fit.needs.force) fit.pushes = pushesAlong (*profile, fit.workspace.axes);
            }
            if (textAt (fit.description, "profile") != hid::pid_profile) fit.connected = isConnected (fit.description, connected, all);
            if (! fit.there)
                for (const auto& device : connected)
                    if (const auto profile = profileFor (fit.description, device, all)) fit.there = partsOf (*profile);
        }
        if (! fit.there) continue;
        fit.lacking = lackingOf (fit.needs, *fit.there);
        if (auto clutch = wrongClutch (fit.workspace, fit.there->others)) fit.messages.push_back (std::move (*clutch));
    }
    return fits;
}

}   // namespace tactus::host
