// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/at.hpp>

#include <array>
#include <cmath>

namespace tactus
{

/// Least squares with a small weight on all unknowns. Rows are added one by one, by Givens' rotations, so no row is kept.
template <int n>
class LeastSquares
{
public:
    using Row = std::array<double, n + 1>;   ///< factors of the unknowns, and the value that they should add up to

    explicit LeastSquares (double weight)
    {
        for (int k = 0; k < n; ++k)
            rows[at (k)][at (k)] = weight;
    }

    void add (Row row)
    {
        for (int k = 0; k < n; ++k)
        {
            Row& own = rows[at (k)];
            const double length = std::sqrt (own[at (k)] * own[at (k)] + row[at (k)] * row[at (k)]), c = own[at (k)] / length, s = row[at (k)] / length;
            for (std::size_t j = at (k); j < row.size(); ++j)
            {
                const double before = own[j];
                own[j] = c * before + s * row[j];
                row[j] = c * row[j] - s * before;
            }
        }
    }

    std::array<double, n> solved() const
    {
        std::array<double, n> x {};
        for (int k = n - 1; k >= 0; --k)
        {
            double rest = rows[at (k)][n];
            for (int j = k + 1; j < n; ++j)
                rest -= rows[at (k)][at (j)] * x[at (j)];
            x[at (k)] = rest / rows[at (k)][at (k)];
        }
        return x;
    }

private:
    std::array<Row, n> rows {};   // the upper triangle
};

}   // namespace tactus
