// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/bristle.hpp>
#include <tactus/kit/tangent_plane.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
#include <array>
#include <tuple>

namespace tactus::nodes
{

/// Friction of a soft round tip, which slips little by little: first at its rim, then farther and farther inwards, and in the end as a whole.
///
/// Under a constant load f_n, a tip that is pulled sideways by s from rest is held by the force of Cattaneo and Mindlin:
///
///     f = mu f_n (1 - (1 - s / s_max)^1.5),   s <= s_max     then mu f_n
///     f = f_r - 2 mu f_n (1 - (1 - |s_r - s| / (2 s_max))^1.5)     after a reversal at s_r and f_r (Masing's rule)
///
/// So it is stiffest at the start and after each reversal, and loses energy in the smallest strokes, without sliding. A stack of six bristles in
/// parallel has this force to within 0.26 % of mu f_n, and to within 0.76 % after reversals. Each sticks and slips as in
/// friction.elasto_plastic with adhesion `stick` and load `bound`:
///
///     f   = -sigma sum_i w_i d_i,   sigma = stiffness, or mu0 reference_load / s_max
///     d_i = d~_i min (1, b_i S / |d~_i|),   d~_i = p - c_i,   S = mu f_n / sigma
///
/// with the constants b_i and w_i below, sum_i w_i b_i = 1. mu0 is mu in file and knobs at the touch, without wires.
///
/// Source: Cattaneo 1938; Mindlin 1949; Mindlin & Deresiewicz 1953; the stack: Masing 1926, Iwan 1966. Hayward, "Physically-Based Haptic
/// Synthesis" (2007), section 2, eq. (3), for each bristle.
///
/// Departures from the sources
///  - The load moves only the bounds: S is proportional to f_n, and the stiffness is constant. The sideways stiffness of a sphere grows as
///    f_n^(1/3), and its s_max as f_n^(2/3); this is not followed, because a stiffness that grows under a stretched contact would have to
///    know which part of it is new. At the load `reference_load` all are the same. Under a load that changes, the force is that of the stack: a
///    bristle keeps its stretch when the load rises, and slips to its new bound when the load falls below it.
///  - The slope at s = 0 is 1.44 mu f_n / s_max instead of 1.5.
///  - The theory is for pulls along a line. Here each stretch lies in the tangent plane, and slips towards the tool.
///
/// Good to know
///  - Passive for every path, load, normal and mu: so is each bristle, and sigma is constant while the tool touches.
///  - Time-free. A tool at rest feels a constant force. A tremor that stays below the slip of a bristle does not move it, so the contact does
///    not walk.
///  - For a sphere pressed into a body, s_max = 3 mu f_n / (16 a G*), with the radius a of the contact and
///    1 / G* = (2 - nu_1) / (4 G_1) + (2 - nu_2) / (4 G_2) (Johnson 1985). For a rigid sphere this is mu (2 - nu) / (2 (1 - nu)) times its depth.
///  - `state` is 1 while at least one bristle holds, and 2 on samples on which all slip.
///  - The force is held between samples, so the device needs a damping of at least 1.44 sigma T / 2 (section 1).
///  - The tangent plane turns with the normal as in friction.elasto_plastic. Energies are counted as there.
struct PartialSlip
{
    struct Inputs
    {
        Position position = Position::Zero();
        Vec3 normal = Vec3::UnitZ();
        double normal_force = 1.0;
    };

    struct Params
    {
        double mu = 0.5;
        double s_max = 1e-3;
        double stiffness = 0.0;
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
        .id = "friction.partial_slip",
        .name = "Friction of a soft tip",
        .summary = "Slips from the rim inwards before it slides: a fingertip, a rubber ball.",
        .source = "Cattaneo 1938; Mindlin 1949; Hayward 2007, section 2, eq. (3)",
        .keywords = "mindlin cattaneo iwan masing micro slip stick finger rubber",
    };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        input (&Inputs::normal, "normal", unit::gain, "direction out of the surface; any length but 0"),
        input (&Inputs::normal_force, "normal_force", unit::newton, "force f_n of the tool into the surface; 0 or less opens the contact"),
        param (&Params::mu, "mu", unit::gain, "friction coefficient", { .hard = { 0, inf }, .usual = { 0, 2 } }),
        param (&Params::s_max, "s_max", unit::metre, "sideways move from rest at which the whole contact slides, at the load reference_load",
               { .hard = { 1e-9, inf }, .usual = { 1e-6, 1e-2 } }),
        param (&Params::stiffness, "stiffness", unit::stiffness, "mean stiffness sigma up to s_max; 0: mu times reference_load / s_max",
               { .hard = { 0, inf }, .usual = { 0, 1e5 } }),
        param (&Params::reference_load, "reference_load", unit::newton, "load at which the contact slides at s_max, if there is no stiffness",
               { .hard = { 1e-9, inf }, .usual = { 0.1, 10 } }),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::deflection, "deflection", unit::metre, "mean stretch of the bristles, -force / sigma"),
        output (&Outputs::stored_energy, "stored_energy", unit::joule, "energy in the stretch"),
        output (&Outputs::dissipated_energy, "dissipated_energy", unit::joule, "energy turned into heat since the start"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 stuck or partly slipping, 2 slipping as a whole"),
    };

    static constexpr Appearance appearance { .kind = Appearance::Kind::contact, .tool = "position", .normal = "normal", .stretch = "deflection" };

    /// One bristle of the stack.
    struct Element
    {
        double bound;    ///< where it slips, over the bound of the whole contact
        double weight;   ///< its stiffness over sigma
    };

    /// The polygon with six sides from (0, 0) to (1, 1) that is nearest to 1 - (1 - x)^1.5; it is off by 0.0025216 at most. `bound` are its corners,
    /// and `weight` is how much its slope falls there. The last weight makes the sum of weight times bound 1.
    static constexpr std::array<Element, 6> stack = [] {
        std::array<Element, 6> all { { { 0.193218312512252, 0.183599604136652 },
                                       { 0.405252159794530, 0.198179602274617 },
                                       { 0.599775761491485, 0.218900517988660 },
                                       { 0.772879501918572, 0.252523482000644 },
                                       { 0.917231877436259, 0.327639333644924 } } };
        double rest = 1.0;
        for (std::size_t i = 0; i + 1 < all.size(); ++i)
            rest -= all[i].weight * all[i].bound;
        all.back() = { 1.0, rest };
        return all;
    }();

    /// The stiffness of the contact while all bristles stick, over sigma.
    static constexpr double stiffest = [] {
        double sum = 0.0;
        for (const auto& element : stack)
            sum += element.weight;
        return sum;
    }();

    Params params;

    void adopt (const PartialSlip& old) noexcept
    {
        contact = old.contact;
        dissipated = old.dissipated;
    }

    Claims claims() const { return { .passive = true, .stiffness = stiffest * stiffnessAtTouch (params) }; }

    Outputs tick (const Inputs& in) noexcept { return tick (in, params); }

    Outputs tick (const Inputs& in, const Params& stored) noexcept
    {
        const bool is_number = isFinite (in.position, in.normal, in.normal_force), opens = is_number && in.normal_force <= 0.0;
        const double total = dissipated + contact.energy;

        Outputs out;
        if (is_number && ! opens && ! in.normal.isZero (0.0) && follow (out, in, stored))
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

    /// The state from one sample to the next. Only `touching` counts while the tool does not touch.
    struct Contact
    {
        bool touching = false;
        Position p = Position::Zero();   // position of the tool
        TangentPlane plane {};
        std::array<Vec3, stack.size()> stretches = unstretched();   // d_i, in the plane's home
        double sigma = 0.0;                                         // N/m
        double energy = 0.0;                                        // in the stretches, in J

        static std::array<Vec3, stack.size()> unstretched() noexcept
        {
            std::array<Vec3, stack.size()> all;
            all.fill (Vec3::Zero());
            return all;
        }
    };

    /// The stiffness that a contact keeps until it opens.
    double stiffnessAtTouch (const Params& stored) const noexcept
    {
        return params.stiffness > 0.0 ? params.stiffness : stored.mu * params.reference_load / stored.s_max;
    }

    /// The contact follows the tool. False if a result is not finite.
    bool follow (Outputs& out, const Inputs& in, const Params& stored) noexcept
    {
        const bool begins = ! contact.touching;
        if (begins) contact = { .p = in.position, .sigma = stiffnessAtTouch (stored) };
        auto& c = contact;
        c.plane.turn (in.normal, begins);
        const double bound = c.sigma > 0.0 ? params.mu * in.normal_force / c.sigma : 0.0;
        const Vec3 dp = c.plane.kept (in.position - c.p);
        c.p = in.position;

        Vec3 mean = Vec3::Zero();
        double loss = 0.0, squares = 0.0;
        bool slips = true;
        for (std::size_t i = 0; i < stack.size(); ++i)
        {
            Bristle bristle;
            bristle.adhesion = BristleAdhesion::stick;
            bristle.d_max = bristle.d_stick = std::max (shortest, stack[i].bound * bound);
            const auto step = bristle.stretch (c.stretches[i], dp);
            c.stretches[i] = step.d;
            mean += stack[i].weight * step.d;
            loss += stack[i].weight * step.loss;
            squares += stack[i].weight * step.d.squaredNorm();
            slips = slips && step.slips;
        }

        const Vec3 d = c.plane.shown (mean);
        const auto plane = c.plane;
        for (auto& stretch : c.stretches)
        {
            c.plane = plane;
            c.plane.settle (stretch, plane.shown (stretch));
        }
        c.energy = 0.5 * c.sigma * squares;
        out = {
            .force = -c.sigma * d,
            .deflection = d,
            .stored_energy = c.energy,
            .dissipated_energy = dissipated + c.sigma * loss,
            .state = slips ? 2.0 : 1.0,
        };
        return isFinite (c.sigma, bound, dp.squaredNorm(), out.force, out.deflection, out.stored_energy, out.dissipated_energy);
    }

    Contact contact;
    double dissipated = 0.0;   // J
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::PartialSlip);
