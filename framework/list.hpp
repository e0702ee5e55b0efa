// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>

namespace tactus
{

using Vec3 = Eigen::Vector3d;

/// The most entries an array port can have. More inputs are added with a second mixer.
inline constexpr int list_capacity = 64;

/// An array port among a node's Inputs: a view on whatever is wired to in[0], in[1], …
/// It reads the sources in place; nothing is copied. Its length is the node's setting `inputs`.
template <typename T>
class InputList
{
public:
    InputList() = default;
    InputList (const double* const* sources_, int size) noexcept : sources (sources_), count (size) {}

    int size() const noexcept { return count; }

    T operator[] (int i) const noexcept
    {
        if constexpr (std::same_as<T, double>)
            return *sources[i];
        else
            return { *sources[3 * i], *sources[3 * i + 1], *sources[3 * i + 2] };
    }

private:
    const double* const* sources = nullptr;
    int count = 0;
};

/// An array among Params or Outputs: gain[0], gain[1], … as long as the node's setting `inputs`.
/// It has room for list_capacity entries in place, so that a tick can return one without allocating.
class List
{
public:
    List (double initial = 0.0) noexcept { values.fill (initial); }

    double operator[] (int i) const noexcept { return values[static_cast<std::size_t> (i)]; }
    double& operator[] (int i) noexcept { return values[static_cast<std::size_t> (i)]; }

private:
    std::array<double, list_capacity> values;
};

/// True if every part of every value is a finite number; what a node asks of its inputs.
inline bool isFinite (double v) noexcept { return v - v == 0.0; }
inline bool isFinite (const Vec3& v) noexcept { return isFinite (v.x()) && isFinite (v.y()) && isFinite (v.z()); }

template <typename T>
bool isFinite (const InputList<T>& list) noexcept
{
    for (int i = 0; i < list.size(); ++i)
        if (! isFinite (list[i])) return false;
    return true;
}

template <typename... T>
requires (sizeof...(T) > 1) bool isFinite (const T&... values) noexcept
{
    return (isFinite (values) && ...);
}

/// The value if all of it is finite, else 0: the last word of a node whose arithmetic may overflow.
inline double finiteOrZero (double v) noexcept { return isFinite (v) ? v : 0.0; }
inline Vec3 finiteOrZero (const Vec3& v) noexcept { return isFinite (v) ? v : Vec3::Zero(); }

/// Where a finite vector points: length 1, or 0 for a vector of length 0. Right for the largest and smallest, too.
inline Vec3 direction (const Vec3& v) noexcept
{
    const double largest = v.cwiseAbs().maxCoeff();
    return largest > 0.0 ? Vec3 { (v / largest).normalized() } : Vec3::Zero();
}

}   // namespace tactus
