// SPDX-License-Identifier: MIT
#include "run_journal.hpp"
#include "reading_fields.hpp"
#include "run_head.hpp"

#include <bit>
#include <utility>

namespace tactus
{

void RunJournal::put (Kind kind, std::uint64_t number) noexcept { ring.put (number << 8u | static_cast<std::uint64_t> (kind)); }

void RunJournal::put (double value) noexcept { ring.put (std::bit_cast<std::uint64_t> (value)); }

void RunJournal::put (const Reading& reading) noexcept
{
    for (const double number : toNumbers (reading))
        put (number);
    ring.put (static_cast<std::uint64_t> (reading.axes.size()) | static_cast<std::uint64_t> (reading.signals.size()) << 8u);
    for (const double value : reading.axes)
        put (value);
    for (const double value : reading.signals)
        put (value);
}

void RunJournal::tookOver (const Plan& plan) noexcept
{
    put (Kind::took);
    ring.put (plan.serial());
}

void RunJournal::tightened (std::size_t role, const GuardLimits& limits) noexcept
{
    put (Kind::tightened, role);
    for (const auto& field : guard_fields)
        put (limits.*field.value);
    ring.put (limits.dead_man_buttons);
}

void RunJournal::turned (std::size_t instance, std::size_t knob, double target) noexcept
{
    put (Kind::turned, instance);
    ring.put (knob);
    put (target);
}

void RunJournal::outdone (std::size_t instance, std::size_t knob) noexcept
{
    put (Kind::outdone, instance);
    ring.put (knob);
}

void RunJournal::struck (std::size_t instance, std::size_t input, double speed) noexcept
{
    put (Kind::struck, instance);
    ring.put (input);
    put (speed);
}

void RunJournal::late (std::uint64_t question) noexcept
{
    put (Kind::late);
    ring.put (question);
}

void RunJournal::passed (double s) noexcept
{
    put (Kind::passed);
    put (s);
}

void RunJournal::halted() noexcept
{
    if (! std::exchange (halting, true)) put (Kind::halted);
}

void RunJournal::resumed() noexcept
{
    if (std::exchange (halting, false)) put (Kind::resumed);
}

void RunJournal::emergency() noexcept { put (Kind::emergency); }

void RunJournal::rearmed() noexcept { put (Kind::rearmed); }

void RunJournal::ticked (const Plan& plan) noexcept
{
    put (Kind::ticked, plan.roles().size());
    ring.put (plan.feeds().size());
    for (const auto& role : plan.roles())
        put (role.state->reading);
    for (const double value : plan.feeds())
        put (value);

    if (broken_at.load (std::memory_order_relaxed) != whole)
        ring.discard();
    else if (! ring.commit())
        broken_at.store (now, std::memory_order_release);
    ++now;
}

std::optional<std::uint64_t> RunJournal::brokenAt() const noexcept
{
    const auto tick = broken_at.load (std::memory_order_acquire);
    return tick == whole ? std::nullopt : std::optional (tick);
}

}   // namespace tactus
