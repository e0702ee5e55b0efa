// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bands.hpp"
#include "meter.hpp"

#include <host/app/look/look.hpp>
#include <host/app/run/traces.hpp>

namespace tactus::host
{

/// The traces of the components of a port.
using PortTraces = std::vector<std::shared_ptr<const Trace>>;

/// Feeds a meter from the trace of a port. The level of a vector is its length.
struct MeterFeed
{
    Meter meter;
    std::string unit;   ///< symbol in SI; empty: not known
    Quantity quantity = Quantity::any;
    double newest = 0.0;        ///< the greatest level that came with the last take(), before the factor
    bool has_changed = false;   ///< true if the last take() was the first one of a run

    /// Returns true if there is a trace. `factor` scales the level.
    bool take (const PortTraces&, double factor, double dt_s);

private:
    std::uint64_t seen = 0;
    std::weak_ptr<const Trace> of;
    std::uint64_t beginnings = 0;   // of this trace
    bool has_begun = false;         // what a trace held before was of another layer, or of an earlier run
    std::vector<double> latest;
};

/// Paints a level as a bar with its peak as a line, on a scale of four decades, from 0.001 to 10. The marks of the scale have the unit with its
/// prefix: "10 mN". If they are too wide, only the first one has it. An empty unit is not known.
void paintMeter (juce::Graphics&, juce::Rectangle<float>, const Meter&, juce::Colour, const Look&, const std::string& unit);

/// "0.42 N", or "–" for silence.
juce::String levelText (double level, const std::string& unit);

/// The colour of a level.
juce::Colour inkOf (Quantity, const Theme&);

/// The latest samples of a trace, at most `n`.
void latestOf (const Trace&, std::size_t n, double factor, std::vector<double>& into);

/// The spectrum of a port: the sum of the spectra of its components.
Bands bandsOfPort (const PortTraces&, double factor);

}   // namespace tactus::host
