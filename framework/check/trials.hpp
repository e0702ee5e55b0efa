// SPDX-License-Identifier: MIT
#pragma once

#include "judge.hpp"

namespace tactus::check
{

/// The budget of tryLoops().
struct TrialEffort
{
    std::size_t places = 6;                                        ///< along the motion
    std::size_t ticks = std::numeric_limits<std::size_t>::max();   ///< of the graph, in all; at least one trial is made whatever it says
};

/// Lets the tools of a graph go at some places of the motion, and looks whether they come to rest: what no slope can tell, as a tool that bounces, that
/// dry friction or a brake holds, or that meets a stiffer wall deeper down.
///
/// At each place, a constant force of the hand balances the graph. The tools are let go from 0.2 and 2 mm off, out of the contact, into it and sideways,
/// and at the speed of the motion, each without a hand; and with the usual hands that are nearest to swinging. A tool swings if it moves to and fro by
/// more than two steps of its sensor, and at least 1 um, in the third of three seconds; it runs away if it goes on through that second. Neither counts
/// while the hand drives the tool more than the graph does. After a start at the speed of the motion, a swing that dies away is none. A trial ends early
/// if nothing moves any more.
///
/// The places are those whose response is heaviest, or is like that of no other place; the deepest, the lightest and the fastest. Nodes that play by
/// themselves, whatever the tool does, are silent. Roles whose mass or damping is not known stay where they are held. Throws Stopped if the
/// subject is stopped. [any thread, as measure()]
Trials tryLoops (const Subject&, const HandMotion&, const Demand&, std::span<const RoleDevice>, const TrialEffort& = {});

}   // namespace tactus::check
