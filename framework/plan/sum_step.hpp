// SPDX-License-Identifier: MIT
#pragma once

/// The steps of a plan that add up wires.

#include "sum.hpp"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace tactus::plan
{

/// Adds up several wires, or applies the gain of one.
struct Sum
{
    struct Term
    {
        const double* from;
        double gain;
    };

    std::vector<Term> terms;
    std::vector<double> scratch;   // for the values to add; same size as `terms`
    double out = 0.0;

    /// The sum of exactly n terms; of any number if n is 0.
    template <std::size_t n>
    void add() noexcept
    {
        const auto value = [t = terms.data()] (std::size_t i) noexcept { return t[i].gain * *t[i].from; };
        if constexpr (n > 0)
            out = [&]<std::size_t... i> (std::index_sequence<i...>) noexcept { return sumOf (value (i)...); }
        (std::make_index_sequence<n>());
        else
        {
            for (std::size_t i = 0; i < terms.size(); ++i)
                scratch[i] = value (i);
            out = sum (scratch.data(), static_cast<int> (terms.size()));
        }
    }

    template <std::size_t n>
    static void step (void* self, const double* const*, void*) noexcept
    {
        static_cast<Sum*> (self)->add<n>();
    }
};

/// Three sums of as many terms each: those of a vector.
struct VectorSum
{
    std::array<Sum*, 3> parts;

    template <std::size_t n>
    static void step (void* self, const double* const*, void*) noexcept
    {
        for (auto* part : static_cast<VectorSum*> (self)->parts)
            part->add<n>();
    }
};

using SumStep = void (*) (void* self, const double* const* sources, void* outputs) noexcept;

/// By number of terms, up to `most_in_network`. The first of sum_steps is for any other number.
inline constexpr std::array<SumStep, most_in_network + 1> sum_steps { &Sum::step<0>, &Sum::step<1>, &Sum::step<2>, &Sum::step<3>, &Sum::step<4> };
inline constexpr std::array<SumStep, most_in_network + 1> vector_steps { nullptr, &VectorSum::step<1>, &VectorSum::step<2>, &VectorSum::step<3>,
                                                                         &VectorSum::step<4> };

inline SumStep stepOf (const Sum& sum) noexcept { return sum_steps[sum.terms.size() < sum_steps.size() ? sum.terms.size() : 0]; }

/// The step that does the same for three sums in one record; null if there is none.
inline SumStep stepOfVector (SumStep single) noexcept
{
    for (std::size_t n = 0; n < sum_steps.size(); ++n)
        if (sum_steps[n] == single) return vector_steps[n];
    return nullptr;
}

/// Calls `visit` for each sum of a record, in order. Does nothing if the record does something else.
template <typename Record, typename Visit>
void eachSum (const Record& record, Visit&& visit)
{
    for (const auto step : sum_steps)
        if (record.step == step) visit (*static_cast<Sum*> (record.self));
    for (const auto step : vector_steps)
        if (record.step == step)
            for (auto* part : static_cast<VectorSum*> (record.self)->parts)
                visit (*part);
}

}   // namespace tactus::plan
