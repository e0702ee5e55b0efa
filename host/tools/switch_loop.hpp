// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/graph.hpp>
#include <host/io/csv.hpp>
#include <host/io/error.hpp>

#include <tl/expected.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// A key switch on its way down and back up. Travel rises from 0.
struct SwitchLoop
{
    std::vector<double> travel, press, release;   // m; N that the key pushes back with
};

/// Reads a recording with columns `x_UNIT` and `force_UNIT` ("x_um", "force_gf", gf being gram-force), rows in the order
/// in which they were taken: down to the deepest one, and up again. Travel counts from the first. Further columns are
/// ignored. Both ways get the same places; readings at one place are averaged, and what pulls (an offset of the gauge) is
/// taken for 0.
///
/// `backlash`: the meter's; on the way up the key is deeper by this than the meter says (m).
///
/// Ids: switch/missing_column, switch/unknown_unit, switch/not_finite, switch/one_way, switch/not_released,
/// switch/no_loss.
[[nodiscard]] tl::expected<SwitchLoop, Error> switchFrom (const Table&, const std::string& name, double backlash = 0.0);

/// What a stroke down and up loses, in J.
double loss (const SwitchLoop&);

/// The nearest loop that gives no energy anywhere: where the way up was measured above the way down, as a meter with
/// backlash does where the force is steep, both take their mean.
SwitchLoop withoutGain (SwitchLoop);

/// The same with fewer points: straight lines between them stay within `tolerance` (N) of both ways (Douglas & Peucker
/// 1973, measured along the force). Travel is rounded to 0.1 um, force to 0.2 mN.
SwitchLoop simplified (const SwitchLoop&, double tolerance);

/// A graph of that key: the mean of both ways as the law of a plane, and half their difference as the bound of a bristle
/// of constant stiffness (N/m), which friction.elasto_plastic drags along the travel.
///
///     press = mean + bound,  release = mean - bound
///
/// A law over travel is a potential, also where it falls; a bristle of constant stiffness whose bound depends on the place
/// only loses energy. So the key is passive for every motion, not only for the two that were measured. After a reversal it
/// changes from one way to the other over a travel of 2 bound / stiffness. It does not pull, but for 1e-9 m times the stiffness: a
/// bound is never quite 0. Beyond the last point a stop goes on as steep as the steepest part of the law.
graph::Graph keyFrom (const SwitchLoop&, const std::string& name, double stiffness);

}   // namespace tactus::host
