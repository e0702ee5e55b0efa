// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_run.hpp"
#include "device_setup.hpp"

#include <host/app/text/filled.hpp>
#include <host/assets/nearest_by_embree.hpp>
#include <host/platform/failsafe.hpp>
#include <host/platform/signals.hpp>
#include <host/sessions/binding.hpp>
#include <tactus/check/factors.hpp>
#include <tactus/plan/missing_parts.hpp>
#include <tactus/run/included_guards.hpp>
#include <tactus/run/turn.hpp>
#include <tactus/text/message.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr int looks_apart = 3;   // every third call to attend() checks the devices: ten times a second

std::vector<std::pair<std::string, Json>> withoutGuards (std::vector<std::pair<std::string, Json>> devices)
{
    for (auto& [role, description] : devices)
        description = withoutGuard (std::move (description));
    return devices;
}

Message stopped() { return Message::error ("run/stopped", {}, "nothing is running in the window", "press START in the window"); }
}   // namespace

LiveRun::LiveRun (Document& d, const Catalogue& c, Sound* s) : document (d), catalogue (c), sound (s)
{
    document.add (*this);
    probes.onWanted = scene_feed.onWanted = port_feed.onWanted = [this] {
        if (isLive()) takeOver();
    };
    scene_feed.hasPlace = [this] (const std::string& role) { return ! isSoundCard (role); };
    scene_feed.onWatched = [this] { showScene(); };
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
        restart();
}

void LiveRun::start (Hand who)
{
    moved_by = std::move (who);
    held = false;
    kept_limits.clear();
    beginSoon (true);
}

void LiveRun::startOther (Hand who)
{
    moved_by = std::move (who);
    held = held || isLatched();
    kept_limits.clear();
    beginSoon (false);
}

void LiveRun::moveBy (Hand who)
{
    moved_by = std::move (who);
    restart();
}

void LiveRun::startAgain() { restart(); }

/// Restarts the run, for changes that cannot be applied while it runs. A latched stop stays latched, and the graph's guards do not become
/// looser.
void LiveRun::restart()
{
    held = held || isLatched();
    if (run) kept_limits = run->askedLimits();
    beginSoon (false);
}

void LiveRun::beginSoon (bool by_start)
{
    stop();
    begins = wanted = true;
    ends_stops = by_start;
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
    held = held || isLatched();
    if (run) kept_limits = run->askedLimits();
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
                                          TRANS ("the force is not played, because a role with a max_signal uses channel 1 or 2 of a sound card").toStdString(),
                                          TRANS ("to hear the force, move the role to other channels").toStdString()));
}

void LiveRun::logNextTo (std::filesystem::path file, std::string program)
{
    log_next = std::move (file);
    log_program = std::move (program);
}

void LiveRun::beginLog()
{
    const auto file = std::exchange (log_next, {});
    if (file.empty()) return;
    if (auto started = run->startLog (file, log_program, {}, document.graph()); ! started)
        said.push_back (std::move (started).error());
    else
        is_logged = true;
}

/// Completes the log of a run that is over, or ends the run.
void LiveRun::endLog()
{
    if (! std::exchange (is_logged, false)) return;
    if (auto finished = run->finish(); ! finished) said.push_back (std::move (finished).error());
}

std::unique_ptr<Run> LiveRun::makeRun (Run::Queries queries)
{
    CompileOptions options { .assets = &assets, .services = { .nearest_triangle = nearestByEmbree } };
    auto made = std::make_unique<Run> (
        catalogue, std::move (options),
        [this] (const std::string& role, const graph::Graph&, const Plan& plan, Messages& messages) { return open (role, plan, messages); },
        queries);
    made->add (probes);
    made->add (scene_feed);
    made->add (port_feed);
    if (rig) made->add (*rig);
    made->add (*this);
    return made;
}

void LiveRun::begin()
{
    if (stop_switch != nullptr && stop_switch->isAhead()) return stop();
    if (! std::exchange (ends_stops, false)) held = held || isLatched();   // also a stop that latched while the forces fell
    end();
    begins = false;
    const auto& graph = document.graph();
    run_devices = withoutGuards (graph.devices);
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
    if (! run->hasEngine())
    {
        log_next.clear();
        return run.reset();
    }

    note (run->engine().newest());
    probes.clear();
    run->keepLimits (kept_limits);
    run->openDevices (graph, said);
    beginLog();
    if (stop_switch != nullptr) obeyed = stop_switch->noticed();
    alarms_told = alarms_stopped = Failsafe::alarms();   // earlier alarms have nothing to do with the devices of this run
    if (held) run->engine().emergencyStop();
    std::ranges::move (missingParts (run->engine().newest()), std::back_inserter (said));
    for (const auto& real : realDevices())
        if (const auto role = std::ranges::find (needed, real.role, &RoleNeeds::role); role != needed.end())
            std::ranges::move (missingTools (*role, partsOf (real.profile())), std::back_inserter (said));
    if (sound != nullptr) sound->setTickRate (run->rate());
    film_tape.begin (run->rate());
    beginSound();
    clock = rig->clock() == nullptr ? makeClock() : nullptr;
    watch = HealthWatch { clock_role };
    run->start (clock ? *clock : *rig->clock(), { .stop_wanted = stopRequested });
}

void LiveRun::end()
{
    if (run) run->end();   // waits until the forces are zero
    endLog();
    if (rig) static_cast<void> (rig->end());
    run.reset();
    clock.reset();
    rig.reset();
    watch = HealthWatch {};
    clock_role.clear();
    hand_damping = 0.0;
    scene_feed.clear();
    port_feed.clear();
    pointer.reset();
    transported.reset();
    delay_ticks.reset();
}

void LiveRun::documentChanged()
{
    const auto& graph = document.graph();
    const bool is_same_run = isLive() && graph.rate_hz == graph_rate_hz && withoutGuards (graph.devices) == run_devices;
    if (is_same_run) return takeOver();
    auto checked = makeRun (Run::Queries::within_tick)->check (graph);   // reports problems now: the previous run may take a moment to end
    said = std::move (checked.messages);
    if (checked.plan)
    {
        needed = needsOf (*checked.plan);
        scene_feed.show (*checked.plan);
    }
    if (wanted) restart();   // the edited graph may compile now
}

/// Shows the plan that runs, or else that of the document, if it compiles.
void LiveRun::showScene()
{
    if (isLive()) return scene_feed.show (run->engine().newest());
    if (const auto checked = makeRun (Run::Queries::within_tick)->check (document.graph()); checked.plan) scene_feed.show (*checked.plan);
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
        return restart();
    }
    note (*edit.plan());
    edit.openDevices();
    edit.commit();
    if (rig->limitsFirst (Sound::channels)) mutes_sound = true;
    said = std::move (edit.messages());
    std::ranges::move (missingParts (run->engine().newest()), std::back_inserter (said));
}

void LiveRun::note (const Plan& plan)
{
    needed = needsOf (plan);
    scene_feed.show (plan);
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

bool LiveRun::canRearm() const noexcept
{
    return std::chrono::steady_clock::now() - std::chrono::seconds (1) > stopped_at && (stop_switch == nullptr || ! stop_switch->isAhead());
}

void LiveRun::rearm() noexcept
{
    if (! canRearm()) return;
    held = false;
    if (! isLive()) return;
    run->engine().rearm();
    if (stop_switch != nullptr && stop_switch->isAhead()) run->engine().emergencyStop();   // pressed since canRearm(): a rearm must not undo it
}

/// Also for a run that has ended by itself.
bool LiveRun::isLatched() const
{
    const auto now = status();
    return now && std::ranges::any_of (now->shown(), &RunStatus::Role::is_latched);
}

bool LiveRun::isStoppedForGood() const { return isRunning() && isLatched(); }

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
    return check::stiffestWall (hand_damping, 1.0 / rate(), static_cast<double> (*ticks));
}

std::optional<double> LiveRun::mostForce() const
{
    std::optional<double> most;
    if (run)
        for (const auto& [role, d] : run->devices())
            if (std::isfinite (d.limits.max_force)) most = std::max (most.value_or (0.0), d.limits.max_force);
    return most;
}

std::optional<double> LiveRun::mostSignal() const
{
    std::optional<double> most;
    if (run)
        for (const auto& [role, d] : run->devices())
            if (std::isfinite (d.limits.max_signal)) most = std::max (most.value_or (0.0), d.limits.max_signal);
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
    if (stop_switch == nullptr) return;
    const auto now = stop_switch->presses();
    const auto before = std::exchange (obeyed, now);
    if (now.emergencies != before.emergencies) run->engine().emergencyStop();
    if (now.stops != before.stops) run->live().stop();
}

void LiveRun::after (const Plan& plan, std::uint64_t tick, bool) noexcept
{
    const auto role = std::ranges::find_if (plan.roles(), [this] (const auto& r) { return r.name == hand_role; });
    if (role == plan.roles().end()) return;
    const auto& device = *role->state;
    const auto &p = device.reading.position, &f = device.applied.force;
    if (sound != nullptr && ! mutes_sound) sound->push (f.sum());
    seen.store ({ p.x(), p.y(), p.z(), f.x(), f.y(), f.z() });
    film_tape.note (tick, p, f);
}

std::optional<audio::AudioStatus> LiveRun::audioStatus() const
{
    if (! rig || ! isLive() || ! rig->isNeeded()) return std::nullopt;
    return rig->status();
}

void LiveRun::noticeAlarms()
{
    const auto now = Failsafe::alarms();
    if (std::exchange (alarms_told, now) == now || (! isRunning() && ! begins)) return;
    emergencyStop();
    auto alarm = Failsafe::alarm();
    std::erase_if (said, [&] (const Message& m) { return m.id == alarm.id; });
    said.push_back (std::move (alarm));
}

void LiveRun::fuse (std::optional<Fuser::Options> how)
{
    fuser.reset();
    if (isLive()) run->engine().newestShared()->fuse (nullptr);
    if (how) fuser.emplace (std::move (*how));
}

void LiveRun::attendFusion()
{
    if (! fuser || ! isRunning()) return;
    const std::chrono::duration<double> now = std::chrono::steady_clock::now().time_since_epoch();
    if (auto trouble = fuser->look (run->engine().newestShared(), now.count())) said.push_back (std::move (*trouble));
}

void LiveRun::attend()
{
    noticeAlarms();
    if (begins && ! isRunning()) begin();
    if (isLive())
    {
        if (auto trouble = run->attend()) said.push_back (std::move (*trouble));
        if (run->live().isOver()) endLog();
        if (++attended % looks_apart == 0) watch.look (realDevices());
        attendFusion();
    }
    if (rig) static_cast<void> (rig->attend());
    if (sound != nullptr) sound->attend();
    probes.collect();
    film_tape.collect();
}

}   // namespace tactus::host
