// SPDX-License-Identifier: MIT
#include "spectral_radius.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace tactus::check
{

namespace
{
/// Scales a state by a power of two so that its row and its column have similar sums. Returns false if they have them already.
bool balance (Eigen::MatrixXd& m, Eigen::Index i)
{
    constexpr double worthwhile = 0.95;
    const double own = std::abs (m (i, i)), row = m.row (i).lpNorm<1>() - own;
    double column = m.col (i).lpNorm<1>() - own, scale = 1.0;
    if (! (row > 0.0) || ! (column > 0.0)) return false;
    const double before = row + column;
    for (; column < row / 2.0; column *= 4.0)
        scale *= 2.0;
    for (; column > row * 2.0; column /= 4.0)
        scale /= 2.0;
    if ((column + row) / scale >= worthwhile * before) return false;
    m.row (i) /= scale;
    m.col (i) *= scale;
    return true;
}
}   // namespace

double spectralRadius (const Jacobian& matrix)
{
    Eigen::MatrixXd m = matrix;
    constexpr int most_rounds = 100;   // a few are enough
    bool changes = true;
    for (int round = 0; changes && round < most_rounds; ++round)
    {
        changes = false;
        for (Eigen::Index i = 0; i < m.rows(); ++i)
            changes = balance (m, i) || changes;
    }
    return Eigen::EigenSolver<Eigen::MatrixXd> (m, false).eigenvalues().cwiseAbs().maxCoeff();
}

}   // namespace tactus::check
