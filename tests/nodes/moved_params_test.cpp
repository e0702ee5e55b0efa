// SPDX-License-Identifier: MIT
// Every param can be wired, so it may move as fast as any signal. The outputs of a node must not grow much beyond those with params that stand still.
#include <support/tested_types.hpp>
#include <tactus/examine/node_dice.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

using namespace tactus;
using examine::NodeDice;
using examine::Rig;

namespace
{
/// Outputs under params that move are at most this times those under params that stand still, at values of the same range.
constexpr double most_growth = 10.0;

enum class Movement
{
    square,
    sine,
    noise
};

/// A value from 0 to 1.
double moved (Movement movement, int k, int period, NodeDice& dice)
{
    if (movement == Movement::square) return (k / std::max (1, period / 2)) % 2 == 0 ? 1.0 : 0.0;
    if (movement == Movement::sine) return 0.5 + 0.5 * std::sin (2.0 * std::numbers::pi * k / period);
    return dice.uniform (0.0, 1.0);
}

struct Trial
{
    const NodeType& type;
    const PortSheet& param;
    double low, high, rate_hz;
    std::vector<std::string> choices;   // an alternative for each choice of the node
};

/// The bound of an output while a param moves, from its largest magnitude while the param stands still.
struct OwnBound
{
    double (*most) (const Trial&, double still);
    std::string_view reason;
};

/// Outputs that have a bound of their own, and why.
const std::map<std::string, OwnBound, std::less<>> own_bounds {
    { "filter.biquad.out by gain_db",
      { [] (const Trial& trial, double still) { return std::max (most_growth * still, 2.0 * std::pow (10.0, trial.high / 20.0)); },
        "a shelf that moves gives up to its highest gain times its input, which is within 1; one that stands still at that gain passes little noise" } },
    { "hold.deadbeat.force by mass",
      { [] (const Trial&, double still) { return 30.0 * still; },
        "it plans two forces for a mass, and takes the error of that plan for a push when the mass is another one on the next tick" } },
};

/// The largest magnitude of each output. `next` gives the param on each tick. The inputs of all runs are the same.
template <typename Next>
std::vector<double> peaks (const Trial& trial, Next next)
{
    constexpr int ticks = 600;
    Rig rig { trial.type, trial.rate_hz };
    std::size_t choice = 0;
    for (const auto& p : trial.type.params)
        if (! p.choices.empty()) rig.choose (p.id, trial.choices[choice++]);
    rig.prepare();
    rig.wire();
    NodeDice inputs { 7 };
    std::vector<double> most;
    for (int k = 0; k < ticks; ++k)
    {
        const int count = trial.param.width * (trial.param.list ? rig.entries() : 1);
        for (int i = 0; i < count; ++i)
            rig.paramAt (trial.param, i) = next (k);
        rig.moved();
        for (auto& v : rig.in)
            v = inputs.uniform (-1.0, 1.0);
        rig.tick();
        most.resize (rig.outputs.size());
        for (std::size_t i = 0; i < most.size(); ++i)
            most[i] = std::isfinite (rig.out (i)) ? std::max (most[i], std::abs (rig.out (i))) : INFINITY;
    }
    return most;
}

std::vector<std::string> faultsOf (const Trial& trial)
{
    std::vector<double> still;
    for (const double share : { 0.0, 1e-3, 0.02, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0 })
    {
        const auto most = peaks (trial, [&] (int) { return std::lerp (trial.low, trial.high, share); });
        still.resize (most.size());
        for (std::size_t i = 0; i < most.size(); ++i)
            still[i] = std::max (still[i], most[i]);
    }
    std::vector<std::string> faults;
    Rig names { trial.type, trial.rate_hz };
    names.prepare();
    for (const auto movement : { Movement::square, Movement::sine, Movement::noise })
        for (const int period : { 2, 10, 100 })
        {
            if (movement == Movement::noise && period != 2) continue;
            NodeDice dice { 3 };
            const auto most = peaks (trial, [&] (int k) { return std::lerp (trial.low, trial.high, moved (movement, k, period, dice)); });
            for (std::size_t i = 0; i < most.size(); ++i)
            {
                const auto name = std::string (trial.type.info.id) + "." + std::string (names.outputs[i].port->id);
                const auto own = own_bounds.find (name + " by " + std::string (trial.param.id));
                if (most[i] <= (own == own_bounds.end() ? most_growth * still[i] : own->second.most (trial, still[i])) + 1e-9) continue;
                faults.push_back (name + " reaches " + std::to_string (most[i]) + ", and " + std::to_string (still[i]) + " while "
                                  + std::string (trial.param.id) + " stands still, at " + std::to_string (trial.rate_hz) + " Hz, from "
                                  + std::to_string (trial.low) + " to " + std::to_string (trial.high) + ", movement "
                                  + std::to_string (static_cast<int> (movement)) + " period " + std::to_string (period));
            }
        }
    return faults;
}

/// The usual range, and ten times as far, within what the node accepts.
std::vector<Interval> rangesOf (const PortSheet& p)
{
    const auto usual = p.limits.usual;
    if (! std::isfinite (usual.min) || ! std::isfinite (usual.max)) return {};
    const double beyond = 4.5 * (usual.max - usual.min);
    const bool is_positive = usual.min > 0.0;
    const double low = p.limits.hard.clamp (is_positive ? usual.min / 10.0 : usual.min - beyond);
    const double high = p.limits.hard.clamp (is_positive ? 10.0 * usual.max : usual.max + beyond);
    return { usual, { low, high } };
}
}   // namespace

TEST_CASE ("no node grows because a wired param moves fast", "[nodes][contract]")
{
    for (const auto& type : test::testedTypes())
    {
        DYNAMIC_SECTION (type.info.id)
        {
            std::vector<std::vector<std::string>> kinds { {} };   // the first alternatives, then each other alternative of each choice
            std::size_t choices = 0;
            for (const auto& p : type.params)
                if (! p.choices.empty())
                {
                    const auto count = kinds.size();
                    for (std::size_t i = 0; i < count; ++i)
                        kinds[i].emplace_back (p.choices.front());
                    for (std::size_t c = 1; c < p.choices.size(); ++c)
                    {
                        auto other = kinds.front();
                        other[choices] = std::string (p.choices[c]);
                        kinds.push_back (other);
                    }
                    ++choices;
                }
            std::vector<std::string> faults;
            for (const auto& p : type.params)
                for (const auto& range : rangesOf (p))
                    for (const auto& kind : kinds)
                        for (const double rate : { 1000.0, 4000.0, 20'000.0 })
                        {
                            const auto more = faultsOf ({ type, p, range.min, range.max, rate, kind });
                            faults.insert (faults.end(), more.begin(), more.end());
                        }
            std::string all;
            for (std::size_t i = 0; i < std::min<std::size_t> (faults.size(), 6); ++i)
                all += faults[i] + "\n";
            CHECK (all == "");
        }
    }
}
