// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/cutting.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
#include <string>

namespace tactus::nodes
{

/// A blade pushed into a sample, which yields, bursts open, and is cut.
///
/// The blade is delta deep below the undeformed surface; the crack it has opened is c long. The uncut part of the sample stores
/// energy. A crack grows when its growth releases the energy of the new surface, J_c per square metre:
///
///     virgin     f = g0 (delta)                                   reversible, up to rupture_force           branch 1
///     rupture    at delta = d_r = g0^-1 (rupture_force) the crack jumps from 0 to c1, the largest root of   branch 2
///                G0 (d_r) = G1 (d_r - c1) + J_c w c1              G0, G1 the energies of g0, g1
///     elastic    f = g1 (e), e = delta - c; 0 for e <= 0          reversible, the crack stays as it is      branches 3, 5, 6
///     cutting    e > e_c = g1^-1 (J_c w): c = delta - e_c         at the force J_c w                        branch 4
///
/// g0 is `law`, g1 `cracked_law` (none: the same), w `width`, J_c `toughness`. The new crack costs less than the stored energy,
/// so rupture drops the force below J_c w; the force must rise to J_c w again, and then stays there. This dip is the feel of a
/// knife through a skin.
/// The cutting force does not depend on stiffness. With g0 = g1 = k e the crack jumps by 2 (d_r - e_c).
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 3 and Fig. 6, 7, which only prints the equation
/// J_c a (Ds); Mahvash & Hayward 2001. The balance at rupture is Griffith's.
///
/// Departures from the printed chapter
///  - If even a crack through the whole indentation, c1 = d_r, leaves energy over, that energy is lost.
///  - A crack longer than `thickness` leaves the sample in two pieces: from then on there is no force, and the stored energy
///    is lost.
///  - Cutting by branch 4 always ends exactly on the branch point e = e_c, so it begins only where e exceeds e_c by more than a
///    relative 1e-9.
///
/// Good to know
///  - Time-free: only the movement of the blade counts. A blade that leaves and returns finds its crack again, and feels no force
///    down to the tip of the crack.
///  - One tick may lead from the surface through rupture and far into the sample. It ends where a slow blade would, and
///    dissipated_energy is the same. The state is then 2, whatever else happened.
///  - dissipated_energy is J_c w c plus the losses at rupture and when the sample falls in two. The work of a slow hand is the
///    growth of stored plus dissipated energy.
///  - Params are read when the blade touches. If wires then give values that `problem` would refuse, a rupture_force below J_c w
///    counts as J_c w, and a sample that would have to gain energy to crack does not crack.
///  - Friction on the flanks of the blade is not included: patch a friction node with a normal force proportional to w c.
///  - The force is held between samples, so where its slope is K, it leaks K dp^2 / 2 for a movement dp in one sample: the device
///    needs a damping of at least K T / 2 (section 1).
struct Blade
{
    struct Inputs
    {
        double depth = 0.0;
    };

    struct Params
    {
        double width = 0.02;
        double toughness = 200.0;
        double rupture_force = 6.0;
        double thickness = 0.0;
    };

    struct Settings
    {
        Law law { .kind = Law::Kind::power, .a = 2000.0, .b = 1.0 };
        Law cracked_law {};
    };

    struct Outputs
    {
        double resistance = 0.0;
        double crack = 0.0;
        double stored_energy = 0.0;
        double dissipated_energy = 0.0;
        double state = 0.0;
    };

    static constexpr Info info {
        .id = "cut.blade",
        .name = "Blade",
        .summary = "A blade pressed into a sample, which bursts open and is cut.",
        .source = "Hayward 2007, section 3; Mahvash & Hayward 2001",
        .keywords = "knife scalpel fracture crack",
    };

    static constexpr std::tuple ports {
        input (&Inputs::depth, "depth", unit::metre, "depth of the blade below the undeformed surface"),
        param (&Params::width, "width", unit::metre, "width of the cut, along the edge of the blade",
               { .hard = { 0, inf }, .usual = { 0, 0.1 }, .latch = true }),
        param (&Params::toughness, "toughness", unit::toughness, "J_c, energy per area of new surface",
               { .hard = { 0, inf }, .usual = { 0, 5000 }, .latch = true }),
        param (&Params::rupture_force, "rupture_force", unit::newton, "force that bursts the sample open; at least width times toughness",
               { .hard = { 0, inf }, .usual = { 0, 50 }, .latch = true }),
        param (&Params::thickness, "thickness", unit::metre, "length of the crack at which the sample falls in two; 0: never",
               { .hard = { 0, inf }, .usual = { 0, 0.2 }, .latch = true }),
        setting (&Settings::law, "law", unit::metre, unit::newton, "force against depth while there is no crack"),
        setting (&Settings::cracked_law, "cracked_law", unit::metre, unit::newton, "force against depth beyond the crack; if not given, the same as law"),
        output (&Outputs::resistance, "resistance", unit::newton, "force against the blade"),
        output (&Outputs::crack, "crack", unit::metre, "length of the crack"),
        output (&Outputs::stored_energy, "stored_energy", unit::joule, "elastic energy"),
        output (&Outputs::dissipated_energy, "dissipated_energy", unit::joule, "energy spent on cracks since the start"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 virgin, 2 rupture, 3 elastic with crack, 4 cutting, 5 cut through"),
    };

    static constexpr Appearance appearance {
        .kind = Appearance::Kind::blade, .depth = "depth", .width = "width", .crack = "crack", .thickness = "thickness"
    };

    Params params;
    Settings settings;

    std::string problem() const { return Cutting::problem (params.width, params.toughness, params.rupture_force, settings.law, cracked()); }

    void adopt (const Blade& old) noexcept
    {
        sample = old.sample;
        if (sample.touching) read (sample, old.sample.params);
    }

    /// `law` is only felt up to rupture, and `cracked_law` only up to the start of cutting.
    Claims claims() const
    {
        Sample s;
        read (s, params);
        return { .passive = true, .stiffness = std::max (settings.law.steepest (s.cutting.ruptureDepth()), cracked().steepest (s.cutting.cutStretch())) };
    }

    Outputs tick (const Inputs&) noexcept;

    void serialize (auto& archive) { archive (sample); }

private:
    struct Sample
    {
        Params params;   // as read when the blade last touched the sample
        Cutting cutting;
        Cutting::Crack crack;
        bool touching = false;
        double dissipated = 0.0;   // J
    };

    const Law& cracked() const noexcept { return settings.cracked_law ? settings.cracked_law : settings.law; }

    void read (Sample&, const Params&) const noexcept;
    static double stateOf (const Sample&, double depth) noexcept;
    Outputs fault() noexcept;

    Sample sample;
};

//==============================================================================
// Implementation below.

inline Blade::Outputs Blade::tick (const Inputs& in) noexcept
{
    const double depth = in.depth;
    if (! isFinite (depth)) return fault();

    Sample now = sample;
    const bool touching = ! now.crack.in_two && depth > now.crack.length;
    if (touching && ! now.touching)
    {
        read (now, params);
        now.crack.in_two = now.crack.length >= now.cutting.last();
    }
    now.touching = touching;

    Cutting::Event event;
    if (touching && ! now.crack.in_two) event = now.cutting.press (now.crack, depth, cracked(), now.dissipated);
    double state = stateOf (now, depth);
    if (event.bursts)
        state = 2.0;
    else if (event.cuts && ! now.crack.in_two)
        state = 4.0;

    const Law::Point answer = Cutting::answer (now.crack, depth, settings.law, cracked());
    const Outputs out {
        .resistance = answer.force,
        .crack = now.crack.length,
        .stored_energy = answer.energy,
        .dissipated_energy = now.dissipated,
        .state = state,
    };
    if (! isFinite (out.resistance, out.crack, out.stored_energy, out.dissipated_energy)) return fault();
    sample = now;
    return out;
}

inline void Blade::read (Sample& s, const Params& p) const noexcept
{
    s.params = p;
    s.cutting = { { .cost = p.width * p.toughness, .rupture_force = p.rupture_force, .thickness = p.thickness }, settings.law, cracked() };
}

inline double Blade::stateOf (const Sample& s, double depth) noexcept
{
    if (s.crack.in_two) return 5.0;
    if (! (depth > s.crack.length)) return 0.0;
    return s.crack.virgin ? 1.0 : 3.0;
}

inline Blade::Outputs Blade::fault() noexcept
{
    sample.touching = false;
    return { .crack = sample.crack.length, .dissipated_energy = sample.dissipated, .state = -1.0 };
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Blade);
