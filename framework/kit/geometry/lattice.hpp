// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace tactus
{

/// The reflection coefficients of y_n = sum_k a_k y_(n-k) + e_n, as many as there are a_k. Runs Levinson's recursion
/// backwards. Empty if the recursion is not stable. [main thread]
std::vector<double> reflectionsOf (std::vector<double> a);

/// An all-pole filter as a normalised lattice. Stage m rotates its forward and backward signals by an angle,
///
///     f_(m-1) = c f_m + k b_(m-1),   b_m = c b_(m-1) - k f_m,   c = sqrt (1 - k^2)
///
/// which keeps their energy however the reflection coefficients k, all below 1 in size, move while it runs: white noise of
/// variance 1 in gives a signal of variance 1 out. Source: Gray & Markel 1975.
class Lattice
{
public:
    /// Starts with this many stages. The backward signals of a lattice that has run for a long time are independent and of
    /// variance 1, so they are taken from `normal`. [main thread]
    template <typename Normal>
    void start (std::size_t order, Normal&& normal)
    {
        reflections.assign (order, 0.0);
        rests.assign (order, 1.0);
        cosines.assign (order, 1.0);
        backward.assign (order, 0.0);
        for (double& b : backward)
            b = normal();
    }

    std::size_t order() const noexcept { return backward.size(); }

    /// Sets all reflection coefficients: `reflection (i)` is that of stage i. Returns the product of 1 - k^2 over all stages. The loops are
    /// separate, so that a compiler can compute several stages at once. [tick thread]
    template <typename Reflection>
    double set (Reflection&& reflection) noexcept
    {
        const auto n = order();
        double* const k = reflections.data();
        double* const rest = rests.data();
        double* const c = cosines.data();
        for (std::size_t i = 0; i < n; ++i)
            k[i] = reflection (i);
        for (std::size_t i = 0; i < n; ++i)
        {
            rest[i] = (1.0 - k[i]) * (1.0 + k[i]);
            c[i] = std::sqrt (rest[i]);
        }
        double product = 1.0;
        for (std::size_t i = 0; i < n; ++i)
            product *= rest[i];
        return product;
    }

    /// One sample. [tick thread]
    double operator() (double e) noexcept
    {
        const auto n = order();
        if (n == 0) return e;
        const double* const k = reflections.data();
        const double* const c = cosines.data();
        double* const b = backward.data();
        double f = c[n - 1] * e + k[n - 1] * b[n - 1];   // nothing reads the backward signal of the last stage
        for (std::size_t i = n - 1; i-- > 0;)
        {
            b[i + 1] = c[i] * b[i] - k[i] * f;
            f = c[i] * f + k[i] * b[i];
        }
        b[0] = f;
        return f;
    }

    /// Copies the signals of the stages that both lattices have. [tick thread]
    void adopt (const Lattice& old) noexcept { std::copy_n (old.backward.begin(), std::min (order(), old.order()), backward.begin()); }

    void serialize (auto& archive) { archive (reflections, rests, cosines, backward); }

private:
    // By stage.
    std::vector<double> reflections, rests, cosines;   // k, 1 - k^2, c
    std::vector<double> backward;                      // backward signal of the previous stage, one sample ago
};

//==============================================================================
// Implementation below.

inline std::vector<double> reflectionsOf (std::vector<double> a)
{
    std::vector<double> reflections (a.size());
    for (std::size_t m = a.size(); m-- > 0;)
    {
        const double k = a[m];
        if (! (std::abs (k) < 1.0)) return {};
        reflections[m] = k;
        const std::vector<double> whole = a;
        for (std::size_t j = 0; j < m; ++j)
            a[j] = (whole[j] + k * whole[m - 1 - j]) / ((1.0 - k) * (1.0 + k));
    }
    return reflections;
}

}   // namespace tactus
