// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "trace_window.hpp"

#include <string>

namespace tactus::host
{

/// The energy balance of the hand.
struct EnergyBalance
{
    double work = 0.0;           ///< done by the hand, in J
    double stored = 0.0;         ///< currently in springs and bristles, in J
    double stored_first = 0.0;   ///< at the start, in J
    double dissipated = 0.0;     ///< turned into heat, in J
    double held = 0.0;           ///< created by holding and delaying the force, in J; with a continuous force, the hand would have done that much more work
    double late = 0.0;           ///< the delay of the device, in ticks
    double worst = 0.0;          ///< the lowest value of `work` so far, in J
    double moved = 0.0;          ///< the sum of all work in either direction, in J
    double seconds = 0.0;        ///< the time that is summed, in s
    std::uint64_t gaps = 0;      ///< missed ticks, across which the work is estimated

    /// The energy put in that no node reports as stored or dissipated. Negative if nodes report more than was put in: they do not know
    /// that a limit or a fade makes their force weaker, and some report too much when they slip within one coarse tick.
    double elsewhere() const noexcept { return work + held - (stored - stored_first) - dissipated; }

    /// True if the hand never got more energy out than was stored at the start.
    bool isPassive() const noexcept { return worst + stored_first >= -tolerance(); }
    double tolerance() const noexcept { return std::max (1e-9, 1e-3 * moved); }
};

/// Sums the work of the hand tick by tick, W = -sum f . dx, where f is the force of the device on the tool during the step dx: with a delay of the device,
/// an earlier one. Also follows the energy that nodes report as stored and dissipated. It continues from call to call, so the traces may be short.
class EnergyMeter
{
public:
    struct Sources
    {
        TraceList position;   ///< position of the tool
        TraceList applied;    ///< the force held until this tick, but for the delay
        TraceList stored, dissipated;
        double late = 0.0;   ///< the delay from a force to its effect on the tool in the device, in ticks
    };

    /// Processes the new ticks. Begins again if it gets different traces of the hand, or those of a new run; in the same run, what it has read
    /// does not count again. What nodes have dissipated stays in the sum when they are bypassed or removed.
    void follow (const Sources&);
    void restart();   ///< from zero; what the traces of this run hold already does not count

    const EnergyBalance& balance() const noexcept { return now; }

    /// Work, stored and dissipated energy over time. Empty before the first tick.
    const TraceList& traces() const noexcept { return shown; }

private:
    void begin (const Sources&);
    void readOn();                     // as far as the traces in `read` go
    void takeNodes (const Sources&);   // goes on with these traces of nodes
    double dissipatedAt (std::uint64_t tick);
    using Vector = std::array<double, 3>;
    void add (const Vector& position, const Vector& force, const Vector& acting, double stored_now);   // `acting`: the delayed force
    Vector actingAt (std::uint64_t tick) const;

    EnergyBalance now;
    Sources read;   // by the last follow()
    std::shared_ptr<Trace> work, stored, dissipated;
    TraceList shown;
    std::uint64_t first = 0, next = 0;   // the first tick that counts, and the one to read next
    std::uint64_t begun = 0;             // beginnings of the first trace
    bool has_last = false, was_gap = false, is_reset = false;
    Vector last {}, last_force {}, last_acting {}, last_step {};
    std::vector<double> lost;   // the latest value of each trace in `read.dissipated`; nan before the first
    double kept = 0.0;          // added to their sum
};

/// "passive over 2.5 s: work of the hand 3.1 mJ, 0.4 mJ stored, 2.7 mJ dissipated"
std::string describe (const EnergyBalance&);

}   // namespace tactus::host
