// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/kit/law.hpp>
#include <tactus/text/json.hpp>

#include <string>

namespace tactus::host
{

/// A uniform body: its curve along the normal is the same everywhere.
struct UniformBody
{
    Law along;             ///< force against depth
    double mu = 0.3;       ///< drag over push while the tool slides; 0: no friction
    double ratio = 0.45;   ///< the sideways deflection at which the tool slides, over its depth; above 0
};

/// A law as a graph file contains it, with six digits.
Json toJson (const Law&);

/// The members "curves" and "mu" of a setting of kind `surface`.
Json curvesOf (const UniformBody&);

/// A graph in which a finger presses and strokes a square pad of this body. `source` says where its curve comes from. [main thread]
graph::Graph surfacePreset (const UniformBody&, const std::string& name, const std::string& about, const std::string& source);

/// "2.48 mJ"; less than a picojoule is 0.
std::string energyText (double joules, int digits = 3);

/// The number rounded to so many digits. Six are more than the accuracy of any fit; places along a path need them.
double tidy (double value, int digits = 6);

}   // namespace tactus::host
