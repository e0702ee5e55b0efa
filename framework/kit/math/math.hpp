// SPDX-License-Identifier: MIT
#pragma once

#include "arc.hpp"
#include "exact.hpp"
#include "exp.hpp"
#include "log.hpp"
#include "pow.hpp"
#include "trig.hpp"

#include <cstdint>

/// All elementary functions: exp exp2 expm1 log log1p log2 log10 pow, sin cos sinCos tan, asin acos atan atan2, hypot fmod remainder. [any thread]
///
/// Nodes call these instead of those of <cmath>, whose last bits differ between C libraries, and even within one library between
/// processors (docs/decisions/elementary_functions.md). The error is at most 2 ulp; infinities, NaN, subnormal numbers and zeros of both
/// signs are treated as in C. Exact by IEEE 754, and so allowed from <cmath>: sqrt, abs, floor, ceil, trunc, round, copysign and the like
/// (tests/structure/functions.py).
namespace tactus::math
{

/// Changes whenever a function gives different bits. Run logs note it, because a replay repeats a run only with the same functions.
inline constexpr std::uint64_t revision = 1;

inline float exp (float x) noexcept { return static_cast<float> (exp (static_cast<double> (x))); }
inline float exp2 (float x) noexcept { return static_cast<float> (exp2 (static_cast<double> (x))); }
inline float expm1 (float x) noexcept { return static_cast<float> (expm1 (static_cast<double> (x))); }
inline float log (float x) noexcept { return static_cast<float> (log (static_cast<double> (x))); }
inline float log1p (float x) noexcept { return static_cast<float> (log1p (static_cast<double> (x))); }
inline float log2 (float x) noexcept { return static_cast<float> (log2 (static_cast<double> (x))); }
inline float log10 (float x) noexcept { return static_cast<float> (log10 (static_cast<double> (x))); }
inline float pow (float x, float y) noexcept { return static_cast<float> (pow (static_cast<double> (x), static_cast<double> (y))); }
inline float sin (float x) noexcept { return static_cast<float> (sin (static_cast<double> (x))); }
inline float cos (float x) noexcept { return static_cast<float> (cos (static_cast<double> (x))); }
inline float tan (float x) noexcept { return static_cast<float> (tan (static_cast<double> (x))); }
inline float atan (float x) noexcept { return static_cast<float> (atan (static_cast<double> (x))); }
inline float atan2 (float y, float x) noexcept { return static_cast<float> (atan2 (static_cast<double> (y), static_cast<double> (x))); }

}   // namespace tactus::math
