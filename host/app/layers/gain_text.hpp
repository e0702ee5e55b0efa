// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Converts gains to and from text that people read and type.

#include <tactus/node/catalogue.hpp>
#include <tactus/text/result.hpp>

#include <string>

namespace tactus::host
{

inline constexpr double silent_db = -120.0;   ///< what a field shows for a gain of 0

/// The magnitude of a gain in dB, rounded to 0.1 dB.
double decibelsOf (double gain);

/// 0 for silent_db and below.
double gainOf (double decibels);

/// The datasheet row of a gain in dB, for a NumberField.
const PortSheet& decibelSheet();

/// The greatest level that the meter of a layer has shown, at a gain of 1. From it follows the gain for a level such as "0.3 N".
struct UnityLevel
{
    double peak = 0.0;   ///< 0 if there is no signal
    std::string unit;    ///< "N"; empty if it is not known
};

/// Reads a gain and returns it in dB: "-6" and "-6 dB", "off", "x0.5" and "50 %", or a level in the unit of the layer, such as "0.3 N".
/// A level that needs a gain above 12 dB is refused: the layer has not sounded as it will. Ids: gain/syntax, gain/unit, gain/no_level, gain/quiet.
Result<double> readGain (const std::string& text, const UnityLevel&);

}   // namespace tactus::host
