// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "node_costs.hpp"
#include "run_status.hpp"
#include "snapshot.hpp"
#include "tick_account.hpp"
#include "tick_clock.hpp"

#include <framework/engine.hpp>

#include <atomic>
#include <cstdint>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tactus::host
{

/// What goes with each tick of a run beside the graph: what is fed before it, probed and recorded after it.
class TickHooks
{
public:
    virtual ~TickHooks() = default;
    virtual void before (std::uint64_t tick) noexcept = 0;   // [tick thread]

    /// A tick that `halts` is one after the end, which only takes the forces off. [tick thread]
    virtual void after (std::uint64_t tick, bool halts) noexcept = 0;
};

/// A run of an engine, in real time or as fast as it goes: a thread with a clock that ticks it, and keeps account of how
/// that went. It ends after its length, when it is asked to, or when the graph takes longer than its ticks last; then
/// it ticks on until the guards have brought all forces to zero.
///
/// The tick thread has the processor's default floating-point mode, whatever the thread that started it had: denormal
/// numbers are neither flushed nor taken for zero, since that would give other bits than offline. Nor would it save
/// anything: a recursion left to decay among denormal numbers takes up to 3 times as long, but nodes that decay set their
/// state to 0 long before (100 modes: 187 ns ringing, 191 ns silent, measured).
class Runner final : private Ticked
{
public:
    struct Options
    {
        std::optional<std::uint64_t> length {};     ///< ticks; nothing: until it is asked to stop
        std::optional<int> core {};                 ///< of the processor, to keep the tick thread on
        bool (*stop_wanted)() noexcept = nullptr;   ///< asked each tick, so that a signal is heeded however busy other threads are
        TickHooks* hooks = nullptr;
    };

    /// A slew limit may make the way to zero long; a device that still has force on it after this is let go.
    static constexpr double longest_halt_s = 30.0;

    /// The engine, the clock and the hooks outlive the runner. [main thread]
    Runner (Engine&, TickClock&, double rate_hz, Options);
    ~Runner() { stop(); }   // and waits until the forces are zero   [main thread]
    Runner (const Runner&) = delete;
    Runner& operator= (const Runner&) = delete;

    /// Begins, once. Returns a sentence for each thing that would help it to be on time and is not granted. [main thread]
    std::vector<std::string> start();

    void stop() noexcept { asked = true; }                                              ///< [any thread]
    bool isOver() const noexcept { return status().phase == RunStatus::Phase::over; }   ///< [any thread]
    void wait() { thread.join(); }                                                      ///< until it is over   [main thread, once, after start]

    RunStatus status() const noexcept { return published.load(); }         ///< [any thread]
    const TickAccount& account() const noexcept { return ticks_so_far; }   ///< [any thread]

    /// To be called many times a second: frees plans that are used no more, and takes in what nodes cost. [main thread]
    void attend();

    /// What the nodes of the newest plan cost, the costliest first; of those that were measured. [main thread]
    std::vector<NodeCost> costs() { return node_costs.of (engine.newest()); }

private:
    bool tick (double late_s) noexcept override;
    void run (std::promise<std::vector<std::string>>);
    bool goesOn() noexcept;
    RunStatus::End whyItEnds() const noexcept;
    void publish() noexcept;

    Engine& engine;
    TickClock& clock;
    const Options options;
    const std::uint64_t longest_halt;   // ticks
    std::atomic<bool> asked = false;
    TickAccount ticks_so_far;
    NodeCosts node_costs;
    Snapshot<RunStatus> published;

    // Of the tick thread.
    RunStatus now;
    std::uint64_t halted_at = 0;   // tick

    std::jthread thread;   // last: it uses the others
};

}   // namespace tactus::host
