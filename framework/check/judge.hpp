// SPDX-License-Identifier: MIT
#pragma once

/// Compares what a graph demands with what a device can do: the conditions of Hayward, "Physically-Based Haptic Synthesis" (2007),
/// sections 1, 2 and 5, and what docs/check.md derives from them for several axes and hands; and, where a contact is not
/// passive, the exact sampled loop (sampled_loop.hpp).
///
/// Some faults would break two conditions: a texture that is too steep on its own also makes the sum too steep. The sum is then
/// judged without that texture, so that each fault is reported once. Condition::text says what was left out.

#include "factors.hpp"
#include "measure.hpp"

#include "sampled_loop.hpp"

#include <tactus/run/device/device_numbers.hpp>
#include <tactus/run/device/sim.hpp>

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::check
{

enum class Verdict
{
    holds,
    close,          ///< holds, but not by the factor that the chapter recommends
    passive,        ///< `stiffness` and `coupling` hold, and all nodes claim it: the contact returns no energy, whatever the hand does
    passive_here,   ///< they hold along this motion, and perhaps not along others
    stable,         ///< they do not hold, but the sampled loop comes to rest without a hand and with the usual ones
    unstable,       ///< they do not hold, and the sampled loop swings without a hand or with one of the usual ones
    broken,         ///< does not hold; `stiffness` and `coupling`: nor is the sampled loop known
    unknown,        ///< a number of the device is not known
    not_reached,    ///< the motion did not reach the node, so nothing about it was judged
};

/// "holds", "close", "passive", "passive_here", "stable", "unstable", "broken", "unknown" or "not reached".
std::string_view nameOf (Verdict) noexcept;

/// One condition, for a role or for one node of the role.
struct Condition
{
    std::string_view id;   ///< permanent, such as "stiffness"; docs/check.md lists all ids
    std::string role;
    std::string axis {};     ///< of the role's device; empty if the condition is about the tool
    std::string node {};     ///< path of the node; empty if the condition is about the role as a whole
    std::string_view law;    ///< such as "(2d + 1) sigma T/2 + |b| <= B"
    double value = 0.0;      ///< what the graph asks for
    double limit = 0.0;      ///< what the device allows; 0 if unknown
    std::string_view unit;   ///< of value and limit; "1" for a ratio
    Verdict verdict = Verdict::unknown;
    std::string text {};     ///< the numbers behind the verdict, in one sentence
    std::string remedy {};   ///< what would help; empty if the condition holds
    double may_grow = 0.0;   ///< for the verdicts `stable` and `unstable`: how many times the response could be as large before the loop swings
    /// The loop along a node's own force.
    struct Loop
    {
        std::string node;
        double passive_up_to = std::numeric_limits<double>::quiet_NaN();   ///< how many times its response could be as large and passive, at every place
        double may_grow = std::numeric_limits<double>::quiet_NaN();        ///< before it swings, where the contact is nearest to swinging; NaN: not judged
    };
    /// Of `stiffness`: the loops of the nodes, the weakest first: for `unstable`, the one that swings first, and else, the one that is passive up to the
    /// least. Empty if they do not explain the verdict.
    std::vector<Loop> loops {};
    double damping = 0.0;      ///< of `stiffness`: the part of the value that is virtual damping along the steepest direction
    bool is_partial = false;   ///< of `stiffness`: without the virtual damping or the textures, which break a condition of their own
    bool falls = false;        ///< for `unstable`: the linear loop swings nowhere; it runs away, since the graph pushes the tool off its place

    bool isKnown() const noexcept { return verdict != Verdict::unknown && verdict != Verdict::not_reached; }   ///< value and limit have a meaning

    bool isBroken() const noexcept { return verdict == Verdict::broken || verdict == Verdict::unstable; }

    /// The factor by which the value could grow: above 1 if the condition holds, 0 if it is not known, infinite if the value is 0. For `stable` and
    /// `unstable`: may_grow.
    double margin() const noexcept;
};

/// The numbers of the device of a role.
struct RoleDevice
{
    std::string role;
    DeviceNumbers numbers {};
    std::string name {};                      ///< of the device, for reports
    std::optional<Simulation> simulated {};   ///< a simulated device: its brake and its axes
};

/// The numbers of a role's device, or of one of its axes if the demand is about one. Empty where they are not known. [any thread]
DeviceNumbers numbersFor (std::span<const RoleDevice>, const RoleDemand&);

/// The result of the trials of a role.
struct Trial
{
    std::string role, axis {};    ///< as in RoleDemand
    bool is_tried = false;        ///< its tool was let go: in all planned trials, or until one of them swung
    bool swings = false;          ///< in one of them, the tool did not come to rest
    bool runs_away = false;       ///< the graph drove it away
    bool dies = false;            ///< its swing became smaller, but was still a swing at the end
    bool is_doubtful = false;     ///< no tool swings, but one nearly does
    bool rests_without = false;   ///< the tool comes to rest if the nodes Demand::modulated are silent
    bool is_lost = false;         ///< in one of them, the tool swung until the hand drove it away from the motion
    double range = 0.0;           ///< of its movement in the last stretch of the trial, in m
    double after_s = 0.0;         ///< time from the release to the start of this stretch
    double t_s = 0.0;             ///< the time of the motion at which it was let go
    double off = 0.0;             ///< distance from its rest at the start, in m
    HeldHand hand {};
};

/// The result of tryLoops().
struct Trials
{
    std::vector<Trial> by_role {};   ///< in the order of Demand::roles
    std::size_t places = 0, runs = 0;
    std::size_t driven_away = 0;   ///< runs in which the hand drove a tool away from the motion
    bool are_dry = false;          ///< a device has dry friction
};

struct JudgeOptions
{
    Factors factors {};
    double speed = 0.0;               ///< of the hand, in m/s, for the rows of Table 1; 0: as measured
    const Trials* trials = nullptr;   ///< on these devices; null: only the slopes are judged, so a tool that bounces is not noticed
};

/// All conditions, role by role. If the list has no device for a role, all numbers of that device count as unknown. This takes
/// microseconds, so many devices can be compared. [any thread]
std::vector<Condition> judge (const Demand&, std::span<const RoleDevice>, const JudgeOptions& = {});

bool isBroken (std::span<const Condition>) noexcept;

}   // namespace tactus::check
