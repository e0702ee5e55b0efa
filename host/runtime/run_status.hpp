// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/guard.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace tactus::host
{

/// How a run stands after a tick.
struct RunStatus
{
    enum class Phase : std::uint32_t
    {
        running,
        halting,   ///< the forces are on their way to zero
        over
    };

    /// Why it halts, or did.
    enum class End : std::uint32_t
    {
        none,
        length,    ///< it has run for as long as it was to
        asked,     ///< somebody wanted it to stop
        overrun,   ///< the graph takes longer than its ticks last
    };

    /// What is on the device of a role.
    struct Role
    {
        std::string_view name;                  ///< lives as long as the engine
        double force = 0.0, torque = 0.0;       ///< N, N m; lengths
        Guard::Stop stop = Guard::Stop::none;   ///< why the guard withholds the effort now

        // Of the latest stop, also when it is over.
        Guard::Stop latest = Guard::Stop::none;
        Guard::Event event {};
        const Guard::Event& latestEvent() const noexcept { return event; }   ///< for describe()
    };

    static constexpr std::size_t most_roles = 16;

    std::uint64_t ticks = 0, misses = 0;   ///< a miss began a period late, or more
    double force = 0.0, peak = 0.0;        ///< N, the largest of all roles: now, and since the run began
    Phase phase = Phase::running;
    End end = End::none;
    bool clock_replaced = false;             ///< this tick is not of the clock that was chosen: forces are held at zero
    bool let_go_under_force = false;         ///< a slew limit made the way to zero too long
    std::uint64_t role_count = 0;            ///< of the plan that ticks; there is more to see of the first `most_roles`
    std::array<Role, most_roles> roles {};   ///< by name; last, since most of them are seldom there

    std::span<const Role> shown() const noexcept { return std::span (roles).first (role_count < most_roles ? static_cast<std::size_t> (role_count) : most_roles); }
};

}   // namespace tactus::host
