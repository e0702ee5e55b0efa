// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace tactus::detail
{

/// A column of numbers, whose layout does not depend on the flags of the compiler.
using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::DontAlign>;

/// A smooth curve through the values of a column.
struct SmoothColumn
{
    Column values {};
    double weight = 0.0;   ///< of the squared second differences, in the sum of squares that the curve minimises
    double noise = 0.0;    ///< standard deviation of the values around the curve
    double rows = 1.0;     ///< rows of which each value is about the mean
};

/// The curve z that minimises the sum of (y - z)^2 + weight (second difference of z)^2. Time: linear.
///
/// Source: Whittaker 1923; Eilers 2003.
Column smoothed (const Column& y, double weight);

/// The curve whose weight predicts left-out rows best. A curve that follows more than 70 % of the rows' freedom is not considered. Changes that are as
/// fast as the noise are taken as noise, and noise that is as slow as the changes is taken as change.
///
/// Source: generalised cross-validation, with the factor 1.4 of Kim & Gu 2004 against following the noise.
SmoothColumn smoothed (const Column& y);

}   // namespace tactus::detail
