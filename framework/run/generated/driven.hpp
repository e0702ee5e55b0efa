// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/node.hpp>

#include <limits>
#include <type_traits>

/// The functions that fused code (host/code/fuse) and exported code (host/code/generate) share.
namespace tactus::generated
{

inline constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Sets the parameters of a node that wires or feeds drive. If a value is not finite, the inputs of the node are not finite either, so it
/// responds as to any fault. [tick thread]
struct Driven
{
    bool moved = false;   ///< at least one parameter has changed, so the node needs an update
    bool fault = false;

    /// `stored`: the stored value, or the sum of the wires that replace it. `added`: the sum of the wires that add to it.
    void operator() (double& target, double stored, double added, double min, double max) noexcept
    {
        const double value = Interval { min, max }.clamp (stored + added);
        if (! isFinite (value))
            fault = true;
        else if (value != target)
        {
            target = value;
            moved = true;
        }
    }

    /// A number, a vector, or the address of a number.
    template <typename T>
    auto in (const T& value) const noexcept
    {
        if constexpr (std::is_pointer_v<T>)
            return fault ? &not_a_number : static_cast<const double*> (value);
        else if constexpr (std::is_convertible_v<double, T>)
            return fault ? T (not_a_number) : value;
        else
            return fault ? T { not_a_number, not_a_number, not_a_number } : value;
    }
};

}   // namespace tactus::generated
