// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace tactus
{

class Plan;

/// Is told all that reaches a run from outside, on the tick on which it takes effect. With it, the run can be repeated to
/// the bit. What is told before ticked() belongs to that tick. Nothing here may allocate, lock or wait. [tick thread]
class Journal
{
public:
    virtual ~Journal() = default;

    /// This plan ticks from now on.
    virtual void tookOver (const Plan&) noexcept = 0;

    /// A target was seen, by the numbers of the instance in the plan and of the knob in the instance.
    virtual void turned (std::size_t instance, std::size_t knob, double target) noexcept = 0;

    /// An edit has another value there, and was outdone by a turn that came after it and before this plan.
    virtual void outdone (std::size_t instance, std::size_t knob) noexcept = 0;

    /// So much comes to what stands at an input, by the numbers of the instance in the plan and of the input among those that
    /// take hits, on the first tick from this one on on which the node runs.
    virtual void struck (std::size_t instance, std::size_t input, double speed) noexcept = 0;

    /// A slow answer was not there when it was due; see SlowAnswers::isLate.
    virtual void late (std::uint64_t question) noexcept = 0;

    /// All efforts are to be brought to zero, or rise again.
    virtual void halted() noexcept = 0;
    virtual void resumed() noexcept = 0;

    /// The emergency stop; and its end, and that of all stops that stay until somebody ends them.
    virtual void emergency() noexcept = 0;
    virtual void rearmed() noexcept = 0;

    /// A tick is over. What it read stands in the plan: the readings of the roles, and the feeds.
    virtual void ticked (const Plan&) noexcept = 0;
};

}   // namespace tactus
