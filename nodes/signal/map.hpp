// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/generic.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::nodes
{

/// Maps a signal through a drawn curve: straight between its points, constant beyond its ends.
///
/// The curve gives the output for each input and may change the unit: speed to force, depth to gain. The default curve passes
/// 0 … 1 unchanged.
struct SignalMap
{
    using Inputs = In<double>;
    using Params = Empty;

    struct Settings
    {
        Curve curve { { 0.0, 1.0 }, { 0.0, 1.0 } };
    };

    using Outputs = Out<double>;

    static constexpr Info info {
        .id = "signal.map",
        .name = "Map",
        .summary = "Maps a signal through a drawn curve.",
        .source = "definition",
        .keywords = "curve table lookup waveshaper",
    };

    static constexpr std::tuple ports {
        input (&Inputs::in, "in", any_unit, "signal"),
        setting (&Settings::curve, "curve", sameAs ("in"), sameAs ("out"), "output over input"),
        output (&Outputs::out, "out", any_unit, "value of the curve at the signal"),
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
