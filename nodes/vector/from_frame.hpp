// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>
#include <framework/rotation.hpp>

#include <numbers>

namespace tactus::nodes
{

/// Brings a point from the coordinates of a turned and shifted frame into those of the world.
///
///     out = origin + R in
///
/// R turns by the rotation vector. Forces and other directions take no shift: leave the origin at 0 for them.
struct VectorFromFrame
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
        .id = "vector.from_frame",
        .name = "From frame",
        .summary = "Brings a vector from a frame into the world.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector, in the frame"),
        param (&Params::origin, "origin", sameAs ("in"), "where the frame has its 0, in the world", { .usual = { -1, 1 } }),
        param (&Params::rotation, "rotation", unit::radian, "how the frame is turned: axis times angle", { .usual = { -std::numbers::pi, std::numbers::pi } }),
        output (&Outputs::out, "out", sameAs ("in"), "the vector, in the world"),
    };

    Params params;

    void update() noexcept { turn = rotationMatrix (params.rotation); }

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! isFinite (in.in)) return {};
        return { .out = finiteOrZero (Vec3 { params.origin + turn * in.in }) };
    }

private:
    Mat3 turn = Mat3::Identity();
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorFromFrame);
