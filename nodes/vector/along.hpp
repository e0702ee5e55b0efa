// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

namespace tactus::nodes
{

/// Splits a vector by a direction: a number along it, and the vector that is left across it.
///
///     u = direction / |direction|      along = in . u      across = in - along u
///
/// Only the direction matters, not its length. With a direction of length 0, `along` is 0 and `across` is the whole vector.
struct VectorAlong
{
    struct Inputs
    {
        Vec3 in = Vec3::Zero();
        Vec3 direction = Vec3::UnitZ();
    };

    using Params = Empty;

    struct Outputs
    {
        double along = 0.0;
        Vec3 across = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "vector.along",
        .name = "Along",
        .summary = "Splits a vector into the parts along and across a direction.",
        .source = "definition",
        .keywords = "project component",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "vector"),
        input (&Inputs::direction, "direction", any_unit, "direction of any length"),
        output (&Outputs::along, "along", sameAs ("in"), "signed part along the direction"),
        output (&Outputs::across, "across", sameAs ("in"), "the rest, at right angles to the direction"),
    };

    Params params;

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! isFinite (in.in, in.direction)) return {};

        const Vec3 u = direction (in.direction);
        const double along = in.in.dot (u);
        const Vec3 across = in.in - along * u;
        if (! isFinite (along, across)) return {};
        return { .along = along, .across = across };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::VectorAlong);
