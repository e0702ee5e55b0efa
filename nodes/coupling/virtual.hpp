// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

namespace tactus::nodes
{

/// A wall of any hardness, felt through a spring and a damper that the device can handle.
///
/// A massless proxy follows the tool, but not into the wall. The coupling ties the tool to the proxy, and the hand only ever
/// feels the coupling: however hard the wall, the device sees no more than kc and bc.
///
///     x = offset - n . p                                 depth of the tool; x_v is the depth of the proxy, e = x - x_v
///     kc e + bc (e - e^-) / T = sigma x_v                in the wall; = 0 outside. e^-: e on the last sample. Solved with
///     g = kc + bc / T,  x_f = x - (bc / T) e^- / g       where the proxy would be without a wall:
///     x_f <= 0: x_v = x_f, f = 0                         the proxy is outside
///     x_f > 0:  x_v = x_f g / (g + sigma), f = sigma x_v n
///
/// The rule is implicit: e belongs to this sample, so a wall of 1e8 N/m is as calm as one of 1e3. f is the force on the tool.
///
/// Source: Adams & Hannaford 1999; Colgate, Stanley & Brown 1995; Hayward, "Physically-Based Haptic Synthesis" (2007),
/// section 1, for the limit on kc.
///
/// Departures: here Adams and Hannaford's proxy has no mass, and the wall has no damping.
///
/// Good to know
///  - The force is held between samples, so the coupling needs what any spring needs. A device damping B of at least kc T / 2 + |bc| is
///    sufficient: then the wall is passive, whatever the hand does. It is not necessary: without bc, the wall settles up to kc = 0.8
///    times 2 B / T and buzzes at 1.3 times 2 B / T, whatever sigma is (see the test), but bc calms a buzz. A wall that is not passive
///    may come to rest: `tactus check` lets go of the tool, and `tactus limits` shows the limits of kc and bc.
///  - On the first sample the proxy is at the tool, in the wall or not, so there is no force. A tool that is inside from the start
///    feels the wall on the next sample, in one step, and gains energy. Otherwise the node is passive.
///  - The wall does not pull. After the tool leaves, the proxy catches up with time constant bc / kc.
///  - `proxy` is where the tool seems to be: draw this, not the tool. `depth` is the depth of the tool, as in deform.plane.
///  - A wall that is moved by a wire or a knob does work, as a real moving wall does.
struct VirtualCoupling
{
    struct Inputs
    {
        Position position = Position::Zero();
    };

    struct Params
    {
        double stiffness = 1000.0;
        double damping = 0.5;
        Vec3 normal = Vec3::UnitZ();
        double offset = 0.0;
        double wall_stiffness = 1e6;
    };

    struct Outputs
    {
        Position proxy = Position::Zero();
        Vec3 force = Vec3::Zero();
        double depth = 0.0;
        double state = 0.0;
    };

    static constexpr Info info {
        .id = "coupling.virtual",
        .name = "Virtual coupling",
        .summary = "A wall of any hardness, felt through a spring and damper that the device can handle.",
        .source = "Adams & Hannaford 1999",
        .keywords = "proxy god object",
    };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position p"),
        param (&Params::stiffness, "stiffness", unit::stiffness, "stiffness kc of the coupling; at most 1.6 times the device's damping / tick period",
               { .hard = { 0, inf }, .usual = { 0, 1e4 } }),
        param (&Params::damping, "damping", unit::damping, "damping bc of the coupling", { .hard = { 0, inf }, .usual = { 0, 20 } }),
        param (&Params::normal, "normal", unit::gain, "direction out of the wall; any length but 0"),
        param (&Params::offset, "offset", unit::metre, "position of the wall along the unit normal", { .usual = { -0.1, 0.1 } }),
        param (&Params::wall_stiffness, "wall_stiffness", unit::stiffness, "stiffness sigma of the wall behind the coupling",
               { .hard = { 0, inf }, .usual = { 0, 1e8 } }),
        output (&Outputs::proxy, "proxy", unit::metre, "where the tool seems to be; in contact, this is barely inside the wall"),
        output (&Outputs::force, "force", unit::newton, "force on the tool"),
        output (&Outputs::depth, "depth", unit::metre, "depth of the tool behind the surface; negative while apart"),
        output (&Outputs::state, "state", unit::state, "-1 fault, 0 open, 1 the proxy is in the wall"),
    };

    static constexpr Appearance appearance {
        .kind = Appearance::Kind::plane, .tool = "position", .normal = "normal", .offset = "offset", .touch = "proxy"
    };

    Params params;

    void prepare (const Setup& setup) noexcept
    {
        dt = setup.dt_s();
        last = {};
    }

    void update() noexcept { n = direction (params.normal); }

    void adopt (const VirtualCoupling& old) noexcept { last = old.last; }

    /// Not passive: a tool that is inside from the start gains the energy that pushes it out.
    Claims claims() const
    {
        const double kc = params.stiffness, sigma = params.wall_stiffness;
        return { .stiffness = sigma > 0.0 ? kc * (sigma / (kc + sigma)) : 0.0, .damping = params.damping };
    }

    Outputs tick (const Inputs& in) noexcept
    {
        const Fine x = params.offset - n.dot (in.position);
        const double sigma = params.wall_stiffness, damper = params.damping / dt, g = params.stiffness + damper;

        const double free = last.known && g > 0.0 ? x - damper / g * last.e : x;
        const bool pressed = last.known && free > 0.0 && g + sigma > 0.0;
        const double proxy = pressed ? free * (g / (g + sigma)) : free;
        const double e = x - proxy;

        const Outputs out {
            .proxy = in.position + e * n,
            .force = pressed ? Vec3 { free * (g * (sigma / (g + sigma))) * n } : Vec3::Zero(),
            .depth = x,
            .state = proxy > 0.0 ? 1.0 : 0.0,
        };
        if (n.isZero (0.0) || ! isFinite (x, e, out.proxy, out.force))
        {
            last = {};
            return { .state = -1.0 };
        }
        last = { .e = e, .known = true };
        return out;
    }

    void serialize (auto& archive) { archive (last); }

private:
    struct Stretch
    {
        double e = 0.0;       // deflection of the coupling along the normal, in m
        bool known = false;   // false until the first finite sample
    };

    Vec3 n = Vec3::UnitZ();
    double dt = 1.0 / Setup {}.rate_hz;   // s
    Stretch last;
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VirtualCoupling);
