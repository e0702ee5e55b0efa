// SPDX-License-Identifier: MIT
#pragma once

#include "spectrum.hpp"

#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

struct HeatMap;   // plot.hpp

/// A signal: the samples of each of its components, such as x, y and z of a force.
using Components = std::vector<std::vector<double>>;

/// The amplitude of each frequency of a signal. The columns are times, or speeds of a stroke. The amplitude of a vector is the root of the sum
/// of the squares of its components' amplitudes, so the result does not depend on the directions of the axes.
struct Spectrogram
{
    std::vector<double> at {};                     ///< the time (s) or speed (m/s) of each column, evenly spaced
    double step_hz = 1.0;                          ///< between two lines
    std::vector<std::vector<double>> columns {};   ///< amplitudes at 0, step_hz, … Hz
};

/// The amplitudes of some samples at 0, step, … Hz, up to a frequency or half the rate. `length`: as for spectrumOf.
std::vector<double> amplitudesOf (std::span<const std::span<const double>> components, double rate_hz, std::size_t length, double up_to_hz);

/// A spectrogram over time, with windows of `window_s`. They overlap as much as the limit of `most_columns` columns allows. Empty if the signal
/// is shorter than a window.
Spectrogram spectrogramOf (const Components&, double rate_hz, double window_s, double up_to_hz, std::size_t most_columns = 800);

/// The frequency of the strongest line of a column, at or above a frequency; 0 if the column is silent.
double ridgeOf (const Spectrogram&, std::size_t column, double from_hz = 0.0);

/// The spectrogram as a map in decibels relative to one unit. The colours reach from the loudest line down by this many decibels.
HeatMap heatMapOf (const Spectrogram&, const std::string& unit, double decibels);

}   // namespace tactus::host
