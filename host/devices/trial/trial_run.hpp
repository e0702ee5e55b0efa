// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/runner.hpp>

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

/// The graphs of a trial: a constant force, or a wall that pushes up.
struct TrialGraph
{
    Vec3 push = Vec3::Zero();   ///< in N; without a wall
    double stiffness = 0.0;     ///< of the wall, in N/m; 0: none
    double offset = 0.0;        ///< of the wall, in m

    std::string text (double rate_hz) const;
};

/// A tick of a trial.
struct TrialRow
{
    Position position = Position::Zero();
    Vec3 asked = Vec3::Zero(), acting = Vec3::Zero();   ///< the force that the graph asks for, and what the guard lets through, in N
    double age = 0.0;                                   ///< of the reading, in s
    double tick_s = 0.0;                                ///< the time of the tick, by its clock, in s
    std::uint32_t buttons = 0;
    ReadingFault fault {};
    bool is_valid = false, halts = false;   ///< halts: after the end, while the force goes to zero
};

/// One run of a trial's graph on a device, under a guard of its own.
class TrialRun final : private TickHooks
{
public:
    struct Options
    {
        double rate_hz = 1000.0;
        double max_force = 0.0;           ///< of the guard, in N; the limits of the device hold as well
        std::uint64_t length = 0;         ///< in ticks; 0: until stop()
        double most_travel = 0.0;         ///< in m: as soon as the tool is farther from its first place, an emergency stop ends the force; 0: anywhere
        std::uint64_t frozen_after = 0;   ///< no tick comes for `frozen_s` after so many; 0: never
        double frozen_s = 0.0;
        bool (*stop_wanted)() noexcept = nullptr;            ///< as Runner::Options
        std::function<std::unique_ptr<TickClock>()> clock;   ///< null: a timer
    };

    /// The device must outlive this object. [main thread]
    TrialRun (Device&, const GuardLimits&, const TrialGraph&, const Options&);
    ~TrialRun() override { end(); }
    TrialRun (const TrialRun&) = delete;
    TrialRun& operator= (const TrialRun&) = delete;

    void emergencyStop() noexcept { engine.emergencyStop(); }   ///< [any thread, even in a signal handler]
    void stop() noexcept { runner.stop(); }                     ///< ends the run; the force goes to zero first   [any thread]
    bool isOver() const noexcept { return runner.isOver(); }    ///< [any thread]
    std::uint64_t ticks() const noexcept { return done; }       ///< [any thread]

    /// Waits for the end: of the length, or of stop(). [main thread]
    void end();

    // After end().
    const std::vector<TrialRow>& rows() const noexcept { return kept; }   ///< the first 30 s
    const TrialRow& last() const noexcept { return latest; }              ///< the last one that was valid, or else the last one; before the halt
    std::uint32_t buttons() const noexcept { return seen_buttons; }       ///< all that were down at some time
    bool hasLost() const noexcept { return has_lost; }                    ///< a reading that was not valid came after one that was, before the halt

    /// The largest age of a reading, in s, and their mean.
    double oldest() const noexcept;
    double meanAge() const noexcept;

    static constexpr double kept_s = 30.0;

private:
    void before (std::uint64_t tick) noexcept override;
    void after (std::uint64_t tick, bool halts) noexcept override;

    const Options options;
    std::unique_ptr<TickClock> clock;
    Engine engine;
    std::vector<TrialRow> kept;
    TrialRow latest;
    Position origin = Position::Zero();
    double tick_s = 0.0;
    std::uint32_t seen_buttons = 0;
    bool has_lost = false;
    std::atomic<std::uint64_t> done = 0;
    Runner runner;   // declared last: its thread uses the other members
};

}   // namespace tactus::host
