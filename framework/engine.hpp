// SPDX-License-Identifier: MIT
#pragma once

#include "guard.hpp"
#include "plan/plan.hpp"

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace tactus
{

/// Runs a plan against devices: read, tick, sum, guard, write. The same engine runs live and offline.
class Engine
{
public:
    /// [main thread] The plan must not be null. A role without a device reads rest at the origin and acts on nothing.
    explicit Engine (std::shared_ptr<Plan>);

    /// Gives a role its device, which must outlive the engine, and the limits of its guard. [main thread, before ticking]
    void attach (std::string_view role, Device&, const GuardLimits& = {});

    /// One sample. Allocates nothing, takes no lock, asks no clock. [tick thread]
    void tick() noexcept;

    /// Brings the efforts of all roles to zero, smoothly, and keeps them there. [tick thread]
    void halt() noexcept;

    /// True once nothing is on any device, so that it can be let go without a step. [tick thread]
    bool isAtRest() const noexcept;

    Plan& plan() noexcept { return *current; }
    const Guard& guardOf (std::string_view role) const;
    double time_s() const noexcept { return static_cast<double> (ticks) / current->rate_hz; }

private:
    struct Attached
    {
        Device* device = nullptr;
        Guard guard;
        std::vector<double> scratch;   // to sum the sinks in
    };

    std::shared_ptr<Plan> current;
    std::vector<Attached> attached;   // as plan().roles
    std::uint64_t ticks = 0;
};

}   // namespace tactus
