// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

#include <algorithm>

namespace tactus::nodes
{

/// Fades a texture in over the first fraction of a millimetre, so that the force does not jump at a touch.
///
///     gain = clamp (depth / window, 0, 1)
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 5, superposition on a nominal force.
///
/// Beware: the gain times a force that depends on lateral position has no potential. A tool that goes in at one place and comes
/// out at another can gain at most the work of the bare texture between the two places. A thin window keeps this small compared
/// with the friction of any real contact.
struct ContactWindow
{
    struct Inputs
    {
        double depth = 0.0;
    };

    struct Params
    {
        double window = 5e-4;
    };

    struct Outputs
    {
        double gain = 0.0;
    };

    static constexpr Info info {
        .id = "contact.window",
        .name = "Contact window",
        .summary = "A gain from 0 at the surface to 1 at a small depth.",
        .source = "Hayward 2007, section 5",
        .keywords = "gate onset fade",
    };

    static constexpr std::tuple ports {
        input (&Inputs::depth, "depth", unit::metre, "depth of the tool in the object"),
        param (&Params::window, "window", unit::metre, "depth at which the gain is 1", { .hard = { 1e-9, inf }, .usual = { 1e-5, 5e-3 } }),
        output (&Outputs::gain, "gain", unit::gain, "0 outside the object, rising to 1 at a depth of window"),
    };

    Params params;

    Claims claims() const { return { .amplitude = 1.0 }; }

    Outputs tick (const Inputs& in) noexcept
    {
        return { .gain = isFinite (in.depth) ? std::clamp (in.depth / params.window, 0.0, 1.0) : 0.0 };
    }

    void serialize (auto&) {}
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::ContactWindow);
