// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

#include <algorithm>
#include <sstream>
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

    Params params;
    Settings settings;

    std::string problem() const;

    void adopt (const Blade& old) noexcept
    {
        sample = old.sample;
        if (sample.touching) sample.material = read (old.sample.material.params);
    }

    /// `law` is only felt up to rupture, and `cracked_law` only up to the start of cutting.
    Claims claims() const
    {
        const Material m = read (params);
        return { .passive = true, .stiffness = std::max (settings.law.steepest (m.d_rupture), cracked().steepest (m.e_cut)) };
    }

    Outputs tick (const Inputs&) noexcept;

private:
    static constexpr double eps_cut = 1e-9;   // relative; keeps steady cutting away from the branch point

    /// Derived from the params that were read when the blade touched.
    struct Material
    {
        Params params;
        double cost = 0.0;        // energy per metre of crack, J_c w, in N
        double last = inf;        // length of the crack at which the sample falls in two, in m
        double e_cut = inf;       // the crack grows while the blade is further than this beyond its tip, in m
        double d_rupture = inf;   // depth at which a virgin sample bursts, m
        double burst = 0.0;       // length of the crack right after the burst, in m
        double loss = 0.0;        // energy lost in the burst, in J
    };

    struct Sample
    {
        Material material;
        bool touching = false, virgin = true, in_two = false;
        double crack = 0.0, dissipated = 0.0;   // m, J
    };

    const Law& cracked() const noexcept { return settings.cracked_law ? settings.cracked_law : settings.law; }

    Material read (const Params&) const noexcept;
    double burstLength (const Material&) const noexcept;
    static double stateOf (const Sample&, double depth) noexcept;
    bool burst (Sample&, double depth) const noexcept;
    bool cut (Sample&, double depth) const noexcept;
    Outputs answer (const Sample&, double depth, double state) const noexcept;
    Outputs fault() noexcept;

    Sample sample;
};

//==============================================================================
// Implementation below.

inline std::string Blade::problem() const
{
    const double cost = params.width * params.toughness;
    const double d = settings.law.inverse (params.rupture_force);

    std::ostringstream text;
    if (! settings.law.rises() || ! cracked().rises())
        text << (settings.law.rises() ? "cracked_law" : "law") << " must not fall with depth";
    else if (params.rupture_force < cost * (1.0 - eps_cut))
        text << "rupture_force is " << params.rupture_force << " N; it must be at least width times toughness, which is " << cost << " N";
    else if (isFinite (d) && cracked().energy (d) > settings.law.energy (d) * (1.0 + eps_cut))
        text << "at rupture, " << d << " m deep, cracked_law stores " << cracked().energy (d)
             << " J; it must not store more than law does, " << settings.law.energy (d) << " J";
    return text.str();
}

inline Blade::Outputs Blade::tick (const Inputs& in) noexcept
{
    const double depth = in.depth;
    if (! isFinite (depth)) return fault();

    Sample now = sample;
    const bool touching = ! now.in_two && depth > now.crack;
    if (touching && ! now.touching)
    {
        now.material = read (params);
        now.in_two = now.crack >= now.material.last;
    }
    now.touching = touching;

    bool bursts = false, cuts = false;
    if (touching && ! now.in_two)
    {
        bursts = burst (now, depth);
        cuts = cut (now, depth);
    }
    double state = stateOf (now, depth);
    if (bursts)
        state = 2.0;
    else if (cuts && ! now.in_two)
        state = 4.0;

    const Outputs out = answer (now, depth, state);
    if (! isFinite (out.resistance, out.crack, out.stored_energy, out.dissipated_energy)) return fault();
    sample = now;
    return out;
}

inline double Blade::stateOf (const Sample& s, double depth) noexcept
{
    if (s.in_two) return 5.0;
    if (! (depth > s.crack)) return 0.0;
    return s.virgin ? 1.0 : 3.0;
}

/// The outputs by branches 1, 3, 5 and 6, and by branch 4, whose force is g1 (e_c).
inline Blade::Outputs Blade::answer (const Sample& s, double depth, double state) const noexcept
{
    const Law& law = s.virgin ? settings.law : cracked();
    const double e = s.in_two ? 0.0 : depth - s.crack;
    return {
        .resistance = law (e),
        .crack = s.crack,
        .stored_energy = law.energy (e),
        .dissipated_energy = s.dissipated,
        .state = state,
    };
}

/// Branch 2.
inline bool Blade::burst (Sample& s, double depth) const noexcept
{
    const Material& m = s.material;
    if (! s.virgin || ! (depth >= m.d_rupture)) return false;
    s.virgin = false;
    s.crack = m.burst;
    s.dissipated += m.loss;
    s.in_two = s.crack >= m.last;
    return true;
}

/// Branch 4. When the crack reaches the end of the sample, the sample falls in two, and the pieces spring back.
inline bool Blade::cut (Sample& s, double depth) const noexcept
{
    const Material& m = s.material;
    const double tip = std::min (depth - m.e_cut, m.last);
    if (s.virgin || s.in_two || ! (depth - s.crack > m.e_cut * (1.0 + eps_cut)) || ! (tip > s.crack)) return false;
    s.dissipated += m.cost * (tip - s.crack);
    s.crack = tip;
    s.in_two = tip >= m.last;
    if (s.in_two) s.dissipated += cracked().energy (m.e_cut);
    return true;
}

inline Blade::Material Blade::read (const Params& p) const noexcept
{
    const double cost = p.width * p.toughness;
    Material m { .params = p, .cost = cost, .last = p.thickness > 0.0 ? p.thickness : inf, .e_cut = cracked().inverse (cost) };

    const double d = settings.law.inverse (std::max (p.rupture_force, cost)), stored = settings.law.energy (d);
    if (! isFinite (d, stored, cost) || cracked().energy (d) > stored * (1.0 + eps_cut)) return m;
    m.d_rupture = d;
    m.burst = std::min (burstLength (m), m.last);
    m.loss = m.burst >= m.last ? stored : std::max (0.0, stored - cracked().energy (d - m.burst));
    return m;
}

/// The largest root c of h (c) = G0 (d_r) - G1 (d_r - c) - J_c w c, at most d_r. Because g1 rises, h is concave with its maximum
/// at d_r - e_c, so Newton's steps from beyond the root come down to it and never pass it.
inline double Blade::burstLength (const Material& m) const noexcept
{
    const double stored = settings.law.energy (m.d_rupture);
    const auto left = [&] (double c) { return stored - cracked().energy (m.d_rupture - c) - m.cost * c; };

    const double top = std::max (0.0, m.d_rupture - m.e_cut);
    if (! (left (top) > 0.0)) return top;

    double c = m.d_rupture;
    for (int i = 0; i < 100; ++i)
    {
        const double short_of = -left (c), slope = m.cost - cracked() (m.d_rupture - c);
        if (! (short_of > 0.0) || ! (slope > 0.0)) break;
        const double next = std::max (top, c - short_of / slope);
        if (! (next < c)) break;
        c = next;
    }
    return c;
}

inline Blade::Outputs Blade::fault() noexcept
{
    sample.touching = false;
    return { .crack = sample.crack, .dissipated_energy = sample.dissipated, .state = -1.0 };
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Blade);
