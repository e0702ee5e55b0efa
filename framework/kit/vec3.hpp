// SPDX-License-Identifier: MIT
#pragma once

// Where Eigen computes with vectors of several doubles, the order in which it adds the terms of a sum depends on their number, and so
// do the last bits. So nodes, and all of Tactus, are compiled with -DEIGEN_DONT_VECTORIZE (tactus::node_flags). It is not defined here: the types
// of Eigen that are aligned for these vectors would then have another layout in programs that include this header than in their other parts.
#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

namespace tactus
{

using Vec3 = Eigen::Vector3d;

/// A relative margin against rounding: this one, but at least a few units in the last place. That matters only in single precision.
constexpr double margin (double relative) noexcept { return std::max (relative, 32.0 * std::numeric_limits<double>::epsilon()); }

/// True if every component of every value is a finite number. Nodes check their inputs with it.
inline bool isFinite (double v) noexcept
{
    const double none = v - v;   // 0 or NaN
    return none == none;
}

namespace detail
{
template <typename T>
concept NumberOrVector = std::same_as<T, double> || std::same_as<T, Vec3>;

inline double total (double v) noexcept { return v; }
inline double total (const Vec3& v) noexcept { return v.x() + v.y() + v.z(); }
inline double zeroIfFinite (double v) noexcept { return v - v; }
inline double zeroIfFinite (const Vec3& v) noexcept { return (v.x() - v.x()) + (v.y() - v.y()) + (v.z() - v.z()); }

/// One comparison for all values. Where their sum is finite, each of them is. Where it is not, it may only be too large.
template <NumberOrVector... T>
bool areFinite (const T&... values) noexcept
{
    return isFinite ((total (values) + ...)) || isFinite ((zeroIfFinite (values) + ...));
}
}   // namespace detail

inline bool isFinite (const Vec3& v) noexcept { return detail::areFinite (v); }

template <typename... T>
requires (sizeof...(T) > 1) auto isFinite (const T&... values) noexcept
{
    if constexpr ((detail::NumberOrVector<T> && ...))
        return detail::areFinite (values...);
    else
        return (isFinite (values) && ...);
}

/// Returns the value if every component is finite, else 0. Nodes whose arithmetic can overflow pass their result through it.
inline double finiteOrZero (double v) noexcept { return isFinite (v) ? v : 0.0; }
inline Vec3 finiteOrZero (const Vec3& v) noexcept { return isFinite (v) ? v : Vec3::Zero(); }

/// The length of a vector, even of the largest and smallest ones. Scaling it first, as Eigen's stableNorm does, costs several
/// times as much, and is needed only where a square would leave the range of doubles. NaN if a component is NaN; stableNorm may lose a NaN.
inline double length (const Vec3& v) noexcept
{
    const double square = v.squaredNorm();
    if (square > 1e-280 && square < 1e280) return std::sqrt (square);
    return square == square ? v.stableNorm() : square;
}

/// The direction of a finite vector: length 1, or 0 for the zero vector. Works for the largest and smallest vectors, too.
inline Vec3 direction (const Vec3& v) noexcept
{
    const double largest = v.cwiseAbs().maxCoeff();
    return largest > 0.0 ? Vec3 { (v / largest).normalized() } : Vec3::Zero();
}

}   // namespace tactus
