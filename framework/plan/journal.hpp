// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactus
{

class Plan;
struct GuardLimits;

/// Receives everything that reaches a run from outside, on the tick on which it takes effect, so that the run can be repeated
/// bit for bit. All calls before ticked() belong to that tick. No function may allocate, lock or wait. [tick thread]
class Journal
{
public:
    virtual ~Journal() = default;

    /// This plan ticks from now on.
    virtual void tookOver (const Plan&) noexcept = 0;

    /// With this plan, the limits of the guard of this role, by its number in the plan, are tightened to these.
    virtual void tightened (std::size_t role, const GuardLimits&) noexcept = 0;

    /// The tick thread picked up a new target for a knob. The numbers are the instance in the plan and the knob in the
    /// instance.
    virtual void turned (std::size_t instance, std::size_t knob, double target) noexcept = 0;

    /// The plan has a different value for this knob, but the knob was turned after the edit, so the turned value takes precedence.
    virtual void outdone (std::size_t instance, std::size_t knob) noexcept = 0;

    /// A hit is added to an input. The numbers are the instance in the plan and the input among the hit inputs. It arrives on
    /// the next tick on which the node runs, which may be this tick.
    virtual void struck (std::size_t instance, std::size_t input, double speed) noexcept = 0;

    /// The answer to an async query was not ready when it was due; see QueryService::isLate.
    virtual void late (std::uint64_t question) noexcept = 0;

    /// The time since the last tick, in s, if it is not one period. The guards count it.
    virtual void passed (double s) noexcept = 0;

    /// All efforts ramp down to zero, or back up.
    virtual void halted() noexcept = 0;
    virtual void resumed() noexcept = 0;

    /// The emergency stop, and the rearming that ends it along with all other latched stops.
    virtual void emergency() noexcept = 0;
    virtual void rearmed() noexcept = 0;

    /// A tick is over. The plan holds the inputs of the tick: the readings of the roles, and the feeds.
    virtual void ticked (const Plan&) noexcept = 0;
};

}   // namespace tactus
