// SPDX-License-Identifier: MIT
#pragma once

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
        stages.assign (order, {});
        for (Stage& stage : stages)
            stage.b = normal();
    }

    std::size_t order() const noexcept { return stages.size(); }

    /// Sets a reflection coefficient. Returns 1 - k^2. [tick thread]
    double set (std::size_t stage, double k) noexcept
    {
        const double rest = (1.0 - k) * (1.0 + k);
        stages[stage].k = k;
        stages[stage].c = std::sqrt (rest);
        return rest;
    }

    /// One sample. [tick thread]
    double operator() (double e) noexcept
    {
        double f = e, b = 0.0;
        for (std::size_t i = stages.size(); i-- > 0;)
        {
            Stage& stage = stages[i];
            b = stage.c * stage.b - stage.k * f;
            f = stage.c * f + stage.k * stage.b;
            if (i + 1 < stages.size()) stages[i + 1].b = b;
        }
        if (! stages.empty()) stages[0].b = f;
        return f;
    }

    /// Copies the signals of the stages that both lattices have. [tick thread]
    void adopt (const Lattice& old) noexcept
    {
        for (std::size_t i = 0; i < stages.size() && i < old.stages.size(); ++i)
            stages[i].b = old.stages[i].b;
    }

private:
    struct Stage
    {
        double k = 0.0, c = 1.0;
        double b = 0.0;   // backward signal of the previous stage, one sample ago
    };

    std::vector<Stage> stages;
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
