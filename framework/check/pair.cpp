// SPDX-License-Identifier: MIT
#include "pair.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tactus::check
{

namespace
{
using Eigen::VectorXd;

constexpr double nudge = 1e-9;              // m; far below any quantum or d_max, far above the rounding of a position
constexpr std::size_t longest_hold = 240;   // ticks
constexpr std::size_t most_phases = 4;
constexpr std::size_t longest_period = 10'000;   // ticks

/// The number of ticks after which all sections run on the same tick again.
std::size_t commonPeriod (const Plan& plan)
{
    std::size_t period = 1;
    for (const auto rest : plan.rests())
        if (const auto both = std::lcm (period, static_cast<std::size_t> (rest)); both <= longest_period) period = both;
    return period;
}
}   // namespace

Pair::Pair (const Subject& subject, const HandMotion& m, const std::vector<std::size_t>& without, std::size_t hold_ticks)
    : motion (m), hold (hold_ticks), still (subject, m), nudged (subject, m), period (commonPeriod (still.plan()))
{
    still.silence (without);
    nudged.silence (without);
    std::size_t numbers = 0;
    for (std::size_t n = 0; n < still.plan().instances().size(); ++n)
    {
        forces.emplace_back (still.plan(), n);
        nudged_forces.emplace_back (nudged.plan(), n);
        numbers += forces.back().size();
    }
    settled.resize (numbers);
    before.resize (numbers);
}

void Pair::moveTo (double tick)
{
    for (; static_cast<double> (now) <= tick; ++now)
    {
        still.follow (motion, static_cast<double> (now));
        nudged.follow (motion, static_cast<double> (now));
        step();
    }
    here = tick;
    meet();
}

void Pair::meet()
{
    still.follow (motion, here);
    nudged.follow (motion, here);
    wait (hold);
}

std::optional<Pair::Response> Pair::respond (std::size_t role, const Vec3& direction)
{
    const auto phases = std::min (period, most_phases);
    std::optional<Response> all;
    std::size_t found = 0;
    for (std::size_t i = 0; i < phases; ++i)
    {
        // Depending on the tick of the shift, a response is late by 0 to period - 1 ticks. The delays are chosen symmetrically, so
        // their mean is that of all delays.
        const auto other = phases - 1 - i, earlier = phases > 1 ? std::min (i, other) * (period - 1) / (phases - 1) : 0;
        const auto late = i <= other ? earlier : period - 1 - earlier, phase = (period - late) % period;
        if (period > 1) wait ((phase + period - still.plan().nextTick() % period) % period);
        const auto one = respondOnce (role, direction);
        if (! one) continue;
        ++found;
        if (! all)
        {
            all = one;
            continue;
        }
        all->late += one->late;
        all->excess += one->excess;
        if (one->settled.norm() > all->settled.norm()) all->settled = one->settled;
    }
    if (! all) return all;
    all->late /= static_cast<double> (found);
    all->excess /= static_cast<double> (found);
    return all;
}

std::optional<Pair::Response> Pair::respondOnce (std::size_t role, const Vec3& direction)
{
    constexpr double tolerance = 0.2;
    auto once = respondTo (nudge, role, direction);
    const auto twice = respondTo (2.0 * nudge, role, direction);
    bool is_proportional = false;
    for (std::size_t r = 0; r < roles(); ++r)
    {
        const double most = std::max (once.of (r).norm(), twice.of (r).norm());
        if ((once.of (r) - twice.of (r)).norm() <= tolerance * most)
            is_proportional = true;
        else
            for (auto* part : { &once.settled, &once.late, &once.excess })
                part->segment<3> (static_cast<Eigen::Index> (3 * r)).setZero();
    }
    return is_proportional ? std::optional (once) : std::nullopt;
}

Pair::Response Pair::respondTo (double size, std::size_t role, const Vec3& direction)
{
    note (before);
    const VectorXd offset = difference();
    nudged.shift (role, size * direction);
    path.clear();
    while (path.size() < hold || (path.size() < hold + longest_hold && ! hasSettled()))
    {
        step();
        path.push_back ((difference() - offset) / size);
    }
    note (settled);
    last_size = size;
    nudged.shift (role, Vec3::Zero());
    wait (path.size());
    return summary();
}

std::vector<double> Pair::pullBack (std::size_t role, const Vec3& direction) const
{
    std::vector<double> all;
    if (period > 1) return all;
    for (const auto& then : path)
        all.push_back (-then.segment<3> (static_cast<Eigen::Index> (3 * role)).dot (direction));
    return all;
}

VectorXd Pair::changeAt (double tick)
{
    note (before);
    const VectorXd offset = difference();
    nudged.follow (motion, tick);
    wait (hold);
    note (settled);
    last_size = 1.0;
    return difference() - offset;
}

void Pair::step()
{
    still.tick();
    nudged.tick();
}

void Pair::wait (std::size_t ticks)
{
    for (std::size_t j = 0; j < ticks; ++j)
        step();
}

/// True if the response has hardly changed over the last ticks.
bool Pair::hasSettled() const
{
    constexpr std::size_t recent = 12;
    constexpr double tolerance = 1e-4;
    const auto& last = path.back();
    const auto watched = static_cast<std::ptrdiff_t> (std::min (path.size(), std::max (recent, 2 * period)));
    return std::all_of (path.end() - watched, path.end(), [&] (const VectorXd& then) { return (then - last).norm() <= tolerance * last.norm(); });
}

VectorXd Pair::difference() const
{
    VectorXd all (static_cast<Eigen::Index> (3 * roles()));
    for (std::size_t r = 0; r < roles(); ++r)
        all.segment<3> (static_cast<Eigen::Index> (3 * r)) = nudged.force (r) - still.force (r);
    return all;
}

/// Notes the difference between the two copies for each force of each node.
void Pair::note (std::vector<double>& all) const noexcept
{
    std::size_t i = 0;
    for (std::size_t n = 0; n < forces.size(); ++n)
        for (std::size_t c = 0; c < forces[n].size(); ++c)
            all[i++] = nudged_forces[n][c] - forces[n][c];
}

/// A response that comes late has too little force at first. Damping responds to the speed of the shift, so it has too much.
Pair::Response Pair::summary() const
{
    const auto size = static_cast<Eigen::Index> (3 * roles());
    Response r { .settled = path.back(), .late = VectorXd::Zero (size), .excess = VectorXd::Zero (size) };
    const double dt = 1.0 / motion.rate_hz;
    for (const auto& then : path)
        for (Eigen::Index i = 0; i < size; ++i)
        {
            const double rest = then[i] - r.settled[i];
            (rest * r.settled[i] < 0.0 ? r.late : r.excess)[i] += dt * rest;
        }
    return r;
}

std::vector<double> Pair::ownResponses() const
{
    std::vector<double> all (settled.size());
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = (settled[i] - before[i]) / last_size;
    return all;
}

void Pair::raise (std::vector<double>& by_node) const
{
    std::size_t i = 0;
    for (std::size_t n = 0; n < forces.size(); ++n)
        for (const auto width : forces[n].widths())
        {
            double square = 0.0;
            for (const auto end = i + width; i < end; ++i)
                square += (settled[i] - before[i]) * (settled[i] - before[i]);
            by_node[n] = std::max (by_node[n], std::sqrt (square) / last_size);
        }
}

}   // namespace tactus::check
