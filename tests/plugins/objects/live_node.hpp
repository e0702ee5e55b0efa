// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

namespace live
{

using namespace tactus;

/// A force that grows with each tick, so that it shows whether the state is kept.
struct Growing
{
    struct Inputs
    {
        Vec3 position = Vec3::Zero();
    };

    struct Params
    {
        double slope = 1.0;
    };

    struct Outputs
    {
        Vec3 force = Vec3::Zero();
    };

    static constexpr Info info {
        .id = "live.growing",
        .name = "Growing",
        .summary = "A force that grows.",
        .source = "for tests",
    };

    static constexpr std::tuple ports {
        input (&Inputs::position, "position", unit::metre, "not used"),
        param (&Params::slope, "slope", unit::newton, "growth per 1000 ticks"),
        output (&Outputs::force, "force", unit::newton, "the force"),
    };

    Params params;

    void adopt (const Growing& old) noexcept { ticks = old.ticks; }
    void serialize (auto& archive) { archive (ticks); }

    Outputs tick (const Inputs&) noexcept
    {
        ticks += 1.0;
        return { .force = Vec3 (0.0, 0.0, params.slope * 1e-3 * ticks) };
    }

private:
    double ticks = 0.0;
};

}   // namespace live

TACTUS_NODE (live::Growing);
