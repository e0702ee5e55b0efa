// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_run.hpp"
#include "device_setup.hpp"

#include <host/app/text/filled.hpp>
#include <host/base/platform/signals.hpp>
#include <tactus/check/factors.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/run/guard/included_guards.hpp>
#include <tactus/run/turn.hpp>
#include <tactus/text/message.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
std::vector<std::pair<std::string, Json>> withoutGuards (std::vector<std::pair<std::string, Json>> devices)
{
    for (auto& [role, description] : devices)
        description = withoutGuard (std::move (description));
    return devices;
}

Message stopped() { return Message::error ("run/stopped", {}, "nothing is running in the window", "press START in the window"); }
}   // namespace

LiveRun::LiveRun (Document& d, const Catalogue& c, Sound* s) : document (d), catalogue (c), sound (s), hand_of (d.identity())
{
    document.add (*this);
    probes.onWanted = scene_feed.onWanted = port_feed.onWanted = [this] {
        if (wanted && isLive()) takeOver();
    };
    scene_feed.hasPlace = [this] (const std::string& role) { return hasPlace (role); };
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
    if (session && setup != nullptr) session->rebind (setup->session());
    if (! wanted || ! isRunning() || setup == nullptr) return;
    const auto& now = setup->session().session;
    const auto sounds = [] (const DeviceSession& s) { return s.audio() != nullptr ? *s.audio() : Json(); };
    if (now.clock() != run_session.clock() || sounds (now) != sounds (run_session) || ! moveWorkspaces (now)) return restart();
    run_session = now;
}

void LiveRun::start (Hand who)
{
    tellOfRestart();
    moved_by = std::move (who);
    held = false;
    resting.reset();
    begins_again = false;
    kept_limits.clear();
    stops->started();
    beginSoon (true);
}

void LiveRun::startOther (Hand who)
{
    moved_by = std::move (who);
    held = held || isLatched();
    resting.reset();
    begins_again = false;
    kept_limits.clear();
    if (! held) stops->started();   // else REARM or START does
    beginSoon (false);
}

void LiveRun::moveBy (Hand who)
{
    const bool starts = ! stops->isStoppedByPerson();
    if (starts) stops->started();
    moved_by = std::move (who);
    if (starts || wanted) restart();
}

void LiveRun::changeHand (Hand who)
{
    moved_by = std::move (who);
    if (wanted) restart();
}

void LiveRun::moveTool (std::string role)
{
    chosen_role = std::move (role);
    hand_of = document.identity();
    if (wanted) restart();
}

void LiveRun::startAgain (By who)
{
    if (who == By::program || wanted || ! stops->isStoppedByPerson()) restart();
}

/// Restarts the run, for changes that cannot be applied while it runs. A latched stop stays latched, and the graph's guards do not become
/// looser.
void LiveRun::restart()
{
    tellOfRestart();
    held = held || isLatched();
    if (session) kept_limits = session->run().askedLimits();
    begins_again = true;
    if (! begins) resting = pointer ? tool() : std::nullopt;   // before its force fades
    beginSoon (false);
}

/// After a stop, the run has ended for the user, even if its forces are still falling.
void LiveRun::tellOfRestart()
{
    if (wanted && is_logged && onRestart) onRestart();
}

void LiveRun::beginSoon (bool by_start)
{
    if (session) session->stop();
    begins = wanted = true;
    ends_stops = by_start;
    if (! isRunning()) begin();
}

void LiveRun::stop (By who) noexcept
{
    stops->stopped (who);
    haltSoon();
}

void LiveRun::haltSoon() noexcept
{
    begins = wanted = false;
    log_next.clear();
    if (session) session->stop();
}

void LiveRun::letGo()
{
    haltSoon();
    held = held || isLatched();
    if (session) kept_limits = session->run().askedLimits();
    end();
}

/// The sound settings from the session; none if they have errors.
audio::AudioSettings LiveRun::audioWanted (Messages& messages) const
{
    if (setup == nullptr) return {};
    auto settings = audio::readAudioSettings (setup->session(), messages);
    return hasErrors (messages) ? audio::AudioSettings {} : settings;
}

/// If the sound cannot be opened, the run continues without it. The sound of the force opens the card a second time, where the
/// limits of a role cannot reach it, so it is silent if it could play on a channel that a role limits.
void LiveRun::beginSound()
{
    mutes_sound = false;
    for (auto& m : session->beginSound())
    {
        m.severity = Message::Severity::warning;
        if (setup != nullptr && m.where.starts_with ("/")) place (m, setup->session());
        said.push_back (std::move (m));
    }
    mutes_sound = rig->isNeeded() && rig->limitsFirst (Sound::channels);
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
    if (auto started = session->log (file, log_program, {}); ! started)
        said.push_back (std::move (started).error());
    else
        is_logged = true;
}

void LiveRun::stopLogging()
{
    log_next.clear();
    if (! std::exchange (is_logged, false)) return;
    if (auto ended = session->endLog(); ! ended) said.push_back (std::move (ended).error());
}

/// Completes the log of a run that is over, or ends the run.
void LiveRun::endLog()
{
    if (! std::exchange (is_logged, false)) return;
    if (auto ended = session->end(); ! ended.log) said.push_back (std::move (ended.log).error());
}

/// Compiles the graph as the runs do, to find out what is wrong with it.
Compiled LiveRun::check (const graph::Graph& graph)
{
    Run checker { catalogue, sessionOptions().compile };
    for (auto* listener : sessionOptions().listeners)
        checker.add (*listener);
    if (rig) checker.add (*rig);
    return checker.check (graph);
}

LiveSession::Options LiveRun::sessionOptions()
{
    LiveSession::Options to;
    if (setup != nullptr) to.devices.session = setup->session();
    to.devices.is_by_graph = [this] (const std::string& role) { return isMovedOtherwise (role); };
    to.devices.adopt = [this] (const std::string& role, Run::RoleDevice& opened, const Workspace& in, Messages& messages) {
        adopt (role, opened, in, messages);
    };
    to.devices.remedy.clear();   // a role without a device is usual while a graph is being built
    to.compile = { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } };
    to.listeners = { &probes, &scene_feed, &port_feed, this };
    to.stops = stops;
    to.kept_limits = kept_limits;
    to.is_stopped = held;
    to.least_ramp_s = begins_again ? Guard::rearm_ramp_s : 0.0;
    return to;
}

void LiveRun::begin()
{
    if (stops->isAhead()) return haltSoon();
    if (! std::exchange (ends_stops, false)) held = held || isLatched();   // also a stop that latched while the forces fell
    const auto held_before = std::exchange (resting, {});
    const auto hand_before = run_of == document.identity() && held_before ? pointer : nullptr;
    const auto role_before = hand_role;
    end();
    begins = false;
    const auto& graph = document.graph();
    began_held = held;
    run_of = document.identity();
    run_devices = withoutGuards (graph.devices);
    if (setup != nullptr) run_session = setup->session().session;
    graph_rate_hz = graph.rate_hz;
    Messages of_sound;
    rig = std::make_unique<audio::AudioRig> (audioWanted (of_sound));
    rig->setLenient (true);
    const Hardware hardware { setup != nullptr ? setup->system() : hid::thisComputer(),
                              [this]() -> const hid::LoadedProfiles& { return setup != nullptr ? setup->profiles() : deviceProfiles(); }, rig.get() };
    setHandRole();
    session = std::make_unique<LiveSession> (catalogue, hardware, sessionOptions());
    said = session->load (graph);
    std::ranges::move (of_sound, std::back_inserter (said));
    if (! session->isLoaded() || session->hasPlaceholders())   // without one of its nodes, a graph may push in unintended ways
    {
        log_next.clear();
        session.reset();
        return showScene();   // not that of the run before
    }

    note (session->engine().newest());
    setHandRole();
    held_at.reset();
    if (hand_before && hand_role == role_before) held_at = HeldAt { held_before->position, hand_before->place() };
    probes.clear();
    auto of_devices = session->openDevices();
    std::ranges::copy_if (of_devices, std::back_inserter (lacking), [] (const Message& m) { return m.severity == Message::Severity::error; });
    std::ranges::move (of_devices, std::back_inserter (said));
    if (lacksPluginDevice())
    {
        log_next.clear();
        haltSoon();
        return end();
    }
    beginLog();
    if (sound != nullptr) sound->setTickRate (session->rate());
    film_tape.begin (session->rate());
    beginSound();
    session->fuse (fuses);
    refused = session->start ({ .stop_wanted = stopRequested });
}

void LiveRun::end()
{
    endLog();   // waits until the forces are zero
    if (session) static_cast<void> (session->end());
    session.reset();
    rig.reset();
    hand_damping = hand_delay = 0.0;
    lacking.clear();
    scene_feed.clear();
    port_feed.clear();
    pointer.reset();
    transported.reset();
    graph_delay.reset();
}

const std::vector<DeviceHealth>& LiveRun::health() const noexcept
{
    static const std::vector<DeviceHealth> none;
    return session ? session->health() : none;
}

const std::string& LiveRun::clockRole() const noexcept
{
    static const std::string none;
    return session ? session->clockRole() : none;
}

void LiveRun::documentChanged()
{
    const bool is_only_moved = std::exchange (version, document.version()) == document.version();
    if (is_only_moved && ! is_logged) return;   // a log keeps the places of nodes, too
    const auto& graph = document.graph();
    const bool is_same_run = wanted && isLive() && graph.rate_hz == graph_rate_hz && withoutGuards (graph.devices) == run_devices;
    if (is_same_run) return takeOver();
    auto checked = check (graph);   // reports problems now: the previous run may take a moment to end
    said = std::move (checked.messages);
    if (checked.plan) needed = needsOf (*checked.plan);
    scene_feed.show (checked.plan.get());   // not what was there before, if it cannot run
    if (wanted) restart();                  // the edited graph may compile now
}

/// Shows the plan that runs, or else that of the document, if it compiles.
void LiveRun::showScene()
{
    scene_feed.show (isRunning() && isOfOpenGraph() ? &session->engine().newest() : check (document.graph()).plan.get());
}

void LiveRun::takeOver()
{
    bool has_other_hand = false;   // such as the first one, or one whose role has another name now
    auto edited = session->edit (document.graph(), LiveSession::EditPolicy::errors, [&] (const Plan& plan) {
        const auto role = handRoleOf (needsOf (plan));
        has_other_hand = ! role.empty() && role != hand_role;
        return ! has_other_hand;
    });
    if (has_other_hand) return restart();
    said = lacking;
    std::ranges::move (edited.messages, std::back_inserter (said));
    if (! edited.is_taken_over) return;
    note (session->engine().newest());
    if (rig->limitsFirst (Sound::channels)) mutes_sound = true;
}

void LiveRun::note (const Plan& plan)
{
    needed = needsOf (plan);
    scene_feed.show (&plan);
    graph_delay.reset();
    for (const auto& d : plan.delays())
        graph_delay = graph_delay ? Delay { std::min (graph_delay->shortest, d.shortest), std::max (graph_delay->longest, d.longest) }
                                  : Delay { d.shortest, d.longest };
}

void LiveRun::emergencyStop (By who) noexcept
{
    held = true;
    stops->note (who);
    if (begins || ! isRunning()) return haltSoon();   // otherwise a run that is about to begin would miss the emergency stop
    session->emergencyStop();
}

bool LiveRun::canRearm() const noexcept { return stops->mayRearm().has_value() && ! stops->isAhead(); }

void LiveRun::rearm() noexcept
{
    if (! canRearm()) return;
    held = began_held = false;
    if (wanted) stops->started();
    if (session) static_cast<void> (session->rearm());
}

bool LiveRun::isStoppedForGood() const { return isRunning() && isLatched(); }

bool LiveRun::meansDevice() const
{
    if (isRunning() && drivesDevice()) return true;
    if (setup == nullptr) return false;
    const auto& bound = setup->session().session;
    return bound.audio() != nullptr || std::ranges::any_of (needed, [&] (const RoleNeeds& r) {
               const auto* device = isMovedOtherwise (r.role) ? nullptr : bound.binding (r.role);
               return device != nullptr && ! isSimulated (*device);
           });
}

std::optional<RunStatus> LiveRun::status() const
{
    const bool is_of_this_graph = isRunning() || run_of == document.identity();
    return isLive() && is_of_this_graph ? std::optional (session->run().live().status()) : std::nullopt;
}

/// If a sound card ticks the run, all ticks of a block use the same reading, which adds the length of a block.
std::optional<LiveRun::Delay> LiveRun::delay() const
{
    if (! graph_delay) return std::nullopt;
    auto ticks = static_cast<std::int64_t> (std::ceil (hand_delay));
    if (rig && rig->clock() != nullptr)
        if (const auto card = rig->status().card; card.rate_hz > 0.0) ticks += static_cast<std::int64_t> (std::ceil (card.block * rate() / card.rate_hz));
    return Delay { graph_delay->shortest + ticks, graph_delay->longest + ticks };
}

std::optional<double> LiveRun::stiffnessLeft() const
{
    const auto ticks = delay();
    if (! session || hand_damping <= 0.0 || ! ticks) return std::nullopt;
    return check::stiffestWall (hand_damping, 1.0 / rate(), static_cast<double> (ticks->longest));
}

std::optional<double> LiveRun::mostForce() const
{
    std::optional<double> most;
    if (session)
        for (const auto& [role, d] : session->run().devices())
            if (std::isfinite (d.limits.max_force)) most = std::max (most.value_or (0.0), d.limits.max_force);
    return most;
}

std::optional<double> LiveRun::mostSignal() const
{
    std::optional<double> most;
    if (session)
        for (const auto& [role, d] : session->run().devices())
            if (std::isfinite (d.limits.max_signal)) most = std::max (most.value_or (0.0), d.limits.max_signal);
    return most;
}

std::vector<NodeCost> LiveRun::costs() { return isLive() ? session->run().live().costs() : std::vector<NodeCost> {}; }

Result<> LiveRun::turn (const std::string& param, const Json& value)
{
    return isRunning() ? turnParam (session->engine(), param, value) : Result<> (stopped());
}

Result<> LiveRun::turnControl (const std::string& id, double value)
{
    return isRunning() ? tactus::turnControl (session->engine(), document.graph(), id, value) : Result<> (stopped());
}

Result<> LiveRun::strike (const std::string& input, double speed)
{
    return isRunning() ? tactus::strike (session->engine(), input, speed) : Result<> (stopped());
}

Result<std::vector<std::string>> LiveRun::capture (const std::string& port, const std::string& watched, const Trigger& trigger)
{
    if (! isRunning()) return stopped();
    return session->run().capture (document.graph(), port, watched, trigger);
}

void LiveRun::endCapture()
{
    if (session) session->run().endCapture();
}

void LiveRun::point (const Vec3& p)
{
    if (pointer) pointer->moveTo (p);
}

std::optional<LiveRun::Tool> LiveRun::tool() const
{
    const auto hasDevice = [this] (const auto& d) { return d.first == hand_role; };
    if (! isRunning() || std::ranges::none_of (session->run().devices(), hasDevice)) return std::nullopt;
    const auto values = seen.load();
    return Tool { Vec3 (values.data()), Vec3 (values.data() + 3) };
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

void LiveRun::fuse (std::optional<Fuser::Options> how)
{
    fuses = std::move (how);
    if (session) session->fuse (fuses);
}

std::string LiveRun::fusion() const
{
    if (! fuses) return {};
    return session && session->fuser() != nullptr ? session->fuser()->describe() : "plan";
}

void LiveRun::tell (LiveSession::Events news)
{
    if (news.alarm && ! isRunning() && ! begins) news.alarm.reset();   // it has nothing to do with the next run
    if (news.alarm)
    {
        emergencyStop (By::program);
        std::erase_if (said, [&] (const Message& m) { return m.id == news.alarm->id; });
    }
    for (auto* each : { &news.alarm, &news.log, &news.fusion })
        if (*each) said.push_back (std::move (**each));
}

void LiveRun::poll()
{
    if (session) tell (session->poll());
    if (begins && ! isRunning()) begin();
    if (isLive() && ! isRunning())
    {
        endLog();
        if (! isOfOpenGraph()) end();   // gives back the memory of the previous graph
    }
    if (sound != nullptr) sound->poll();
    probes.collect();
    film_tape.collect();
}

}   // namespace tactus::host
