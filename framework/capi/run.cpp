// SPDX-License-Identifier: MIT
#include "handles.hpp"

#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/device/guard_limits.hpp>
#include <tactus/run/turn.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/number_text.hpp>

#include <span>

using namespace tactus::capi;
using tactus::Message;
using tactus::Messages;
using tactus::Run;

namespace
{
/// The pushed device of a role, else the one that tactus_run_device describes, else the one that the graph describes, else a simulated
/// tool at rest.
Run::RoleDevice open (tactus_run& r, const std::string& role, const tactus::graph::Graph& graph, Messages& messages)
{
    if (const auto mine = r.waiting.find (role); mine != r.waiting.end())
    {
        r.pushed[role] = mine->second.get();
        auto device = std::move (mine->second);
        r.waiting.erase (mine);
        return { std::move (device), r.limits[role] };
    }
    const auto given = r.described.find (role);
    const bool is_given = given != r.described.end();
    const auto* described = graph.device (role);
    if (! is_given && described == nullptr)
        messages.push_back (Message::warning ("device/undescribed", "/devices",
                                              "no device is given for the role '" + role + "', so it gets a simulated tool at rest",
                                              "give it one with tactus_run_device or tactus_run_pushed_device"));
    const auto description = is_given ? given->second.description : tactus::describedByGraph (described, role, messages);
    auto made = tactus::makeDevice (description, is_given ? given->second.folder : std::filesystem::path (graph.folder));
    for (auto& m : made.messages)
        m.where = "/devices/" + role + m.where;
    std::ranges::move (made.messages, std::back_inserter (messages));
    return { std::move (made.device), made.limits };
}

tactus_run* create (const tactus_graph& g, const tactus_run_options& given, tactus_messages* messages)
{
    tactus::CompileOptions options { .rate_hz = given.rate_hz,
                                     .feeds = list (given.feeds, given.feed_count),
                                     .records = list (given.records, given.record_count) };
    for (const auto& set : list (given.sets, given.set_count))
    {
        auto read = tactus::readOverride (set);
        if (! read)
        {
            failed (messages, std::move (read).error());
            return nullptr;
        }
        options.overrides.push_back (std::move (*read));
    }
    auto* made = makeRun (g.history.graph(), std::move (options), { given.assets, given.asset_context }, tactus::catalogue(), messages);
    if (made == nullptr) return nullptr;
    made->log = text (given.log);
    made->sets = list (given.sets, given.set_count);
    return made;
}

bool knowsRole (const tactus_run& r, const char* role, tactus_messages* messages)
{
    if (std::ranges::find (r.roles, text (role)) != r.roles.end()) return true;
    failed (messages,
            Message::error ("api/unknown_role", "/devices", "the graph has no role '" + text (role) + "'", "use a name that tactus_run_role returns"));
    return false;
}

tactus_result isNull() noexcept { return misuse ("a handle or pointer is NULL"); }
tactus_result notOpen() noexcept { return misuse ("the run is not open: call tactus_run_open first"); }
tactus_result notPushed() noexcept { return misuse ("the role has no device of tactus_run_pushed_device, or the run is not open"); }

/// The motion of a device between steps. Empty if the caller's values are none of their types.
std::optional<tactus::StepMotion> rulesOf (const tactus_device_options& o) noexcept
{
    using Motion = tactus::StepMotion;
    const auto between = static_cast<std::uint32_t> (o.between), effort = static_cast<std::uint32_t> (o.step_effort);
    if (between > TACTUS_BY_VELOCITY || effort > TACTUS_MEAN) return std::nullopt;
    return Motion { static_cast<Motion::Readings> (between), static_cast<Motion::Efforts> (effort) };
}

/// A control that an edit sets stands where the edited graph puts it.
void forgetTurns (tactus_run& r, const tactus::graph::Graph& next)
{
    std::erase_if (r.turned, [&] (const auto& turn) {
        const auto before = tactus::findControl (r.graph, turn.first), after = tactus::findControl (next, turn.first);
        const auto same = [] (const auto& a, const auto& b) { return a.path == b.path && a.low == b.low && a.high == b.high; };
        return ! before || ! after || (*before)->value != (*after)->value || ! std::ranges::equal ((*before)->to, (*after)->to, same);
    });
}

/// Writes the log.
void attendLog (tactus_run& r)
{
    if (auto trouble = r.run->poll()) r.log_trouble = std::move (trouble);
}
}   // namespace

tactus_run* tactus::capi::makeRun (graph::Graph g, CompileOptions options, AssetReader reader, const Catalogue& types, tactus_messages* messages)
{
    auto made = std::make_unique<tactus_run> (options, reader);
    options.assets = &made->assets;
    options.services.nearest_triangle = nearestByBoxes;
    made->graph = std::move (g);
    const auto opener = [r = made.get()] (const std::string& role, const tactus::graph::Graph& graph, const tactus::Plan&, Messages& out) {
        return open (*r, role, graph, out);
    };
    made->run = std::make_unique<Run> (types, std::move (options), opener, Run::Queries::within_tick);
    made->run->add (made->recorder);
    made->run->add (made->guards);
    made->run->add (made->probes.listener());
    auto loaded = made->run->load (made->graph);
    const bool is_broken = tactus::hasErrors (loaded);
    add (messages, std::move (loaded));
    if (is_broken || ! made->run->hasEngine()) return nullptr;
    made->run->keepRecords();
    const auto& plan = made->run->engine().newest();
    for (const auto& role : plan.roles())
        made->roles.emplace_back (role.name);
    for (const auto& tap : plan.taps())
    {
        made->names.push_back (tap.name);
        made->units.push_back (tap.unit);
    }
    return made.release();
}

tactus_run* tactus_run_create (const tactus_graph* g, const tactus_run_options* given, tactus_messages* messages)
{
    if (g == nullptr || ! isSized (given, messages)) return nullptr;
    return guarded<tactus_run*> (messages, nullptr, [&] { return create (*g, known (given, tactus_run_options TACTUS_RUN_OPTIONS), messages); });
}

void tactus_run_free (tactus_run* r)
{
    if (r == nullptr) return;
    tactus_run_stop (r);
    delete r;
}

double tactus_run_rate (const tactus_run* r) { return r != nullptr ? r->run->rate() : 0.0; }
size_t tactus_run_role_count (const tactus_run* r) { return r != nullptr ? r->roles.size() : 0; }
const char* tactus_run_role (const tactus_run* r, size_t i) { return r != nullptr && i < r->roles.size() ? r->roles[i].c_str() : nullptr; }
size_t tactus_run_feed_count (const tactus_run* r) { return r != nullptr ? r->options.feeds.size() : 0; }
size_t tactus_run_record_count (const tactus_run* r) { return r != nullptr ? r->names.size() : 0; }
const char* tactus_run_record_name (const tactus_run* r, size_t i) { return r != nullptr && i < r->names.size() ? r->names[i].c_str() : nullptr; }
const char* tactus_run_record_unit (const tactus_run* r, size_t i) { return r != nullptr && i < r->units.size() ? r->units[i].c_str() : nullptr; }

//==============================================================================
tactus_result tactus_run_device (tactus_run* r, const char* role, const char* device, tactus_messages* messages)
{
    if (r == nullptr || device == nullptr) return isNull();
    if (r->is_open) return misuse ("the devices are open already");
    return guarded (messages, TACTUS_FAILED, [&] {
        if (! knowsRole (*r, role, messages)) return TACTUS_FAILED;
        auto parsed = tactus::parseDeviceOption (text (role) + "=" + device, r->graph.devices, r->graph.folder);
        if (! parsed) return failed (messages, std::move (parsed).error());
        r->waiting.erase (text (role));
        r->described[text (role)] = std::move (*parsed);
        return TACTUS_OK;
    });
}

tactus_result tactus_run_pushed_device (tactus_run* r, const char* role, const tactus_device_options* given, tactus_messages* messages)
{
    if (r == nullptr) return isNull();
    if (r->is_open) return misuse ("the devices are open already");
    if (! isSized (given, messages)) return TACTUS_MISUSE;
    return guarded (messages, TACTUS_FAILED, [&] {
        if (! knowsRole (*r, role, messages)) return TACTUS_FAILED;
        const auto options = known (given, tactus_device_options TACTUS_DEVICE_OPTIONS);
        tactus::DeviceLayout parts { .axes = list (options.axes, options.axis_count),
                                     .efforts = list (options.efforts, options.effort_count),
                                     .buttons = list (options.buttons, options.button_count),
                                     .signal_inputs = options.signal_inputs,
                                     .signal_outputs = options.signal_outputs,
                                     .brake = options.brake };
        if (! tactus::isFinite (parts.brake) || parts.brake < 0.0)
            return failed (messages, Message::error ("api/value", "/devices/" + text (role) + "/brake",
                                                     "the largest damping of a brake is a number of at least 0, not " + tactus::numberText (parts.brake),
                                                     "give it in N s/m, or 0 for a device without a brake"));
        const auto rules = rulesOf (options);
        if (! rules)
            return failed (messages, Message::error ("api/value", "/devices/" + text (role), "`between` or `step_effort` is none of the values of its type",
                                                     "use the names in tactus.h, such as TACTUS_LINEAR and TACTUS_MEAN"));
        Messages found;
        tactus::GuardLimits limits;
        if (options.guard != nullptr)
        {
            const auto json = tactus::Json::tryParse (options.guard);
            if (! json) return failed (messages, Message::error ("api/value", "/guard", "the limits are not valid JSON", "write them as in docs/safety.md"));
            limits = tactus::readGuardLimits (*json, "/guard", found, parts);
            if (! tactus::hasErrors (found)) tactus::checkStops (limits, "/guard", found);
        }
        const bool is_broken = tactus::hasErrors (found);
        add (messages, std::move (found));
        if (is_broken) return TACTUS_FAILED;
        r->described.erase (text (role));
        r->limits[text (role)] = PushedDevice::watched (limits);
        r->waiting[text (role)] = std::make_unique<PushedDevice> (std::move (parts), PushedDevice::steadySeconds, *rules, options.simulated != 0);
        return TACTUS_OK;
    });
}

tactus_result tactus_run_open (tactus_run* r, tactus_messages* messages)
{
    if (r == nullptr) return isNull();
    if (r->is_open) return misuse ("the devices are open already");
    return guarded (messages, TACTUS_FAILED, [&] {
        Messages found;
        r->run->openDevices (r->graph, found);
        if (! tactus::hasErrors (found) && ! r->log.empty())
        {
            auto logs = r->run->startLog (r->log, "libtactus " TACTUS_LIBRARY_VERSION, r->sets, r->graph);
            if (! logs) found.push_back (std::move (logs).error());
        }
        const bool is_broken = tactus::hasErrors (found);
        add (messages, std::move (found));
        r->is_open = ! is_broken;
        if (r->is_open)
        {
            r->guards.watch (r->run->engine());
            r->guards.look();
        }
        const auto isGone = [&] (const auto& p) { return std::ranges::count (r->run->devices(), p.first, [] (const auto& d) { return d.first; }) == 0; };
        std::erase_if (r->pushed, isGone);   // a device that was refused is freed
        r->stepper.emplace (*r->run);
        for (const auto& [role, device] : r->pushed)
            r->stepper->add (device->steps());
        return is_broken ? TACTUS_FAILED : TACTUS_OK;
    });
}

tactus_result tactus_run_push (tactus_run* r, const char* role, const tactus_reading* reading)
{
    if (r == nullptr || role == nullptr || reading == nullptr) return isNull();
    if (! isSized (reading)) return TACTUS_MISUSE;
    const auto device = r->pushed.find (std::string_view (role));
    if (device == r->pushed.end()) return notPushed();
    device->second->push (known (reading, tactus_reading {}));
    return TACTUS_OK;
}

tactus_result tactus_run_push_moving (tactus_run* r, const char* role, const tactus_reading* reading, const double* velocity, const double* angular_velocity)
{
    if (r == nullptr || role == nullptr || reading == nullptr || velocity == nullptr) return isNull();
    if (! isSized (reading)) return TACTUS_MISUSE;
    const auto device = r->pushed.find (std::string_view (role));
    if (device == r->pushed.end()) return notPushed();
    constexpr double no_turn[3] = {};
    device->second->push (known (reading, tactus_reading {}), velocity, angular_velocity != nullptr ? angular_velocity : no_turn);
    return TACTUS_OK;
}

tactus_result tactus_run_take (const tactus_run* r, const char* role, tactus_effort* effort)
{
    if (r == nullptr || role == nullptr) return isNull();
    const auto device = r->pushed.find (std::string_view (role));
    return device != r->pushed.end() ? give (effort, device->second->effort()) : notPushed();
}

//==============================================================================
tactus_result tactus_run_tick (tactus_run* r)
{
    if (! isTickedByCaller (r)) return notTickedByCaller();
    r->run->tick();
    return TACTUS_OK;
}

tactus_result tactus_run_tick_after (tactus_run* r, double passed_s)
{
    if (! isTickedByCaller (r)) return notTickedByCaller();
    if (! (passed_s >= 0.0)) return misuse ("the time that has passed is negative or not a number");
    for (const auto& [role, device] : r->pushed)
        device->passTime (passed_s);
    r->run->engine().passTime (passed_s);
    r->run->tick();
    return TACTUS_OK;
}

tactus_result tactus_run_step_for (tactus_run* r, double dt_s)
{
    if (! isTickedByCaller (r)) return notTickedByCaller();
    if (! (dt_s > 0.0 && dt_s <= tactus::Stepper::longest_s)) return misuse ("the length of a step is not more than 0 and at most 1 s");
    r->stepper->step (dt_s);
    return TACTUS_OK;
}

tactus_result tactus_run_set_feeds (tactus_run* r, const double* values)
{
    if (! isTickedByCaller (r)) return notTickedByCaller();
    if (values == nullptr) return isNull();
    r->run->engine().plan().setFeeds ({ values, r->options.feeds.size() });
    return TACTUS_OK;
}

tactus_result tactus_run_get_records (const tactus_run* r, double* values)
{
    if (! isTickedByCaller (r)) return notTickedByCaller();
    if (values == nullptr) return isNull();
    const auto& taps = r->run->engine().plan().taps();
    for (size_t i = 0; i < r->names.size() && i < taps.size(); ++i)
        values[i] = *taps[i].value;
    return TACTUS_OK;
}

tactus_result tactus_run_steps (tactus_run* r, size_t ticks, const double* feeds, double* records)
{
    if (! isTickedByCaller (r)) return notTickedByCaller();
    const bool has_log = ! r->log.empty();
    const auto drain_every = std::max<size_t> (1, static_cast<size_t> (r->run->rate() / 4.0));   // the log buffers a second
    for (size_t k = 0; k < ticks; ++k)
    {
        if (feeds != nullptr) r->run->engine().plan().setFeeds ({ feeds + k * r->options.feeds.size(), r->options.feeds.size() });
        r->run->tick();
        if (records != nullptr) tactus_run_get_records (r, records + k * r->names.size());
        if (has_log && k % drain_every == 0) attendLog (*r);
    }
    if (has_log) attendLog (*r);
    return TACTUS_OK;
}

double tactus_run_duration (const tactus_run* r)
{
    double seconds = 0.0;
    if (r != nullptr)
        for (const auto& [role, d] : r->run->devices())
            seconds = std::max (seconds, d.device->duration());
    return seconds;
}

//==============================================================================
tactus_result tactus_run_start (tactus_run* r, const tactus_start_options* given, tactus_messages* messages)
{
    if (! isTickedByCaller (r)) return notTickedByCaller();
    if (! isSized (given, messages)) return TACTUS_MISUSE;
    return guarded (messages, TACTUS_FAILED, [&] {
        const auto options = known (given, tactus_start_options TACTUS_START_OPTIONS);
        tactus::Runner::Options runner;
        if (options.length > 0) runner.length = options.length;
        if (options.core >= 0) runner.core = options.core;
        if (options.buffer > 0) r->recorder.ring = std::make_unique<tactus::SpscRing<double>> (options.buffer, r->names.size());
        r->clock.emplace (1.0 / r->run->rate());
        for (const auto& [role, device] : r->pushed)
            device->useClock();
        for (auto& refused : r->run->start (*r->clock, runner))
            if (messages != nullptr) messages->list.push_back (Message::warning ("run/privilege", "", std::move (refused)));
        r->has_started = true;
        return TACTUS_OK;
    });
}

tactus_result tactus_run_attend (tactus_run* r, tactus_messages* messages)
{
    if (r == nullptr) return isNull();
    if (! r->is_open) return notOpen();
    return guarded (messages, TACTUS_FAILED, [&] {
        attendLog (*r);
        r->probes.drain();
        const auto trouble = std::exchange (r->log_trouble, std::nullopt);
        return trouble ? failed (messages, *trouble) : TACTUS_OK;
    });
}

size_t tactus_run_collect (tactus_run* r, double* rows, size_t most) { return r != nullptr ? r->recorder.collect (rows, most) : 0; }
uint64_t tactus_run_lost (const tactus_run* r) { return r != nullptr ? r->recorder.lost() : 0; }

tactus_result tactus_run_stop (tactus_run* r)
{
    if (r == nullptr) return isNull();
    return guarded (nullptr, TACTUS_FAILED, [&] {
        if (std::exchange (r->has_stopped, true)) return TACTUS_OK;
        if (! r->run->isLive())
            for (const auto& [role, device] : r->pushed)
                device->end();
        r->has_ended = true;   // before the log ends, so that a tick thread of the caller adds nothing to it
        auto ended = r->run->finish();
        if (ended) return TACTUS_OK;
        r->log_trouble = std::move (ended).error();
        return TACTUS_FAILED;
    });
}

tactus_result tactus_run_status (const tactus_run* r, tactus_status* to)
{
    return r != nullptr ? give (to, statusOf (*r->run, r->has_started)) : isNull();
}

//==============================================================================
tactus_result tactus_run_set (tactus_run* r, const char* param, double value, tactus_messages* messages)
{
    if (r == nullptr) return isNull();
    return guarded (messages, TACTUS_FAILED, [&] { return asResult (messages, tactus::turnParam (r->run->engine(), text (param), tactus::Json (value))); });
}

tactus_result tactus_run_hit (tactus_run* r, const char* input, double speed, tactus_messages* messages)
{
    if (r == nullptr) return isNull();
    return guarded (messages, TACTUS_FAILED, [&] { return asResult (messages, tactus::strike (r->run->engine(), text (input), speed)); });
}

tactus_result tactus_run_edit (tactus_run* r, const tactus_graph* g, tactus_messages* messages)
{
    if (r == nullptr || g == nullptr) return isNull();
    if (! r->is_open) return notOpen();
    return guarded (messages, TACTUS_FAILED, [&] {
        std::optional<tactus::graph::Graph> copy;
        const auto& next = continuing (*g, r->graph, copy);
        auto edit = r->run->edit (next);
        const bool runs = edit.plan() != nullptr && ! tactus::hasErrors (edit.messages());
        if (runs) edit.openDevices();
        const bool is_broken = ! runs || tactus::hasErrors (edit.messages());
        add (messages, std::move (edit.messages()));
        if (is_broken) return TACTUS_FAILED;
        r->probes.drain();   // the samples of the plan before
        edit.commit();
        r->probes.follow (r->run->engine().newest());
        forgetTurns (*r, next);
        r->graph = next;
        return TACTUS_OK;
    });
}

tactus_result tactus_run_emergency_stop (tactus_run* r)
{
    if (r == nullptr) return isNull();
    r->run->engine().emergencyStop();
    return TACTUS_OK;
}

tactus_result tactus_run_rearm (tactus_run* r)
{
    if (r == nullptr) return isNull();
    r->run->engine().rearm();
    return TACTUS_OK;
}
