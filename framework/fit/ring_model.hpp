// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace tactus::detail
{

constexpr double fastest_decay = 0.25;   ///< of a tone, per row; the angle per row is another limit

/// Re (amplitude e^(rate n)) at row n; the rate is -decay + i angle, per row.
struct DecayingTone
{
    std::complex<double> rate, amplitude {};
};

/// Decaying tones and a slow drift, a polynomial of the row divided by the number of rows.
struct RingModel
{
    std::vector<DecayingTone> tones {};
    Eigen::VectorXd drift {};   ///< coefficients, constant first
    Eigen::Index rows = 0;
    double sum = 0.0;   ///< of the squared residuals

    Eigen::Index parameters() const { return 4 * static_cast<Eigen::Index> (tones.size()) + drift.size(); }
    std::vector<std::complex<double>> allRates() const;
    Eigen::VectorXd values() const;

    /// The products of the slopes of the model with one another, over the rows from `begin` to `end`. The parameters are decay, angle, and the real
    /// and imaginary part of the amplitude of each tone, then the drift. Takes no time per row, because the sums over rows are geometric series.
    Eigen::MatrixXd products (Eigen::Index begin, Eigen::Index end) const;

    /// The products of these slopes with a signal.
    Eigen::VectorXd productsWith (const Eigen::VectorXd& signal, Eigen::Index begin, Eigen::Index end) const;

    /// By how much the sum of squares grows if one tone is left out, and the amplitudes of the others change.
    std::vector<double> gains() const;
};

/// Fits tones by least squares, starting from these rates. Amplitudes and drift follow from the rates by linear least squares (variable projection,
/// Golub & Pereyra 1973), and damped Gauss-Newton steps change the rates. Each step reads the signal once for each tone.
RingModel fitRing (const Eigen::VectorXd& signal, const std::vector<std::complex<double>>& rates, Eigen::Index drift, int most_steps, const FitCourse*);

}   // namespace tactus::detail
