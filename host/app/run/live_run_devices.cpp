// SPDX-License-Identifier: GPL-3.0-or-later
// The tool of a live run: which hand moves it.
#include "device_profiles.hpp"
#include "device_setup.hpp"
#include "live_run.hpp"

#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/sessions/binding.hpp>
#include <host/devices/sessions/role_fits.hpp>
#include <tactus/run/device/gesture_device.hpp>
#include <tactus/run/device/trace.hpp>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace tactus::host
{

namespace
{
/// In m. The pointer starts this far above the origin, so that a run does not start inside an object.
constexpr double hover = 5e-3;

// For a hand that the graph does not describe.
constexpr double usual_stiffness = 400.0, usual_damping = 4.0;   // N/m, N s/m

/// True if the graph reads where the tool is.
bool isRead (const DeviceParts& parts) { return parts.position || parts.rotation || parts.truth; }

/// True if it has axes or motors that move it.
bool isMoved (const DeviceParts& parts) { return parts.force || parts.torque || ! parts.others.axes.empty() || ! parts.others.efforts.empty(); }
}   // namespace

/// The role whose tool is drawn and heard, and that the mouse can move. The user may have chosen it. Otherwise a role whose place the graph reads comes
/// first, then one with axes or motors, and not one that only shakes; of equals the one of the run so far, so that a new role does not take the hand away.
std::string LiveRun::handRoleOf (const std::vector<RoleNeeds>& roles) const
{
    const bool is_same_graph = hand_of == document.identity();
    const auto rank = [&] (const RoleNeeds& r) {
        const bool is_chosen = is_same_graph && r.role == chosen_role, is_kept = is_same_graph && r.role == hand_role;
        return std::tuple (is_chosen, isRead (r.parts), isMoved (r.parts), is_kept);
    };
    const RoleNeeds* hand = nullptr;
    for (const auto& r : roles)
        if (! isSoundCard (r.role) && (hand == nullptr || rank (r) > rank (*hand))) hand = &r;
    return hand == nullptr ? std::string {} : hand->role;
}

/// Call while nothing runs.
void LiveRun::setHandRole()
{
    hand_role = handRoleOf (needed);
    if (std::exchange (hand_of, document.identity()) != document.identity()) chosen_role.clear();
}

std::vector<std::string> LiveRun::toolRoles() const
{
    std::vector<std::string> all;
    for (const auto& [role, parts] : needed)
        if (isRead (parts) && ! isSoundCard (role)) all.push_back (role);
    return all;
}

/// A sound card and a vibration motor have no place.
bool LiveRun::hasPlace (const std::string& role) const
{
    const auto found = std::ranges::find (needed, role, &RoleNeeds::role);
    return ! isSoundCard (role) && (found == needed.end() || isRead (found->parts) || isMoved (found->parts));
}

bool LiveRun::isSoundCard (const std::string& role) const
{
    const auto* bound = setup != nullptr ? setup->session().session.binding (role) : nullptr;
    const auto* description = bound != nullptr ? bound : document.graph().device (role);
    return description != nullptr && audio::isAudio (*description);
}

bool LiveRun::isMovedOtherwise (const std::string& role) const { return role == hand_role && moved_by.kind != Hand::Kind::described; }

/// True if a role is bound to a driver of a plugin and got no device. Such a device cannot be waited for, unlike a HID device with a profile: its parts
/// and its limits are known only when it is open.
bool LiveRun::lacksPluginDevice() const
{
    const auto& opened = session->run().devices();
    return std::ranges::any_of (session->engine().newest().roles(), [&] (const auto& role) {
        const auto* bound = isMovedOtherwise (role.name) ? nullptr : run_session.binding (role.name);
        return bound != nullptr && namesPlugin (*bound) && std::ranges::none_of (opened, [&] (const auto& d) { return d.first == role.name; });
    });
}

/// True if the session binds the role to a device with a place, and this device moves the tool.
bool LiveRun::isBound (const std::string& role) const
{
    const auto* bound = setup != nullptr ? setup->session().session.binding (role) : nullptr;
    return bound != nullptr && ! audio::isAudio (*bound) && ! isMovedOtherwise (role);
}

WorkspaceDevice* LiveRun::workspaceDevice (const std::string& role) const
{
    if (! isRunning()) return nullptr;
    for (const auto& [name, opened] : session->run().devices())
        if (name == role) return dynamic_cast<WorkspaceDevice*> (opened.device.get());
    return nullptr;
}

std::optional<Workspace> LiveRun::workspaceOf (const std::string& role) const
{
    if (! isBound (role)) return std::nullopt;
    auto workspace = bindingOf (setup->session(), role)->workspace;
    if (const auto* device = workspaceDevice (role)) workspace.offset = device->origin();
    return workspace;
}

bool LiveRun::holdWorkspace (bool is_held)
{
    auto* device = is_held && ! isBound (hand_role) ? nullptr : workspaceDevice (hand_role);
    if (device != nullptr) device->hold (is_held);
    return device != nullptr;
}

bool LiveRun::wouldGetOtherDevices() const
{
    if (setup == nullptr) return false;
    const auto &before = run_session, &now = setup->session().session;
    const auto differs = [] (const Json* a, const Json* b) { return (a == nullptr) != (b == nullptr) || (a != nullptr && *a != *b); };
    return now.clock() != before.clock() || differs (before.audio(), now.audio()) || std::ranges::any_of (needed, [&] (const RoleNeeds& r) {
               return ! isMovedOtherwise (r.role) && differs (before.binding (r.role), now.binding (r.role));
           });
}

/// Moves the devices whose offset is all that differs between the session of the run and this one. False if more differs, so that the run has to begin
/// again. Also false if the run has other roles: their nodes may see the position of this tool jump, and only the guard of the moved role knows.
bool LiveRun::moveWorkspaces (const DeviceSession& now)
{
    const auto withoutOffset = [] (const Json* binding) {
        auto rest = binding != nullptr ? *binding : Json();
        if (rest.is_object() && rest.contains ("workspace") && rest["workspace"].is_object())
        {
            rest["workspace"].erase ("offset");
            if (rest["workspace"].empty()) rest.erase ("workspace");
        }
        return rest;
    };
    std::vector<std::pair<WorkspaceDevice*, Vec3>> moves;
    for (const auto& role : session->engine().newest().roles())
    {
        const auto *before = run_session.binding (role.name), *after = now.binding (role.name);
        if (before == after || (before != nullptr && after != nullptr && *before == *after)) continue;
        auto* device = workspaceDevice (role.name);
        if (device == nullptr || after == nullptr || ! isBound (role.name) || withoutOffset (before) != withoutOffset (after)) return false;
        const auto binding = bindingOf (setup->session(), role.name);
        if (hasErrors (binding->messages)) return false;
        moves.emplace_back (device, binding->workspace.offset);
    }
    if (! moves.empty() && session->engine().newest().roles().size() > 1) return false;
    for (const auto& [device, offset] : moves)
        device->moveTo (offset);
    return true;
}

/// Puts the chosen hand on its tool, and lets a workspace be moved.
void LiveRun::adopt (const std::string& role, Run::RoleDevice& opened, const Workspace& in, Messages& messages)
{
    if (role == hand_role) adoptHand (opened, in, messages);
    if (opened.device && isBound (role)) makeMovable (opened);
}

void LiveRun::adoptHand (Run::RoleDevice& opened, const Workspace& in, Messages& messages)
{
    const auto& role = hand_role;
    auto& driver = opened.driver != nullptr ? *opened.driver : *opened.device;
    const auto* simulated = dynamic_cast<const SimulatedDevice*> (&driver);
    hand_damping = simulated != nullptr ? simulated->simulation().damping : 0.0;
    hand_delay = simulated != nullptr ? static_cast<double> (simulated->simulation().delay) : 0.0;
    if (const auto real = realDevice (role, driver))
    {
        hand_damping = real->profile().limits.device_damping / in.scale;
        if (const auto& ticks = real->profile().physics.delay) hand_delay = ticks->value;
    }
    if (const auto plugin = pluginRole (role, driver)) hand_damping = plugin->device->about().layout.mechanics.damping / in.scale;
    if (held_at && (! in.isPlain() || ! isFinite (held_at->tool))) held_at->tool = held_at->hand;   // the hand is in the coordinates of the device
    auto hand = chosenHand (simulated, hand_damping, messages);
    if (! hand) return;
    opened.driver = hand.get();
    if (in.isPlain())
        opened.device = std::move (hand);
    else
        opened.device = std::make_unique<WorkspaceDevice> (std::move (hand), in);
}

/// The simulated tool of the hand's role, held by the chosen hand; null if the described device should be used.
std::unique_ptr<Device> LiveRun::chosenHand (const SimulatedDevice* described, double& damping, Messages& messages)
{
    auto what = described != nullptr ? described->simulation() : Simulation {};
    if (what.hand.stiffness == 0.0) what.hand = { usual_stiffness, usual_damping, nullptr };
    switch (moved_by.kind)
    {
    case Hand::Kind::described:
        if (described == nullptr || ! what.hand.path) return nullptr;
        what.hand.path = transported = std::make_shared<TransportPath> (what.hand.path);
        break;
    case Hand::Kind::pointer:
        what.position = held_at ? held_at->tool : Vec3 (0.0, 0.0, hover);
        what.velocity.setZero();
        what.hand_force.setZero();
        what.hand.path = pointer = std::make_shared<PointerPath> (held_at ? held_at->hand : what.position);
        break;
    case Hand::Kind::path:
    {
        auto made = makeDevice ({ { "driver", "sim" }, { "hand", { { "path", moved_by.path } } } }, document.graph().folder);
        std::ranges::move (made.messages, std::back_inserter (messages));
        const auto* chosen = dynamic_cast<SimulatedDevice*> (made.device.get());
        if (chosen == nullptr) return nullptr;
        what.hand.path = transported = std::make_shared<TransportPath> (chosen->simulation().hand.path);
        if (findGesture (moved_by.path) == nullptr)   // a recording: the tool goes exactly where it was, so that it is felt as it was recorded
        {
            what.hand.stiffness = std::numeric_limits<double>::infinity();
            what.quantum = 0.0;
        }
        what.position = what.hand.path->at (0.0).position;
        what.velocity.setZero();
        break;
    }
    }
    damping = what.damping;
    return std::make_unique<SimulatedDevice> (std::move (what));
}

}   // namespace tactus::host
