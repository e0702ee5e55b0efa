// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace tactus::nodes
{

/// Friction that sticks, gives a little, and lets go: the drag of a tool across a surface.
///
/// The tool p is attached to the surface at a contact point c, as if by a short bristle. Pulled sideways, the bristle stretches
/// and the hand feels a spring. Pulled further than d_max, it is dragged along and the hand feels mu f_n. A long d_max feels
/// like rubber or flesh, one of micrometres like steel.
///
///     d = p - c,   dd/dp = 1 - zeta (|d|) sgn (dp) d      the bristle yields by the adhesion function zeta   (1) (2)
///     d = d~ min (1, d_max / |d~|),  d~ = p - c           adhesion `stick`: it yields not at all or fully    (3)
///     c <- c + |dp| zeta d~                               the other functions, by Euler's rule               (4)
///     f = -sigma d,   sigma = mu f_n / d_max              force on the tool, in the tangent plane
///
/// The adhesion functions of Fig. 2, d_stick = static_ratio d_max:
///
///     1 stick    0 up to d_stick, then 1 / d_max: sticks without creep, slides freely
///     2 dupont   0 up to d_ba = break_away d_max, a half sine, 1 / d_max from d_stick on (Dupont et al. 2002)
///     3 ramp     |d| / (d_stick d_max), at most 1 / d_max: creeps under any load, less than Dahl
///     4 dahl     1 / d_max: creeps most
///     curve      your own table of zeta d_max over |d| / d_max, each value in 0…1
///
/// With static_ratio > 1 function 1 sticks up to d_stick and falls back to d_max: stick-slip with the spatial period
/// d_stick - d_max at any speed, and mu_s / mu_k = static_ratio.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 2, eq. (1) to (4) and Fig. 2;
/// Hayward & Armstrong 2000; Dupont, Hayward, Armstrong & Altpeter 2002.
///
/// Departures from the printed chapter
///  - The chapter leaves the first contact point open. Here it is the tool's position at the first touch, so a touch starts
///    without a force.
///  - Eq. (4) lacks a clamp: where |dp| zeta > 1 on a reversal, the force would flip sign. Here |dp| zeta is clamped at 1.
///  - Steady sliding by eq. (3) or (4) ends exactly on the branch point, where rounding would make force and state chatter.
///    Both branches keep away from it by the relative guard 1e-9.
///  - The default for functions 2 to 4 is not eq. (4) but the solution of eq. (2) with zeta held over the step,
///    d = d e^(-zeta |dp|) + dp (1 - e^(-zeta |dp|)) / (zeta |dp|). It needs neither clamp nor projection and is exact for Dahl
///    at any sampling rate. `integrator: euler` gives eq. (4).
///  - With sigma following the load as printed, pressing harder while the bristle is stretched adds energy that comes back on
///    release (1.6e-4 J in 50 strokes; see the test). `load: passive` re-anchors instead: when sigma rises, by load, mu or
///    d_max, the force stays and the stretch shrinks, because new contact area is not sheared yet. `load: scale` is the printed
///    rule.
///  - Eq. (1) to (4) are one-dimensional. Here d and dp are projected on the tangent plane of each sample, so that a turning
///    normal takes the contact point along.
///
/// Good to know
///  - Time-free: only displacement moves the state. A tool at rest feels a constant force forever, and repeating a sample does
///    not change a single bit of the state.
///  - stored_energy is sigma |d|^2 / 2. dissipated_energy is what the bristle has lost since the start, along the straight path
///    between the samples: sigma times the stretch times the slip of c, and everything released when the load falls, the
///    contact re-anchors, the normal turns or the contact opens. So the work of the hand is the growth of stored plus
///    dissipated energy, and dissipated_energy never falls. Under `load: scale` it does fall when the load rises: this is the
///    energy that rule creates. Energy stored when a fault opens the contact is not counted.
///  - The force is held between samples, so while the contact sticks, the device needs a damping of at least sigma T / 2
///    (section 1), or twice that with functions 2 to 4, which are twice as stiff on a reversal.
///  - If the bound shrinks below the stretch, the bristle slips immediately, even at rest. This is how a texture on d_max is
///    felt; keep `stiffness` constant for that.
///  - With functions 2 and 3 and static_ratio > 1, the exponential integrator slides at a stretch between d_max and d_stick,
///    while eq. (4) collapses to d_max and buzzes. Use function 1 for stick-slip.
///  - With a table that never reaches 1, the bristle stretches beyond d_max; with one that ends in 0, without limit.
struct ElastoPlastic
{
    enum class Adhesion
    {
        stick,
        dupont,
        ramp,
        dahl,
        curve
    };

    enum class Integrator
    {
        exponential,
        euler
    };

    enum class Load
    {
        passive,
        scale
    };

    struct Inputs
    {
        Vec3 position = Vec3::Zero();
        Vec3 normal = Vec3::UnitZ();
        double normal_force = 1.0;
    };

    struct Params
    {
        double mu = 0.4;
        double d_max = 1e-4;
        double static_ratio = 1.0;
        double break_away = 0.7;
        double stiffness = 0.0;
        Adhesion adhesion = Adhesion::stick;
        Integrator integrator = Integrator::exponential;
        Load load = Load::passive;
    };

    struct Settings
    {
        Curve adhesion_curve { { 0.0, 0.7, 1.0 }, { 0.0, 0.0, 1.0 } };
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
        .id = "friction.elasto_plastic",
        .name = "Elasto-plastic friction",
        .summary = "Sticks, gives a little, and slides; without drift, at any speed.",
        .source = "Hayward 2007, section 2, eq. (1) to (4)",
    };

    static constexpr std::string_view adhesion_names[] { "stick", "dupont", "ramp", "dahl", "curve" };
    static constexpr std::string_view integrator_names[] { "exponential", "euler" };
    static constexpr std::string_view load_names[] { "passive", "scale" };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        input (&Inputs::normal, "normal", unit::gain, "direction out of the surface; any length but 0"),
        input (&Inputs::normal_force, "normal_force", unit::newton, "force f_n of the tool into the surface; 0 or less opens the contact"),
        param (&Params::mu, "mu", unit::gain, "friction coefficient while sliding", { .hard = { 0, inf }, .usual = { 0, 2 } }),
        param (&Params::d_max, "d_max", unit::metre, "stretch of the contact while it slides", { .hard = { 1e-9, inf }, .usual = { 1e-6, 1e-2 } }),
        param (&Params::static_ratio, "static_ratio", unit::gain, "d_stick / d_max = mu_s / mu_k; above 1: stick-slip",
               { .hard = { 1, inf }, .usual = { 1, 5 } }),
        param (&Params::break_away, "break_away", unit::gain, "d_ba / d_max, where adhesion dupont begins to yield", { .hard = { 0, 1 } }),
        param (&Params::stiffness, "stiffness", unit::stiffness, "stiffness sigma; 0: mu normal_force / d_max; above 0: mu and load have no effect",
               { .hard = { 0, inf }, .usual = { 0, 1e5 } }),
        choice (&Params::adhesion, "adhesion", adhesion_names, "how the contact yields, Fig. 2"),
        choice (&Params::integrator, "integrator", integrator_names, "exponential solves eq. (2) over each step; euler is eq. (4)"),
        choice (&Params::load, "load", load_names, "a rising load re-anchors the contact, or scales its force"),
        setting (&Settings::adhesion_curve, "adhesion_curve", unit::gain, unit::gain, "zeta d_max over |d| / d_max, for adhesion curve"),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::deflection, "deflection", unit::metre, "stretch d of the contact"),
        output (&Outputs::stored_energy, "stored_energy", unit::joule, "energy in the stretch"),
        output (&Outputs::dissipated_energy, "dissipated_energy", unit::joule, "energy turned into heat since the start"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 stuck, 2 slipping"),
    };

    Params params;
    Settings settings;

    std::string problem() const
    {
        const auto inside = [] (double zeta) { return zeta >= 0.0 && zeta <= 1.0; };
        if (settings.adhesion_curve.empty()) return "adhesion_curve needs at least one point";
        if (! std::ranges::all_of (settings.adhesion_curve.y, inside)) return "adhesion_curve must stay between 0 (sticks) and 1 (slides)";
        return {};
    }

    void adopt (const ElastoPlastic& old) noexcept
    {
        contact = old.contact;
        dissipated = old.dissipated;
    }

    /// The stiffness of the contact grows with normal_force without limit unless `stiffness` is given; functions 2 to 4 are twice as
    /// stiff on a reversal.
    Claims claims() const
    {
        return {
            .passive = params.load == Load::passive || params.stiffness > 0.0,
            .stiffness = params.stiffness > 0.0 ? (params.adhesion == Adhesion::stick ? 1.0 : 2.0) * params.stiffness : inf,
        };
    }

    Outputs tick (const Inputs&) noexcept;

private:
    static constexpr double eps_slip = 1e-9;   // relative; keeps steady sliding away from the branch points of eq. (3) and (4)

    /// The state from one sample to the next while the tool touches.
    struct Contact
    {
        bool touching = false;
        Vec3 p = Vec3::Zero(), n = Vec3::UnitZ();   // position of the tool, unit normal
        Vec3 given = Vec3::UnitZ();                 // the normal input, of any length
        Vec3 d = Vec3::Zero();                      // stretch; the contact point is c = p - d
        double sigma = 0.0, d_max = 0.0, d_stick = 0.0;
        Adhesion adhesion {};
        Integrator integrator {};
        Load load {};

        double stored() const noexcept { return 0.5 * sigma * d.squaredNorm(); }
    };

    /// One step along dp: the new stretch, the energy lost on the way divided by sigma, and whether c has moved.
    struct Step
    {
        Vec3 d;
        double loss = 0.0;
        bool slips = false;
    };

    double zeta (double r, Adhesion) const noexcept;
    Step advance (const Vec3& d, const Vec3& dp, const Contact&) const noexcept;
    Step stick (const Vec3& d, const Vec3& dp) const noexcept;
    Step euler (const Vec3& d, const Vec3& dp, Adhesion) const noexcept;
    Step exponential (const Vec3& d, const Vec3& dp, Adhesion) const noexcept;
    bool letGo (Vec3& d, Adhesion) const noexcept;
    Outputs open() noexcept;
    Step drag (double from, const Vec3& d, double r, double hold) const noexcept;
    Outputs fault() noexcept;

    static bool isExact (const Contact& c) noexcept { return c.adhesion != Adhesion::stick && c.integrator == Integrator::exponential; }
    static Vec3 tangential (const Vec3& v, const Vec3& n) noexcept { return v - n * n.dot (v); }

    Contact contact;
    double dissipated = 0.0;   // J
};

//==============================================================================
// Implementation below.

inline ElastoPlastic::Outputs ElastoPlastic::tick (const Inputs& in) noexcept
{
    if (! isFinite (in.position, in.normal, in.normal_force)) return fault();

    if (in.normal_force <= 0.0) return open();

    const double longest = in.normal.cwiseAbs().maxCoeff();
    const double sigma = params.stiffness > 0.0 ? params.stiffness : params.mu * in.normal_force / params.d_max;
    if (longest == 0.0 || ! isFinite (sigma)) return fault();

    Contact now = contact;
    if (in.normal != contact.given) now.n = (in.normal / longest).normalized();
    now.given = in.normal;
    now.p = in.position;
    now.sigma = sigma;
    now.d_max = params.d_max;
    now.d_stick = params.static_ratio * params.d_max;

    bool slips = false;
    double lost = 0.0;

    if (! contact.touching)
    {
        now.touching = true;
        now.d.setZero();
        now.adhesion = params.adhesion;
        now.integrator = params.integrator;
        now.load = params.load;
    }
    else
    {
        // Changes since the last sample take effect where the tool was, before it moves.
        if (sigma > contact.sigma && (now.load == Load::passive || params.stiffness > 0.0)) now.d *= contact.sigma / sigma;
        if (now.n != contact.n) now.d = tangential (now.d, now.n);
        if (isExact (now) && (now.d_max < contact.d_max || now.d_stick < contact.d_stick)) slips = letGo (now.d, now.adhesion);
        lost = contact.stored() - now.stored();

        const Vec3 dp = tangential (now.p - contact.p, now.n);
        if (! isFinite (dp.squaredNorm())) return fault();

        const Step step = advance (now.d, dp, now);
        now.d = step.d;
        lost += sigma * step.loss;
        slips = slips || step.slips;
    }

    const Outputs out {
        .force = -sigma * now.d,
        .deflection = now.d,
        .stored_energy = now.stored(),
        .dissipated_energy = dissipated + lost,
        .state = slips ? 2.0 : 1.0,
    };
    if (! isFinite (out.force, out.deflection, out.stored_energy, out.dissipated_energy)) return fault();

    contact = now;
    dissipated = out.dissipated_energy;
    return out;
}

inline ElastoPlastic::Outputs ElastoPlastic::open() noexcept
{
    const double lost = dissipated + contact.stored();
    contact = {};
    if (isFinite (lost)) dissipated = lost;
    return { .dissipated_energy = dissipated };
}

inline ElastoPlastic::Step ElastoPlastic::advance (const Vec3& d, const Vec3& dp, const Contact& c) const noexcept
{
    if (isExact (c)) return exponential (d, dp, c.adhesion);
    return c.adhesion == Adhesion::stick ? stick (d, dp) : euler (d, dp, c.adhesion);
}

/// Fig. 2: how fast the contact yields at stretch r, in 1/m.
inline double ElastoPlastic::zeta (double r, Adhesion adhesion) const noexcept
{
    const double d_max = params.d_max, d_stick = params.static_ratio * d_max, d_ba = params.break_away * d_max;
    switch (adhesion)
    {
    case Adhesion::stick:
        return r > d_stick ? 1.0 / d_max : 0.0;
    case Adhesion::dupont:
        if (r >= d_stick) return 1.0 / d_max;
        if (r <= d_ba) return 0.0;
        return 0.5 / d_max * (1.0 + std::sin (std::numbers::pi * (r - 0.5 * (d_stick + d_ba)) / (d_stick - d_ba)));
    case Adhesion::ramp:
        return std::min (r / d_stick, 1.0) / d_max;
    case Adhesion::dahl:
        return 1.0 / d_max;
    case Adhesion::curve:
        return std::clamp (settings.adhesion_curve (r / d_max), 0.0, 1.0) / d_max;
    }
    return 0.0;
}

/// Eq. (3).
inline ElastoPlastic::Step ElastoPlastic::stick (const Vec3& d, const Vec3& dp) const noexcept
{
    const Vec3 pulled = d + dp;
    const double r = pulled.norm(), d_stick = params.static_ratio * params.d_max;
    if (r > d_stick * (1.0 + eps_slip)) return drag (d.norm(), pulled, r, d_stick);
    return { .d = pulled };
}

/// Eq. (4), clamped. For the loss, the bristle first stretches to d~ and then yields there.
inline ElastoPlastic::Step ElastoPlastic::euler (const Vec3& d, const Vec3& dp, Adhesion adhesion) const noexcept
{
    const Vec3 pulled = d + dp;
    const double r = pulled.norm(), z = zeta (r, adhesion);
    if (z * r > 1.0 + eps_slip) return drag (d.norm(), pulled, r, 1.0 / z);

    const double g = std::min (1.0, z * dp.norm());
    return { .d = pulled - g * pulled, .loss = 0.5 * g * (2.0 - g) * r * r, .slips = g > 0.0 };
}

/// Eq. (2), solved with zeta held over the step, x = zeta |dp|. The mean stretch over the step is phi d + psi dp; its product
/// with dp is the work done on the way.
inline ElastoPlastic::Step ElastoPlastic::exponential (const Vec3& d, const Vec3& dp, Adhesion adhesion) const noexcept
{
    const double x = zeta ((d + dp).norm(), adhesion) * dp.norm();
    if (! (x > 0.0)) return { .d = d + dp };

    const double phi = -std::expm1 (-x) / x;
    const double psi = x < 1e-3 ? 1.0 / 2.0 - x * (1.0 / 6.0 - x * (1.0 / 24.0 - x / 120.0)) : (1.0 - phi) / x;
    const Vec3 after = std::exp (-x) * d + phi * dp;
    const double work = (phi * d + psi * dp).dot (dp);
    return { .d = after, .loss = std::max (0.0, work - 0.5 * (after - d).dot (after + d)), .slips = true };
}

/// Drags the contact point along: the stretch, which was pulled to d (of length r), returns to d_max. The contact holds up to a stretch
/// of `hold`, or of `from` if that is longer because the bound has shrunk. From there the spring falls back to d_max, and the
/// rest of the way is slip against the mean of static and sliding friction.
inline ElastoPlastic::Step ElastoPlastic::drag (double from, const Vec3& d, double r, double hold) const noexcept
{
    const double d_max = params.d_max, peak = std::clamp (from, hold, r);
    return { .d = d * (d_max / r), .loss = 0.5 * ((peak - d_max) * (peak + d_max) + (hold + d_max) * (r - peak)), .slips = true };
}

/// If a shrinking bound has left the stretch outside it, brings the stretch back to the value at which the contact slides.
/// Eq. (3) and (4) do so on their own.
inline bool ElastoPlastic::letGo (Vec3& d, Adhesion adhesion) const noexcept
{
    const double r = d.norm(), yield = zeta (r, adhesion) * r;
    if (! (yield > 1.0 + eps_slip)) return false;
    d /= yield;
    return true;
}

inline ElastoPlastic::Outputs ElastoPlastic::fault() noexcept
{
    contact = {};
    return { .dissipated_energy = dissipated, .state = -1.0 };
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::ElastoPlastic);
