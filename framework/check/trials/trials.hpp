// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/check/judge.hpp>

namespace tactus::check
{

/// The budget of tryLoops().
struct TrialEffort
{
    std::size_t places = 6;                                        ///< along the motion
    std::size_t ticks = std::numeric_limits<std::size_t>::max();   ///< of the graph, in all; at least one trial is made at each place
    std::size_t threads = 1;                                       ///< that share the places; the result does not depend on them
};

/// Lets the tools of a graph go at some places of the motion, in a simulation, and finds out whether they come to rest. Slopes cannot show this for a tool
/// that bounces, is held by dry friction or a brake, or meets a stiffer wall deeper down.
///
/// At each place, a constant force of the hand balances the graph. Without a hand, the tools start 0.2 or 2 mm off, out of the contact, into it and
/// sideways, also at the speed of the motion if that is above 0.05 m/s, and 3 mm off if a damper is felt. With the usual hand whose loop is nearest to
/// swinging, they start 0.2 and 2 mm off, and with the arm, 2 mm off; all hands are tried if that loop is not known. Where the loop is known and would be
/// passive with much less damping, there are only four starts.
///
/// A tool swings if it moves to and fro by more than two steps of its sensor, and at least 1 um, in the third of three seconds. It runs away if it keeps
/// moving through that second. Neither counts if the hand drives the tool more than the graph does. A trial in which a swing dies or grows, or a tool runs
/// away, goes on for up to 24 s, and its end counts. A trial ends early once the tool is at rest.
///
/// The places are those with the largest response, those whose response is unlike all others, and those with the largest force, a small one and the
/// largest speed. Nodes that play by themselves are silent. Tools whose mass or damping is not known stay where they are held. Throws Stopped if the
/// subject is stopped. [any thread, as measure()]
Trials tryLoops (const Subject&, const HandMotion&, const Demand&, std::span<const RoleDevice>, const TrialEffort& = {});

}   // namespace tactus::check
