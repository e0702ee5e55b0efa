// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/face.hpp>

#include <tactus/graph/edit.hpp>

#include <optional>
#include <string>
#include <vector>

#include <juce_core/juce_core.h>

namespace tactus::host
{

/// A wire that adds to a parameter, and how far it moves the parameter around its value.
struct Modulation
{
    std::string patch;   ///< where the wire is
    graph::Id wire = 0;
    std::string from;            ///< "lfo.out"
    double depth = 0.0;          ///< SI units of the parameter; negative if it goes down where the source goes up
    bool is_one_sided = false;   ///< the source is never below 0: an envelope, a speed
    double of_one = 0.0;         ///< the depth for a gain of 1 in the unit of the gain; 0 if it is not known
    std::string unit {};         ///< of the parameter, SI; "" if it is not known
};

/// The wires that add to a param of a node, in the order of the patch. The depth is that of a full swing of the source: the amplitude of an oscillator,
/// the standard deviation of a noise, 0.1 m/s of a speed, and 1 of all others.
std::vector<Modulation> modulationsOf (const graph::Graph&, const std::string& patch, const std::string& node, const FacePort&, const Catalogue&);

/// The same for the path of a param, such as "grain/wave.amplitude", with the wires to ports through which subgraphs expose it. None for a path into another
/// file, or into several instances.
std::vector<Modulation> modulationsAt (const graph::Graph&, const std::string& path, const Catalogue&);

/// "±8 mN", or "+8 mN" from a source that is never below 0.
juce::String sizeOf (const Modulation&);

/// "±8 mN by lfo.out".
juce::String textOf (const Modulation&);

/// Gives a modulation another depth, in SI units of the parameter, in the unit in which its gain is written. Empty if its wire is gone or has no gain
/// that can be changed.
std::optional<graph::Command> changeDepth (const graph::Graph&, const Modulation&, double to);

/// Reads a depth that the user typed, in SI units of the parameter. A number without a unit has the unit in which the depth is shown.
Result<double> readDepth (const std::string& typed, const Modulation&, const PortSheet&);

/// Removes the wire.
graph::Command removeModulation (const Modulation&);

/// The depth after dragging up by this many pixels: 200 pixels are `span`. It is 0 within some pixels around 0, so that one finds it.
double draggedDepth (double from, double span, double pixels);

}   // namespace tactus::host
