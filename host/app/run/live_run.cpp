// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_run.hpp"
#include "device_setup.hpp"

#include <framework/plan/missing_parts.hpp>
#include <framework/run/turn.hpp>
#include <framework/text/message.hpp>
#include <host/app/model/device_profiles.hpp>
#include <host/assets/nearest_by_embree.hpp>
#include <host/hid_link/open_device.hpp>
#include <host/platform/failsafe.hpp>
#include <host/platform/signals.hpp>
#include <host/sessions/binding.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
/// In m. The pointer starts this far above the origin, so that a run does not start inside an object.
constexpr double hover = 5e-3;

constexpr int looks_apart = 3;   // every third call of attend() checks the devices: ten times a second

// For a hand that the graph does not describe.
constexpr double usual_stiffness = 400.0, usual_damping = 4.0;   // N/m, N s/m

Message stopped() { return Message::error ("run/stopped", {}, "nothing is running in the window", "press START in the window"); }
}   // namespace

LiveRun::LiveRun (Document& d, const Catalogue& c, Sound* s) : document (d), catalogue (c), sound (s)
{
    document.add (*this);
    probes.onWanted = [this] {
        if (isLive()) takeOver();
    };
    documentChanged();
}

LiveRun::~LiveRun()
{
    document.remove (*this);
    end();
}

void LiveRun::use (const DeviceSetup& d) { setup = &d; }

void LiveRun::setupChanged()
{
    if (! wanted || ! isRunning() || setup == nullptr) return;
    const auto& now = setup->session().session;
    const auto differs = [&] (const auto& role) {
        const auto *before = run_session.binding (role.name), *after = now.binding (role.name);
        return before == nullptr || after == nullptr ? before != after : *before != *after;
    };
    const auto sounds = [] (const DeviceSession& s) { return s.audio() != nullptr ? *s.audio() : Json(); };
    if (now.clock() != run_session.clock() || sounds (now) != sounds (run_session) || std::ranges::any_of (run->engine().newest().roles(), differs))
        beginAnew (true);
}

bool LiveRun::isBound (const std::string& role) const { return setup != nullptr && setup->session().session.binding (role) != nullptr; }

/// The first role that is not a sound card. Its tool is the one that is drawn and heard, and that the mouse can move.
std::string LiveRun::handRoleOf (const Plan& plan) const
{
    for (const auto& role : plan.roles())
    {
        const auto* description = isBound (role.name) ? setup->session().session.binding (role.name) : document.graph().device (role.name);
        if (description == nullptr || ! audio::isAudio (*description)) return role.name;
    }
    return {};
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

Run::RoleDevice LiveRun::openDescribed (const std::string& role, const Plan& plan, Messages& messages)
{
    const auto* described = document.graph().device (role);
    auto made = make (described != nullptr ? *described : Json { { "driver", "sim" } }, document.graph().folder, role, plan);
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
    return ! isMovedOtherwise (role) && isBound (role) ? openBySession (role, plan, messages) : openDescribed (role, plan, messages);
}

/// A device that has its own clock ticks the run, as on the command line.
ClockChoice LiveRun::decideClock (const Plan& plan) const
{
    auto& system = setup != nullptr ? setup->system() : hid::thisComputer();
    const auto& profiles = setup != nullptr ? setup->profiles() : deviceProfiles();
    std::vector<Described> described;
    for (const auto& role : plan.roles())
    {
        const bool is_moved = isMovedOtherwise (role.name);
        const auto bound = setup != nullptr ? bindingOf (setup->session(), role.name) : std::nullopt;
        const auto* own = document.graph().device (role.name);
        if (! is_moved && (bound || own != nullptr))
            described.emplace_back (role.name, bound ? bound->description : *own);
        else
            described.emplace_back (role.name, Json { { "driver", "sim" } });
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

void LiveRun::start (Hand who)
{
    moved_by = std::move (who);
    beginAnew (false);
}

/// Restarts the run, for changes that cannot be applied while it runs. A latched stop stays latched unless the user starts the run.
void LiveRun::beginAnew (bool stays_stopped)
{
    held = stays_stopped && (held || isStoppedForGood());
    stop();
    begins = wanted = true;
    if (! isRunning()) begin();
}

void LiveRun::stop() noexcept
{
    begins = wanted = false;
    if (isLive()) run->live().stop();
}

void LiveRun::letGo()
{
    stop();
    end();
}

/// The sound settings from the session.
audio::AudioSettings LiveRun::audioWanted (Messages& messages) const
{
    const auto* written = setup != nullptr ? run_session.audio() : nullptr;
    if (written == nullptr) return {};
    auto settings = audio::readAudioSettings (*written, "/audio", messages);
    for (auto& m : messages)
        place (m, setup->session());
    return hasErrors (messages) ? audio::AudioSettings {} : settings;
}

/// If the sound cannot be opened, the run continues without it. The sound of the force opens the card a second time, where the
/// limits of a role cannot reach it, so it is silent if it could play on a channel that a role limits.
void LiveRun::beginSound()
{
    mutes_sound = false;
    if (! rig->isNeeded()) return rig->seal();
    for (auto& m : rig->begin (run->engine().plan(), run->rate(), &run->engine()))
    {
        m.severity = Message::Severity::warning;
        if (setup != nullptr && m.where.starts_with ("/")) place (m, setup->session());
        said.push_back (std::move (m));
    }
    mutes_sound = rig->limitsFirst (Sound::channels);
    if (mutes_sound && sound != nullptr && sound->isOn())
        said.push_back (Message::warning ("audio/force_silent", "",
                                          "the force is not played, because a role with a max_signal uses channel 1 or 2 of a sound card",
                                          "to hear the force, move the role to other channels"));
}

std::unique_ptr<Run> LiveRun::makeRun (Run::Queries queries)
{
    CompileOptions options { .assets = &assets, .services = { .nearest_triangle = nearestByEmbree } };
    auto made = std::make_unique<Run> (
        catalogue, std::move (options),
        [this] (const std::string& role, const graph::Graph&, const Plan& plan, Messages& messages) { return open (role, plan, messages); },
        queries);
    made->add (probes);
    if (rig) made->add (*rig);
    made->add (*this);
    return made;
}

void LiveRun::begin()
{
    end();
    begins = false;
    const auto& graph = document.graph();
    run_devices = graph.devices;
    if (setup != nullptr) run_session = setup->session().session;
    graph_rate_hz = graph.rate_hz;
    Messages of_sound;
    rig = std::make_unique<audio::AudioRig> (audioWanted (of_sound));
    rig->setLenient (true);
    run = makeRun (Run::Queries::on_thread);
    said = run->load (graph);
    if (run->hasEngine())
    {
        hand_role = handRoleOf (run->engine().newest());
        auto choice = decideClock (run->engine().newest());
        clock_role = choice.role;
        if (! choice.role.empty() && choice.rate_hz != run->rate())
        {
            run->setRate (choice.rate_hz);
            said = run->load (graph);
        }
        if (choice.by_sound_card) rig->tickBy (run->rate());
        std::ranges::move (choice.messages, std::back_inserter (said));
    }
    std::ranges::move (of_sound, std::back_inserter (said));
    if (! run->hasEngine()) return run.reset();

    note (run->engine().newest());
    probes.clear();
    run->openDevices (graph, said);
    alarms_told = alarms_stopped = Failsafe::alarms();   // what happened before concerns no device of this run
    if (held) run->engine().emergencyStop();
    std::ranges::move (missingParts (run->engine().newest()), std::back_inserter (said));
    for (const auto& real : realDevices())
        if (const auto role = std::ranges::find (needed, real.role, &RoleNeeds::role); role != needed.end())
            std::ranges::move (missingTools (*role, partsOf (real.profile())), std::back_inserter (said));
    if (sound != nullptr) sound->setTickRate (run->rate());
    beginSound();
    clock = rig->clock() == nullptr ? makeClock() : nullptr;
    watch = HealthWatch { clock_role };
    run->start (clock ? *clock : *rig->clock(), { .stop_wanted = stopRequested });
}

void LiveRun::end()
{
    if (run) run->end();   // waits until the forces are zero
    if (rig) static_cast<void> (rig->end());
    run.reset();
    clock.reset();
    rig.reset();
    watch = HealthWatch {};
    clock_role.clear();
    hand_damping = 0.0;
    pointer.reset();
    transported.reset();
    delay_ticks.reset();
}

void LiveRun::documentChanged()
{
    const auto& graph = document.graph();
    const bool is_same_run = isLive() && graph.rate_hz == graph_rate_hz && graph.devices == run_devices;
    if (is_same_run) return takeOver();
    auto checked = makeRun (Run::Queries::within_tick)->check (graph);   // reports problems now: the previous run may take a moment to end
    said = std::move (checked.messages);
    if (checked.plan) needed = needsOf (*checked.plan);
    if (wanted) beginAnew (true);   // the edited graph may compile now
}

void LiveRun::takeOver()
{
    auto edit = run->edit (document.graph());
    if (edit.plan() == nullptr)
    {
        said = std::move (edit.messages());
        return;
    }
    if (hand_role.empty() && ! handRoleOf (*edit.plan()).empty())   // the run had no hand
    {
        edit.drop();
        return beginAnew (true);
    }
    note (*edit.plan());
    edit.openDevices();
    edit.commit();
    said = std::move (edit.messages());
    std::ranges::move (missingParts (run->engine().newest()), std::back_inserter (said));
}

void LiveRun::note (const Plan& plan)
{
    needed = needsOf (plan);
    delay_ticks.reset();
    for (const auto& d : plan.delays())
        delay_ticks = std::max (delay_ticks.value_or (0), d.shortest);
}

void LiveRun::emergencyStop() noexcept
{
    held = true;
    stopped_at = std::chrono::steady_clock::now();
    if (begins || ! isRunning()) return stop();   // otherwise a run that is about to begin would miss the emergency stop
    run->engine().emergencyStop();
}

bool LiveRun::canRearm() const noexcept { return std::chrono::steady_clock::now() - std::chrono::seconds (1) > stopped_at; }

void LiveRun::rearm() noexcept
{
    if (! canRearm()) return;
    held = false;
    if (isLive()) run->engine().rearm();
}

bool LiveRun::isStoppedForGood() const
{
    const auto now = status();
    return isRunning() && std::ranges::any_of (now->shown(), &RunStatus::Role::is_latched);
}

std::optional<RunStatus> LiveRun::status() const { return isLive() ? std::optional (run->live().status()) : std::nullopt; }

/// If a sound card ticks the run, all ticks of a block use the same reading, which adds the length of a block.
std::optional<std::int64_t> LiveRun::delay() const
{
    if (! delay_ticks || ! rig || rig->clock() == nullptr) return delay_ticks;
    const auto card = rig->status().card;
    return card.rate_hz > 0.0 ? *delay_ticks + static_cast<std::int64_t> (std::ceil (card.block * rate() / card.rate_hz)) : *delay_ticks;
}

std::optional<double> LiveRun::stiffnessLeft() const
{
    const auto ticks = delay();
    if (! run || hand_damping <= 0.0 || ! ticks) return std::nullopt;
    return 2.0 * hand_damping * rate() / (2.0 * static_cast<double> (*ticks) + 1.0);
}

std::optional<double> LiveRun::mostForce() const
{
    std::optional<double> most;
    if (run)
        for (const auto& [role, d] : run->devices())
            if (std::isfinite (d.limits.max_force)) most = std::max (most.value_or (0.0), d.limits.max_force);
    return most;
}

std::vector<NodeCost> LiveRun::costs() { return isLive() ? run->live().costs() : std::vector<NodeCost> {}; }

Result<> LiveRun::turn (const std::string& param, const Json& value) { return isRunning() ? turnParam (run->engine(), param, value) : Result<> (stopped()); }

Result<> LiveRun::turnControl (const std::string& id, double value)
{
    return isRunning() ? tactus::turnControl (run->engine(), document.graph(), id, value) : Result<> (stopped());
}

Result<> LiveRun::strike (const std::string& input, double speed) { return isRunning() ? tactus::strike (run->engine(), input, speed) : Result<> (stopped()); }

Result<std::vector<std::string>> LiveRun::capture (const std::string& port, const std::string& watched, const Trigger& trigger)
{
    if (! isRunning()) return stopped();
    return run->capture (document.graph(), port, watched, trigger);
}

void LiveRun::endCapture()
{
    if (run) run->endCapture();
}

void LiveRun::point (const Vec3& p)
{
    if (pointer) pointer->moveTo (p);
}

std::optional<LiveRun::Tool> LiveRun::tool() const
{
    const auto hasDevice = [this] (const auto& d) { return d.first == hand_role; };
    if (! isRunning() || std::ranges::none_of (run->devices(), hasDevice)) return std::nullopt;
    const auto values = seen.load();
    return Tool { Vec3 (values.data()), Vec3 (values.data() + 3) };
}

void LiveRun::before (Plan&, std::uint64_t) noexcept
{
    if (const auto now = Failsafe::alarms(); std::exchange (alarms_stopped, now) != now) run->engine().emergencyStop();
}

void LiveRun::after (const Plan& plan, std::uint64_t, bool) noexcept
{
    const auto role = std::ranges::find_if (plan.roles(), [this] (const auto& r) { return r.name == hand_role; });
    if (role == plan.roles().end()) return;
    const auto& device = *role->state;
    const auto &p = device.reading.position, &f = device.applied.force;
    if (sound != nullptr && ! mutes_sound) sound->push (f.sum());
    seen.store ({ p.x(), p.y(), p.z(), f.x(), f.y(), f.z() });
}

std::optional<audio::AudioStatus> LiveRun::audioStatus() const
{
    if (! rig || ! isLive() || ! rig->isNeeded()) return std::nullopt;
    return rig->status();
}

void LiveRun::noticeAlarms()
{
    const auto now = Failsafe::alarms();
    if (std::exchange (alarms_told, now) == now || ! isRunning()) return;
    emergencyStop();
    auto alarm = Failsafe::alarm();
    std::erase_if (said, [&] (const Message& m) { return m.id == alarm.id; });
    said.push_back (std::move (alarm));
}

void LiveRun::attend()
{
    noticeAlarms();
    if (begins && ! isRunning()) begin();
    if (isLive())
    {
        run->attend();
        if (++attended % looks_apart == 0) watch.look (realDevices());
    }
    if (rig) static_cast<void> (rig->attend());
    if (sound != nullptr) sound->attend();
    probes.collect();
}

}   // namespace tactus::host
