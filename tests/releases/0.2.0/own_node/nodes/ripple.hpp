// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

#include <cmath>
#include <numbers>
#include <tuple>

namespace my
{

/// Rings around the origin, like those around a stone dropped into water: f = a sin(2 pi k r) along the radius.
struct Ripple
{
    struct Inputs
    {
        tactus::Vec3 position = tactus::Vec3::Zero();
    };
    struct Params
    {
        double amplitude = 0.2, spatial_frequency = 200.0;
    };
    struct Outputs
    {
        tactus::Vec3 force = tactus::Vec3::Zero();
    };

    static constexpr tactus::Info info { "my.ripple", "Ripple", "Rings around the origin of the xy plane", "own" };
    static constexpr std::tuple ports {
        tactus::input (&Inputs::position, "position", tactus::unit::metre, "tool position"),
        tactus::param (&Params::amplitude, "amplitude", tactus::unit::newton, "largest force", { .usual = { 0, 1 } }),
        tactus::param (&Params::spatial_frequency, "spatial_frequency", tactus::unit::per_metre, "rings per metre", { .hard = { 0, tactus::inf } }),
        tactus::output (&Outputs::force, "force", tactus::unit::newton, "force on the tool"),
    };

    Outputs tick (const Inputs& in) const noexcept
    {
        const double r = std::hypot (in.position.x(), in.position.y());
        if (! std::isfinite (r) || r == 0.0) return {};
        const double f = params.amplitude * std::sin (2.0 * std::numbers::pi * params.spatial_frequency * r);
        return { .force = { f * in.position.x() / r, f * in.position.y() / r, 0.0 } };
    }

    Params params;
};

}   // namespace my

TACTUS_NODE (my::Ripple);
