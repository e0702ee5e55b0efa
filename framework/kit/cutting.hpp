// SPDX-License-Identifier: MIT
#pragma once

#include "law.hpp"
#include "vec3.hpp"

#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace tactus
{

/// The law of cut.blade: how a sample yields, bursts open and is cut. The blade is at the depth delta below the undeformed surface, and
/// the crack has the length c. For the sources see nodes/cut/blade.hpp.
///
///     virgin     f = g0 (delta), until delta = d_r, where g0 is rupture_force                                  branch 1
///     rupture    the crack jumps from 0 to the largest root of G0 (d_r) = G1 (d_r - c) + R c, or to d_r        branch 2
///     elastic    f = g1 (e), e = delta - c, while e is at most e_c, where g1 is R                              branches 3, 5, 6
///     cutting    c = delta - e_c, at the force R                                                               branch 4
///
/// G0 and G1 are the energies of g0 and g1. R is the energy per metre of crack, J_c w. When the crack is as long as the sample is
/// thick, the sample is cut through: there is no force from then on, and the stored energy is lost.
class Cutting
{
public:
    struct Sample
    {
        double cost = 0.0;            ///< R, in N
        double rupture_force = 0.0;   ///< in N; a value below R counts as R
        double thickness = 0.0;       ///< in m; 0: the sample is never cut through
    };

    struct Crack
    {
        double length = 0.0;   ///< in m
        bool virgin = true, in_two = false;
    };

    /// The events while the blade moved to a depth.
    struct Event
    {
        bool bursts = false, cuts = false;
    };

    Cutting() = default;

    /// `law` is g0, `cracked` is g1. A sample that would have to gain energy to crack does not crack.
    Cutting (const Sample&, const Law& law, const Law& cracked) noexcept;

    /// Moves the blade to a depth below the surface, through rupture and cutting if necessary. The crack ends where it would with a
    /// slow blade. Adds the lost energy to `dissipated`, in J.
    Event press (Crack&, double depth, const Law& cracked, double& dissipated) const noexcept;

    /// Force in N and elastic energy in J. This covers branch 4 too: once the crack has followed, the force is g1 (e_c).
    static Law::Point answer (const Crack&, double depth, const Law& law, const Law& cracked) noexcept;

    double last() const noexcept { return end; }                 ///< length of the crack at which the sample is cut through, in m
    double cutStretch() const noexcept { return e_cut; }         ///< e_c, in m
    double ruptureDepth() const noexcept { return d_rupture; }   ///< d_r, in m

    /// The problem of a sample and its laws, as a sentence; empty if there is none. [main thread]
    static std::string problem (double width, double toughness, double rupture_force, const Law& law, const Law& cracked);

    void serialize (auto& archive) { archive (cost, end, e_cut, d_rupture, first, loss); }

private:
    static constexpr double eps_cut = margin (1e-9);   // relative; a cut ends exactly at e_c, and rounding there must not continue it
    static constexpr double inf = std::numeric_limits<double>::infinity();

    double burstLength (const Law& law, const Law& cracked) const noexcept;
    bool burst (Crack&, double depth, double& dissipated) const noexcept;
    bool cut (Crack&, double depth, const Law& cracked, double& dissipated) const noexcept;

    double cost = 0.0;        // N
    double end = inf;         // m
    double e_cut = inf;       // the crack grows if the blade is further than this beyond the tip of the crack, in m
    double d_rupture = inf;   // depth at which a virgin sample bursts, m
    double first = 0.0;       // length of the crack right after the burst, in m
    double loss = 0.0;        // energy lost in the burst, in J
};

//==============================================================================
// Implementation below.

inline Cutting::Cutting (const Sample& s, const Law& law, const Law& cracked) noexcept
    : cost (s.cost), end (s.thickness > 0.0 ? s.thickness : inf), e_cut (cracked.inverse (s.cost))
{
    const double d = law.inverse (std::max (s.rupture_force, cost)), stored = law.energy (d);
    if (! isFinite (d, stored, cost) || cracked.energy (d) > stored * (1.0 + eps_cut)) return;
    d_rupture = d;
    first = std::min (burstLength (law, cracked), end);
    loss = first >= end ? stored : std::max (0.0, stored - cracked.energy (d - first));
}

inline Cutting::Event Cutting::press (Crack& c, double depth, const Law& cracked, double& dissipated) const noexcept
{
    const bool bursts = burst (c, depth, dissipated);
    return { .bursts = bursts, .cuts = cut (c, depth, cracked, dissipated) };
}

inline Law::Point Cutting::answer (const Crack& c, double depth, const Law& law, const Law& cracked) noexcept
{
    const Law& now = c.virgin ? law : cracked;
    const double e = c.in_two ? 0.0 : depth - c.length;
    return { now (e), now.energy (e) };
}

/// Branch 2.
inline bool Cutting::burst (Crack& c, double depth, double& dissipated) const noexcept
{
    if (! c.virgin || ! (depth >= d_rupture)) return false;
    c.virgin = false;
    c.length = first;
    dissipated += loss;
    c.in_two = c.length >= end;
    return true;
}

/// Branch 4. When the crack reaches the end of the sample, the sample is cut through, and the pieces spring back.
inline bool Cutting::cut (Crack& c, double depth, const Law& cracked, double& dissipated) const noexcept
{
    const double tip = std::min (depth - e_cut, end);
    if (c.virgin || c.in_two || ! (depth - c.length > e_cut * (1.0 + eps_cut)) || ! (tip > c.length)) return false;
    dissipated += cost * (tip - c.length);
    c.length = tip;
    c.in_two = tip >= end;
    if (c.in_two) dissipated += cracked.energy (e_cut);
    return true;
}

/// The largest root c of h (c) = G0 (d_r) - G1 (d_r - c) - R c, at most d_r. Because g1 rises, h is concave with its maximum
/// at d_r - e_c. So Newton's method, started beyond the root, comes down to the root and never passes it.
inline double Cutting::burstLength (const Law& law, const Law& cracked) const noexcept
{
    const double stored = law.energy (d_rupture);
    const auto left = [&] (double c) { return stored - cracked.energy (d_rupture - c) - cost * c; };

    const double top = std::max (0.0, d_rupture - e_cut);
    if (! (left (top) > 0.0)) return top;

    double c = d_rupture;
    for (int i = 0; i < 100; ++i)
    {
        const double short_of = -left (c), slope = cost - cracked (d_rupture - c);
        if (! (short_of > 0.0) || ! (slope > 0.0)) break;
        const double next = std::max (top, c - short_of / slope);
        if (! (next < c)) break;
        c = next;
    }
    return c;
}

inline std::string Cutting::problem (double width, double toughness, double rupture_force, const Law& law, const Law& cracked)
{
    const double cost = width * toughness;
    const double d = law.inverse (rupture_force);

    if (! law.rises() || ! cracked.rises()) return std::string (law.rises() ? "cracked_law" : "law") + " must not fall with depth";
    if (rupture_force < cost * (1.0 - eps_cut))
        return "rupture_force is " + roundedText (rupture_force) + " N; it must be at least width times toughness, which is " + roundedText (cost) + " N";
    if (isFinite (d) && cracked.energy (d) > law.energy (d) * (1.0 + eps_cut))
        return "at rupture, " + roundedText (d) + " m deep, cracked_law stores " + roundedText (cracked.energy (d))
               + " J; it must not store more than law does, " + roundedText (law.energy (d)) + " J";
    return {};
}

}   // namespace tactus
