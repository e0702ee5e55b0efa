// SPDX-License-Identifier: MIT
#include "smooth_column.hpp"

#include <tactus/kit/math/math.hpp>

#include <cmath>
#include <limits>
#include <numbers>

namespace tactus::detail
{

using Eigen::Index;

Column smoothed (const Column& y, double weight)
{
    const Index n = y.size();
    if (n < 4) return y;
    Column pivot (n), next (n), second (n), z = y;   // L D L^T of a band of two
    for (Index i = 0; i < n; ++i)
    {
        const bool is_end = i == 0 || i == n - 1, is_beside = i == 1 || i == n - 2;
        double d = 1.0 + weight * (is_end ? 1.0 : is_beside ? 5.0
                                                            : 6.0),
               e = weight * (i == 0 || i == n - 2 ? -2.0 : -4.0);
        if (i > 0)
        {
            d -= pivot[i - 1] * next[i - 1] * next[i - 1];
            e -= pivot[i - 1] * next[i - 1] * second[i - 1];
            z[i] -= next[i - 1] * z[i - 1];
        }
        if (i > 1)
        {
            d -= pivot[i - 2] * second[i - 2] * second[i - 2];
            z[i] -= second[i - 2] * z[i - 2];
        }
        pivot[i] = d;
        next[i] = e / d;
        second[i] = weight / d;
    }
    for (Index i = n; i-- > 0;)
    {
        z[i] /= pivot[i];
        if (i + 1 < n) z[i] -= next[i] * z[i + 1];
        if (i + 2 < n) z[i] -= second[i] * z[i + 2];
    }
    return z;
}

namespace
{
/// The number of free values of the curve through n rows, from the eigenvalues of the second differences.
double freedomOf (Index n, double weight)
{
    double sum = 0.0;
    for (Index k = 0; k < n; ++k)
    {
        const double step = 2.0 - 2.0 * math::cos (std::numbers::pi * static_cast<double> (k) / static_cast<double> (n));
        sum += 1.0 / (1.0 + weight * step * step);
    }
    return sum;
}
}   // namespace

SmoothColumn smoothed (const Column& y)
{
    constexpr double caution = 1.4, lightest = 0.1, heaviest = 1e10, finer = 3.0;
    const auto n = static_cast<double> (y.size());
    SmoothColumn best { .values = y };
    double least = std::numeric_limits<double>::infinity();
    for (double weight = lightest; weight < heaviest; weight *= finer)
    {
        const double freedom = freedomOf (y.size(), weight);
        if (caution * freedom >= n) continue;
        const Column z = smoothed (y, weight);
        const double sum = (y - z).squaredNorm(), score = sum / ((n - caution * freedom) * (n - caution * freedom));
        if (! (score < least)) continue;
        least = score;
        best = { z, weight, std::sqrt (sum / (n - freedom)), n / freedom };
    }
    return best;
}

}   // namespace tactus::detail
