// SPDX-License-Identifier: MIT
#pragma once

#include "surface.hpp"

#include <limits>
#include <string>

namespace tactus
{

/// Why a surface cannot be used, as a sentence. Empty if it can.
std::string problemOf (const Surface&);

// Warnings about a usable surface. Each is a sentence, or empty.
std::string wrongSide (const Surface&);                ///< the surface faces inwards, and therefore attracts
std::string leaning (const Surface&);                  ///< frames are tilted against their triangles, so without friction there is no potential
std::string slipGain (const Surface&, double scale);   ///< a slip generates energy at a depth a hand can reach

/// The smallest depth at which a slip anywhere generates energy, f_t (mu_c d^z) < |dU/dc|, and the triangle where it does. The
/// search uses a grid of depths.
struct SlipGain
{
    int triangle = -1;
    double depth = std::numeric_limits<double>::infinity();   ///< in m
};
SlipGain shallowestGain (const Surface&, double scale);

}   // namespace tactus
