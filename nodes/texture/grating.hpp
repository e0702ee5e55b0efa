// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/node/node.hpp>

#include <numbers>

namespace tactus::nodes
{

/// Regular ridges: a force along their direction that rises and falls as the tool crosses them.
///
///     value = A sin (2 pi k s + phase),   s = x cos (angle) + y sin (angle)
///     force = value (cos (angle), sin (angle), 0)
///
/// k is in ridges per metre: 200 1/m is one every 5 mm. The force is the gradient of a potential, so it does no work over any
/// closed path: added to anything passive it stays passive. That is why it points along the wave; a normal force modulated by
/// lateral position would create energy, as Campion and Hayward (2008) warn.
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 5; Campion & Hayward 2005.
///
/// Good to know
///  - The steepest slope of the force is 2 pi A k, in N/m; the device must damp it like a spring of that stiffness.
///    (Table 1 gives A k, "proportional to the slope".)
///  - At speed v it sounds at k v Hz. Above the device's bandwidth it buzzes, and above half the sampling rate it aliases:
///    multiply by texture.antialias. Multiply by contact.window too, so that the force does not jump at a touch.
///  - Moving does no work over a closed path. Changing amplitude, frequency or angle in contact does work.
struct Grating
{
    struct Inputs
    {
        Position position = Position::Zero();
    };

    struct Params
    {
        double amplitude = 0.1;
        double spatial_frequency = 200.0;
        double angle = 0.0;
        double phase = 0.0;
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
        double value = 0.0;
    };

    static constexpr Info info {
        .id = "texture.grating",
        .name = "Grating",
        .summary = "Sinusoidal ridges, felt as a force along the wave.",
        .source = "Hayward 2007, section 5",
        .keywords = "ridges bumps sine roughness",
    };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "tool position"),
        param (&Params::amplitude, "amplitude", unit::newton, "peak force A", { .hard = { 0, inf }, .usual = { 0, 1 } }),
        param (&Params::spatial_frequency, "spatial_frequency", unit::per_metre, "k, in ridges per metre", { .hard = { 0, inf }, .usual = { 10, 5000 } }),
        param (&Params::angle, "angle", unit::radian, "angle of the wave in the xy plane, from x towards y",
               { .usual = { -std::numbers::pi, std::numbers::pi } }),
        param (&Params::phase, "phase", unit::radian, "phase at the origin", { .usual = { -std::numbers::pi, std::numbers::pi } }),
        output (&Outputs::force, "force", unit::newton, "force on the tool, along the wave"),
        output (&Outputs::value, "value", unit::newton, "signed value of the force"),
    };

    static constexpr Appearance appearance {
        .kind = Appearance::Kind::ridges, .tool = "position", .frequency = "spatial_frequency", .angle = "angle", .phase = "phase"
    };

    Params params;

    void update() noexcept { along = { math::cos (params.angle), math::sin (params.angle), 0.0 }; }

    Claims claims() const
    {
        return {
            .passive = true,
            .stiffness = 2.0 * std::numbers::pi * params.amplitude * params.spatial_frequency,
            .spatial_frequency = params.spatial_frequency,
            .amplitude = params.amplitude,
        };
    }

    Outputs tick (const Inputs& in) noexcept
    {
        const Fine s = along.dot (in.position);
        const double value = params.amplitude * math::sin (2.0 * std::numbers::pi * params.spatial_frequency * s + params.phase);
        if (! isFinite (value, in.position.z())) return {};
        return { .force = value * along, .value = value };
    }

    void serialize (auto&) {}

private:
    Vec3 along = Vec3::UnitX();
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::Grating);
