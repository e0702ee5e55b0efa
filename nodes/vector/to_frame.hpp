// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/rotation.hpp>
#include <tactus/node/frame.hpp>
#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// Transforms a point from the world into a rotated and shifted frame. The inverse of vector.from_frame.
///
///     out = R^T (in - origin)
///
/// R is the rotation of the rotation vector. Forces and other directions are not shifted: leave the origin at 0 for them.
struct VectorToFrame
{
    using Inputs = In<Vec3>;
    using Params = Frame;
    using Outputs = Out<Vec3>;

    static constexpr Info info {
        .id = "vector.to_frame",
        .name = "To frame",
        .summary = "Transforms a vector from the world into a frame.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector, in the world"),
        frameOrigin (&Params::origin),
        frameRotation (&Params::rotation),
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
