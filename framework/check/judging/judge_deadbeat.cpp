// SPDX-License-Identifier: MIT
#include "judging.hpp"
#include <tactus/check/deadbeat_loop.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::check::judging
{

namespace
{
constexpr double usual_error = 0.2;     // of the mass: a known mass is assumed to be accurate to this fraction
constexpr double smoothing_s = 10e-3;   // tau, over which hold.deadbeat smooths its estimate of the hand's force

/// A wall of hold.deadbeat on a device whose mass and damping are known.
struct Wall
{
    double mass, damping, assumed, stiffness, delay, period_s;   // kg, N s/m, kg, N/m, ticks, s

    /// K T^2/M: the square of the angle, in rad, by which a bounce advances in a tick.
    double turn() const noexcept { return stiffness * period_s * period_s / mass; }

    /// By how much M may be smaller than assumed, as a fraction of M. The node then pushes too hard, which counts as a negative damping
    /// of second order in K. Found by simulation, within a factor of 6, for K T^2/M up to 4 and d up to 16.
    double mayBeLess() const noexcept
    {
        const double late = (1.0 + 2.0 * delay) * turn();
        return late > 0.0 ? std::min (usual_error, damping * period_s / mass / (2.0 * late * late)) : usual_error;
    }

    /// By how much M may be larger than assumed, as a fraction of M; 0 if the wall turns the tool back within a few ticks.
    ///
    /// If M is 1 + r times what is assumed, the node takes the missing inertia for a force of the hand, and smooths it over tau. While the
    /// tool swings at w, the depth that the node predicts over a time D is wrong by r (w D)^2/2 j w tau/(1 + j w tau) of the depth. The part
    /// in quadrature counts as a negative damping, which takes half of B at
    ///
    ///     r = B/M (1 + (w tau)^2) / (w^4 D^2 tau)      w^2 = K/M, D = (d + 3/2) T: the delay, the hold and half of a plan
    ///
    /// A force that is planned for a lighter tool also comes too early, which damps a stiff wall more than this takes. Of 6000 closed loops
    /// at the limit, with B T/M from 1e-4 to 0.1 and 500 Hz to 10 kHz, none has an eigenvalue outside the unit circle.
    double mayBeMore() const noexcept
    {
        if (! ((1.0 + delay) * (1.0 + delay) * turn() <= 3.0)) return 0.0;
        if ((1.0 + 2.0 * delay) * turn() >= 0.5) return usual_error;
        const double square = stiffness / mass, taken = square * square * ahead() * ahead() * smoothing_s;
        const double given = damping / mass * (1.0 + square * smoothing_s * smoothing_s);   // r = given / taken
        return given + taken > 0.0 ? std::min (usual_error, given / (given + taken)) : usual_error;
    }

    /// D, in s.
    double ahead() const noexcept { return (1.5 + delay) * period_s; }

    bool isMassRight() const noexcept
    {
        constexpr double rounding = 1e-9;   // of the mass
        const double less = assumed / mass - 1.0;
        return less <= mayBeLess() + rounding && -less <= mayBeMore() + rounding;
    }

    /// The stiffest wall that hides the steps of a sensor from the hand, in N/m.
    double stiffest() const noexcept { return mass / std::pow ((1.0 + delay) * period_s, 2.0); }

    /// The stiffest wall that tolerates the usual error of the mass, in N/m.
    double forgiving() const noexcept
    {
        const double over = mass / (period_s * period_s) / (1.0 + 2.0 * delay) * std::sqrt (damping * period_s / mass / (2.0 * usual_error));
        // The w^2 at which mayBeMore() is the usual error solves w^4 = b (1 + (w tau)^2).
        const double b = damping / mass * (1.0 - usual_error) / usual_error / (ahead() * ahead() * smoothing_s);
        const double half = 0.5 * b * smoothing_s * smoothing_s;
        return std::min ({ over, mass * (half + std::sqrt (half * half + b)), 3.0 * stiffest() });
    }
};

/// A mass that is off by more than the bounds above: judges the loop of the pressed tool exactly. The margin is the factor by which the error of the mass
/// could grow before the loop swings.
void closeLoop (Condition& c, const Wall& wall, const Deadbeat& node, const DeviceNumbers& numbers, double delay)
{
    DeadbeatPlan plan { .damping = node.damping > 0.0 ? node.damping : wall.damping,
                        .stiffness = wall.stiffness,
                        .delay = static_cast<std::size_t> (wall.delay) };
    const auto rests = [&] (double factor) {
        plan.mass = wall.mass + factor * (wall.assumed - wall.mass);
        const auto radius = deadbeatRadius (plan, numbers, static_cast<std::size_t> (delay), wall.period_s);
        return radius && *radius <= at_rest;
    };
    const bool is_stable = rests (1.0);
    c.may_grow = roomToGrow (rests);
    c.verdict = is_stable ? Verdict::stable : Verdict::unstable;
    c.text +=
        is_stable ? "; a tool that is pressed into the wall comes to rest, up to " : "; a tool that is pressed into the wall swings, and would rest with ";
    c.text += text (c.may_grow) + " times this error of M";
}

void breaks (Condition& c, double value, double limit, std::string_view unit, const std::string& remedy)
{
    c.verdict = Verdict::broken;
    c.value = value;
    c.limit = limit;
    c.unit = unit;
    c.remedy = remedy;
}
}   // namespace

void judgeDeadbeat (const Demand& demand, const Deadbeat& node, const DeviceNumbers& numbers, Condition& c)
{
    if (! numbers.mass) return unknown (c, 0.0, "mass");
    const double shortest = delayOf (numbers) + static_cast<double> (node.shortest), longest = delayOf (numbers) + static_cast<double> (node.longest);
    const Wall wall { .mass = numbers.mass->value,
                      .damping = numbers.damping ? numbers.damping->value : 0.0,
                      .assumed = node.mass > 0.0 ? node.mass : numbers.mass->value,
                      .stiffness = node.stiffness,
                      .delay = node.delay,
                      .period_s = periodOf (demand, numbers) };
    c.text = "M " + text (wall.mass, "kg") + ", assumed " + text (wall.assumed, "kg") + ", d " + text (longest) + ", assumed " + text (node.delay);
    if (node.delay < shortest || node.delay > longest)
        return breaks (c, node.delay < shortest ? shortest : longest, node.delay, "1",
                       "the setting \"delay\" at " + text (shortest) + " ticks, a device without delay, or a softer deform.plane");
    if (! numbers.damping) return unknown (c, 0.0, "damping");

    c.text += "; M may be " + text (100.0 * wall.mayBeLess()) + " % smaller or " + text (100.0 * wall.mayBeMore()) + " % larger than assumed";
    const auto softer = "a stiffness of " + atMost (wall.forgiving(), "N/m") + ", at which M may be off by " + text (100.0 * usual_error) + " %";
    if (! wall.isMassRight())
    {
        breaks (c, std::abs (wall.assumed - wall.mass), wall.mass * (wall.assumed > wall.mass ? wall.mayBeLess() : wall.mayBeMore()), "kg",
                "mass 0, which takes the mass of the device, the mass of this device, or " + softer);
        return closeLoop (c, wall, node, numbers, longest);
    }

    if (! numbers.quantum) return unknown (c, 0.0, "quantum");
    const double quantum = numbers.quantum->value, value = 0.5 * wall.assumed * quantum / (wall.period_s * wall.period_s);
    c.text += ", delta " + text (1e6 * quantum, "um");
    constexpr double rounding = 1e-9;
    if (quantum > 0.0 && wall.stiffness > wall.stiffest() * (1.0 + rounding))
        return breaks (c, wall.stiffness, wall.stiffest(), "N/m", "a stiffness of " + atMost (wall.stiffest(), "N/m"));
    if (! numbers.coulomb && value > 0.0) return unknown (c, value, "Coulomb friction");
    const double limit = numbers.coulomb ? numbers.coulomb->value : 0.0;
    std::vector<std::string> ways;
    if (limit > 0.0)
        ways = { "a quantum of " + atMost (1e6 * quantum * limit / value, "um"), "a rate of " + atMost (std::sqrt (limit / value) / wall.period_s, "Hz") };
    ways.push_back ("a device with a dry friction of " + atLeast (value, "N"));
    decide (c, value, limit, Strict::no, 1.0, anyOf (ways));
    if (c.verdict == Verdict::holds && std::min (wall.mayBeLess(), wall.mayBeMore()) < usual_error)
    {
        c.verdict = Verdict::close;
        c.remedy = softer;
    }
}

}   // namespace tactus::check::judging
