// SPDX-License-Identifier: MIT
#pragma once

#include "at.hpp"
#include "vec3.hpp"

#include <algorithm>
#include <array>
#include <concepts>

namespace tactus
{

/// The most entries an array port can have. Chain a second mixer to add more inputs.
inline constexpr int list_capacity = 64;

/// An array port among a node's Inputs: a view of what is wired to in[0], in[1], …
/// It reads the sources in place and copies nothing. Its length is the node's setting `inputs`.
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

/// An array among Params or Outputs: gain[0], gain[1], … The node's setting `inputs` is the number of entries in use.
/// It holds list_capacity entries in place, so that a tick can return one without allocating.
class List
{
public:
    List (double initial = 0.0) noexcept { values.fill (initial); }

    /// Sets only the entries in use; no other entry is ever read. For outputs: setting all of them on each tick would cost more than
    /// many nodes do.
    List (double initial, int used) noexcept { std::fill_n (values.begin(), used, initial); }

    double operator[] (int i) const noexcept { return values[at (i)]; }
    double& operator[] (int i) noexcept { return values[at (i)]; }

private:
    std::array<double, list_capacity> values;
};

template <typename T>
bool isFinite (const InputList<T>& list) noexcept
{
    for (int i = 0; i < list.size(); ++i)
        if (! isFinite (list[i])) return false;
    return true;
}

}   // namespace tactus
