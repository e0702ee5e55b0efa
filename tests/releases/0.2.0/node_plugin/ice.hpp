// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

#include <tuple>

namespace my
{

/// A floor of ice at z = 0: it pushes the tool up, and has no friction. f = k depth, straight up.
struct Ice
{
    struct Inputs
    {
        tactus::Vec3 position = tactus::Vec3::Zero();
    };
    struct Params
    {
        double stiffness = 800.0;
    };
    struct Outputs
    {
        tactus::Vec3 force = tactus::Vec3::Zero();
    };

    static constexpr tactus::Info info { "my.ice", "Ice", "A floor without friction.", "own" };
    static constexpr std::tuple ports {
        tactus::input (&Inputs::position, "position", tactus::unit::metre, "tool position"),
        tactus::param (&Params::stiffness, "stiffness", tactus::unit::stiffness, "force per depth", { .hard = { 0, tactus::inf }, .usual = { 0, 2000 } }),
        tactus::output (&Outputs::force, "force", tactus::unit::newton, "force on the tool"),
    };

    Params params;

    tactus::Claims claims() const { return { .passive = true, .stiffness = params.stiffness }; }

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! tactus::isFinite (in.position) || in.position.z() >= 0.0) return {};
        return { .force = tactus::finiteOrZero (tactus::Vec3 (0.0, 0.0, -params.stiffness * in.position.z())) };
    }
};

}   // namespace my

TACTUS_NODE (my::Ice);
