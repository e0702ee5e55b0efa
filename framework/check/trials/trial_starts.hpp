// SPDX-License-Identifier: MIT
#pragma once

#include "trials.hpp"

#include <utility>
#include <vector>

namespace tactus::check
{

inline constexpr double near_off = 2e-4, far_off = 2e-3, hard_off = 3e-3;   // m; how far off its rest a tool starts

/// The tools of a motion, as trials know them.
struct TriedTools
{
    /// The tool of a role of the demand, and the number of its axis; -1: the tool itself, -2: an axis that is not known.
    struct Owner
    {
        std::size_t tool = 0;
        int axis = -1;
    };

    std::vector<DeviceNumbers> numbers {};   ///< by tool
    std::vector<bool> known {};              ///< by tool: whether its mass and its damping are known, and it is as fast as the graph
    std::vector<Owner> owners {};            ///< in the order of the demand

    bool isFree (std::size_t d) const { return owners[d].axis >= 0 || (owners[d].axis == -1 && known[owners[d].tool]); }
};

/// The release of all tools at once.
struct Release
{
    double along = 0.0, across = 0.0, third = 0.0;   // m; out of the contact, sideways
    double speed = 0.0;                              // times that of the motion
    HeldHand hand {};
    double off() const noexcept { return std::sqrt (along * along + across * across + third * third); }
};

/// The places of a motion at which tools are let go, and the starts of the tools there.
class TrialStarts
{
public:
    /// All must outlive this object.
    TrialStarts (const HandMotion& m, const Demand& d, const TriedTools& t, const TrialEffort& e) : motion (m), demand (d), tools (t), effort (e) {}

    std::vector<std::size_t> places() const;                    ///< as ticks, in order
    std::vector<Release> releasesAt (std::size_t tick) const;   ///< the starts of one trial after another
    Vec3 speedAt (std::size_t tool, std::size_t tick) const;    ///< in m/s, over some ticks of the motion

private:
    std::size_t tickOf (double t_s) const;
    std::pair<HeldHand, double> worstHand (std::size_t place) const;
    double loadOf (std::size_t role, std::size_t place) const;
    bool isLoopKnown (std::size_t role, std::size_t place) const;
    bool isLoopUnknown() const;
    bool isCalm (std::size_t place) const;

    const HandMotion& motion;
    const Demand& demand;
    const TriedTools& tools;
    const TrialEffort& effort;
};

}   // namespace tactus::check
