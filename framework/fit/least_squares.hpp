// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"

#include <Eigen/Core>

#include <algorithm>
#include <functional>

namespace tactus::detail
{

/// The search for parameters x that minimise the sum of squares of the residuals. Parameters should be of the order of 1.
struct LeastSquares
{
    Eigen::Index rows = 0;
    std::function<void (const Eigen::VectorXd& x, Eigen::VectorXd& residual)> residual {};   ///< recorded minus model
    std::function<void (const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian)> jacobian {};   ///< empty: by central differences
    double step = 1e-5;                                                                      ///< of these differences
    double size = 0.0;                                                                       ///< root mean square of the recorded values
    const FitCourse* course = nullptr;                                                       ///< can cancel the search
};

struct LeastSquaresFit
{
    Eigen::VectorXd x, residual;
    Eigen::MatrixXd jacobian;   ///< of the residual, at x
    double size = 0.0;          ///< root mean square of the recorded values

    double sum() const { return residual.squaredNorm(); }

    /// The sum, but at least what rounding leaves in a recording without noise. Used to choose between models.
    double sumToCompare() const { return atLeastRounding (sum()); }

    /// The same for the changes of the residual from row to row. What a model lacks is mostly slow, and hardly counts.
    double changesToCompare() const { return atLeastRounding ((residual.tail (residual.size() - 1) - residual.head (residual.size() - 1)).squaredNorm()); }

private:
    double atLeastRounding (double squares) const
    {
        constexpr double rounding = 1e-9;   // of the size
        return std::max ({ squares, static_cast<double> (residual.size()) * rounding * rounding * size * size, 1e-300 });
    }
};

/// The Levenberg-Marquardt method (Eigen's). The result is a local minimum, so the start matters.
LeastSquaresFit minimise (const LeastSquares&, Eigen::VectorXd start);

/// The residuals and their slopes without a search.
LeastSquaresFit evaluated (const LeastSquares&, const Eigen::VectorXd& x);

/// The slopes of the fitted parameters with the recorded values: a row for each parameter. They are 0 in directions that the recording does not
/// determine; see isSet.
Eigen::MatrixXd influenceOf (const LeastSquaresFit&);

/// The covariance of estimates. `influence` contains their slopes with the recorded values, a row for each estimate. The residuals show how large
/// the errors of the recorded values are, and how they depend on one another: they are modelled as autoregressive, with an order that BIC
/// selects. The errors are taken as at least a millionth of `size`, because no sensor is better. `parameters` is the number of fitted parameters.
/// Where parts of the recording disagree, the variances are larger: see widenByParts.
Eigen::MatrixXd covarianceOf (const Eigen::MatrixXd& influence, const Eigen::VectorXd& residual, Eigen::Index parameters, double size = 0.0);

inline constexpr Eigen::Index quarters = 4;

/// Widens the covariance of estimates where the halves or the quarters of the recording disagree more than it says, for example because an object
/// wore off: each deviation is multiplied by the Birge ratio, the square root of chi^2 per degree of freedom, if that is above 1. `of_quarters`
/// contains what each quarter of the recording contributes to the estimates: influence times residuals, a row for each estimate. Without drift, the
/// deviations grow by 23 % on average, and 95 % intervals become 97 % intervals.
///
/// Source: Birge 1932; the scale factor of the Particle Data Group, "Review of Particle Physics", Introduction, section 5. What parts contribute:
/// the covariance of Liang & Zeger 1986 with the parts as clusters.
void widenByParts (Eigen::MatrixXd& covariance, const Eigen::MatrixXd& of_quarters);

/// The power of the errors per row at each angle per row, with the same model of the residuals: the variance if they are white. One angle for each
/// fitted parameter.
Eigen::VectorXd errorPowers (const Eigen::VectorXd& residual, const Eigen::VectorXd& angles, double size);

/// The covariance of the fitted parameters. The variance of a parameter that the recording does not determine is infinite, and its covariances
/// with the others are 0.
Eigen::MatrixXd covarianceOf (const LeastSquaresFit&);

/// The variance of the sum of parameters with these factors, which begin at `first`. Infinite if one of them has an infinite variance.
double varianceAlong (const Eigen::MatrixXd& covariance, Eigen::Index first, const Eigen::VectorXd& factors);

/// False for parameters on which no residual depends, or whose effect other parameters can cancel completely.
std::vector<bool> isSet (const LeastSquaresFit&);

/// The effective number of independent rows. It is smaller than the number of rows if the residuals depend on one another.
double independentRows (const Eigen::VectorXd& residual);

/// Half the width of a 95 % interval in standard deviations: Student's t to 0.5 %. At least one degree of freedom is assumed.
double halfWidth95 (double degrees_of_freedom);

/// An interval around a value.
FitValue withInterval (std::string name, std::string unit, double value, double deviation, double degrees_of_freedom, bool is_main = true);

/// The same for a positive value whose logarithm has this standard deviation.
FitValue withLogInterval (std::string name, std::string unit, double value, double log_deviation, double degrees_of_freedom, bool is_main = true);

}   // namespace tactus::detail
