// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/bristle.hpp>
#include <tactus/kit/tangent_plane.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
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
/// The load f_n may change while the bristle is stretched. The param `load` selects what follows the load:
///
///     bound      sigma is constant while the tool touches, and the contact slides at the stretch s instead of d_max:
///                sigma = stiffness, or mu0 reference_load / d_max0;   s = (mu f_n / sigma) (d_max / d_max0)
///     scale      sigma = mu f_n / d_max at each sample, as printed
///     passive    as `scale`, but when sigma rises, the contact point moves towards the tool so that the force stays the same
///
/// mu0 and d_max0 are the values of mu and d_max in file and knobs at the touch, without wires. With `bound`, d_stick, d_ba and
/// zeta scale with s. Section 4 bounds the stretch by the depth in the same way.
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
/// d_stick - d_max, and mu_s / mu_k = static_ratio. The teeth and the mean drag are the same at any speed and rate: a step
/// that passes d_stick leaves the stretch that a slow hand would have at the same place.
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
///  - Eq. (3) leaves a stretch of d_max after every slip, however far the step went beyond d_stick. With static_ratio > 1, the
///    teeth then get longer the faster the hand moves, and finally vanish. Here, a slip leaves
///    d_max + (|d~| - d_stick) mod (d_stick - d_max).
///  - With sigma following the load as printed, pressing harder while the bristle is stretched adds energy that comes back on
///    release (3.2 uJ in each stroke of docs/figures/load_strokes.json). `load: passive` adds none, because new contact area is not
///    sheared yet, but the contact point walks: if the load trembles by 10 % at 10 Hz, a tool that leans with 0.2 N on a contact that
///    can hold 0.5 N creeps by 81 um/s, although the state is 1. `load: bound` neither gives energy nor walks, however the load
///    changes, and is the default (docs/decisions/friction_load.md). Graph files of version 1 mean `passive` if they say nothing.
///  - Eq. (1) to (4) are one-dimensional. Here d and dp lie in the tangent plane. When the normal turns, the plane turns with it
///    by the smallest angle and takes d along (parallel transport), so d keeps its length and the turn does no work. If
///    p - c were projected on the new plane, every turn would shorten d, and under a normal that trembles the contact would lose its
///    force and walk (docs/decisions/parallel_transport.md). For a constant normal, both are the same.
///
/// Good to know
///  - Time-free: only displacement moves the state. A tool at rest feels a constant force forever, and repeating a sample does
///    not change a single bit of the state.
///  - stored_energy is sigma |d|^2 / 2. dissipated_energy is what the bristle has lost since the start, along the straight path
///    between the samples: sigma times the stretch times the slip of c, each collapse of a step, and everything released when
///    the load falls, the contact re-anchors or the contact opens. So the work of the hand is the increase of
///    stored plus dissipated energy, and dissipated_energy never falls. Under `load: scale` it does fall when the load rises:
///    this is the energy that `scale` creates. Energy stored when a fault opens the contact is not counted.
///  - The force is held between samples, so while the contact sticks, the device needs a damping of at least sigma T / 2
///    (section 1), or twice that with functions 2 to 4, which are twice as stiff on a reversal.
///  - A normal that trembles, about one axis or several, brings the force back when the normal comes back. Only if the normal
///    turns by more than 60 degrees may the stretch come back turned within the plane, as on a tool that is carried around a ball.
///    Opposite normals have the same plane, so the sign of the normal does not matter.
///  - A tool that is held in place does not lose any force under a trembling normal. A tool that leans with a constant force
///    stretches the contact by a little more or less as the plane tilts. It walks by at most 2 |d| angle^4 in each cycle, with the
///    angle in rad: 2 nm for a stretch of 20 um and +-5 degrees. This holds for a tool that moves only sideways. If it also moves
///    along the normal by a, as on a soft wall, the contact walks by up to pi a sin (angle) in each cycle: 2.2 um for 8 um and
///    +-5 degrees. With a constant normal it does not walk, so give friction the normal of the smooth surface.
///  - If the bound shrinks below the stretch, the bristle slips immediately, even at rest. This is how a texture on mu or d_max
///    is felt: with `bound`, sliding needs the force mu f_n d_max / d_max0. So if d_max changes while the tool touches, the drag
///    changes at once, but the softness of the contact only at the next touch.
///  - With `bound` and no `stiffness`, a mu of 0 in file and knobs at the touch makes sigma 0. Then even a wire on mu brings no
///    friction until the next touch.
///  - With `scale` and `passive`, `stiffness` above 0 keeps sigma constant, and d_max alone is the bound: mu has no effect, and
///    normal_force only opens and closes the contact.
///  - Position noise weakens the drag of functions 2 to 4, because the bristle yields a little with each small step back and forth.
///    With a noise of 1 um rms at 10 kHz, 2 mm/s and a d_max of 50 um, a mean drag of 0.5 N becomes 0.39 N with function 2,
///    0.21 N with 3 and 0.09 N with 4. Function 1 keeps 0.49 N.
///  - With functions 2 and 3 and static_ratio > 1, the exponential integrator slides at a stretch between d_max and d_stick,
///    while eq. (4) collapses to d_max and buzzes. Use function 1 for stick-slip.
///  - With a table that never reaches 1, the bristle stretches beyond d_max; with one that ends in 0, without limit.
struct ElastoPlastic
{
    using Adhesion = BristleAdhesion;
    using Integrator = BristleIntegrator;

    enum class Load
    {
        bound,
        scale,
        passive
    };

    struct Inputs
    {
        Position position = Position::Zero();
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
        Load load = Load::bound;
        double reference_load = 1.0;
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
        .keywords = "stick slip stiction drag dahl lugre rub",
    };

    static constexpr std::string_view adhesion_names[] { "stick", "dupont", "ramp", "dahl", "curve" };
    static constexpr std::string_view integrator_names[] { "exponential", "euler" };
    static constexpr std::string_view load_names[] { "bound", "scale", "passive" };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        input (&Inputs::normal, "normal", unit::gain, "direction out of the surface; any length but 0"),
        input (&Inputs::normal_force, "normal_force", unit::newton, "force f_n of the tool into the surface; 0 or less opens the contact"),
        param (&Params::mu, "mu", unit::gain, "friction coefficient while sliding", { .hard = { 0, inf }, .usual = { 0, 2 } }),
        param (&Params::d_max, "d_max", unit::metre, "stretch of the contact while it slides", { .hard = { 1e-9, inf }, .usual = { 1e-6, 1e-2 } }),
        param (&Params::static_ratio, "static_ratio", unit::gain, "d_stick / d_max = mu_s / mu_k; above 1: stick-slip",
               { .hard = { 1, inf }, .usual = { 1, 5 } }),
        param (&Params::break_away, "break_away", unit::gain, "d_ba / d_max, where adhesion dupont begins to yield", { .hard = { 0, 1 } }),
        param (&Params::stiffness, "stiffness", unit::stiffness, "stiffness sigma; 0: mu / d_max times the load, or times reference_load with load bound",
               { .hard = { 0, inf }, .usual = { 0, 1e5 } }),
        choice (&Params::adhesion, "adhesion", adhesion_names, "how the contact yields, Fig. 2"),
        choice (&Params::integrator, "integrator", integrator_names, "exponential solves eq. (2) over each step; euler is eq. (4)"),
        choice (&Params::load, "load", load_names, "what follows the load: the bound of the stretch, the stiffness, or the stiffness with re-anchoring"),
        param (&Params::reference_load, "reference_load", unit::newton, "load at which the contact slides at d_max, with load bound and no stiffness",
               { .hard = { 1e-9, inf }, .usual = { 0.1, 10 } }),
        setting (&Settings::adhesion_curve, "adhesion_curve", unit::gain, unit::gain, "zeta d_max as a curve over |d| / d_max; only for adhesion curve"),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::deflection, "deflection", unit::metre, "stretch d of the contact"),
        output (&Outputs::stored_energy, "stored_energy", unit::joule, "energy in the stretch"),
        output (&Outputs::dissipated_energy, "dissipated_energy", unit::joule, "energy turned into heat since the start"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 stuck, 2 slipping"),
    };

    static constexpr Appearance appearance { .kind = Appearance::Kind::contact, .tool = "position", .normal = "normal", .stretch = "deflection" };

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

    /// Functions 2 to 4 are twice as stiff on a reversal. Unless `stiffness` is given, loads `scale` and `passive` make the contact
    /// stiffer with normal_force, without limit.
    Claims claims() const
    {
        const bool grows = params.load != Load::bound && params.stiffness == 0.0;
        return {
            .passive = params.load != Load::scale || params.stiffness > 0.0,
            .stiffness = (params.adhesion == Adhesion::stick ? 1.0 : 2.0) * (grows ? inf : stiffnessAtTouch (params)),
        };
    }

    Outputs tick (const Inputs& in) noexcept { return tick (in, params); }
    Outputs tick (const Inputs&, const Params& stored) noexcept;

    void serialize (auto& archive) { archive (contact, dissipated); }

private:
    static constexpr double shortest = 1e-30;   // m; replaces a bound of 0, because the bristle divides by the bound

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
        Load load {};
        Bristle bristle {};

        double stored() const noexcept { return 0.5 * sigma * d.squaredNorm(); }
    };

    double stiffnessAtTouch (const Params& stored) const noexcept;
    Contact atRest (const Position&, const Params& stored) const noexcept;
    void setBound (double normal_force) noexcept;
    bool follow (Outputs&, const Inputs&, const Params& stored) noexcept;

    Contact contact;
    double dissipated = 0.0;   // J
};

//==============================================================================
// Implementation below.

inline auto ElastoPlastic::tick (const Inputs& in, const Params& stored) noexcept -> Outputs
{
    const bool is_number = isFinite (in.position, in.normal, in.normal_force), opens = is_number && in.normal_force <= 0.0;
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

/// The contact follows the tool. False if a result is not finite.
inline bool ElastoPlastic::follow (Outputs& out, const Inputs& in, const Params& stored) noexcept
{
    auto& c = contact;
    const bool begins = ! c.touching;
    if (begins) c = atRest (in.position, stored);
    c.plane.turn (in.normal, begins);

    // Changes since the last sample take effect where the tool was, before it moves.
    const Contact before = c;
    setBound (in.normal_force);
    if (c.sigma > before.sigma && (c.load == Load::passive || params.stiffness > 0.0)) c.d *= before.sigma / c.sigma;
    bool slips = false;
    if (c.bristle.d_max < before.bristle.d_max || c.bristle.d_stick < before.bristle.d_stick) slips = c.bristle.letGo (c.d);
    const double released = c.energy - c.stored();

    const Vec3 dp = c.plane.kept (in.position - c.p);
    const auto step = c.bristle.stretch (c.d, dp);   // eq. (3), (4)
    c.p = in.position;
    c.d = step.d;

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
    return isFinite (c.sigma, c.bristle.d_max, dp.squaredNorm(), out.force, out.deflection, out.stored_energy, out.dissipated_energy);
}

/// The stiffness that a contact with load `bound` keeps until it opens.
inline double ElastoPlastic::stiffnessAtTouch (const Params& stored) const noexcept
{
    return params.stiffness > 0.0 ? params.stiffness : stored.mu * params.reference_load / stored.d_max;
}

/// A contact that begins. The tool has not pulled it yet.
inline auto ElastoPlastic::atRest (const Position& p, const Params& stored) const noexcept -> Contact
{
    Contact c;
    c.p = p;
    c.load = params.load;
    c.bristle.adhesion = params.adhesion;
    c.bristle.integrator = params.integrator;
    c.d_max0 = stored.d_max;
    c.sigma = c.load == Load::bound ? stiffnessAtTouch (stored) : 0.0;
    return c;
}

/// Sets the stiffness and the lengths of Fig. 2 for this load.
inline void ElastoPlastic::setBound (double normal_force) noexcept
{
    auto& c = contact;
    double d_max = params.d_max;
    if (c.load == Load::bound)
    {
        const double slides = params.mu * normal_force / c.sigma * (params.d_max / c.d_max0);
        d_max = c.sigma > 0.0 ? std::max (shortest, slides) : shortest;
    }
    else
        c.sigma = params.stiffness > 0.0 ? params.stiffness : params.mu * normal_force / params.d_max;

    c.bristle.d_max = d_max;
    c.bristle.d_stick = params.static_ratio * d_max;
    c.bristle.d_ba = params.break_away * d_max;
    c.bristle.own = &settings.adhesion_curve;
}

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::ElastoPlastic);
