// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/result.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <limits>
#include <utility>

namespace tactus::host
{

/// The one who stops or starts a run. A person presses a key, a button or a pad, or clicks; all else is a program.
enum class By
{
    person,
    program
};

/// The stop button of live runs, however busy the main thread is. Any thread can press it. The tick thread of each run checks it before every
/// tick; the main thread notices a press when it has time. It outlives the runs, so a press between two runs is not lost, and a rearm cannot come
/// too early because another run has begun meanwhile.
///
/// It also knows who may start: what a person has stopped, or has not started yet, only a person starts. A program may start what a program has
/// stopped, and what has ended by itself.
class StopSwitch
{
public:
    /// The number of presses of each kind of stop.
    struct PressCounts
    {
        std::uint32_t stops = 0, emergencies = 0;

        bool operator== (const PressCounts&) const = default;
    };

    /// The shortest time from an emergency stop, or from a rearm, to the next rearm. So a double click or two keys pressed in a hurry do not
    /// undo a stop.
    static constexpr std::chrono::seconds pause { 1 };

    // [any thread, even in a signal handler]
    void stop (By who) noexcept
    {
        stopped (who);   // before the press itself, as below
        stops.fetch_add (1);
    }
    void emergencyStop (By who) noexcept
    {
        note (who);   // before the press itself: mayRearm() compares this time
        emergencies.fetch_add (1);
    }
    PressCounts presses() const noexcept { return { stops.load(), emergencies.load() }; }

    /// Notes an emergency stop that needs no press, because its caller stops the run.
    void note (By who) noexcept   ///< [any thread, even in a signal handler]
    {
        stopped (who);
        pressed_at.exchange (now());
    }

    /// Notes who stops, if the caller stops the run itself. A program's stop leaves that of a person in place. [any thread, even in a signal handler]
    void stopped (By who) noexcept
    {
        if (who == By::person) stopped_by_person.fetch_add (1);
    }

    /// The number of stops by a person. [any thread]
    std::uint32_t personStops() const noexcept { return stopped_by_person.load(); }

    /// True if a person has stopped, and no person has started since. False before anyone has done either. [any thread]
    bool isStoppedByPerson() const noexcept
    {
        const auto latest = personStops();
        return latest != at_first && answered.load() != latest;
    }

    /// A person starts or rearms, and has seen this many stops of a person: a later one still counts. [any thread]
    void startedAfter (std::uint32_t person_stops) noexcept { answered.store (person_stops); }

    /// A person starts. A press that is not noticed yet comes later. [main thread]
    void started() noexcept
    {
        const auto seen = personStops();
        if (! isAhead()) startedAfter (seen);
    }

    /// Checks that a program may start or rearm. Id: run/stopped_by_person. [any thread]
    Result<> mayStart() const;

    /// The time of the latest emergency stop, only for comparison with an earlier answer. The call writes, so that it cannot move before or after
    /// what its thread does before and after it. [any thread]
    std::chrono::steady_clock::rep latest() noexcept { return pressed_at.fetch_add (0); }

    /// Allows a rearm that was asked for at this time, or refuses because it was asked for within a pause of an emergency stop, or before the
    /// stop, or comes within a pause of the last rearm. Id: run/rearm_too_early. [any thread]
    Result<> mayRearm (std::chrono::steady_clock::time_point asked = std::chrono::steady_clock::now()) const;
    void rearmed() noexcept { rearmed_at.store (now()); }   ///< [any thread]

    /// The presses that the main thread knew of at its last notice(). A new run counts these as obeyed. So it also obeys a press that comes
    /// between notice() and its first tick. [main thread]
    const PressCounts& noticed() const noexcept { return known; }
    bool isAhead() const noexcept { return presses() != known; }   ///< true if there is a press to notice   [main thread]

    /// Marks all presses as noticed, and returns what noticed() returned before. [main thread]
    PressCounts notice() noexcept { return std::exchange (known, presses()); }

private:
    using Time = std::chrono::steady_clock::rep;
    static_assert (std::atomic<Time>::is_always_lock_free && std::atomic<std::uint32_t>::is_always_lock_free, "a signal handler writes them");

    static constexpr Time never = std::numeric_limits<Time>::min();
    static Time now() noexcept { return std::chrono::steady_clock::now().time_since_epoch().count(); }
    static bool isWithinPause (Time since, Time at) noexcept;

    std::atomic<std::uint32_t> stops { 0 }, emergencies { 0 };
    static constexpr std::uint32_t at_first = 1;
    std::atomic<std::uint32_t> stopped_by_person { at_first }, answered { 0 };   // differ until a person starts, also for the first time
    std::atomic<Time> pressed_at { never }, rearmed_at { never };
    PressCounts known;
};

}   // namespace tactus::host
