// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"

#include <Eigen/Core>

#include <functional>

namespace tactus::detail
{

/// Parameters x for which the sum of squares of the residuals is smallest. Parameters should be of the order of 1.
struct LeastSquares
{
    Eigen::Index rows = 0;
    std::function<void (const Eigen::VectorXd& x, Eigen::VectorXd& residual)> residual {};   ///< recorded minus model
    std::function<void (const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian)> jacobian {};   ///< empty: by central differences
    double step = 1e-5;                                                                      ///< of these differences
    const FitCourse* course = nullptr;                                                       ///< may end the search early
};

struct LeastSquaresFit
{
    Eigen::VectorXd x, residual;
    Eigen::MatrixXd jacobian;   ///< of the residual, at x

    double sum() const { return residual.squaredNorm(); }
};

/// Levenberg and Marquardt's method (Eigen's). The result is a local minimum, so the start matters.
LeastSquaresFit minimise (const LeastSquares&, Eigen::VectorXd start);

/// The residuals and their slopes without a search.
LeastSquaresFit evaluated (const LeastSquares&, const Eigen::VectorXd& x);

/// How each parameter of a least squares fit moves if a row is recorded higher: a row per parameter. Directions that the recording does not set
/// do not move, so see isSet.
Eigen::MatrixXd influenceOf (const LeastSquaresFit&);

/// The covariance of estimates that move by `influence` (a row per estimate) with the errors of the rows. The residuals say how large these
/// errors are and how they depend on one another: they are modelled as autoregressive, with an order that BIC selects. `parameters` were fitted.
Eigen::MatrixXd covarianceOf (const Eigen::MatrixXd& influence, const Eigen::VectorXd& residual, Eigen::Index parameters);

/// False for parameters on which no residual depends, or that can be exchanged for others without a trace.
std::vector<bool> isSet (const LeastSquaresFit&);

/// The number of independent rows among residuals that depend on one another.
double independentRows (const Eigen::VectorXd& residual);

/// Half the width of a 95 % interval in standard deviations.
double halfWidth95 (double degrees_of_freedom);

/// An interval around a value.
FitValue withInterval (std::string name, std::string unit, double value, double deviation, double degrees_of_freedom, bool is_main = true);

/// The same for a positive value whose logarithm has this deviation.
FitValue withLogInterval (std::string name, std::string unit, double value, double log_deviation, double degrees_of_freedom, bool is_main = true);

}   // namespace tactus::detail
