// SPDX-License-Identifier: MIT
#pragma once

#include "rig.hpp"

#include <cmath>
#include <iterator>
#include <random>

/// Random params, settings and inputs for a node that is known only by its datasheet.
namespace tactus::examine
{

/// Generates random numbers for nodes. The seed determines the whole run.
class NodeDice
{
public:
    explicit NodeDice (unsigned seed) : random (seed) {}

    double uniform (double from, double to) { return std::uniform_real_distribution { from, to }(random); }
    int below (int n) { return std::uniform_int_distribution { 0, n - 1 }(random); }
    bool once_in (int n) { return below (n) == 0; }

    /// A magnitude from 0 to almost the largest double. Typical magnitudes of hand movements and forces are among them.
    double size()
    {
        static constexpr double sizes[] { 0.0, 5e-324, 1e-310, 1e-200, 1e-9, 1e-6, 1e-3, 1e-2, 1.0, 10.0, 1e3, 1e9, 1e150, 1e300, 1.7e308 };
        return sizes[below (static_cast<int> (std::size (sizes)))];
    }

    double within (const Interval& range)
    {
        if (once_in (8) && std::isfinite (range.min)) return range.min;
        if (once_in (8) && std::isfinite (range.max)) return range.max;
        if (std::isfinite (range.min) && std::isfinite (range.max)) return uniform (range.min, range.max);
        return range.clamp (uniform (-1.0, 1.0) * std::pow (10.0, uniform (-6.0, 12.0)));
    }

private:
    std::mt19937 random;
};

/// The range of its datasheet that a random param comes from.
enum class Span
{
    usual,
    hard
};

/// Sets all params, choices too.
inline void randomParams (Rig& rig, NodeDice& dice, Span span)
{
    for (const auto& p : rig.type().params)
    {
        if (! p.choices.empty())
            rig.choose (p.id, p.choices[static_cast<std::size_t> (dice.below (static_cast<int> (p.choices.size())))]);
        else
            for (int i = 0; i < p.width * (p.list ? rig.entries() : 1); ++i)
                rig.paramAt (p, i) = dice.within (span == Span::usual ? p.limits.usual : p.limits.hard);
    }
    rig.moved();
}

/// Sets numbers, including those in records, within their usual ranges. Everything else keeps its default.
inline void randomSettings (Rig& rig, NodeDice& dice)
{
    for (const auto& s : rig.type().settings)
    {
        const auto bounded = [] (const Interval& range) { return std::isfinite (range.min) && std::isfinite (range.max); };
        if (s.kind == SettingSheet::Kind::integer && bounded (s.limits.usual))
            rig.set (s.id, std::round (dice.within (s.limits.usual)));
        else if (s.kind == SettingSheet::Kind::number && bounded (s.limits.usual))
            rig.set (s.id, dice.within (s.limits.usual));
        else if (s.kind == SettingSheet::Kind::records)
        {
            Records records (static_cast<std::size_t> (dice.below (4)));
            for (auto& record : records)
                for (const auto& f : s.fields)
                    record.push_back (f.kind == SettingSheet::Kind::number ? SettingValue { dice.within (f.limits.usual) } : f.initial);
            rig.set (s.id, records);
            if (! rig.problem().empty()) rig.set (s.id, s.initial);
        }
    }
}

/// Inputs for the next tick: sometimes unchanged, otherwise random. Most are as large as `size`, some have a random magnitude.
inline void randomInputs (Rig& rig, NodeDice& dice, double size)
{
    if (dice.once_in (4)) return;
    for (auto& v : rig.in)
        v = dice.uniform (-1.0, 1.0) * (dice.once_in (4) ? dice.size() : size);
}

/// Like randomInputs, but in the range of hand movements, so that nothing overflows.
inline void randomTameInputs (Rig& rig, NodeDice& dice)
{
    if (dice.once_in (4)) return;
    for (auto& v : rig.in)
        v = dice.uniform (-1.0, 1.0) * std::pow (10.0, dice.below (4) - 3);
}

}   // namespace tactus::examine
