// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/csv.hpp>
#include <tactus/graph/graph.hpp>
#include <tactus/text/result.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// The force of a key switch on the way down and back up. Travel starts at 0.
struct SwitchLoop
{
    std::vector<double> travel, press, release;   // travel in m; force of the key in N
};

/// Reads a recording with columns `x_UNIT` and `force_UNIT` ("x_um", "force_gf", with gf for gram-force), rows in measured
/// order: down to the deepest point, and up again. Travel counts from the first row. Other columns are ignored. The way
/// down and the way up are sampled at the same positions; readings at the same position are averaged, and negative forces (an
/// offset of the gauge) are set to 0.
///
/// `backlash`: the backlash of the meter (m); on the way up, the key is this much deeper than measured.
///
/// Ids: switch/missing_column, switch/unknown_unit, switch/not_finite, switch/one_way, switch/not_released,
/// switch/no_loss.
[[nodiscard]] Result<SwitchLoop> switchFrom (const Table&, const std::string& name, double backlash = 0.0);

/// Energy lost by a stroke down and up, in J.
double loss (const SwitchLoop&);

/// The nearest loop that does not release energy anywhere: where the way up was measured above the way down, which happens
/// on steep slopes if the meter has backlash, both forces are set to their mean.
SwitchLoop withoutGain (SwitchLoop);

/// Reduces the number of points: straight lines between them stay within `tolerance` (N) of the measured force, both on the way
/// down and on the way up (Douglas & Peucker 1973, measured along the force). Travel is rounded to 0.1 um, force to 0.2 mN.
SwitchLoop simplified (const SwitchLoop&, double tolerance);

/// A graph of the key: the mean of the forces on the way down and on the way up is the law of a plane, and half their difference
/// is the bound of a bristle of constant stiffness (N/m), which friction.elasto_plastic drags along the travel.
///
///     press = mean + bound,  release = mean - bound
///
/// A law of travel alone has a potential, even where it falls, and a bristle of constant stiffness whose bound depends only on
/// position never generates energy. So the key is passive for every motion, not only for the two measured ones. After a reversal
/// its force changes from one curve to the other over a travel of 2 bound / stiffness. The key never pulls. Beyond the last point, the
/// law continues as a stop with its steepest slope.
graph::Graph keyFrom (const SwitchLoop&, const std::string& name, double stiffness);

}   // namespace tactus::host
