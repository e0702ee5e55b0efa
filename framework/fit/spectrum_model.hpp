// SPDX-License-Identifier: MIT
#pragma once

#include "least_squares.hpp"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace tactus::detail
{

/// Periodograms of stretches of one signal: each a power density relative to the mean power of a row, at frequencies in rad per row.
struct Periodogram
{
    std::vector<double> frequency {}, power {};
    double widening = 1.0;   ///< the factor by which tapering the ends of the stretches increases variances
};

Periodogram periodogramOf (const std::vector<std::span<const double>>& stretches);

/// The share of the power that the largest line and its two neighbours hold, in a spectrum as fine as the length of each stretch allows; the mean over
/// the stretches, by power. Of noise, a line this narrow holds little, and less the longer the stretch; of a tone, at least 80 %.
double shareOfTones (const std::vector<std::span<const double>>& stretches);

/// An autoregressive model with a white floor.
struct SpectrumModel
{
    std::vector<double> coefficients {};
    double variance = 1.0, floor = 0.0;
    double deviance = 0.0;           ///< mean over the lines; about 1.154 (twice Euler's constant) if the signal is noise with this spectrum
    Eigen::MatrixXd covariance {};   ///< of the coefficients, ln variance and the floor
};

/// Fits a model by Whittle's likelihood, with at most this many coefficients. The stretches give the start values.
SpectrumModel fitSpectrum (const Periodogram&, const std::vector<std::span<const double>>& stretches, int most_coefficients, const FitCourse*);

}   // namespace tactus::detail
