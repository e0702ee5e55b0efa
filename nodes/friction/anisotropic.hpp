// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/grained_bristle.hpp>
#include <tactus/kit/tangent_plane.hpp>
#include <tactus/node/node.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace tactus::nodes
{

/// Friction on a grain: velvet, fur, scales, brushed metal. It drags less with the grain than against it, and differently across it. So it also
/// pushes sideways: a tool that is pulled at an angle to the grain is led along it.
///
/// A bristle between tool and surface sticks, stretches and yields as in friction.elasto_plastic. The stretches at which it slides are bounded
/// by two half ellipses, and it slips along the normal n of this bound:
///
///     d = p - c                                     stretch, in the tangent plane; d_g along the grain, d_a across
///     rho (d)^2 = (d_g / s_g)^2 + (d_a / s_a)^2     1 on the bound
///     s_i = (mu_i f_n / sigma) (d_max / d_max0)     s_g: of mu_along if d_g > 0, of mu_against if d_g < 0; s_a: of mu_across
///     d = nearest point of the bound to d~ = p - c, if rho (d~) > 1      adhesion `stick`                    (3)
///     c <- c + Z (rho) h (dp) A^-1 d                                     the other functions                 (4)
///     f = -sigma d,   sigma = stiffness, or mu0 reference_load / d_max0
///
/// Z = zeta d_max is the adhesion function of friction.elasto_plastic over rho; A = diag (s_g^2, s_a^2); h (v) = |A^(1/2) v| is the largest d . v
/// that the bound allows. A^-1 d points along n. While the tool slides in the direction v, the force is
///
///     f = -f_n (mu_g^2 v_g, mu_across^2 v_a) / |(mu_g v_g, mu_across v_a)|,   mu_g = mu_along if v_g > 0, else mu_against
///
/// This is the force within the bound that costs the motion most. With mu_along 0.3 and mu_across 0.45, a slide at 45 degrees between both feels
/// 0.382 N against it and 0.147 N towards the grain, for each newton of load; between against (0.6) and across, 0.530 and 0.148 N. With three
/// equal coefficients this is friction.elasto_plastic with `load: bound`, bit for bit.
///
/// mu0 is the largest of the three coefficients in file and knobs at the touch, and d_max0 is d_max there, both without wires. So d_max is the
/// longest of the stretches, at the load `reference_load`.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 2, eq. (3) and (4), where zeta is a function of the stretch; the bound and
/// its flow rule: Michalowski & Mroz 1978, Goyal, Ruina & Papadopoulos 1991.
///
/// Departures from the printed chapter
///  - The chapter does not say how zeta depends on the direction. The ellipse and its two halves are our choice; they need three numbers.
///  - In eq. (4) a slip shortens the stretch without turning it. Friction would then act exactly against the motion, and no grain would ever lead
///    the hand. Here a slip goes along the normal of the bound.
///  - The other functions solve eq. (4) over each step with Z held, as friction.elasto_plastic does. Where a turn of the path would take the
///    stretch out of the bound, it is put back to the nearest point.
///  - All those of friction.elasto_plastic, except that the load only moves the bound here: no other rule is passive and stays in place.
///
/// Good to know
///  - Passive for every path, load, grain, normal and coefficient: a slip along the normal of a convex bound around 0 never lengthens the stretch,
///    and sigma is constant while the tool touches.
///  - Time-free, like friction.elasto_plastic, and with the same energies.
///  - `grain` is a direction in space; its part in the tangent plane counts. With the grain, the tool moves towards `grain`. A grain
///    along the normal, or of length 0, has no direction: then mu_across holds in every direction.
///  - If the grain turns while the tool touches, the stretch stays, and slips where it is now longer than allowed.
///  - The slope of the force is at most sigma with function 1, because the nearest point of a convex bound moves no farther than the tool, and at
///    most (1 + q) sigma with functions 2 to 4, where q is the ratio of two coefficients. `claims` counts this. But the held force leaks no more
///    than that of a spring of sigma, or of 2 sigma with functions 2 to 4, so a damping of sigma T / 2, or sigma T, is enough (section 1).
///  - With a coefficient of 0, a tool that moves in that direction slides freely, and one that moves at an angle to it feels only the part of
///    the friction across.
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
        .summary = "Drags less with the grain than against it, and leads the hand along it: velvet, fur, brushed metal.",
        .source = "Hayward 2007, section 2, eq. (4); Michalowski & Mroz 1978",
        .keywords = "orthotropic anisotropic directional nap pile brush scales rub stick slip",
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
        const auto [least, most] = std::minmax ({ params.mu_along, params.mu_against, params.mu_across });
        const double steepest = params.adhesion == Adhesion::stick ? 1.0 : 1.0 + (least == most ? 1.0 : most / least);
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

    void serialize (auto& archive) { archive (contact, dissipated); }

private:
    static constexpr double shortest = 1e-30;   // m; replaces a bound of 0, because the bristle divides by the bound

    using Vec2 = FrictionBound::Vec2;

    /// The grain in the plane where d is kept, and the bound.
    struct Grain
    {
        Vec3 along = Vec3::Zero(), across = Vec3::Zero();   // unit vectors; 0 if the grain has no direction
        FrictionBound bound {};

        bool operator== (const Grain&) const = default;

        Vec2 of (const Vec3& v) const noexcept { return { v.dot (along), v.dot (across) }; }
        Vec3 in (const Vec2& v) const noexcept { return v.x() * along + v.y() * across; }
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
        Grain grain {};
        Bristle bristle {};   // with the lengths of the bound across the grain

        double stored() const noexcept { return 0.5 * sigma * d.squaredNorm(); }
    };

    /// The stiffness that a contact keeps until it opens.
    double stiffnessAtTouch (const Params& stored) const noexcept
    {
        if (params.stiffness > 0.0) return params.stiffness;
        return std::max ({ stored.mu_along, stored.mu_against, stored.mu_across }) * params.reference_load / stored.d_max;
    }

    Grain grainOf (const Inputs& in) const noexcept
    {
        const auto& c = contact;
        const auto reach = [&] (double mu) {
            const double slides = mu * in.normal_force / c.sigma * (params.d_max / c.d_max0);
            return c.sigma > 0.0 ? std::max (shortest, slides) : shortest;
        };
        Grain grain { .along = direction (c.plane.kept (direction (in.grain))) };
        grain.across = c.plane.home.cross (grain.along);
        grain.bound = { reach (params.mu_along), reach (params.mu_against), reach (params.mu_across) };
        if (grain.along.isZero (0.0)) grain.bound.with = grain.bound.against = grain.bound.side;
        return grain;
    }

    /// The bristle with the lengths of Fig. 2 for a bound of this length.
    Bristle scaled (double reach) const noexcept
    {
        Bristle bristle = contact.bristle;
        bristle.d_max = reach;
        bristle.d_stick = params.static_ratio * reach;
        bristle.d_ba = params.break_away * reach;
        return bristle;
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

        // Changes since the last sample take effect where the tool was, before it moves.
        const Bristle bristle_before = c.bristle;
        const Grain grain_before = c.grain;
        c.grain = grainOf (in);
        c.bristle = scaled (c.grain.bound.side);
        const bool is_round = c.grain.bound.isCircle();
        const Bristle unit = scaled (1.0);
        const GrainedBristle grained { c.grain.bound, unit };
        bool slips = false;
        if (is_round)
        {
            if (c.bristle.d_max < bristle_before.d_max || c.bristle.d_stick < bristle_before.d_stick) slips = c.bristle.letGo (c.d);
        }
        else if (c.grain != grain_before || c.bristle.d_stick != bristle_before.d_stick || c.bristle.d_ba != bristle_before.d_ba)
        {
            const auto step = grained.letGo (c.grain.of (c.d));
            slips = step.slips;
            if (slips) c.d = c.grain.in (step.d);
        }
        const double released = c.energy - c.stored();

        const Vec3 dp = c.plane.kept (in.position - c.p);
        double loss = 0.0;
        if (is_round)
        {
            const auto step = c.bristle.stretch (c.d, dp);
            c.d = step.d;
            loss = step.loss;
            slips = slips || step.slips;
        }
        else
        {
            const auto step = grained.stretch (c.grain.of (c.d), c.grain.of (dp));
            c.d = step.slips ? c.grain.in (step.d) : Vec3 { c.d + dp };
            loss = step.loss;
            slips = slips || step.slips;
        }
        c.p = in.position;

        const Vec3 d = c.plane.shown (c.d);
        c.plane.settle (c.d, d);
        c.energy = c.stored();
        out = {
            .force = -c.sigma * d,
            .deflection = d,
            .stored_energy = c.energy,
            .dissipated_energy = dissipated + (released + c.sigma * loss),
            .state = slips ? 2.0 : 1.0,
        };
        return isFinite (c.sigma, c.grain.bound.with, c.grain.bound.against, c.grain.bound.side, dp.squaredNorm(), out.force, out.deflection,
                         out.stored_energy, out.dissipated_energy);
    }

    Contact contact;
    double dissipated = 0.0;   // J
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Anisotropic);
