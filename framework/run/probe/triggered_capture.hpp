// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/plan.hpp>
#include <tactus/run/plan_swap.hpp>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tactus
{

/// The condition that starts a capture of some ports, and the ticks that are captured, like the trigger of an oscilloscope.
struct Trigger
{
    enum class Edge
    {
        rising,    ///< from below the level to the level or above
        falling,   ///< from above the level to the level or below
        either
    };

    double level = 0.0;   ///< in the unit of the watched port
    Edge edge = Edge::rising;
    std::size_t before = 0, after = 0;   ///< ticks before and after the trigger

    std::size_t ticks() const noexcept { return before + 1 + after; }
};

/// The values of some taps on each tick of a window around the first edge of another tap. Edges count only after enough ticks
/// have been recorded, so the window is always complete.
class TriggeredCapture
{
public:
    static constexpr std::size_t most = 65536;   ///< maximum number of values: components times ticks

    /// Captures from the plan with this serial number and from later plans; the taps must have the same numbers in all of them. The capture must fit into
    /// `most` values. [main thread]
    TriggeredCapture (const Trigger& t, std::uint64_t serial, std::vector<std::size_t> components, std::size_t watched_tap)
        : trigger (t), first_serial (serial), taps (std::move (components)), watched (watched_tap), frames (trigger.ticks() * taps.size())
    {
    }

    /// [tick thread]
    void note (const Plan& plan, std::uint64_t tick) noexcept
    {
        if (plan.serial() < first_serial || isComplete()) return;
        for (std::size_t i = 0; i < taps.size(); ++i)
            frames[next * taps.size() + i] = *plan.taps()[taps[i]].value;
        next = next + 1 < trigger.ticks() ? next + 1 : 0;

        const double now = *plan.taps()[watched].value;
        if (left == 0 && seen > 0 && seen >= trigger.before && isEdge (now))
        {
            at = tick;
            left = trigger.after + 1;
        }
        last = now;
        ++seen;
        if (left > 0 && --left == 0) complete.store (true, std::memory_order_release);
    }

    bool isComplete() const noexcept { return complete.load (std::memory_order_acquire); }   // [any thread]

    // Valid once the capture is complete. [main thread]
    const Trigger& window() const noexcept { return trigger; }
    std::uint64_t triggeredAt() const noexcept { return at; }   ///< tick number

    /// The components on a tick of the window; tick 0 is the first one of the window.
    std::span<const double> frame (std::size_t tick) const noexcept
    {
        return std::span (frames).subspan ((next + tick) % trigger.ticks() * taps.size(), taps.size());
    }

private:
    bool isEdge (double now) const noexcept
    {
        const bool rises = last < trigger.level && now >= trigger.level, falls = last > trigger.level && now <= trigger.level;
        return (rises && trigger.edge != Trigger::Edge::falling) || (falls && trigger.edge != Trigger::Edge::rising);
    }

    Trigger trigger;
    std::uint64_t first_serial;
    std::vector<std::size_t> taps;
    std::size_t watched;
    std::vector<double> frames;   // a ring buffer, until the capture is complete

    // Used by the tick thread until the capture is complete.
    std::size_t next = 0, left = 0;   // index in the ring; remaining ticks, including the edge
    std::uint64_t seen = 0, at = 0;
    double last = 0.0;
    std::atomic<bool> complete = false;
};

/// Hands at most one capture at a time to the tick thread. Neither side waits.
class CaptureSlot
{
public:
    /// Replaces the previous capture. [main thread]
    void arm (std::unique_ptr<TriggeredCapture> capture)
    {
        armed = capture.get();
        give (std::make_unique<Slot> (std::move (capture)));
    }

    void disarm()   // [main thread]
    {
        if (armed == nullptr) return;
        armed = nullptr;
        give (std::make_unique<Slot>());
    }

    /// The armed capture, once it is complete; null until then. It stays until disarm() or arm(). [main thread]
    const TriggeredCapture* complete() const noexcept { return armed && armed->isComplete() ? armed : nullptr; }

    /// Call it after each tick. [tick thread]
    void note (const Plan& plan, std::uint64_t tick) noexcept
    {
        if (auto* slot = slots.take())
        {
            used = slot;
            slots.done (slot);
        }
        if (*used) (*used)->note (plan, tick);
    }

private:
    using Slot = std::unique_ptr<TriggeredCapture>;

    void give (std::unique_ptr<Slot> slot)
    {
        slots.takeBack();
        slots.give (std::move (slot));
        slots.clear();
    }

    const TriggeredCapture* armed = nullptr;   // [main thread]
    PlanSwap<Slot> slots { std::make_unique<Slot>() };
    Slot* used = &slots.newest();   // [tick thread]
};

}   // namespace tactus
