// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/free_impact.hpp>
#include <tactus/kit/math/math.hpp>
#include <tactus/kit/signal/past_window.hpp>
#include <tactus/node/node.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <string>

namespace tactus::nodes
{

/// A flat wall or floor: no force until the tool touches it, then more force with depth.
///
///     depth = offset - n . p                                  n points out of the object; offset is measured along n
///     N     = max (0, K (depth) (1 + dissipation rate) + damping rate)   while depth > 0; N = 0 otherwise
///     f     = N n                                             force on the tool
///
/// K is `law`, or stiffness times depth if no law is given. `rate` is the change of the measured depth over `window` (0: one tick),
/// divided by this time, even while apart: on the first sample inside it is the speed of the approach. While the depth changes in the
/// opposite direction from that over the window, `rate` is 0, so that the damping never drives the tool.
///
/// Damping acts from the first touch, so the force jumps there. Dissipation (Hunt and Crossley's lambda, section 6) grows with K
/// and makes no jump. With dissipation alone, and any power law, a tool of any mass comes back with the fraction e = (1 + W (-(1 +
/// x) exp (-(1 + x)))) / x of its impact speed v, with x = dissipation v and W Lambert's function.
///
/// `dissipated_energy` is what damping and dissipation have taken so far: the integral of the damping part of N over depth, along
/// straight lines between the samples. It never falls. The work of the hand on the wall is stored_energy plus dissipated_energy,
/// except for the energy that leaks because the force is held between samples (see below).
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 4 (one patch) and eq. (10); Hunt & Crossley 1975.
/// Eq. (10) is printed with a minus, which would create energy here, where the rate is positive into the object.
///
/// Good to know
///  - The force never pulls: when the tool leaves fast, a damped wall lets go before the tool is out.
///  - The force is held between samples, so a spring of stiffness K leaks K dp^2 / 2 for a movement dp in one sample. A device damping
///    of at least K T / 2 + |damping| is sufficient for a passive wall (section 1). It is not necessary for one that comes to rest:
///    damping calms a wall that buzzes, until the damper itself swings. `tactus check` tells the two apart.
///  - A short contact needs a high rate. At 1 kHz, a tool of 50 g that hits 5e5 d^1.5 with a dissipation of 1 s/m at 2 m/s comes back
///    at up to 1.5 times its speed instead of 0.41 times, depending on where the samples fall. `warning` computes such a hit with
///    the mass of the device, if the graph gives the mass, and names the rate that the contact needs. shock.hunt_crossley can play
///    such a contact at a lower rate.
///  - One quantum q of the position in one tick is a rate of q / T: 0.1 m/s for 5 um at 20 kHz. The damping times this rate is felt as
///    ticks, and these grow with the tick rate. A `window` of 1 ms makes them as small at every rate as at 1 kHz. The damping then
///    acts half a window late, so use 0 if a contact is shorter than about ten windows.
///  - A wall that is moved by a wire or a knob does work, as a real moving wall does.
struct Plane
{
    struct Inputs
    {
        Position position = Position::Zero();
    };

    struct Params
    {
        Vec3 normal = Vec3::UnitZ();
        double offset = 0.0;
        double stiffness = 1000.0;
        double damping = 0.0;
        double dissipation = 0.0;
    };

    struct Settings
    {
        Law law;
        double window = 0.0;
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
        double resistance = 0.0;
        Fine depth = 0.0;
        double hit = 0.0;
        double stored_energy = 0.0;
        double dissipated_energy = 0.0;
        double state = 0.0;
    };

    static constexpr Info info {
        .id = "deform.plane",
        .name = "Plane",
        .summary = "A flat wall with a law of elasticity and two kinds of damping.",
        .source = "Hayward 2007, sections 4 and 6, eq. (10)",
        .keywords = "wall floor virtual wall spring stiffness",
    };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        param (&Params::normal, "normal", unit::gain, "direction out of the object; any length but 0"),
        param (&Params::offset, "offset", unit::metre, "position of the surface along the unit normal", { .usual = { -0.1, 0.1 } }),
        param (&Params::stiffness, "stiffness", unit::stiffness, "stiffness of the wall, if no law is given", { .hard = { 0, inf }, .usual = { 0, 1e4 } }),
        param (&Params::damping, "damping", unit::damping, "viscous damping from the first touch; never pulls", { .hard = { 0, inf }, .usual = { 0, 20 } }),
        param (&Params::dissipation, "dissipation", unit::second_per_metre, "Hunt-Crossley damping: the law is multiplied by 1 + dissipation times rate",
               { .hard = { 0, inf }, .usual = { 0, 10 } }),
        setting (&Settings::law, "law", unit::metre, unit::newton, "force against depth; none: stiffness times depth"),
        setting (&Settings::window, "window", unit::second, "time over which the rate is measured; 0: one tick", { .hard = { 0, 0.1 }, .usual = { 0, 0.01 } }),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::resistance, "resistance", unit::newton, "magnitude of the force"),
        output (&Outputs::depth, "depth", unit::metre, "depth of the tool in the object; negative while apart"),
        output (&Outputs::hit, "hit", unit::hit, "impact speed on the tick of the first touch"),
        output (&Outputs::stored_energy, "stored_energy", unit::joule, "elastic energy"),
        output (&Outputs::dissipated_energy, "dissipated_energy", unit::joule, "energy taken by damping and dissipation so far"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 contact"),
    };

    static constexpr Appearance appearance {
        .kind = Appearance::Kind::plane, .tool = "position", .normal = "normal", .offset = "offset", .depth = "depth"
    };

    Params params;
    Settings settings;

    void prepare (const Setup& setup)
    {
        past.prepare (settings.window, setup.dt_s());
        stored_before = 0.0;
    }

    void update() noexcept
    {
        n = direction (params.normal);
    }

    void learn (const DeviceMechanics& device) noexcept { tool = { device.mass, device.damping }; }

    void adopt (const Plane& old) noexcept
    {
        past.adopt (old.past);
        stored_before = old.stored_before;
        dissipated = old.dissipated;
    }

    std::string warning (const Setup&) const;

    Claims claims() const
    {
        return { .passive = true, .stiffness = settings.law ? settings.law.steepest() : params.stiffness, .damping = params.damping };
    }

    Outputs tick (const Inputs& in) noexcept
    {
        const Fine depth = params.offset - n.dot (in.position);
        const double rate = rateAt (depth);
        const bool inside = depth > 0.0, onset = inside && ! past.isEmpty() && past.last() <= 0.0;
        const double stored = inside ? energy (depth) : 0.0, N = inside ? push (std::max (0.0, law (depth)), rate) : 0.0;
        const double total = dissipated + loss (depth, stored, rate);

        const Outputs out {
            .force = N * n,
            .resistance = N,
            .depth = depth,
            .hit = onset ? rate : 0.0,
            .stored_energy = stored,
            .dissipated_energy = isFinite (total) ? total : dissipated,
            .state = inside ? 1.0 : 0.0,
        };
        if (n.isZero (0.0) || ! isFinite (in.position, depth, rate, out.force, out.resistance, out.stored_energy))
        {
            past.clear();
            return { .dissipated_energy = dissipated, .state = -1.0 };
        }
        past.remember (depth);
        stored_before = stored;
        dissipated = out.dissipated_energy;
        return out;
    }

    void serialize (auto& archive) { archive (past, stored_before, dissipated); }

private:
    double law (double depth) const noexcept { return settings.law ? settings.law (depth) : params.stiffness * depth; }
    double energy (double depth) const noexcept { return settings.law ? settings.law.energy (depth) : 0.5 * params.stiffness * depth * depth; }

    /// The change of depth over the window, in m/s; 0 while the last step of the depth goes the other way.
    double rateAt (double depth) const noexcept
    {
        const auto change = past.to (depth);
        const bool turns = (depth - past.last()) * change.by < 0.0;
        return change.time > 0.0 && ! turns ? change.by / change.time : 0.0;
    }

    /// The force N of a tool inside the wall: eq. (10), with `elastic` for K, plus viscous damping.
    double push (double elastic, double rate) const noexcept
    {
        return std::max (0.0, elastic * (1.0 + params.dissipation * rate) + params.damping * rate);
    }

    /// The energy that the damping takes between the last sample and this one. While the tool leaves, this is at most what the spring
    /// gives, because the wall does not pull.
    double loss (double depth, double stored, double rate) const noexcept
    {
        if (past.isEmpty() || (params.dissipation == 0.0 && params.damping == 0.0)) return 0.0;
        const double before = std::max (0.0, past.last()), now = std::max (0.0, depth);
        const double earlier = settings.law ? stored_before : energy (before);   // a knob may have changed the stiffness since
        const double damped = rate * (params.dissipation * (stored - earlier) + params.damping * (now - before));
        return std::max (0.0, rate < 0.0 ? std::min (damped, earlier - stored) : damped);
    }

    double returned (double rate_hz, double phase) const;

    static constexpr double hard_hit = 2.0;   // m/s; the impact speed that `warning` assumes

    /// The known mechanics of the tool.
    struct Tool
    {
        double mass = 0.0, damping = 0.0;   // kg, N s/m; mass 0: unknown
    };

    Vec3 n = Vec3::UnitZ();
    PastWindow<double> past { Setup {}.dt_s() };   // depths, in m
    double stored_before = 0.0;                    // J, at the last sample
    double dissipated = 0.0;                       // J
    Tool tool;
};

//==============================================================================
// Implementation below.

/// The fraction of its speed that the tool keeps after a hard hit, with the wall's force held between samples. `phase` is the time
/// from the touch to the first sample inside, in samples.
inline double Plane::returned (double rate_hz, double phase) const
{
    constexpr int longest = 1000;   // in samples
    const double T = 1.0 / rate_hz, decay = tool.damping * T / tool.mass;
    const double kept = math::exp (-decay), per_force = decay > 0.0 ? -math::expm1 (-decay) / tool.damping : T / tool.mass;
    const double per_speed = decay > 0.0 ? per_force * tool.mass : T, rise = decay > 0.0 ? (T - per_speed) / tool.damping : 0.5 * T * T / tool.mass;

    double d = phase * hard_hit * T, v = hard_hit;
    Plane hit = *this;
    hit.past.prepare (settings.window, T);
    for (auto k = std::lround (settings.window / T) + 1; k > 0; --k)
        hit.past.remember (d - static_cast<double> (k) * hard_hit * T);
    for (int k = 0; k < longest && d > 0.0; ++k)
    {
        const double f = -push (law (d), hit.rateAt (d));
        hit.past.remember (d);
        d += per_speed * v + rise * f;
        v = kept * v + per_force * f;
    }
    return -v / hard_hit;
}

/// Compares a sampled hard hit with the same hit on a continuous wall.
inline std::string Plane::warning (const Setup& setup) const
{
    constexpr double tolerance = 0.2, cured = 0.05, many = 64.0;   // fractions of the impact speed; samples in a contact that is always accurate
    if (! (tool.mass > 0.0)) return {};

    const auto force = [this] (double d, double v) noexcept { return d > 0.0 ? push (law (d), v) + tool.damping * v : 0.0; };
    const auto rebound = freeImpact (force, tool.mass, hard_hit, many * setup.dt_s());
    if (! rebound.isKnown()) return {};

    const double right = rebound.speed / hard_hit;
    const auto farthest = [&] (double rate_hz) {
        double most = right;
        for (const double phase : { 0.25, 0.5, 0.75, 1.0 })
            if (const double e = returned (rate_hz, phase); ! (std::abs (e - right) <= std::abs (most - right))) most = e;
        return most;
    };
    const double wrong = farthest (setup.rate_hz);
    if (std::abs (wrong - right) <= tolerance) return {};

    constexpr double highest = 1e6;   // Hz
    double needed = setup.rate_hz;
    while (needed <= highest && needed * rebound.duration < many && ! (std::abs (farthest (needed) - right) <= cured))
        needed *= 1.1;
    const double digit = math::pow (10.0, std::floor (math::log10 (needed)) - 1.0);

    auto text = "a tool of " + roundedText (tool.mass, 2) + " kg that hits at " + roundedText (hard_hit, 2) + " m/s comes back at " + roundedText (wrong, 2)
                + " times its speed instead of " + roundedText (right, 2) + " times, even without a delay, because the contact lasts only "
                + roundedText (rebound.duration * setup.rate_hz, 2) + " samples; ";
    if (const double rate = std::ceil (needed / digit) * digit; needed <= highest)
        text += "raise the rate to " + roundedText (rate, 7) + " Hz, which gives " + roundedText (farthest (rate), 2) + " times without a delay, or ";
    return text + "use a softer law";
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Plane);
