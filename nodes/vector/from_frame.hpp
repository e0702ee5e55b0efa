// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/rotation.hpp>
#include <tactus/node/frame.hpp>
#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// Transforms a point from a rotated and shifted frame into the world.
///
///     out = origin + R in
///
/// R is the rotation of the rotation vector. Forces and other directions are not shifted: leave the origin at 0 for them.
struct VectorFromFrame
{
    using Inputs = In<Vec3>;
    using Params = Frame;
    using Outputs = Out<Vec3>;

    static constexpr Info info {
        .id = "vector.from_frame",
        .name = "From frame",
        .summary = "Transforms a vector from a frame into the world.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector, in the frame"),
        frameOrigin (&Params::origin),
        frameRotation (&Params::rotation),
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
