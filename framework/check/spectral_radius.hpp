// SPDX-License-Identifier: MIT
#pragma once

#include "measure.hpp"

namespace tactus::check
{

/// The largest magnitude of an eigenvalue of a square matrix without infinities and NaN. [any thread]
///
/// Rows and columns are balanced first, by powers of two (Parlett and Reinsch, Numerische Mathematik 13, 1969): the states of a loop are metres, metres per
/// second and newtons, so its entries differ by many powers of ten, and almost equal eigenvalues would be wrong by 1e-4.
double spectralRadius (const Jacobian&);

}   // namespace tactus::check
