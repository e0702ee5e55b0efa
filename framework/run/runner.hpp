// SPDX-License-Identifier: MIT
#pragma once

#include "run_status.hpp"
#include "tick_clock.hpp"
#include <tactus/run/clock/node_costs.hpp>
#include <tactus/run/clock/passed_time.hpp>
#include <tactus/run/clock/tick_account.hpp>

#include "engine.hpp"

#include <tactus/kit/threads/snapshot.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <future>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tactus
{

/// Takes part in each tick of a run, for example to set feeds before the tick, or to probe and record after it.
class TickHooks
{
public:
    virtual ~TickHooks() = default;
    virtual void before (std::uint64_t tick) noexcept = 0;   // [tick thread]

    /// A tick that `halts` comes after the end of the run and only removes the forces. [tick thread]
    virtual void after (std::uint64_t tick, bool halts) noexcept = 0;
};

/// A moment in s: since 1970 (UTC), and by the steady clock of the computer.
struct TwoClocks
{
    double wall_s, monotonic_s;
};

/// A run of an engine, in real time or as fast as possible, on a thread ticked by a clock, with statistics of its timing. It
/// ends after its length, on request, or when the graph takes longer than a tick period; it then keeps ticking until the guards
/// have brought all forces to zero.
///
/// The tick thread uses the processor's default floating-point mode, whatever mode the starting thread has: denormal numbers
/// are neither flushed nor treated as zero, because then the results would not be bit-identical to offline ones. Flushing would
/// not save anything either: a recursion that decays among denormal numbers takes up to 3 times as long, but nodes that decay
/// set their state to 0 long before that (100 modes: 187 ns ringing, 191 ns silent, measured).
class Runner final : private Ticked
{
public:
    struct Options
    {
        std::optional<std::uint64_t> length {};     ///< in ticks; empty: the run lasts until it is stopped
        std::optional<double> length_s {};          ///< in s: of wall time, however many ticks are lost, or of the ticks if they have no deadlines
        std::optional<int> core {};                 ///< the CPU core to pin the tick thread to
        bool (*stop_wanted)() noexcept = nullptr;   ///< called on each tick, so that a signal takes effect no matter how busy other threads are
        TickHooks* hooks = nullptr;
    };

    /// With a slew limit, the force may take a long time to fall to zero. A device that still has force on it after this time is
    /// released anyway.
    static constexpr double longest_halt_s = 30.0;

    /// The engine, the clock and the hooks must outlive the runner. [main thread]
    Runner (Engine&, TickClock&, double rate_hz, Options);
    ~Runner() { stop(); }   // waits until the forces are zero   [main thread]
    Runner (const Runner&) = delete;
    Runner& operator= (const Runner&) = delete;

    /// Starts the thread; call it once. Returns a sentence for each real-time privilege that the system refuses. [main thread]
    std::vector<std::string> start();

    void stop() noexcept { asked = true; }                                              ///< [any thread]
    bool isOver() const noexcept { return status().phase == RunStatus::Phase::over; }   ///< [any thread]
    void wait()                                                                         ///< waits until the run is over   [main thread, after start]
    {
        if (thread.joinable()) thread.join();
    }

    RunStatus status() const noexcept { return published.load(); }         ///< [any thread]
    const TickAccount& account() const noexcept { return ticks_so_far; }   ///< [any thread]

    /// The time at which the first tick began; empty before it, and for runs that are not in real time. [any thread]
    std::optional<TwoClocks> firstTick() const noexcept;

    /// Call it many times a second: frees plans that are no longer used, and collects node costs. [main thread]
    void poll();

    /// The costs of the nodes of the newest plan measured so far, the most expensive first. [main thread]
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
    const double period_s;
    const std::uint64_t longest_halt;   // in ticks
    std::atomic<bool> asked = false;
    std::atomic<double> first_wall_s = 0.0, first_monotonic_s = 0.0;   // 0: not yet
    TickAccount ticks_so_far;
    PassedTime passed_time;
    NodeCosts node_costs;
    Snapshot<RunStatus> published;

    // Used by the tick thread.
    RunStatus now;
    std::array<std::uint64_t, RunStatus::most_roles> seen {};   // by role: Guard::changes() when its name and latest stop were published
    std::uint64_t halted_at = 0;                                // tick number
    bool is_real_time = false;                                  // the clock's answer on the last tick: there are deadlines
    double elapsed_s = 0.0;                                     // as Options::length_s counts

    std::jthread thread;   // declared last: it uses the other members
};

}   // namespace tactus
