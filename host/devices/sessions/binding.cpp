// SPDX-License-Identifier: MIT
#include "binding.hpp"
#include "awaited_device.hpp"

#include <host/devices/sessions/audio_settings.hpp>
#include <tactus/run/device/guard_limits.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace tactus::host
{

namespace
{
/// True for errors that go away when the user plugs in the device, closes the other program or installs the udev rule.
bool isOfTheMoment (const Message& m)
{
    constexpr std::string_view ids[] { "hid/not_connected", "hid/several", "hid/not_permitted", "hid/not_opened", "hid/init" };
    return std::ranges::find (ids, m.id) != std::end (ids);
}

std::shared_ptr<const hid::Profile> profileOf (const Json& description, const hid::LoadedProfiles& all)
{
    const auto name = description.find ("profile");
    return name != description.end() && name->is_string() ? hid::profileNamed (all, name->asString()) : nullptr;
}

/// Makes a device that waits for the real one, if that is possible.
std::unique_ptr<AwaitedDevice> await (const Json& description, hid::HidSystem& system, const hid::LoadedProfiles& all, MadeDevice& made)
{
    const auto isError = [] (const Message& m) { return m.severity == Message::Severity::error; };
    if (! hid::isHid (description) || std::ranges::any_of (made.messages, [&] (const Message& m) { return isError (m) && ! isOfTheMoment (m); }))
        return nullptr;
    auto profile = profileOf (description, all);
    if (! profile) return nullptr;

    for (auto& m : made.messages)
        if (isError (m))
        {
            m.severity = Message::Severity::warning;
            m.text += ", so the role gets no force until the device is available";
        }
    GuardLimits session;
    if (const auto guard = description.find ("guard"); guard != description.end())
        session = readGuardLimits (*guard, "/guard", made.messages, hid::layoutOf (hid::HidModel (profile)));
    made.limits = hid::limitsOf (*profile, session);
    if (hasErrors (made.messages)) return nullptr;
    made.about = profile->name + ", once it is available.";
    return std::make_unique<AwaitedDevice> (description, std::move (profile), system);
}
}   // namespace

std::optional<RoleBinding> bindingOf (const LoadedSession& s, std::string_view role)
{
    const auto* bound = s.session.binding (role);
    if (bound == nullptr) return std::nullopt;
    RoleBinding b { *bound, {}, s.file.parent_path(), {} };
    if (const auto w = b.description.find ("workspace"); w != b.description.end())
    {
        b.workspace = readWorkspace (*w, "/workspace", b.messages);
        b.description.erase ("workspace");
    }
    return b;
}

Json rebound (const Json* before, Json description)
{
    if (before == nullptr || ! before->is_object() || audio::isAudio (*before) || audio::isAudio (description)) return description;
    for (const auto* key : { "guard", "workspace" })
        if (const auto kept = before->find (key); kept != before->end() && ! description.contains (key)) description[key] = *kept;
    return description;
}

BoundDevice openBound (const LoadedSession& s, std::string_view role, const RoleBinding& b, const OpenDevice& open, hid::HidSystem& system,
                       const hid::LoadedProfiles& all, Absence absence)
{
    BoundDevice bound;
    const bool may_open = ! hasErrors (b.messages);
    auto made = ! may_open ? MadeDevice {} : open (b.description, b.folder);
    if (may_open && ! made.device && absence == Absence::waits) made.device = await (b.description, system, all, made);

    bound.messages = b.messages;
    std::ranges::move (made.messages, std::back_inserter (bound.messages));
    if (made.device)
        if (auto wrong = wrongClutch (b.workspace, made.device->layout())) bound.messages.push_back (std::move (*wrong));
    for (auto& m : bound.messages)
    {
        m.where = "/roles/" + std::string (role) + m.where;
        place (m, s);
    }
    if (! made.device || hasErrors (bound.messages)) return bound;

    bound.driver = made.device.get();
    bound.device = b.workspace.isPlain() ? std::move (made.device) : std::make_unique<WorkspaceDevice> (std::move (made.device), b.workspace, made.limits);
    bound.limits = inWorkspace (made.limits, b.workspace);
    bound.about = std::move (made.about);
    return bound;
}

}   // namespace tactus::host
