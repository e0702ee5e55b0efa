// SPDX-License-Identifier: MIT
#pragma once

#include "surface.hpp"

#include <limits>
#include <string>

namespace tactus
{

/// What a surface cannot be, as a sentence; empty if it can.
std::string problemOf (const Surface&);

// What it had better not be, each a sentence or empty.
std::string wrongSide (const Surface&);                ///< it faces inwards, and so attracts
std::string leaning (const Surface&);                  ///< frames lean against their triangles: frictionless, it is no potential
std::string slipGain (const Surface&, double scale);   ///< a slip gives energy, at depths that a hand reaches

/// The least depth at which a slip somewhere gives energy, and where: f_t (mu_c d^z) < |dU/dc|, on a grid of depths.
struct SlipGain
{
    int triangle = -1;
    double depth = std::numeric_limits<double>::infinity();   ///< m
};
SlipGain shallowestGain (const Surface&, double scale);

}   // namespace tactus
