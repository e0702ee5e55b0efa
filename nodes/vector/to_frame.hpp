// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>
#include <framework/rotation.hpp>

#include <numbers>

namespace tactus::nodes
{

/// Brings a point from the coordinates of the world into those of a turned and shifted frame; undoes vector.from_frame.
///
///     out = R^T (in - origin)
///
/// R turns by the rotation vector. Forces and other directions take no shift: leave the origin at 0 for them.
struct VectorToFrame
{
    struct Inputs
    {
        Vec3 in = Vec3::Zero();
    };

    struct Params
    {
        Vec3 origin = Vec3::Zero();
        Vec3 rotation = Vec3::Zero();
    };

    struct Outputs
    {
        Vec3 out = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "vector.to_frame",
        .name = "To frame",
        .summary = "Brings a vector from the world into a frame.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector, in the world"),
        param (&Params::origin, "origin", sameAs ("in"), "where the frame has its 0, in the world", { .usual = { -1, 1 } }),
        param (&Params::rotation, "rotation", unit::radian, "how the frame is turned: axis times angle", { .usual = { -std::numbers::pi, std::numbers::pi } }),
        output (&Outputs::out, "out", sameAs ("in"), "the vector, in the frame"),
    };

    Params params;

    void update() noexcept { turn = rotationMatrix (params.rotation); }

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! isFinite (in.in)) return {};
        return { .out = finiteOrZero (Vec3 { turn.transpose() * (in.in - params.origin) }) };
    }

private:
    Mat3 turn = Mat3::Identity();
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorToFrame);
