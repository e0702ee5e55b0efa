// SPDX-License-Identifier: MIT
#include "pressing.hpp"

#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace tactus::host
{

namespace
{
using Values = std::vector<double>;

bool areFinite (const Values& values)
{
    return std::ranges::all_of (values, [] (double v) { return std::isfinite (v); });
}

/// The noise of a row, from its distance to the straight line through its neighbours. The median leaves out the snaps of a key.
double noiseOf (const Values& f)
{
    constexpr double median_of_normal = 0.6745;
    Values bends;
    for (std::size_t i = 2; i < f.size(); ++i)
        bends.push_back (std::abs (f[i] - 2.0 * f[i - 1] + f[i - 2]));
    if (bends.empty() || ! areFinite (bends)) return 0.0;
    const auto middle = bends.begin() + static_cast<std::ptrdiff_t> (bends.size() / 2);
    std::ranges::nth_element (bends, middle);
    return *middle / (median_of_normal * std::sqrt (6.0));
}

/// The way from the touch to the largest force, in recorded depths.
struct Rise
{
    double touch = 0.0, most = 0.0;   // m
};

/// Means over a fortieth of the rows up to the largest force, so that noise is no touch. The touch is where a straight line through the first two means
/// that are clearly above the rest of the force meets it.
class ForceRise
{
public:
    ForceRise (Values its_depth, Values its_force) : depth (std::move (its_depth)), force (std::move (its_force))
    {
        if (depth.size() != force.size() || force.empty() || ! areFinite (depth) || ! areFinite (force)) return;
        if (force.front() > 0.5 * *std::ranges::max_element (force) && force.back() < force.front())   // only the way out was recorded
        {
            std::ranges::reverse (depth);
            std::ranges::reverse (force);
        }
        largest = static_cast<std::size_t> (std::ranges::max_element (force) - force.begin());
        block = std::max<std::size_t> (1, (largest + 1) / 40);
        count = (largest + 1) / block;
    }

    std::optional<Rise> find() const
    {
        if (count < 2 || ! (force[largest] > 0.0)) return {};
        double rest = meanOf (force, 0);
        for (std::size_t k = 1; k < count; ++k)
            rest = std::min (rest, meanOf (force, k));
        constexpr double clearly = 5.0, of_largest = 0.01;   // deviations of the noise; of the rise
        const double above = rest + std::max (clearly * noiseOf (force) / std::sqrt (static_cast<double> (block)), of_largest * (force[largest] - rest));
        std::size_t low = count;
        for (std::size_t k = count; k-- > 0 && low == count;)
            if (meanOf (force, k) <= above) low = k;
        if (low + 1 >= count) return {};   // nothing but noise
        return Rise { touchAfter (low, rest), depth[largest] };
    }

private:
    Values depth, force;
    std::size_t largest = 0, block = 1, count = 0;

    double meanOf (const Values& values, std::size_t k) const
    {
        const auto first = values.begin() + static_cast<std::ptrdiff_t> (k * block);
        return std::accumulate (first, first + static_cast<std::ptrdiff_t> (block), 0.0) / static_cast<double> (block);
    }

    double touchAfter (std::size_t low, double rest) const
    {
        if (low == 0) return depth.front();   // no air was recorded
        const double first = depth[low * block], a = meanOf (depth, low + 1), f = meanOf (force, low + 1);
        const double slope = low + 2 < count ? meanOf (force, low + 2) - f : 0.0;
        if (! (slope > 0.0)) return meanOf (depth, low);
        const double meets = a - (f - rest) * (meanOf (depth, low + 2) - a) / slope;
        return std::clamp (meets, std::min (first, a), std::max (first, a));
    }
};

bool isNegative (const Values& values, double other_sign)
{
    const auto [least, most] = std::ranges::minmax (values);
    return least < 0.0 && most <= -other_sign * least;
}

void turn (Values& values)
{
    for (double& v : values)
        v = 0.0 - v;   // -0 would be printed
}

class Orienting
{
public:
    Orienting (RecordedColumns& columns, const ColumnChoice& choice) : recorded (columns), chosen (choice) {}

    /// Turns the values of a role if the user says so, or else if the recording does.
    template <typename Says>
    void decide (const std::string& role, Says&& says)
    {
        auto& values = recorded[role];
        if (values.empty()) return;
        const auto given = chosen.turned.find (role);
        std::string why = given == chosen.turned.end() ? says (values) : std::string();
        if (why.empty() && (given == chosen.turned.end() || ! given->second)) return;
        turn (values);
        did.turned.insert (role);
        if (! why.empty()) did.notes.push_back ("the " + role + " " + why + "; its sign was turned");
    }

    Pressing did {};

private:
    RecordedColumns& recorded;
    const ColumnChoice& chosen;
};

/// The depth at which the tool touches, if the recorded 0 cannot be it.
std::optional<double> touchOf (const Values& depth, const Values& force)
{
    constexpr double well = 0.1, late = 0.5;   // of the way from the touch to the largest force
    const auto rise = ForceRise (depth, force).find();
    if (! rise || ! (rise->most > rise->touch)) return {};
    const double way = rise->most - rise->touch;
    const bool is_outside = *std::ranges::min_element (depth) > well * way;
    return is_outside || rise->touch < -well * way || rise->touch > late * way ? std::optional (rise->touch) : std::nullopt;
}
}   // namespace

Pressing orient (const std::vector<FitColumn>& columns, RecordedColumns& recorded, const ColumnChoice& choice, const Touch& touch)
{
    constexpr double noise = 0.05, pull = 0.5;   // what may have the other sign, over the largest value
    constexpr const char* is_negative = "is negative in the recording";
    const auto wants = [&] (const std::string& role) {
        const auto at = std::ranges::find (columns, role, &FitColumn::role);
        return at != columns.end() && at->is_positive;
    };
    Orienting all (recorded, choice);
    auto &depth = recorded["depth"], &force = recorded["force"];
    if (touch.given)
        for (double& d : depth)
            d -= *touch.given;
    for (const auto& column : columns)
        if (column.is_positive && column.role != "depth")
        {
            const double other_sign = wants ("depth") && column.role == "force" ? pull : noise;
            all.decide (column.role, [&] (const Values& v) { return isNegative (v, other_sign) ? is_negative : ""; });
        }
    if (! wants ("depth") || depth.empty()) return std::move (all.did);

    all.decide ("depth", [&] (const Values& v) {
        const auto rise = ForceRise (v, force).find();
        const bool is_known = rise && rise->most != rise->touch;
        if (is_known ? rise->most > rise->touch : ! isNegative (v, noise)) return "";
        return isNegative (v, noise) ? is_negative : "falls while the force grows";
    });
    if (touch.given || ! touch.is_looked_for) return std::move (all.did);
    if (const auto found = touchOf (depth, force))
    {
        for (double& d : depth)
            d -= *found;
        all.did.touch = all.did.turned.contains ("depth") ? -*found : *found;
        all.did.notes.push_back ("the depth is counted from " + roundedText (1e3 * *all.did.touch, 3) + " mm of the recording, where the force begins");
    }
    return std::move (all.did);
}

}   // namespace tactus::host
