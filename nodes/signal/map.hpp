// SPDX-License-Identifier: MIT
#pragma once

#include <framework/node.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::nodes
{

/// Bends a signal by a drawn curve: straight between its points, held beyond its ends.
///
/// The curve says what comes out for each value that goes in, and may change the unit on the way: speed to newton, depth to
/// gain. As delivered it passes 0 … 1 unchanged.
struct SignalMap
{
    struct Inputs
    {
        double in = 0.0;
    };

    struct Params
    {
    };

    struct Settings
    {
        Curve curve { { 0.0, 1.0 }, { 0.0, 1.0 } };
    };

    struct Outputs
    {
        double out = 0.0;
    };

    static constexpr Info info {
        .id = "signal.map",
        .name = "Map",
        .summary = "Bends a signal by a drawn curve.",
        .source = "definition",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        setting (&Settings::curve, "curve", sameAs ("in"), sameAs ("out"), "what comes out over what goes in"),
        output (&Outputs::out, "out", any_unit, "the curve at the signal"),
    };

    Params params;
    Settings settings;

    Outputs tick (const Inputs& in) const noexcept
    {
        if (! isFinite (in.in)) return {};
        return { .out = finiteOrZero (settings.curve (in.in)) };
    }

    Claims claims() const
    {
        double largest = 0.0;
        for (const double y : settings.curve.y)
            largest = std::max (largest, std::abs (y));
        return { .amplitude = largest };
    }
};

}   // namespace tactus::nodes

TACTUS_NODE (tactus::nodes::SignalMap);
