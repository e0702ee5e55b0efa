// SPDX-License-Identifier: MIT
#pragma once

#include "contact_changes.hpp"
#include "judging.hpp"

#include <array>
#include <optional>
#include <vector>

namespace tactus::check::judging
{

/// The responses of a role's force at all places of the motion, and what its device has to dissipate there.
class RoleLoops
{
public:
    RoleLoops (const Demand& d, const RoleDemand& r, const DeviceNumbers& n) : demand (d), role (r), numbers (n), period_s (periodOf (d, n)) {}

    const Demand& demand;
    const RoleDemand& role;
    const DeviceNumbers& numbers;
    double period_s;

    double delay() const noexcept { return delayOf (numbers); }   ///< of the device, in ticks

    double virtualDamping() const;   ///< the largest b, in N s/m
    double steepest() const;         ///< the largest stiffness along the motion, in N/m

    Dampers dampers() const;

    double motorMass() const { return check::motorMass (numbers, period_s); }

    /// The largest b at which the virtual damper does not oscillate, in N s/m.
    double largestDamper() const { return check::largestDamper (numbers, period_s); }

    /// True if b breaks the condition `damping`. Then `stiffness` is judged without b, because b would break it too.
    bool isOverdamped() const { return numbers.damping && numbers.mass && ! (virtualDamping() < largestDamper()); }

    /// The largest slope that the device allows a texture, in N/m.
    double stiffestTexture() const { return numbers.damping ? stiffestWall (numbers.damping->value, period_s, delay()) : inf; }

    /// A place, and what the device has to dissipate there, in N s/m.
    struct Load
    {
        const Slope* at;
        double damping;   // b, or 0 if b is left out
        double sum;       // (2d + 1) sigma T/2 + |b|
        double total;     // exactly; the sum if the response is not known
        double limit;     // B, and the brake there

        double share() const noexcept { return total / std::max (limit, 1e-12); }
    };

    Load loadAt (const Slope&) const;

    /// The response of this role's force at a place, in all directions together; empty if it is not known. The nominal slopes have none.
    const std::vector<Jacobian>& responseAt (const Slope&) const;

    DeviceNumbers at (const Slope&) const;   ///< the numbers of the device, with its brake as at a place

    static std::array<const DeviceNumbers*, 3> axesOf (const DeviceNumbers& n) noexcept { return { &n, &n, &n }; }

private:
    mutable std::vector<std::vector<Jacobian>> own_responses {};   // by place; findResponses()
    mutable std::vector<std::optional<double>> own_loads {};       // by place; exactLoad()

    std::optional<double> exactLoad (const Slope&) const;
    void findResponses() const;
};

/// Sets the condition `stiffness`, and which nodes it is about.
void judgeContact (const RoleLoops&, const JudgeOptions&, Condition&);

}   // namespace tactus::check::judging
