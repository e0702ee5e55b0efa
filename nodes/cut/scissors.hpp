// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
#include <numbers>

namespace tactus::nodes
{

/// Scissors that close on a plate. The plate yields a little, then opens along the blades as fast as they close.
///
/// Two straight blades meet at a pivot, opened by theta. A plate of thickness h lies between them, cut up to the crack front at
/// x from the pivot. The squeeze at the front stores energy, and the crack grows when a step of it releases the energy of the
/// new surface, J_c h per metre:
///
///     t = tan (theta / 2),   delta = h / 2 - x t          squeeze; contact while delta > 0
///     U = k delta^2 / 2                                   stored energy
///     T = k delta x / (2 cos^2 (theta / 2))               torque against closing
///     cutting: k delta t > J_c h   ->   x such that k delta t = J_c h, where T = J_c h x / sin (theta)
///
/// So the cutting torque depends on the toughness of the plate and the shape of the scissors, not on stiffness. It rises as the
/// front moves out and the blades become parallel. The force at a handle is T over its length.
///
/// Source: Mahvash & Okamura 2005, whose abstract states that the fracture force depends on toughness and geometry;
/// Hayward, "Physically-Based Haptic Synthesis" (2007), section 3, for the energy balance. The formulas are derived here from
/// that balance for straight blades; neither source prints them in this form.
///
/// Departures
///  - Cutting always ends exactly on its criterion, so it begins only where k delta t exceeds J_c h by more than a relative 1e-9.
///
/// Good to know
///  - Time-free: a step of the angle, however large, cuts as much as slow blades that close by the same angle. Blades that open
///    and close again feel nothing until they are back at the front.
///  - Below t = 4 J_c / k the blades are too parallel to cut: the front stops at k h / (16 J_c), and further closing only
///    squeezes.
///  - The work of a slow hand is the growth of stored_energy plus dissipated_energy; dissipated_energy is J_c h times the
///    distance the front has moved.
///  - At theta <= 0 or >= pi there is no force and no stored energy: closing through 0 releases the squeeze in one step.
///  - Params are read when the blades touch the plate; pivot_distance is ignored after the first cut.
///  - The plate has no end. The blades have no friction and unlimited length.
struct Scissors
{
    struct Inputs
    {
        double angle = 0.0;
    };

    struct Params
    {
        double thickness = 1e-3;
        double toughness = 2800.0;
        double stiffness = 1e6;
        double pivot_distance = 1.5e-3;
    };

    struct Outputs
    {
        double torque = 0.0;
        double crack_front = 0.0;
        double stored_energy = 0.0;
        double dissipated_energy = 0.0;
        double state = 0.0;
    };

    static constexpr Info info {
        .id = "cut.scissors",
        .name = "Scissors",
        .summary = "Scissors that cut a plate; the torque depends on toughness and shape.",
        .source = "after Mahvash & Okamura 2005; Hayward 2007, section 3",
        .keywords = "shears",
    };

    static constexpr std::tuple ports {
        input (&Inputs::angle, "angle", unit::radian, "opening angle theta of the blades"),
        param (&Params::thickness, "thickness", unit::metre, "thickness h of the plate", { .hard = { 0, inf }, .usual = { 0, 0.01 }, .latch = true }),
        param (&Params::toughness, "toughness", unit::toughness, "J_c, energy per area of new surface",
               { .hard = { 0, inf }, .usual = { 0, 5000 }, .latch = true }),
        param (&Params::stiffness, "stiffness", unit::stiffness, "stiffness k of the plate at the crack front",
               { .hard = { 0, inf }, .usual = { 1e4, 1e7 }, .latch = true }),
        param (&Params::pivot_distance, "pivot_distance", unit::metre, "distance from the pivot to the first touch of the plate",
               { .hard = { 0, inf }, .usual = { 0, 0.1 }, .latch = true }),
        output (&Outputs::torque, "torque", unit::torque, "torque against closing"),
        output (&Outputs::crack_front, "crack_front", unit::metre, "distance from the pivot to the end of the cut"),
        output (&Outputs::stored_energy, "stored_energy", unit::joule, "elastic energy"),
        output (&Outputs::dissipated_energy, "dissipated_energy", unit::joule, "energy spent on the crack since the start"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 3 elastic, 4 cutting"),
    };

    static constexpr Appearance appearance {
        .kind = Appearance::Kind::scissors, .angle = "angle", .crack = "crack_front", .thickness = "thickness", .pivot = "pivot_distance"
    };

    Params params;

    void prepare (const Setup&) noexcept { plate = { .front = params.pivot_distance }; }

    void adopt (const Scissors& old) noexcept { plate = old.plate; }

    Claims claims() const { return { .passive = true }; }

    Outputs tick (const Inputs&) noexcept;

    void serialize (auto& archive) { archive (plate); }

private:
    static constexpr double eps_cut = margin (1e-9);   // relative margin: a front exactly at the criterion must not grow by rounding errors

    struct Plate
    {
        Params params {};                 // as read when the blades last touched the plate
        bool touching = false;            // whether the blades touched the plate on the last sample
        bool cut = false;                 // true once the plate has been cut
        double t = -1.0;                  // tan (theta / 2) on the last sample; negative: none, or theta was not between 0 and pi
        double front = 0.0, lost = 0.0;   // m, J

        double squeeze() const noexcept { return 0.5 * params.thickness - front * t; }
    };

    static bool grow (Plate&, double from) noexcept;
    Outputs fault() noexcept;

    Plate plate { .front = Params {}.pivot_distance };
};

//==============================================================================
// Implementation below.

inline Scissors::Outputs Scissors::tick (const Inputs& in) noexcept
{
    if (! isFinite (in.angle)) return fault();

    Plate now = plate;
    const bool between = in.angle > 0.0 && in.angle < std::numbers::pi;
    if (! now.touching)
    {
        now.params = params;
        if (! now.cut) now.front = params.pivot_distance;
    }
    const auto half = math::sinCos (0.5 * in.angle);   // costs less than the tangent, whose last digit does not matter here
    now.t = between ? half.sine / half.cosine : -1.0;
    now.touching = between && now.squeeze() > 0.0;

    const bool cuts = now.touching && grow (now, plate.t);
    const double delta = now.touching ? std::max (0.0, now.squeeze()) : 0.0;
    const double k = now.params.stiffness;

    const double closed = cuts ? 4.0 : 3.0;
    const Outputs out {
        .torque = 0.5 * k * delta * now.front * (1.0 + now.t * now.t),
        .crack_front = now.front,
        .stored_energy = 0.5 * k * delta * delta,
        .dissipated_energy = now.lost,
        .state = now.touching ? closed : 0.0,
    };
    if (! isFinite (out.torque, out.crack_front, out.stored_energy, out.dissipated_energy)) return fault();
    plate = now;
    return out;
}

/// The front that meets the criterion at t, h / (2 t) - J_c h / (k t^2), is furthest out at t = 4 J_c / k. Blades that close past
/// that angle within one step leave the front there.
inline bool Scissors::grow (Plate& p, double from) noexcept
{
    const double h = p.params.thickness, k = p.params.stiffness, price = p.params.toughness * h;
    const double furthest = 4.0 * p.params.toughness / k;
    const double t = from > p.t ? std::clamp (furthest, p.t, from) : p.t;
    const double delta = 0.5 * h - p.front * t;
    if (! (k * delta * t > price * (1.0 + eps_cut))) return false;

    const double front = (0.5 * h - price / (k * t)) / t;
    if (! (front > p.front)) return false;
    p.lost += price * (front - p.front);
    p.front = front;
    p.cut = true;
    return true;
}

inline Scissors::Outputs Scissors::fault() noexcept
{
    plate.touching = false;
    plate.t = -1.0;
    return { .crack_front = plate.front, .dissipated_energy = plate.lost, .state = -1.0 };
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Scissors);
