// SPDX-License-Identifier: MIT
#pragma once

#include "guard.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace tactus
{

/// The state of a run after a tick.
struct RunStatus
{
    enum class Phase : std::uint32_t
    {
        running,
        halting,   ///< the forces are falling to zero
        over
    };

    /// The reason why the run halts, or halted.
    enum class End : std::uint32_t
    {
        none,
        length,    ///< the run reached its length
        asked,     ///< a stop was requested
        overrun,   ///< the graph takes longer than a tick period
    };

    /// The effort on the device of a role since the last tick, as the limits of the guard and of the motors let it through.
    struct Role
    {
        double force = 0.0, torque = 0.0;       ///< magnitudes, in N and N m
        Guard::Stop stop = Guard::Stop::none;   ///< why the guard withholds the effort now
        bool is_latched = false;                ///< a stop lasts until rearm, even if another cause is reported
        bool is_clipping = false;               ///< most ticks of the last second asked for more than the guard's limits let through

        // What follows rarely changes, so most ticks do not publish it.
        std::string_view name;   ///< lives as long as the engine

        // The latest stop, even after it has ended.
        Guard::Stop latest = Guard::Stop::none;
        Guard::Event event {};
        const Guard::Event& latestEvent() const noexcept { return event; }   ///< for describe()
    };

    static constexpr std::size_t most_roles = 16;

    std::uint64_t ticks = 0, misses = 0;   ///< misses: ticks that began at least one period late
    double force = 0.0, peak = 0.0;        ///< largest force of all roles in N: since the last tick, and since the run began
    Phase phase = Phase::running;
    End end = End::none;
    bool clock_replaced = false;             ///< this tick does not come from the chosen clock, so forces are held at zero
    bool let_go_under_force = false;         ///< the device was released with force still on it, because a slew limit kept the force from reaching zero in time
    std::uint64_t role_count = 0;            ///< number of roles in the running plan; details of the first `most_roles` are below
    std::array<Role, most_roles> roles {};   ///< sorted by name; the last member, so that unused entries need not be published

    std::span<const Role> shown() const noexcept
    {
        return std::span (roles).first (role_count < most_roles ? static_cast<std::size_t> (role_count) : most_roles);
    }
};

}   // namespace tactus
