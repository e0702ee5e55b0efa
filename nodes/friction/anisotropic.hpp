// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/bristle.hpp>
#include <tactus/kit/tangent_plane.hpp>
#include <tactus/node/node.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace tactus::nodes
{

/// Friction on a grain: velvet, fur, scales, brushed metal. It drags less with the grain than against it, and differently across it.
///
/// A bristle between tool and surface sticks, stretches and yields as in friction.elasto_plastic, but its adhesion function takes the
/// stretch d as a vector: the direction of d says at which stretch the contact slides.
///
///     d = p - c                                        stretch, in the tangent plane
///     1 / s (d)^2 = (cos / s_g)^2 + (sin / s_a)^2      stretch at which it slides; cos and sin of the angle from the grain to d
///     s_i = (mu_i f_n / sigma) (d_max / d_max0)        s_g: of mu_along if cos > 0, of mu_against if cos < 0; s_a: of mu_across
///     c <- c + |dp| zeta (d) d                         zeta of friction.elasto_plastic, with all lengths in proportion to s (d)   (4)
///     f = -sigma d,   sigma = stiffness, or mu0 reference_load / d_max0
///
/// So a tool that slides at an angle to the grain is pulled back against its motion, with the force f_n mu (angle), where
/// 1 / mu^2 = (cos / mu_along)^2 + (sin / mu_across)^2, or with mu_against on the other side. With three equal coefficients this is
/// friction.elasto_plastic with `load: bound`, bit for bit.
///
/// mu0 is the largest of the three coefficients in file and knobs at the touch, and d_max0 is d_max there, both without wires. So d_max is the
/// longest of the stretches, at the load `reference_load`.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 2, eq. (4), where zeta is a function of the stretch.
///
/// Departures from the printed chapter
///  - The chapter does not say how zeta depends on the direction. The ellipse and its two halves are our choice; they need three numbers.
///  - All those of friction.elasto_plastic, except that the load only moves the bound here: no other rule is passive and stays in place.
///
/// Good to know
///  - Passive for every path, load, grain, normal and coefficient: the contact point only ever moves towards the tool, along the stretch, and
///    sigma is constant while the tool touches.
///  - Time-free, like friction.elasto_plastic, and with the same energies.
///  - `grain` is a direction in space; its part in the tangent plane counts. With the grain, the tool moves towards `grain`. A grain
///    along the normal, or of length 0, has no direction: then mu_across holds in every direction.
///  - If the grain turns while the tool touches, the stretch stays, and slips where it is now longer than allowed.
///  - The slope of the force can exceed sigma: sideways on a sliding contact it is up to (q + 1/q) / 2 sigma with function 1, where q is the
///    ratio of two coefficients, and up to (1 + q) sigma with functions 2 to 4. `claims` counts this. But the held force leaks no more than
///    that of a spring of sigma, or of 2 sigma with functions 2 to 4, so a damping of sigma T / 2, or sigma T, is enough (section 1).
///  - With a coefficient of 0, a tool that moves exactly in that direction slides freely, and one that moves at a small angle to it nearly so.
struct Anisotropic
{
    enum class Adhesion
    {
        stick,
        dupont,
        ramp,
        dahl
    };

    struct Inputs
    {
        Position position = Position::Zero();
        Vec3 normal = Vec3::UnitZ();
        Vec3 grain = Vec3::UnitX();
        double normal_force = 1.0;
    };

    struct Params
    {
        double mu_along = 0.3;
        double mu_against = 0.6;
        double mu_across = 0.4;
        double d_max = 1e-4;
        double static_ratio = 1.0;
        double break_away = 0.7;
        double stiffness = 0.0;
        Adhesion adhesion = Adhesion::stick;
        double reference_load = 1.0;
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
        Vec3 deflection = Vec3::Zero();
        double stored_energy = 0.0;
        double dissipated_energy = 0.0;
        double state = 0.0;
    };

    static constexpr Info info {
        .id = "friction.anisotropic",
        .name = "Friction on a grain",
        .summary = "Drags less with the grain than against it: velvet, fur, brushed metal.",
        .source = "Hayward 2007, section 2, eq. (4)",
        .keywords = "anisotropic directional nap pile brush scales rub stick slip",
    };

    static constexpr std::string_view adhesion_names[] { "stick", "dupont", "ramp", "dahl" };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        input (&Inputs::normal, "normal", unit::gain, "direction out of the surface; any length but 0"),
        input (&Inputs::grain, "grain", unit::gain, "direction of the grain; its part in the tangent plane counts"),
        input (&Inputs::normal_force, "normal_force", unit::newton, "force f_n of the tool into the surface; 0 or less opens the contact"),
        param (&Params::mu_along, "mu_along", unit::gain, "friction coefficient with the grain", { .hard = { 0, inf }, .usual = { 0, 2 } }),
        param (&Params::mu_against, "mu_against", unit::gain, "friction coefficient against the grain", { .hard = { 0, inf }, .usual = { 0, 2 } }),
        param (&Params::mu_across, "mu_across", unit::gain, "friction coefficient across the grain", { .hard = { 0, inf }, .usual = { 0, 2 } }),
        param (&Params::d_max, "d_max", unit::metre, "stretch while it slides in the direction of the largest coefficient",
               { .hard = { 1e-9, inf }, .usual = { 1e-6, 1e-2 } }),
        param (&Params::static_ratio, "static_ratio", unit::gain, "d_stick / d_max = mu_s / mu_k; above 1: stick-slip",
               { .hard = { 1, inf }, .usual = { 1, 5 } }),
        param (&Params::break_away, "break_away", unit::gain, "d_ba / d_max, where adhesion dupont begins to yield", { .hard = { 0, 1 } }),
        param (&Params::stiffness, "stiffness", unit::stiffness, "stiffness sigma; 0: the largest coefficient times reference_load / d_max",
               { .hard = { 0, inf }, .usual = { 0, 1e5 } }),
        choice (&Params::adhesion, "adhesion", adhesion_names, "how the contact yields, Fig. 2"),
        param (&Params::reference_load, "reference_load", unit::newton, "load at which the contact slides at d_max, if there is no stiffness",
               { .hard = { 1e-9, inf }, .usual = { 0.1, 10 } }),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::deflection, "deflection", unit::metre, "stretch d of the contact"),
        output (&Outputs::stored_energy, "stored_energy", unit::joule, "energy in the stretch"),
        output (&Outputs::dissipated_energy, "dissipated_energy", unit::joule, "energy turned into heat since the start"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 stuck, 2 slipping"),
    };

    static constexpr Appearance appearance { .kind = Appearance::Kind::contact, .tool = "position", .normal = "normal", .stretch = "deflection" };

    Params params;

    void adopt (const Anisotropic& old) noexcept
    {
        contact = old.contact;
        dissipated = old.dissipated;
    }

    Claims claims() const
    {
        const auto [along, against, across] = coefficients (params);
        const auto slope = [] (double a, double b) { return a == b ? 1.0 : 0.5 * (a / b + b / a); };
        const auto [least, most] = std::minmax ({ along, against, across });
        const double steepest = params.adhesion == Adhesion::stick ? std::max (slope (along, across), slope (against, across))
                                                                   : 1.0 + (least == most ? 1.0 : most / least);
        const double sigma = stiffnessAtTouch (params);
        return { .passive = true, .stiffness = sigma > 0.0 ? steepest * sigma : 0.0 };
    }

    Outputs tick (const Inputs& in) noexcept { return tick (in, params); }

    Outputs tick (const Inputs& in, const Params& stored) noexcept
    {
        const bool is_number = isFinite (in.position, in.normal, in.grain, in.normal_force), opens = is_number && in.normal_force <= 0.0;
        const bool touches = is_number && ! opens && ! in.normal.isZero (0.0);
        const double total = dissipated + contact.energy;

        Outputs out;
        if (touches && follow (out, in, stored))
        {
            contact.touching = true;
            dissipated = out.dissipated_energy;
            return out;
        }
        if (contact.touching && opens && isFinite (total)) dissipated = total;
        contact.touching = false;
        return { .dissipated_energy = dissipated, .state = opens ? 0.0 : -1.0 };
    }

private:
    static constexpr double shortest = 1e-30;   // m; replaces a bound of 0, because the bristle divides by the bound

    using Three = std::array<double, 3>;   // along, against and across the grain

    /// The stretches at which the contact slides, by direction.
    struct Ellipse
    {
        Vec3 along, across;   // unit vectors in the plane where d is kept, or 0 if the grain has no direction
        Three reach {};       // m

        /// 1 / reach^2 = (cos / reach_along)^2 + (sin / reach_across)^2, written so that equal axes give their own length exactly.
        double operator() (const Vec3& d) const noexcept
        {
            const double length = d.norm(), side = reach[2];
            const double x = d.dot (along), y = d.dot (across), line = along.isZero (0.0) ? side : reach[x < 0.0 ? 1 : 0];
            const bool is_long = line > side;
            const double ratio = is_long ? line / side : side / line, share = length > 0.0 ? (is_long ? y : x) / length : 0.0;
            return std::max (shortest, std::max (line, side) / std::sqrt (1.0 + (ratio * ratio - 1.0) * share * share));
        }
    };

    /// The state from one sample to the next. Only `touching` counts while the tool does not touch.
    struct Contact
    {
        bool touching = false;
        Position p = Position::Zero();   // position of the tool
        TangentPlane plane {};
        Vec3 d = Vec3::Zero();   // stretch, in the plane's home
        double sigma = 0.0;      // N/m
        double energy = 0.0;     // in the stretch, in J
        double d_max0 = 0.0;     // d_max in file and knobs at the touch, in m
        Bristle bristle {};      // with the lengths in the direction of d

        double stored() const noexcept { return 0.5 * sigma * d.squaredNorm(); }
    };

    static Three coefficients (const Params& p) noexcept { return { p.mu_along, p.mu_against, p.mu_across }; }

    /// The stiffness that a contact keeps until it opens.
    double stiffnessAtTouch (const Params& stored) const noexcept
    {
        if (params.stiffness > 0.0) return params.stiffness;
        return std::max ({ stored.mu_along, stored.mu_against, stored.mu_across }) * params.reference_load / stored.d_max;
    }

    Ellipse ellipse (const Inputs& in) const noexcept
    {
        const auto& c = contact;
        const Vec3 along = direction (c.plane.kept (direction (in.grain)));
        Ellipse bound { .along = along, .across = c.plane.home.cross (along) };
        const Three mu = coefficients (params);
        for (std::size_t i = 0; i < mu.size(); ++i)
        {
            const double slides = mu[i] * in.normal_force / c.sigma * (params.d_max / c.d_max0);
            bound.reach[i] = c.sigma > 0.0 ? std::max (shortest, slides) : shortest;
        }
        return bound;
    }

    /// Sets the lengths of Fig. 2 for a stretch in this direction.
    void setLengths (double reach) noexcept
    {
        contact.bristle.d_max = reach;
        contact.bristle.d_stick = params.static_ratio * reach;
        contact.bristle.d_ba = params.break_away * reach;
    }

    void begin (const Position& p, const Params& stored) noexcept
    {
        contact = { .p = p, .sigma = stiffnessAtTouch (stored), .d_max0 = stored.d_max };
        constexpr BristleAdhesion functions[] { BristleAdhesion::stick, BristleAdhesion::dupont, BristleAdhesion::ramp, BristleAdhesion::dahl };
        contact.bristle.adhesion = functions[static_cast<std::size_t> (params.adhesion)];
    }

    /// The contact follows the tool. False if a result is not finite.
    bool follow (Outputs& out, const Inputs& in, const Params& stored) noexcept
    {
        const bool begins = ! contact.touching;
        if (begins) begin (in.position, stored);
        auto& c = contact;
        c.plane.turn (in.normal, begins);
        const Ellipse reach = ellipse (in);

        // Changes since the last sample take effect where the tool was, before it moves.
        const Bristle before = c.bristle;
        const double reach_before = reach (c.d);
        setLengths (reach_before);
        bool slips = false;
        if (c.bristle.d_max < before.d_max || c.bristle.d_stick < before.d_stick) slips = c.bristle.letGo (c.d);
        const double released = c.energy - c.stored();

        const Vec3 dp = c.plane.kept (in.position - c.p);
        const double reach_now = reach (c.d + dp);
        setLengths (reach_now);
        const auto step = c.bristle.stretch (c.d, dp, reach_now / reach_before);
        c.p = in.position;
        c.d = step.d;
        setLengths (reach (c.d));

        const Vec3 d = c.plane.shown (c.d);
        c.plane.settle (c.d, d);
        c.energy = c.stored();
        out = {
            .force = -c.sigma * d,
            .deflection = d,
            .stored_energy = c.energy,
            .dissipated_energy = dissipated + (released + c.sigma * step.loss),
            .state = slips || step.slips ? 2.0 : 1.0,
        };
        return isFinite (c.sigma, reach_now, dp.squaredNorm(), out.force, out.deflection, out.stored_energy, out.dissipated_energy);
    }

    Contact contact;
    double dissipated = 0.0;   // J
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Anisotropic);
