// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "look_at.hpp"

#include <string>

namespace tactus::host
{

/// Where the energy of the hand goes.
struct EnergyBalance
{
    double work = 0.0;     ///< J, that the hand has put in
    double stored = 0.0;   ///< J, in springs and bristles now
    double stored_first = 0.0;
    double dissipated = 0.0;   ///< J, turned into heat
    double held = 0.0;         ///< J, made by holding the force from tick to tick; a force that followed the hand would have cost it that much more
    double worst = 0.0;        ///< J, the least that the hand had put in at any time
    double moved = 0.0;        ///< J, that has gone to and fro
    std::uint64_t gaps = 0;    ///< ticks that were missed, across which the work is an estimate

    /// What no node accounts for. Less than 0 where nodes count more than there was, which some do on a slip in one coarse step.
    double elsewhere() const noexcept { return work + held - (stored - stored_first) - dissipated; }

    /// More can never have come out than was in there to begin with.
    bool isPassive() const noexcept { return worst + stored_first >= -tolerance(); }
    double tolerance() const noexcept { return std::max (1e-9, 1e-3 * moved); }
};

/// Adds up the work of the hand tick by tick, W = -sum f . dx, f the force the device has put on the tool over the step dx;
/// and beside it what nodes say they store and dissipate. It goes on from call to call, so that its window may be short.
class EnergyMeter
{
public:
    struct Sources
    {
        TraceList position;   ///< of the tool
        TraceList applied;    ///< the force that was held until this tick
        TraceList stored, dissipated;
    };

    /// Takes in the ticks that have come since. Starts over if what it looks at is another.
    void follow (const Sources&);
    void restart();

    const EnergyBalance& balance() const noexcept { return now; }

    /// Over time: the work, what is stored, what is dissipated; empty before the first tick.
    const TraceList& traces() const noexcept { return shown; }

private:
    void begin (const Sources&);

    EnergyBalance now;
    TraceList looked_at;
    std::shared_ptr<Trace> work, stored, dissipated;
    TraceList shown;
    std::uint64_t next = 0;
    bool has_last = false, was_gap = false;
    std::array<double, 3> last {}, last_force {}, last_step {};
    double lost_first = 0.0;
};

/// "passive: the hand has put in 3.1 mJ, 0.4 mJ are stored, 2.7 mJ dissipated"
std::string inWords (const EnergyBalance&);

}   // namespace tactus::host
