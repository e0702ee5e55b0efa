// SPDX-License-Identifier: MIT
#pragma once

/// The Inputs, Params, Settings and Outputs that many generic nodes have in common. A node may use them in place of its own:
///
///     using Inputs = In<double>;
///     using Params = Empty;
///     using Outputs = Out<double>;

#include "node.hpp"

#include <string_view>
#include <type_traits>

namespace tactus
{

namespace detail
{
template <typename T>
T zero() noexcept
{
    if constexpr (requires { typename T::Scalar; })
        return T::Zero();
    else
        return T {};
}
}   // namespace detail

struct Empty
{
};

/// One input of type double, Vec3 or an InputList of these.
template <typename T>
struct In
{
    T in = detail::zero<T>();
};

template <typename T>
struct Pair
{
    T a = detail::zero<T>(), b = detail::zero<T>();
};

template <typename T>
struct Out
{
    T out = detail::zero<T>();
};

template <typename T>
struct Amount
{
    T amount = detail::zero<T>();
};

/// A vector as three signals: right, away from the person, up.
struct Components
{
    double x = 0.0, y = 0.0, z = 0.0;
};

/// The param of a low-pass, and its row in the datasheet.
struct Cutoff
{
    double cutoff = 100.0;
};

constexpr auto lowPassCutoff (double Cutoff::*member)
{
    return param (member, "cutoff", unit::hertz, "frequency at which the response is 3 dB down", { .hard = { 0, inf }, .usual = { 1, 1000 } });
}

/// The setting that gives array ports their length, and its row in the datasheet.
struct InputCount
{
    int inputs = 2;
};

template <typename Settings>
constexpr auto inputCount (int Settings::*member, std::string_view about = "number of inputs")
{
    return setting (member, "inputs", unit::count, about, { .hard = { 1, list_capacity }, .usual = { 1, 8 } });
}

}   // namespace tactus
