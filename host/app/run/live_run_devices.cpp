// SPDX-License-Identifier: GPL-3.0-or-later
// The devices of a live run: which hand or session moves a role, and what ticks the run.
#include "device_setup.hpp"
#include "live_run.hpp"

#include <host/app/model/device_profiles.hpp>
#include <host/hid_link/open_device.hpp>
#include <host/sessions/binding.hpp>
#include <tactus/run/device/gesture_device.hpp>
#include <tactus/run/device/trace.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
/// In m. The pointer starts this far above the origin, so that a run does not start inside an object.
constexpr double hover = 5e-3;

// For a hand that the graph does not describe.
constexpr double usual_stiffness = 400.0, usual_damping = 4.0;   // N/m, N s/m
}   // namespace

bool LiveRun::isBound (const std::string& role) const { return setup != nullptr && setup->session().session.binding (role) != nullptr; }

/// The first role that is not a sound card. Its tool is the one that is drawn and heard, and that the mouse can move.
std::string LiveRun::handRoleOf (const Plan& plan) const
{
    const auto hand = std::ranges::find_if (plan.roles(), [this] (const auto& role) { return ! isSoundCard (role.name); });
    return hand == plan.roles().end() ? std::string {} : hand->name;
}

bool LiveRun::isSoundCard (const std::string& role) const
{
    const auto* description = isBound (role) ? setup->session().session.binding (role) : document.graph().device (role);
    return description != nullptr && audio::isAudio (*description);
}

/// True if the mouse, or a path that the user has chosen, moves the tool.
bool LiveRun::isMovedOtherwise (const std::string& role) const { return role == hand_role && moved_by.kind != Hand::Kind::described; }

MadeDevice LiveRun::make (const Json& description, const std::filesystem::path& folder, const std::string& role, const Plan& plan)
{
    if (audio::isAudio (description)) return audio::openAudio (audio::withChannels (description, plan, role), *rig);
    return hid::openDevice (description, folder, setup != nullptr ? setup->system() : hid::thisComputer(),
                            setup != nullptr ? setup->profiles() : deviceProfiles());
}

/// Opens the device that the session binds a role to. Returns none, with a message, if it cannot be opened.
Run::RoleDevice LiveRun::openBySession (const std::string& role, const Plan& plan, Messages& messages)
{
    const auto& session = setup->session();
    const auto openOne = [&] (const Json& description, const std::filesystem::path& folder) { return make (description, folder, role, plan); };
    const auto binding = bindingOf (session, role);
    auto bound = openBound (session, role, *binding, openOne, setup->system(), setup->profiles(), Absence::waits);
    std::ranges::move (bound.messages, std::back_inserter (messages));
    if (! bound.device) return {};

    Run::RoleDevice opened { std::move (bound.device), bound.limits, bound.driver };
    if (role != hand_role) return opened;
    if (const auto real = realDevice (role, *opened.driver)) hand_damping = real->profile().limits.device_damping / binding->workspace.scale;
    const auto* simulated = dynamic_cast<const SimulatedDevice*> (opened.driver);
    if (simulated == nullptr) return opened;
    hand_damping = simulated->simulation().damping;
    if (auto hand = chosenHand (simulated, hand_damping, messages))
    {
        opened.driver = hand.get();
        if (binding->workspace.isPlain())
            opened.device = std::move (hand);
        else
            opened.device = std::make_unique<WorkspaceDevice> (std::move (hand), binding->workspace);
    }
    return opened;
}

Run::RoleDevice LiveRun::openDescribed (const std::string& role, Messages& messages)
{
    const auto* described = document.graph().device (role);
    auto made = makeDevice (describedByGraph (described, role, messages), document.graph().folder);
    for (auto& m : made.messages)
        m.where = "/devices/" + role + m.where;
    std::ranges::move (made.messages, std::back_inserter (messages));
    if (! made.device || role != hand_role) return { std::move (made.device), made.limits };

    const auto* simulated = dynamic_cast<SimulatedDevice*> (made.device.get());
    hand_damping = simulated != nullptr ? simulated->simulation().damping : 0.0;
    if (auto hand = chosenHand (simulated, hand_damping, messages)) made.device = std::move (hand);
    return { std::move (made.device), made.limits };
}

Run::RoleDevice LiveRun::open (const std::string& role, const Plan& plan, Messages& messages)
{
    return ! isMovedOtherwise (role) && isBound (role) ? openBySession (role, plan, messages) : openDescribed (role, messages);
}

/// A device that has its own clock ticks the run, as on the command line.
ClockChoice LiveRun::decideClock (const Plan& plan) const
{
    auto& system = setup != nullptr ? setup->system() : hid::thisComputer();
    const auto& profiles = setup != nullptr ? setup->profiles() : deviceProfiles();
    std::vector<Described> described;
    for (const auto& role : plan.roles())
    {
        const auto bound = setup != nullptr && ! isMovedOtherwise (role.name) ? bindingOf (setup->session(), role.name) : std::nullopt;
        described.emplace_back (role.name, bound ? bound->description : Json { { "driver", "sim" } });
    }
    const auto rateOf = [&] (const Described& d, bool may_wait) {
        const bool is_bound = setup != nullptr && setup->session().session.binding (d.first) != nullptr;
        return tickRateOf (d.second, system, profiles, may_wait && is_bound);
    };
    return chooseClock ({ {}, setup != nullptr ? setup->session().session.clock() : std::string(), {} }, described, rateOf);
}

std::vector<RealDevice> LiveRun::realDevices() const
{
    std::vector<RealDevice> all;
    if (run)
        for (const auto& [role, d] : run->devices())
            if (auto real = realDevice (role, d.driver != nullptr ? *d.driver : *d.device)) all.push_back (std::move (*real));
    return all;
}

bool LiveRun::drivesDevice() const
{
    if (! run) return false;
    const auto isReal = [] (const auto& role) {
        const auto& [name, d] = role;
        auto* driver = d.driver != nullptr ? d.driver : d.device.get();
        return dynamic_cast<SimulatedDevice*> (driver) == nullptr && dynamic_cast<GestureDevice*> (driver) == nullptr
               && dynamic_cast<TraceDevice*> (driver) == nullptr;
    };
    return audioStatus().has_value() || std::ranges::any_of (run->devices(), isReal);
}

std::unique_ptr<TickClock> LiveRun::makeClock()
{
    for (const auto& real : realDevices())
        if (real.role == clock_role)
        {
            if (real.present != nullptr) return std::make_unique<RunClock> (*real.present, run->rate());
            return std::make_unique<RunClock> (*real.awaited, run->rate());
        }
    clock_role.clear();
    return std::make_unique<AbsoluteTimer> (1.0 / run->rate());
}

/// The simulated tool of the first role, held by the chosen hand; null if the described device should be used.
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
        what.position = Vec3 (0.0, 0.0, hover);
        what.velocity.setZero();
        what.hand_force.setZero();
        what.hand.path = pointer = std::make_shared<PointerPath> (what.position);
        break;
    case Hand::Kind::path:
    {
        auto made = makeDevice ({ { "driver", "sim" }, { "hand", { { "path", moved_by.path } } } }, document.graph().folder);
        std::ranges::move (made.messages, std::back_inserter (messages));
        const auto* chosen = dynamic_cast<SimulatedDevice*> (made.device.get());
        if (chosen == nullptr) return nullptr;
        what.hand.path = transported = std::make_shared<TransportPath> (chosen->simulation().hand.path);
        what.position = what.hand.path->at (0.0).position;
        what.velocity.setZero();
        break;
    }
    }
    damping = what.damping;
    return std::make_unique<SimulatedDevice> (std::move (what));
}

}   // namespace tactus::host
