// SPDX-License-Identifier: MIT
#include "spots.hpp"
#include "bench.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::check
{

namespace
{
/// The path of all tools together: finds the time at which a given length has been travelled.
class Way
{
public:
    explicit Way (const HandMotion& motion) : passed (motion.ticks, 0.0)
    {
        for (std::size_t k = 1; k < motion.ticks; ++k)
        {
            double square = 0.0;
            for (const auto& role : motion.roles)
                square += (role.readings[k].position - role.readings[k - 1].position).squaredNorm();
            passed[k] = passed[k - 1] + std::sqrt (square);
        }
    }

    double length() const noexcept { return passed.empty() ? 0.0 : passed.back(); }

    /// The time, in ticks, at which this length has been travelled.
    double tickAt (double wanted) const noexcept
    {
        const auto after = std::ranges::upper_bound (passed, wanted) - passed.begin();
        const auto k = static_cast<std::size_t> (std::clamp<std::ptrdiff_t> (after, 1, static_cast<std::ptrdiff_t> (passed.size()) - 1));
        const double step = passed[k] - passed[k - 1];
        return static_cast<double> (k - 1) + (step > 0.0 ? std::clamp ((wanted - passed[k - 1]) / step, 0.0, 1.0) : 0.0);
    }

private:
    std::vector<double> passed;   // m, by tick
};

/// For each stretch of the path, the step over which the forces change most.
std::vector<Spot> steepestSteps (const Subject& subject, const HandMotion& motion, std::size_t stretches, const std::vector<std::size_t>& without,
                                 std::size_t at_most)
{
    const Way way { motion };
    if (stretches == 0 || ! (way.length() > 0.0)) return {};
    const auto steps = std::clamp<std::size_t> (static_cast<std::size_t> (way.length() / shortest_step), stretches, std::max (stretches, at_most));
    const auto tickOf = [&] (std::size_t step) { return way.tickAt (way.length() * static_cast<double> (step) / static_cast<double> (steps)); };
    Bench behind { subject, motion }, ahead { subject, motion };
    behind.silence (without);
    ahead.silence (without);

    std::vector<Spot> steepest (stretches);
    std::vector<double> most (stretches, -1.0);
    for (std::size_t i = 0; i < steps; ++i)
    {
        const Spot step { tickOf (i), tickOf (i + 1) };
        behind.follow (motion, step.from);
        ahead.follow (motion, step.to);
        behind.tick();
        ahead.tick();
        double change = 0.0;
        for (std::size_t r = 0; r < motion.roles.size(); ++r)
            change += (ahead.force (r) - behind.force (r)).squaredNorm();
        const auto stretch = i * stretches / steps;
        if (! (change > most[stretch])) continue;
        most[stretch] = change;
        steepest[stretch] = step;
    }
    return steepest;
}
}   // namespace

std::vector<Spot> chooseSpots (const Subject& subject, const HandMotion& motion, std::size_t count, const std::vector<std::size_t>& without,
                               std::size_t steps)
{
    count = std::min (count, motion.ticks);
    auto spots = steepestSteps (subject, motion, count - count / 3, without, std::min (steps, most_steps));
    const auto even = count - spots.size();
    for (std::size_t i = 0; i < even; ++i)
    {
        const auto tick = static_cast<double> ((2 * i + 1) * motion.ticks / (2 * even));
        spots.push_back ({ tick, tick });
    }
    std::ranges::sort (spots, {}, &Spot::middle);
    return spots;
}

}   // namespace tactus::check
