// SPDX-License-Identifier: MIT
#pragma once

#include "recording.hpp"

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tactus::host
{

/// The changes that orient() made to the columns of a recording.
struct Pressing
{
    std::set<std::string> turned {};     ///< the roles whose sign was turned, also those that the user has chosen
    std::optional<double> touch {};      ///< the recorded depth that became 0, in m; empty if 0 stayed 0
    std::vector<std::string> notes {};   ///< a sentence for each change that the user has not chosen
};

/// The choice of the place where the depth is 0.
struct Touch
{
    bool is_looked_for = false;       ///< where the force begins, if the recorded 0 cannot be the touch
    std::optional<double> given {};   ///< the recorded depth at the touch, in m
};

/// Some programs record a force as that on the sensor, a depth as a height, or a place on a scale with a zero somewhere else. Turns what should be positive
/// and is not, unless the choice says which signs are turned:
///  - a force, a load: if it is negative where it is largest and, but for noise or a pull on the way out, in the whole column;
///  - a depth: if it falls while the force grows from the touch to its largest value; without such a rise of the force, if the whole column is negative.
/// Then it moves the zero of the depth. The recorded 0 cannot be the touch if it is outside the recording, if the force begins well before it, or if the
/// force begins only after a third of the way. [any thread]
Pressing orient (const std::vector<FitColumn>&, RecordedColumns&, const ColumnChoice& = {}, const Touch& = {});

}   // namespace tactus::host
