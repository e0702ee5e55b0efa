// SPDX-License-Identifier: MIT
#pragma once

/// The functions that fused code (host/code/fuse) calls for the steps of a plan that are not nodes. Each of them gives the same bits as its counterpart in
/// framework/plan/steps/ops.hpp and running_section.hpp, and works on the same memory. Nothing here allocates, throws or locks. [tick thread]

#include "driven.hpp"

#include <tactus/node/node.hpp>
#include <tactus/plan/sum.hpp>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>

namespace tactus::fused
{

using generated::Driven;
using generated::not_a_number;

/// The objects of a plan by number, as FusedTick::objects lists them.
class Objects
{
public:
    explicit Objects (void* const* o) noexcept : objects (o) {}

    template <typename T>
    T& as (std::size_t i) const noexcept
    {
        return *static_cast<T*> (objects[i]);
    }

    double& value (std::size_t i) const noexcept { return as<double> (i); }
    std::uint64_t& ticks (std::size_t i) const noexcept { return as<std::uint64_t> (i); }
    const double* const* sources (std::size_t i) const noexcept { return static_cast<const double* const*> (objects[i]); }

    void* at (std::size_t i) const noexcept { return objects[i]; }

    /// Runs a record of the plan as the plan does. Its function, object, sources and outputs are in this order.
    void run (std::size_t i) const noexcept
    {
        using Step = void (*) (void* self, const double* const* sources, void* outputs) noexcept;
        reinterpret_cast<Step> (objects[i]) (objects[i + 1], sources (i + 2), objects[i + 3]);
    }

private:
    void* const* objects;
};

/// The sum of several wires. They are added in order of value, so the order of the wires does not matter.
template <typename... T>
double sumOf (T... values) noexcept
{
    if constexpr (sizeof...(T) <= plan::most_in_network)
        return plan::sumOf (values...);
    else
    {
        double all[] { values... };
        return plan::sum (all, static_cast<int> (sizeof...(T)));
    }
}

/// What reaches a hit input: the hits of wires, and those from outside.
inline double struck (double by_wires, double& pending) noexcept
{
    if (std::bit_cast<std::uint64_t> (pending) == 0) return by_wires;   // compares bits, because it is never -0, and comparing doubles takes two branches
    by_wires += pending;
    pending = 0.0;
    return by_wires;
}

/// The value that arrives over a delayed wire, which is also kept in `out`.
inline double delayed (const double& samples, const std::size_t& now, double& out) noexcept { return out = (&samples)[now]; }

/// Sends a value over a delayed wire.
inline void delay (double value, double& samples, std::size_t& now, std::size_t size) noexcept
{
    (&samples)[now] = value;
    if (++now == size) now = 0;
}

/// Takes the samples that were gathered on the way into or out of a section.
inline void deliver (double& out, double& gathered) noexcept
{
    out = gathered;
    gathered = 0.0;
}

/// Starts a new straight line where the last one ended. The first line begins and ends at the current value.
inline void head (double value, double& before, double& newest, bool& begun) noexcept
{
    before = begun ? newest : value;
    newest = value;
    begun = true;
}

/// The point on the line at a fraction from 0 to 1. Before the first line exists, the current value.
inline double follow (double value, double before, double newest, bool begun, double part) noexcept
{
    return begun ? std::lerp (before, newest, part) : value;
}

/// Sets the member of a Params at this offset.
template <typename Params>
void store (Params& params, std::size_t offset, double value) noexcept
{
    std::memcpy (reinterpret_cast<std::byte*> (&params) + offset, &value, sizeof value);
}

}   // namespace tactus::fused
