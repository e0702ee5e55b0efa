// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/fit/blade_fit.hpp>
#include <tactus/fit/friction_fit.hpp>
#include <tactus/fit/grating_fit.hpp>
#include <tactus/fit/modes_fit.hpp>
#include <tactus/fit/shock_fit.hpp>
#include <tactus/fit/switch_fit.hpp>
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

/// A key: the mean of the forces on the way down and on the way up is the law of a plane, and half their difference is the bound of a bristle of
/// constant stiffness (N/m), which friction.elasto_plastic drags along the travel.
///
///     press = mean + bound,  release = mean - bound
///
/// A law of travel alone has a potential, even where it falls, and a bristle of constant stiffness whose bound depends only on
/// position never generates energy. So the key is passive for every motion, not only for the two recorded ones. After a reversal
/// its force changes from one curve to the other over a travel of 2 bound / stiffness. The key never pulls.
graph::Graph switchPreset (const SwitchLoop&, double stiffness, const std::string& source);

}   // namespace tactus::host
