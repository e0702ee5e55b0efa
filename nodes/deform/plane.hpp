// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

#include <algorithm>

namespace tactus::nodes
{

/// A flat wall or floor: no force until the tool touches it, then more force with depth.
///
///     depth = offset - n . p                                  n points out of the object; offset is measured along n
///     N     = max (0, K (depth) (1 + dissipation rate) + damping rate)   while depth > 0; N = 0 otherwise
///     f     = N n                                             force on the tool
///
/// K is `law`, or stiffness times depth if no law is given. `rate` is the change of the measured depth per sample,
/// divided by the sample period, even while apart: on the first sample inside it is the speed of the approach.
///
/// Damping acts from the first touch and so steps the force. Dissipation (Hunt and Crossley's lambda, section 6) grows with K
/// and does not step it. With dissipation alone, and any power law, a tool of any mass comes back with the fraction
/// e = (1 + W (-(1 + x) exp (-(1 + x)))) / x of its impact speed v, with x = dissipation v and W Lambert's function.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 4 (one patch) and eq. (10); Hunt & Crossley 1975.
/// Eq. (10) is printed with a minus, which would create energy here, where the rate is positive into the object.
///
/// Good to know
///  - The force never pulls: when the tool leaves fast, a damped wall lets go before the tool is out.
///  - The force is held between samples, so a spring of stiffness K leaks K dp^2 / 2 for a movement dp in one sample: the device
///    needs a damping of at least K T / 2 (section 1).
///  - The rate of a quantised position is coarse: one quantum in one sample. Damping times quantum / T is felt as a tick.
///  - A wall that is moved by a wire or a knob does work, as a real moving wall does.
struct Plane
{
    struct Inputs
    {
        Vec3 position = Vec3::Zero();
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
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
        double resistance = 0.0;
        double depth = 0.0;
        double hit = 0.0;
        double stored_energy = 0.0;
        double state = 0.0;
    };

    static constexpr Info info {
        .id = "deform.plane",
        .name = "Plane",
        .summary = "A flat wall with a law of elasticity and two kinds of damping.",
        .source = "Hayward 2007, sections 4 and 6, eq. (10)",
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
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::resistance, "resistance", unit::newton, "magnitude of the force"),
        output (&Outputs::depth, "depth", unit::metre, "depth of the tool in the object; negative while apart"),
        output (&Outputs::hit, "hit", unit::hit, "impact speed on the tick of the first touch"),
        output (&Outputs::stored_energy, "stored_energy", unit::joule, "elastic energy"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 contact"),
    };

    Params params;
    Settings settings;

    void prepare (const Setup& setup) noexcept
    {
        dt = setup.dt_s();
        last = {};
    }

    void update() noexcept
    {
        n = direction (params.normal);
    }

    void adopt (const Plane& old) noexcept { last = old.last; }

    Claims claims() const
    {
        return { .passive = true, .stiffness = settings.law ? settings.law.steepest() : params.stiffness, .damping = params.damping };
    }

    Outputs tick (const Inputs& in) noexcept
    {
        const double depth = params.offset - n.dot (in.position);
        const double rate = last.known ? (depth - last.depth) / dt : 0.0;
        const bool inside = depth > 0.0, onset = inside && last.known && last.depth <= 0.0;

        const double elastic = inside ? std::max (0.0, law (depth)) : 0.0;
        const double N = inside ? std::max (0.0, elastic * (1.0 + params.dissipation * rate) + params.damping * rate) : 0.0;

        const Outputs out {
            .force = N * n,
            .resistance = N,
            .depth = depth,
            .hit = onset ? rate : 0.0,
            .stored_energy = inside ? energy (depth) : 0.0,
            .state = inside ? 1.0 : 0.0,
        };
        if (n.isZero (0.0) || ! isFinite (in.position, depth, rate, out.force, out.resistance, out.stored_energy))
        {
            last = {};
            return { .state = -1.0 };
        }
        last = { .depth = depth, .known = true };
        return out;
    }

private:
    double law (double depth) const noexcept { return settings.law ? settings.law (depth) : params.stiffness * depth; }
    double energy (double depth) const noexcept { return settings.law ? settings.law.energy (depth) : 0.5 * params.stiffness * depth * depth; }

    struct Sample
    {
        double depth = 0.0;
        bool known = false;   // false until the first finite sample
    };

    Vec3 n = Vec3::UnitZ();
    double dt = 1.0 / Setup {}.rate_hz;   // s
    Sample last;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Plane);
