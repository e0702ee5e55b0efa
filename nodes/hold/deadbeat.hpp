// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/bouncing_mass.hpp>
#include <tactus/kit/math/math.hpp>
#include <tactus/kit/signal/held_step.hpp>
#include <tactus/node/node.hpp>

#include <algorithm>
#include <array>

namespace tactus::nodes
{

/// A wall that is stiffer than a sampled spring can be, for a device whose mass and damping are known.
///
/// A sampled spring acts too late at the touch, too late while the tool turns back, and too long when the tool leaves. So the tool
/// leaves faster than it came. This node knows the mass M and the damping B of what it pushes. Every second sample, it computes where
/// the tool would be two samples later at a continuous wall, and the two held forces that bring the tool exactly there:
///
///     e = offset - n . p                                        depth; the continuous wall: M e'' = -B e' - K e (e > 0) + d
///     (e, e')_(k+2) = A^2 (e, e')_k + (A b + b) d + A b f_k + b f_(k+1)       two equations for the forces f_k and f_(k+1)
///
/// A and b describe how a damped mass moves in one sample under a held force. The prediction covers a tool that enters or
/// leaves the wall between two samples, so a bounce depends neither on where the samples fall nor on their rate.
///
/// The speed e' follows from the last two positions and the force held between them. d is any other force on the tool, such as that of
/// the hand. It is estimated from the last three positions and the forces held between them, and smoothed over 10 ms.
///
/// Source: Gillespie & Cutkosky 1996, as cited in Hayward, "Physically-Based Haptic Synthesis" (2007), section 1: a known mass is
/// controlled in two samples, with prediction across the surface. The equations are our own.
///
/// With a delay of `delay` ticks from the sensor to the motor, the forces of the last `delay` ticks are still on their way. The node
/// knows them and plans from the state in which they leave the tool.
///
/// Departure: the speed and the force of the hand are estimated from positions. M and B may include a finger that is tied to the tool:
/// the title of the source says "user-specific".
///
/// What to expect: with the right mass and damping, a bounce on a wall of 30 times 2B/T ends with the same speed as on a continuous
/// wall, within 0.01 %. With a mass that is off by 20 % (0.1 kg, 2 N s/m, 1 kHz), the speed is off by less than 1 % at 3 times 2B/T and by
/// less than 10 % at 10 times, and a hand that presses comes to rest (see the test).
///
/// Good to know
///  - The force can begin up to two samples before the touch, and may pull for one sample when the tool enters or leaves.
///  - `mass` 0 and `damping` 0 mean those of the device that the position comes from. If the device is unknown, they mean 0.1 kg and
///    0 N s/m.
///  - The speed is known from the second sample on. If the tool touches on the first one, at the start or after a fault, the force
///    comes late.
///  - Wire `force` straight to the motor, and add no other strong force. Whatever is added, filtered or limited after this node
///    looks like a hand to it, and the node estimates the hand too late.
///  - `delay` must be the whole delay: that of the device plus that of nodes and wires. `tactus validate` warns of each: rate/late names
///    the delay of nodes and wires, and rate/device_delay a described device whose delay is longer than `delay`. If the delay is wrong
///    by one tick, a pressing hand meets a limit cycle; with two ticks, a bounce gains speed.
///  - A mass that is assumed too large makes the force too large and too early, which counts as a negative damping. If M is smaller than
///    assumed by a fraction of up to B T / (2 M) (M / ((1 + 2 delay) K T^2))^2, but at most 20 %, a pressing hand still comes to rest;
///    without a delay and with K from 0.2 to 0.6 M/T^2, it never does with 4 times that. For 0.1 kg, 2 N s/m and 1 kHz, this is 20 % at 3 times
///    2B/T, 6 % at 10 times and 0.7 % at 30 times. A mass that is assumed up to 20 % too small, as when a finger is tied to the tool, does no
///    harm while (1 + delay)^2 K < 3 M/T^2, except at a low rate with a delay and little damping: there, the missing inertia seems to be a
///    force of the hand, and its estimate comes late. `tactus check` judges both, in the row `deadbeat`.
///  - If a bounce lasts less than about four samples (K > 0.6 M/T^2), its speed is still correct, but it feels like two pulses.
///  - A position quantum q makes the speed at which a tool leaves wrong by less than (3 + 2 delay) q sqrt (K/M), whatever T, B and
///    the speed are; without a delay, it is wrong by 0.4 to 0.8 q sqrt (K/M) rms. For each plan, the position is wrong by up to q / 2
///    and the speed by up to q / T. A wall turns these into a speed of up to 2 (K T/M) (q/2 + (1 + delay) q). A bounce takes
///    pi/(2T) sqrt (M/K) plans, and on average 2/pi of the speed that each plan adds is left at the end.
///  - Position quanta also keep a pressing hand from coming to rest. With 0.1 kg at 1 kHz, a wall of 3 times 2B/T and a quantum of
///    10 um, the hand meets a limit cycle of about 1 N, unless the device has a Coulomb friction of about 0.5 N.
struct DeadbeatHold
{
    struct Inputs
    {
        Vec3 position = Vec3::Zero();
    };

    struct Params
    {
        double stiffness = 1000.0;
        Vec3 normal = Vec3::UnitZ();
        double offset = 0.0;
        double mass = 0.0;
        double damping = 0.0;
    };

    struct Settings
    {
        int delay = 0;
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
        double depth = 0.0;
        double state = 0.0;
    };

    static constexpr Info info {
        .id = "hold.deadbeat",
        .name = "Deadbeat wall",
        .summary = "A stiff wall that moves a known mass as a continuous wall would, in steps of two samples.",
        .source = "Gillespie & Cutkosky 1996",
        .keywords = "wall",
    };

    static constexpr int longest_delay = 16;   // ticks

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        param (&Params::stiffness, "stiffness", unit::stiffness, "stiffness K of the wall", { .hard = { 0, 1e9 }, .usual = { 0, 2e4 } }),
        param (&Params::normal, "normal", unit::gain, "direction out of the wall; any length but 0"),
        param (&Params::offset, "offset", unit::metre, "position of the wall along the unit normal", { .usual = { -0.1, 0.1 } }),
        param (&Params::mass, "mass", unit::kilogram, "mass M that the force moves; 0: that of the device", { .hard = { 0, 1000 }, .usual = { 0, 1 } }),
        param (&Params::damping, "damping", unit::damping, "damping B of this mass; 0: that of the device", { .hard = { 0, 1e6 }, .usual = { 0, 20 } }),
        setting (&Settings::delay, "delay", unit::count, "delay from sensor to motor in addition to the hold, in ticks", { .hard = { 0, longest_delay } }),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::depth, "depth", unit::metre, "depth of the tool behind the surface; negative while apart"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 contact"),
    };

    Params params;
    Settings settings;

    void learn (const DeviceMechanics& device) noexcept
    {
        device_mass = device.mass;
        device_damping = device.damping;
    }

    void prepare (const Setup& setup) noexcept
    {
        dt = setup.dt_s();
        learns = -math::expm1 (-dt / smoothing);
        past = {};
    }

    void update() noexcept { n = direction (params.normal); }

    void adopt (const DeadbeatHold& old) noexcept { past = old.past; }

    Outputs tick (const Inputs& in) noexcept
    {
        const double e = params.offset - n.dot (in.position);
        if (n.isZero (0.0) || ! isFinite (e)) return fault();

        BouncingMass body { .mass = mass(), .damping = damping(), .stiffness = params.stiffness };
        const HeldStep step (body.mass, body.damping, dt);
        Past now = past;
        const double v = observe (now, e, step);
        double force = now.next;
        if (now.planned)
            now.planned = false;
        else
        {
            body.force = now.push;
            force = plan (now, arrival (now, { .depth = e, .speed = v }, step), body, step);
        }
        std::ranges::copy_backward (now.sent.begin(), now.sent.end() - 1, now.sent.end());
        now.sent[0] = force;
        now.e[1] = now.e[0];
        now.e[0] = e;
        now.known = std::min (now.known + 1, 2);

        const Outputs out { .force = -force * n, .depth = e, .state = e > 0.0 ? 1.0 : 0.0 };
        if (! isFinite (out.force, now.next, now.push)) return fault();
        past = now;
        return out;
    }

    void serialize (auto& archive) { archive (past.e, past.sent, past.next, past.push, past.known, past.planned); }

private:
    static constexpr double smoothing = 0.01;   // s

    /// Depths and forces are positive into the wall.
    struct Past
    {
        double e[2] {};                                       // depths at the last sample and the one before, in m
        std::array<double, at (longest_delay) + 2> sent {};   // the last outputs, the newest first, in N
        double next = 0.0;                                    // the second force of the plan, in N
        double push = 0.0;                                    // the estimate of d, in N
        int known = 0;                                        // number of depths that are known
        bool planned = false;                                 // true if `next` is the force for this sample
    };

    double mass() const noexcept
    {
        if (params.mass > 0.0) return params.mass;
        return device_mass > 0.0 ? device_mass : 0.1;
    }

    double damping() const noexcept { return params.damping > 0.0 ? params.damping : device_damping; }

    Outputs fault() noexcept
    {
        past = {};
        return { .state = -1.0 };
    }

    /// Updates the estimate of what else pushes, and returns the speed at depth e.
    double observe (Past& now, double e, const HeldStep& step) const noexcept
    {
        // The speed at the end of a sample, from the depths at its start and end and the force held in between.
        const auto speed = [&] (double from, double to, double force) {
            const double start = (to - from - step.x_per_f * force) / step.x_per_v;
            return start + step.v_loss * start + step.v_per_f * force;
        };
        const double held = now.sent[at (settings.delay)], before = now.sent[at (settings.delay) + 1];   // the force since the last sample, and the one before
        if (now.known == 2)
        {
            double expected = now.e[0], v = speed (now.e[1], now.e[0], before + now.push);
            step (expected, v, held + now.push);
            const double per_push = step.x_per_f + step.x_per_v * step.v_per_f - (1.0 + step.v_loss) * step.x_per_f;   // depth per N
            now.push += (e - expected) / per_push * learns;
        }
        return now.known > 0 ? speed (now.e[0], e, held + now.push) : 0.0;
    }

    /// The state of the tool when the next output arrives at the motor. Until then, the outputs that are on their way push the tool.
    BouncingMass::State arrival (const Past& now, BouncingMass::State s, const HeldStep& step) const noexcept
    {
        for (int i = settings.delay - 1; i >= 0; --i)
            step (s.depth, s.speed, now.sent[at (i)] + now.push);
        return s;
    }

    /// Finds the forces for two samples from the state s on. Returns the first and stores the second.
    double plan (Past& now, BouncingMass::State s, const BouncingMass& body, const HeldStep& step) const noexcept
    {
        now.next = 0.0;
        const auto wanted = body.after (s, 2.0 * dt);
        if (! wanted.touched) return 0.0;

        double e = s.depth, v = s.speed;
        for (int i = 0; i < 2; ++i)
            step (e, v, now.push);
        const double de = wanted.state.depth - e, dv = wanted.state.speed - v;

        // de = (x_per_f + x_per_v v_per_f) f_k + x_per_f f_(k+1), dv = (1 + v_loss) v_per_f f_k + v_per_f f_(k+1)
        const double first = step.x_per_f + step.x_per_v * step.v_per_f, keeps = 1.0 + step.v_loss;
        const double force = (de - dv * step.x_per_f / step.v_per_f) / (first - keeps * step.x_per_f);
        now.next = dv / step.v_per_f - keeps * force;
        now.planned = true;
        return force;
    }

    Vec3 n = Vec3::UnitZ();
    double dt = 1.0 / Setup {}.rate_hz;   // s
    double learns = 0.0;                  // the fraction of an error that the estimate corrects per sample; set by prepare
    double device_mass = 0.0, device_damping = 0.0;
    Past past;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::DeadbeatHold);
