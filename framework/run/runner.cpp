// SPDX-License-Identifier: MIT
#include "runner.hpp"

#include "realtime.hpp"

#include <tactus/text/caught.hpp>

#include <algorithm>
#include <cfenv>
#include <cstddef>
#include <type_traits>

namespace tactus
{

namespace
{
/// Notes what was on the devices since the last tick, after the limits of the guards and of the motors. Call before the nodes tick.
void noteEfforts (const Plan& plan, RunStatus& now) noexcept
{
    now.force = 0.0;
    std::size_t i = 0;
    for (const auto& role : plan.roles())
    {
        const auto& applied = role.state->applied;
        const double force = applied.force.norm();
        now.force = std::max (now.force, force);
        if (i == RunStatus::most_roles) continue;
        now.roles[i].force = force;
        now.roles[i].torque = applied.torque.norm();
        ++i;
    }
    now.peak = std::max (now.peak, now.force);
}
}   // namespace

Runner::Runner (Engine& e, TickClock& c, double rate_hz, Options o)
    : engine (e), clock (c), options (o), period_s (1.0 / rate_hz),
      longest_halt (static_cast<std::uint64_t> (longest_halt_s * rate_hz)), ticks_so_far (1.0 / rate_hz),
      passed_time (1.0 / rate_hz),
      node_costs (c)
{
}

std::vector<std::string> Runner::start()
{
    std::vector<std::string> refused;
    if (clock.isRealTime())
        if (auto sentence = lockMemory()) refused.push_back (std::move (*sentence));

    std::promise<std::vector<std::string>> ready;
    auto more = ready.get_future();
    // If run() throws before the promise is kept, the caller of start() gets the exception of a broken promise.
    thread = std::jthread ([this, r = std::move (ready)]() mutable { static_cast<void> (caught ("the tick thread", [&] { run (std::move (r)); })); });
    std::ranges::move (more.get(), std::back_inserter (refused));
    return refused;
}

void Runner::run (std::promise<std::vector<std::string>> ready)
{
    std::fesetenv (FE_DFL_ENV);
    // At real-time priority, a clock that never sleeps would starve other programs.
    ready.set_value (clock.isRealTime() ? becomeRealTime (options.core) : std::vector<std::string> {});
    node_costs.begin();
    engine.resume();
    if (goesOn()) clock.drive (*this);
    now.phase = RunStatus::Phase::over;
    publish();
}

bool Runner::tick (double late_s) noexcept
{
    const auto k = ticks_so_far.ticks();
    const double begin = clock.now();
    if (k == 0 && clock.isRealTime())
    {
        first_wall_s = std::chrono::duration<double> (std::chrono::system_clock::now().time_since_epoch()).count();
        first_monotonic_s = std::chrono::duration<double> (std::chrono::steady_clock::now().time_since_epoch()).count();
    }
    now.clock_replaced = clock.isReplaced();
    engine.invalidateReadings (now.clock_replaced);
    is_real_time = clock.isRealTime();
    const double passed_s = is_real_time ? passed_time (begin, clock.block_s()) : period_s;
    if (is_real_time) engine.passTime (passed_s);
    elapsed_s += passed_s;
    if (options.hooks) options.hooks->before (k);
    engine.tick ([this] (Plan& plan) noexcept {
        noteEfforts (plan, now);
        node_costs.tick (plan);
    });
    if (options.hooks) options.hooks->after (k, now.phase == RunStatus::Phase::halting);
    const double took = clock.now() - begin;

    ticks_so_far.note (late_s, took);
    node_costs.earn (took);
    const bool more = goesOn();
    publish();
    return more;
}

std::optional<TwoClocks> Runner::firstTick() const noexcept
{
    const double monotonic_s = first_monotonic_s;
    if (monotonic_s == 0.0) return std::nullopt;
    return TwoClocks { first_wall_s, monotonic_s };
}

RunStatus::End Runner::whyItEnds() const noexcept
{
    if (is_real_time && ticks_so_far.isOverrun()) return RunStatus::End::overrun;
    if (asked.load (std::memory_order_relaxed) || (options.stop_wanted && options.stop_wanted())) return RunStatus::End::asked;
    if (options.length && ticks_so_far.ticks() >= *options.length) return RunStatus::End::length;
    if (options.length_s && elapsed_s > 0.0 && elapsed_s + 0.5 * period_s >= *options.length_s) return RunStatus::End::length;
    return RunStatus::End::none;
}

/// Returns true if there is a next tick.
bool Runner::goesOn() noexcept
{
    const auto ticks = ticks_so_far.ticks();
    if (now.phase == RunStatus::Phase::running)
    {
        now.end = whyItEnds();
        if (now.end == RunStatus::End::none) return true;
        now.phase = RunStatus::Phase::halting;
        halted_at = ticks;
    }
    engine.halt();   // on each tick, because a plan may have added a role
    if (engine.isAtRest()) return false;
    now.let_go_under_force = ticks - halted_at > longest_halt;
    return ! now.let_go_under_force;
}

void Runner::publish() noexcept
{
    now.ticks = ticks_so_far.ticks();
    now.misses = ticks_so_far.misses();
    now.role_count = engine.roleCount();
    const bool is_released = now.phase == RunStatus::Phase::over && engine.isAtRest();
    if (is_released) now.force = 0.0;
    constexpr std::size_t roles_at = offsetof (RunStatus, roles), often = offsetof (RunStatus::Role, name), all = sizeof (RunStatus::Role);
    static_assert (roles_at % 8 == 0 && often % 8 == 0 && all % 8 == 0, "a snapshot stores words");
    std::array<bool, RunStatus::most_roles> is_new {};
    for (std::size_t i = 0; i < now.shown().size(); ++i)
    {
        const auto [name, applied, guard] = engine.role (i);
        auto& role = now.roles[i];
        if (is_released) role.force = role.torque = 0.0;
        role.stop = guard.stop();
        role.is_latched = guard.isLatched();
        role.is_clipping = guard.isClipping();
        // The name lives in the channel of the role, so a channel with another guard has another name.
        is_new[i] = role.name.data() != name.data() || seen[i] != guard.changes();
        if (! is_new[i]) continue;
        role.name = name;
        role.event = guard.latest();
        role.latest = role.event.why;
        seen[i] = guard.changes();
    }
    published.storeParts (now, [&] (auto part) {
        part (0, std::integral_constant<std::size_t, roles_at>());
        for (std::size_t i = 0; i < now.shown().size(); ++i)
        {
            const auto begin = roles_at + i * all;
            is_new[i] ? part (begin, all) : part (begin, std::integral_constant<std::size_t, often>());
        }
    });
}

void Runner::poll()
{
    engine.clear();
    node_costs.collect();
}

}   // namespace tactus
