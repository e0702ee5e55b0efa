// SPDX-License-Identifier: MIT
#include "engine.hpp"

#include <tactus/kit/state_archive.hpp>
#include <tactus/run/guard/effort_sum.hpp>

#include <tactus/plan/find_hit.hpp>
#include <tactus/plan/find_param.hpp>

#include <algorithm>
#include <new>
#include <stdexcept>
#include <type_traits>

namespace tactus
{

/// The sum of the efforts of all sinks of a role.
inline Effort Engine::total (const Plan::RoleUse& role, Scratch& scratch) noexcept
{
    if (role.sinks.size() == 1) return role.sinks[0].effort (role.sinks[0].node);

    std::size_t n = 0;
    for (const auto& sink : role.sinks)
        scratch.efforts[n++] = sink.effort (sink.node);
    return sumOfEfforts (std::span (scratch.efforts).first (n), scratch.numbers.data());
}

Engine::Engine (std::shared_ptr<Plan> p)
    : rate_hz (p->rateHz()), plans (makeRunning (std::move (p))), running (&plans.newest()), period (1.0 / rate_hz), passed_s (period)
{
}

Engine::Channel* Engine::find (std::string_view role) const noexcept
{
    const auto at = std::find_if (channels.rbegin(), channels.rend(), [&] (const auto& c) { return c->role == role; });
    return at != channels.rend() ? at->get() : nullptr;
}

Engine::Channel& Engine::channelOf (const std::string& role)
{
    auto* found = find (role);
    return found ? *found : makeChannel (role);
}

Engine::Channel& Engine::makeChannel (const std::string& role)
{
    channels.push_back (std::make_unique<Channel> (Channel { role }));
    channels.back()->guard.prepare ({}, 1.0 / rate_hz);
    channels.back()->bumpless.prepare (1.0 / rate_hz);
    return *channels.back();
}

std::unique_ptr<Engine::Running> Engine::makeRunning (std::shared_ptr<Plan> p)
{
    auto made = std::make_unique<Running> (Running { std::move (p), {}, {}, {}, {} });
    std::size_t most = 0;
    for (const auto& role : made->plan->roles())
    {
        made->channels.push_back (&channelOf (role.name));
        most = std::max (most, role.sinks.size());
    }
    made->scratch.efforts.resize (most);
    made->scratch.numbers.resize (most);

    for (std::size_t i = 0; i < made->channels.size(); ++i)
        if (made->channels[i]->is_tightened) made->tightenings.push_back ({ i, made->channels[i]->limits });

    const auto& plan = made->plan;
    const auto& used = made->channels;
    for (const auto i : plan->bound())
    {
        const auto& node = plan->flat().nodes[i];
        const auto role = std::ranges::find (plan->roles(), node.role, &Plan::RoleUse::name);
        if (role == plan->roles().end()) continue;
        made->bound.push_back ({ node.type, plan->instances()[i].node.get(), role->state.get(),
                                 used[static_cast<std::size_t> (role - plan->roles().begin())] });
    }
    return made;
}

/// Gives a role its device. The nodes are bound to it later, by bindDevices().
void Engine::attachDevice (Channel& channel, Device& device, const GuardLimits& limits, const Plan& plan, double dt_s)
{
    auto& layout = std::ranges::find (plan.roles(), channel.role, &Plan::RoleUse::name)->state->layout;
    layout = device.layout();
    channel.device = &device;
    channel.guard.prepare (limits, dt_s, layout);
    channel.is_news = channel.to_announce = true;
    channel.limits = tightest (limits, {});   // as the guard reads them: a limit that is negative or not a number lets nothing through
    device.limitSignals (channel.limits.max_signal, channel.limits.max_signal_slew);
    device.limitSlews (channel.limits.max_slew, channel.limits.max_torque_slew, channel.limits.max_axis_slew);
    device.prepare (dt_s);
}

/// Tells nodes about the layouts of new devices. bindDevices() then binds the nodes to these layouts.
void Engine::sizeForLayout (const Running& plan)
{
    for (const auto& node : plan.bound)
        if (node.channel->to_announce && node.type->announce) node.type->announce (node.node, *node.state);
}

/// Binds nodes to the layouts of new devices, and tells the nodes that learn about a device what it is.
void Engine::bindDevices (Running& plan) noexcept
{
    if (std::ranges::none_of (plan.channels, &Channel::is_news)) return;   // so a takeover need not visit the nodes
    for (const auto& node : plan.bound)
        if (node.channel->is_news) node.type->bind ? node.type->bind (node.node, *node.state) : node.type->learn (node.node, node.state->layout.mechanics);
    for (auto* channel : plan.channels)
        channel->is_news = false;
}

void Engine::attach (std::string_view role, Device& device, const GuardLimits& limits)
{
    const auto& roles = newest().roles();
    if (std::ranges::find (roles, role, &Plan::RoleUse::name) == roles.end()) throw std::out_of_range ("the plan has no role '" + std::string (role) + "'");
    auto& channel = channelOf (std::string (role));
    attachDevice (channel, device, limits, newest(), 1.0 / rate_hz);
    sizeForLayout (plans.newest());
    bindDevices (plans.newest());
    channel.to_announce = false;
}

void Engine::report (Journal& to) noexcept
{
    journal = &to;
    journal->tookOver (*running->plan);
}

std::shared_ptr<Plan> Engine::withdraw()
{
    const auto back = plans.takeBack();
    has_withdrawn = has_withdrawn || back;
    return back ? back->plan : nullptr;
}

/// The role's old channel has no device, and the tick thread may still be using it. So the role gets a new channel, which plans
/// submitted from now on use.
void Engine::join (const Joining& joining, const Plan& plan)
{
    if (std::ranges::find (plan.roles(), joining.role, &Plan::RoleUse::name) == plan.roles().end())
        throw std::out_of_range ("the plan has no role '" + joining.role + "'");
    if (const auto* channel = find (joining.role); channel && channel->device)
        throw std::invalid_argument ("the role '" + joining.role + "' already has a device");
    auto& channel = makeChannel (joining.role);
    attachDevice (channel, joining.device, joining.limits, plan, 1.0 / rate_hz);
    channel.bumpless.begin (false);   // takeOver() knows whether nodes are new
}

void Engine::submit (std::shared_ptr<Plan> next, std::span<const Joining> joining)
{
    if (next)
    {
        if (next->rateHz() != rate_hz) throw std::invalid_argument ("a plan for a different rate cannot take over");
        for (const auto& j : joining)
            join (j, *next);
        const bool was_waiting = plans.takeBack() || has_withdrawn;
        has_withdrawn = false;
        // If the tick thread has taken the last plan, it binds the nodes to the devices that joined with it, and they must not be told again.
        if (! was_waiting)
            for (const auto& channel : channels)
                channel->to_announce = channel->to_announce && std::ranges::count (joining, channel->role, &Joining::role) > 0;
        auto made = makeRunning (std::move (next));
        sizeForLayout (*made);
        plans.give (std::move (made));
    }
    clear();
}

void Engine::tighten (std::string_view role, const GuardLimits& limits)
{
    auto* channel = find (role);
    if (channel == nullptr) return;
    const auto tighter = tightened (channel->limits, limits);
    if (tighter == channel->limits) return;
    channel->limits = tighter;
    channel->is_tightened = true;
    if (channel->device) channel->device->limitSignals (tighter.max_signal, tighter.max_signal_slew);
}

std::size_t Engine::clear()
{
    plans.clear();
    return plans.size();
}

Result<plan::ParamRef> Engine::param (std::string_view name)
{
    auto found = params (name);
    if (! found) return std::move (found).error();
    return std::move (found->front());
}

Result<std::vector<plan::ParamRef>> Engine::params (std::string_view name) { return plan::findParams (newest(), name); }

void Engine::set (const plan::ParamRef& param, double value) noexcept
{
    plan::turn (param, value);
    touched.store (true, std::memory_order_release);
}

Result<std::vector<plan::HitRef>> Engine::hits (std::string_view name) { return plan::findHits (newest(), name); }

void Engine::strike (const plan::HitRef& hit, double speed) noexcept
{
    plan::strike (hit, speed);
    touched.store (true, std::memory_order_release);
}

/// Once tightened, a role's limits come with every plan, so those of a plan that was withdrawn are not lost.
void Engine::tightenGuards (const Running& next) noexcept
{
    for (const auto& [role, limits] : next.tightenings)
        if (next.channels[role]->guard.tighten (limits) && journal) journal->tightened (role, limits);
}

void Engine::takeOver (Running& next) noexcept
{
    if (journal) journal->tookOver (*next.plan);
    next.plan->takeOver (*running->plan, journal);
    for (std::size_t i = 0; i < next.channels.size(); ++i)
        if (! next.plan->roles()[i].untouched)
        {
            next.channels[i]->bumpless.begin (next.plan->roles()[i].has_new_nodes);
            next.channels[i]->touched_at = ticks;
        }
    bindDevices (next);
    tightenGuards (next);
    if (is_stopped)
        for (auto* channel : next.channels)
            channel->guard.emergencyStop();
    running = &next;
    plans.done (running);
    fresh = true;
    if (const auto& rests = next.plan->rests(); ! rests.empty()) settled_at = ticks + rests.back();
}

/// A change in a section that does not run on every tick takes effect only when the section runs. The effort may jump then, so the
/// fade starts again on that tick.
void Engine::fadeAgain() noexcept
{
    for (auto* channel : running->channels)
        for (const auto rests : running->plan->rests())
            if (ticks % rests == 0 && ticks > channel->touched_at && ticks < channel->touched_at + rests) channel->bumpless.begin (false);
}

void Engine::takeSubmitted() noexcept
{
    if (auto* next = plans.take()) takeOver (*next);
}

void Engine::emergencyStop() noexcept
{
    emergency.store (true, std::memory_order_relaxed);
    touched.store (true, std::memory_order_release);
}

void Engine::rearm() noexcept
{
    emergency.store (false, std::memory_order_relaxed);
    rearming.store (true, std::memory_order_relaxed);
    touched.store (true, std::memory_order_release);
}

void Engine::applyStops() noexcept
{
    if (rearming.exchange (false, std::memory_order_relaxed))
    {
        if (journal) journal->rearmed();
        for (auto* channel : running->channels)
            channel->guard.rearm();
        is_stopped = false;
    }
    if (is_stopped || ! emergency.load (std::memory_order_relaxed)) return;
    if (journal) journal->emergency();
    for (auto* channel : running->channels)
        channel->guard.emergencyStop();
    is_stopped = true;
}

/// Values that were set before a plan was running are waiting in its knobs, so the knobs of a fresh plan are read too.
void Engine::turnKnobs() noexcept
{
    touched.exchange (false, std::memory_order_acquire);
    applyStops();
    running->plan->applyTurns (journal);
    if (fresh) running->plan->startRamping();
    fresh = false;
}

void Engine::beforePlan() noexcept
{
    static_assert (std::is_trivially_destructible_v<Reading>, "a new reading replaces the last one in place");
    takeSubmitted();
    if (ticks < settled_at) fadeAgain();
    if (fresh || touched.load (std::memory_order_relaxed)) turnKnobs();

    auto& [plan, used, bound, scratch, tightenings] = *running;
    for (std::size_t i = 0; i < used.size(); ++i)
        if (used[i]->device)
        {
            auto& [reading, applied, layout] = *plan->roles()[i].state;
            new (&reading) Reading (used[i]->device->read());   // in place, because most of a reading is rarely used, but copying would copy all of it
            reading.valid = reading.valid && ! readings_invalid;
            applied.force -= reading.unrendered_force;
            applied.torque -= reading.unrendered_torque;
        }

    plan->beginTick (ticks);
}

void Engine::afterPlan() noexcept
{
    static_assert (std::is_trivially_destructible_v<Effort>, "a new effort replaces the last one in place");
    auto& [plan, used, bound, scratch, tightenings] = *running;
    for (std::size_t i = 0; i < used.size(); ++i)
    {
        const auto& role = plan->roles()[i];
        auto& channel = *used[i];
        auto& [reading, applied, layout] = *role.state;
        const auto& wanted = channel.bumpless (total (role, scratch));
        const auto events = channel.guard.events();
        new (&applied) Effort (channel.guard (wanted, reading, passed_s));   // in place, like the reading
        if (channel.guard.stop() != Guard::Stop::none)
        {
            channel.bumpless.stop (applied);
            if (channel.device) channel.device->withhold();
        }
        if (channel.device) channel.device->write (applied);
        if (channel.guard.events() != events) stops.note ({ ticks, channel.role, channel.guard.latest() });   // last, so as not to delay the effort
    }
    passed_s = period;
    if (journal) journal->ticked (*plan);
    ++ticks;
}

void Engine::tick() noexcept
{
    tick ([] (Plan& p) noexcept { p.tick(); });
}

void Engine::halt() noexcept
{
    if (journal) journal->halted();
    for (auto* channel : running->channels)
        channel->guard.halt();
}

void Engine::resume() noexcept
{
    if (journal) journal->resumed();
    for (auto* channel : running->channels)
        channel->guard.resume();
}

void Engine::serialize (StateArchive& archive)
{
    // Values set since the last tick are part of the state. If nothing has ticked yet, values that are set later still apply at once.
    touched.exchange (false, std::memory_order_acquire);
    applyStops();
    running->plan->applyTurns (journal);

    running->plan->serialize (archive);
    archive.enter ("run", {});
    archive (ticks, settled_at, passed_s, fresh);
    for (std::size_t i = 0; i < running->channels.size(); ++i)
    {
        auto& channel = *running->channels[i];
        auto& [reading, applied, layout] = *running->plan->roles()[i].state;
        archive.enter ("role", channel.role);
        archive (channel.bumpless, channel.touched_at, reading, applied);
        channel.guard.serialize (archive);
        archive.expect (channel.device != nullptr ? 1 : 0);
        if (channel.device && ! channel.device->serialize (archive))
            archive.refuse ("has a device whose state cannot be saved, because it is not simulated; a device of a program says so in its options");
    }

    archive (is_stopped);
    if (! archive.restores()) return;
    if (is_stopped && ! archive.isRefused()) emergency.store (true, std::memory_order_relaxed);
    touched.store (true, std::memory_order_release);   // a stop that comes meanwhile is not lost
}

bool Engine::isAtRest() const noexcept
{
    return std::ranges::all_of (running->channels, [] (const Channel* c) { return c->guard.isAtRest(); });
}

const Guard& Engine::guardOf (std::string_view role) const
{
    if (const auto* channel = find (role)) return channel->guard;
    throw std::out_of_range ("the plan has no role '" + std::string (role) + "'");
}

}   // namespace tactus
