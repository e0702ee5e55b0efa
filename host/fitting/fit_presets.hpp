// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/fit/blade_fit.hpp>
#include <tactus/fit/friction_fit.hpp>
#include <tactus/fit/grating_fit.hpp>
#include <tactus/fit/modes_fit.hpp>
#include <tactus/fit/shock_fit.hpp>
#include <tactus/fit/texture_fit.hpp>
#include <tactus/graph/graph.hpp>

#include <string>

namespace tactus::host
{

// Graphs in which a fit can be felt. `source` says where the numbers come from. Everything that was not fitted is marked as a guess.

graph::Graph frictionPreset (const FrictionFit&, const std::string& load_source, const std::string& source);
graph::Graph modesPreset (const ModesFit&, double newtons_per_unit, const std::string& amplitude_source, const std::string& source);
graph::Graph texturePreset (const TextureFit&, double mass, const std::string& mass_source, const std::string& source);

/// The force of ridge i on a tool without friction is load 2 pi i / period times its amplitude.
graph::Graph gratingPreset (const GratingFit&, double load, const std::string& source);
graph::Graph bladePreset (const BladeFit&, const std::string& source);
graph::Graph shockPreset (const ShockFit&, const std::string& source);

}   // namespace tactus::host
