// SPDX-License-Identifier: MIT
#pragma once

/// The steps of a plan that add up wires.

#include <tactus/plan/sum.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace tactus::plan
{

/// The number of wires of a sum with a gain other than 1: none or some. Most sums have none, and are not multiplied.
enum class Gains
{
    none,
    some
};

/// Adds up several wires, or applies the gain of one.
struct Sum
{
    struct Term
    {
        const double* from;
        double gain;

        template <Gains gains>
        double value() const noexcept
        {
            return gains == Gains::none ? *from : gain * *from;
        }
    };

    static constexpr std::size_t fewest_terms = 0;

    std::vector<Term> terms;
    std::vector<Placed> sorted;   // the terms in the order of the last tick, if there are more than a network sorts
    double out = 0.0;

    /// The sum of exactly n terms; of any number if n is 0.
    template <std::size_t n, Gains gains>
    void add() noexcept
    {
        const auto value = [t = terms.data()] (std::size_t i) noexcept { return t[i].template value<gains>(); };
        if constexpr (n > 0)
            out = [&]<std::size_t... i> (std::index_sequence<i...>) noexcept { return sumOf (value (i)...); }
        (std::make_index_sequence<n>());
        else
        {
            for (auto& s : sorted)
                s.value = value (s.term);
            out = sorted.empty() ? 0.0 : sumInOrder (sorted.data(), sorted.size());
        }
    }

    template <std::size_t n, Gains gains>
    static void step (void* self, const double* const*, void*) noexcept
    {
        static_cast<Sum*> (self)->add<n, gains>();
    }
};

/// Three sums with the same number of terms: those of a vector.
struct VectorSum
{
    static constexpr std::size_t fewest_terms = 1;

    std::array<Sum*, 3> parts;

    template <std::size_t n, Gains gains>
    static void step (void* self, const double* const*, void*) noexcept
    {
        auto& [x, y, z] = static_cast<VectorSum*> (self)->parts;
#ifdef __SSE2__
        const auto values = [a = x->terms.data(), b = y->terms.data()] (std::size_t i) noexcept {
            const Two both { *a[i].from, *b[i].from };
            return gains == Gains::none ? both : Two { a[i].gain, b[i].gain } * both;
        };
        const Two sums = [&]<std::size_t... i> (std::index_sequence<i...>) noexcept { return sumOf (values (i)...); }
        (std::make_index_sequence<n>());
        x->out = sums[0];
        y->out = sums[1];
#else
        x->add<n, gains>();
        y->add<n, gains>();
#endif
        z->add<n, gains>();
    }
};

using SumStep = void (*) (void* self, const double* const* sources, void* outputs) noexcept;

template <typename S, Gains gains, std::size_t n>
constexpr SumStep stepFor() noexcept
{
    if constexpr (n >= S::fewest_terms)
        return &S::template step<n, gains>;
    else
        return nullptr;
}
template <typename S, Gains gains, std::size_t... n>
constexpr std::array<SumStep, sizeof...(n)> stepsFor (std::index_sequence<n...>) noexcept
{
    return { stepFor<S, gains, n>()... };
}

inline constexpr std::size_t step_count = most_in_network + 1;
/// First the steps for terms with gains, then those for terms without; within each, by number of terms, up to `most_in_network`. The first
/// one of Sum is for any other number of terms.
template <typename S>
inline constexpr std::array<std::array<SumStep, step_count>, 2> steps_of { stepsFor<S, Gains::some> (std::make_index_sequence<step_count>()),
                                                                           stepsFor<S, Gains::none> (std::make_index_sequence<step_count>()) };

inline SumStep stepOf (const Sum& sum) noexcept
{
    const bool plain = std::ranges::all_of (sum.terms, [] (const Sum::Term& t) { return t.gain == 1.0; });
    return steps_of<Sum>[plain][sum.terms.size() < step_count ? sum.terms.size() : 0];
}

/// The step that does the same for three sums in one record; null if there is none.
inline SumStep stepOfVector (SumStep single) noexcept
{
    for (std::size_t g = 0; g < 2; ++g)
        for (std::size_t n = 1; n < step_count; ++n)
            if (steps_of<Sum>[g][n] == single) return steps_of<VectorSum>[g][n];
    return nullptr;
}

/// Calls `visit` for each sum of a record, in order. Does nothing if the record does something else.
template <typename Record, typename Visit>
void eachSum (const Record& record, Visit&& visit)
{
    for (std::size_t g = 0; g < 2; ++g)
        for (std::size_t n = 0; n < step_count; ++n)
        {
            if (record.step == steps_of<Sum>[g][n]) visit (*static_cast<Sum*> (record.self));
            if (n == 0 || record.step != steps_of<VectorSum>[g][n]) continue;
            for (auto* part : static_cast<VectorSum*> (record.self)->parts)
                visit (*part);
        }
}

}   // namespace tactus::plan
