// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/signal/past_window.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>

namespace tactus::nodes
{

/// A thick liquid around the tool: it holds the tool back the more, the faster it moves, and takes it along where it flows.
///
///     w = dp / dt - u                                     velocity of the tool in the liquid; u: `flow`
///     D = linear |w| + quadratic |w|^2                    drag; where its slope would exceed max_damping, D goes on with this slope
///     f = -amount D w / |w|                               force on the tool
///
/// `linear` is the drag of honey or oil (Stokes), `quadratic` that of water (Newton). dp is the way over `window` (0: one tick), and dt its
/// time. While the tool moves backwards against this way, dp is 0, so that a window never makes the liquid drive the tool.
///
/// A tool that a force F pulls through the liquid comes to the speed at which D = F.
///
/// Source: definition. Limits: Hayward, "Physically-Based Haptic Synthesis" (2007), section 1, and footnote 2 on virtual damping.
///
/// Good to know
///  - A liquid that is at rest only brakes: f . dp is never above 0 for the last way dp of the tool. `dissipated_energy` is what it has taken
///    from the hand so far; with a flow, what the hand and the flow have lost in it. It never falls.
///  - The force is held between samples, so a damper swings by itself beyond 2 M / T + 4 B / 3 on a device of mass M and damping B. A
///    device damping as large as the slope of D is sufficient for a liquid that is passive, whatever the hand does (section 1); it is not
///    necessary for a tool that comes to rest. `tactus check` says what a device allows.
///  - `amount` 0 is outside of the liquid, 1 inside. Wire it to contact.window for a soft surface of the liquid.
///  - A vortex is a `flow` of vector.cross: of the axis of rotation, in rad/s, and the position.
///  - One quantum q of the position in one tick is a speed of q / T, which D turns into ticks. A `window` of some milliseconds makes
///    them small; the drag then acts half a window late.
struct Viscous
{
    struct Inputs
    {
        Position position = Position::Zero();
        Vec3 flow = Vec3::Zero();
        double amount = 1.0;
    };

    struct Params
    {
        double linear = 2.0;
        double quadratic = 0.0;
        double max_damping = 10.0;
    };

    struct Settings
    {
        double window = 0.0;
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
        Vec3 velocity = Vec3::Zero();
        double dissipated_energy = 0.0;
        double state = 0.0;
    };

    static constexpr Info info {
        .id = "field.viscous",
        .name = "Viscous liquid",
        .summary = "Holds the tool back the more, the faster it moves: honey, oil, water; at rest or flowing.",
        .source = "Hayward 2007, section 1; definition",
        .keywords = "damper drag fluid medium honey water flow wind current vortex",
    };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        input (&Inputs::flow, "flow", unit::speed, "velocity u of the liquid where the tool is"),
        input (&Inputs::amount, "amount", unit::gain, "share of the liquid around the tool, 0 to 1"),
        param (&Params::linear, "linear", unit::damping, "drag per speed", { .hard = { 0, inf }, .usual = { 0, 20 } }),
        param (&Params::quadratic, "quadratic", unit::kilogram_per_metre, "drag per square of the speed", { .hard = { 0, inf }, .usual = { 0, 50 } }),
        param (&Params::max_damping, "max_damping", unit::damping, "largest slope of the drag over the speed", { .hard = { 0, inf }, .usual = { 0, 50 } }),
        setting (&Settings::window, "window", unit::second, "time over which the velocity is measured; 0: one tick",
                 { .hard = { 0, 0.1 }, .usual = { 0, 0.01 } }),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::velocity, "velocity", unit::speed, "velocity w of the tool in the liquid"),
        output (&Outputs::dissipated_energy, "dissipated_energy", unit::joule, "energy that the liquid has turned into heat so far"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 outside, 1 in the liquid"),
    };

    Params params;
    Settings settings;

    void prepare (const Setup& setup)
    {
        dt = setup.dt_s();
        past.prepare (settings.window, dt);
    }

    void adopt (const Viscous& old) noexcept
    {
        past.adopt (old.past);
        dissipated = old.dissipated;
    }

    Claims claims() const { return { .passive = true, .damping = params.quadratic > 0.0 ? params.max_damping : std::min (params.linear, params.max_damping) }; }

    Outputs tick (const Inputs& in) noexcept
    {
        const bool is_number = isFinite (in.position, in.flow, in.amount);
        Vec3 moved = Vec3::Zero(), velocity = Vec3::Zero();
        if (is_number && ! past.isEmpty())
        {
            const auto change = past.to (in.position);
            moved = in.position - past.last();
            const Vec3 way = change.by;
            if (moved.dot (way) >= 0.0) velocity = way / change.time;
        }
        const Vec3 w = velocity - in.flow;
        const double amount = std::clamp (in.amount, 0.0, 1.0), speed = length (w);
        const double damping = speed > 0.0 ? amount * drag (speed) / speed : 0.0;
        const Vec3 force = -damping * w;
        const double heat = std::max (0.0, -force.dot (Vec3 { moved - in.flow * dt })), total = dissipated + heat;

        const bool is_fine = is_number && isFinite (force, w, total);
        past.remember (in.position, is_fine);
        if (! is_fine) return { .dissipated_energy = dissipated, .state = -1.0 };
        dissipated = total;
        return { .force = force, .velocity = w, .dissipated_energy = total, .state = amount > 0.0 ? 1.0 : 0.0 };
    }

    void serialize (auto& archive) { archive (past, dissipated); }

private:
    /// D, in N, at a speed in m/s.
    double drag (double speed) const noexcept
    {
        const double first = std::min (params.linear, params.max_damping), steepening = 2.0 * params.quadratic;
        const double bends = steepening > 0.0 ? std::min (speed, (params.max_damping - first) / steepening) : speed;   // m/s; from here on, D is straight
        const double slope = first + steepening * bends;
        return (first + params.quadratic * bends) * bends + slope * (speed - bends);
    }

    double dt = 1.0 / Setup {}.rate_hz;   // s
    PastWindow<Position> past { dt };     // positions, in m
    double dissipated = 0.0;              // J
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Viscous);
