// SPDX-License-Identifier: MIT
#include "switch_fit.hpp"
#include "least_squares.hpp"

#include <tactus/kit/law.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace tactus
{

namespace
{
/// Sorts readings into a curve; averages readings at the same position.
class Readings
{
public:
    void add (double x, double force)
    {
        auto& [sum, count] = places[x];
        sum += force;
        ++count;
    }

    Curve curve() const
    {
        Curve c;
        for (const auto& [x, readings] : places)
        {
            c.x.push_back (x);
            c.y.push_back (std::max (0.0, readings.first / readings.second));
        }
        return c;
    }

private:
    std::map<double, std::pair<double, int>> places;
};

/// Rows up to `first`, which is the first of the deepest rows, are the way down. Rows from `last` are the way up.
struct Turn
{
    std::size_t first = 0, last = 0;

    explicit Turn (const std::vector<double>& depth)
    {
        const auto bottom = *std::ranges::max_element (depth);
        first = static_cast<std::size_t> (std::ranges::find (depth, bottom) - depth.begin());
        last = static_cast<std::size_t> (std::find (depth.rbegin(), depth.rend(), bottom).base() - depth.begin()) - 1;
    }
};

Result<SwitchLoop> loopOf (const RecordedLoop& recorded, double backlash)
{
    const auto& depth = recorded.depth;
    const Turn turn (depth);
    Readings down, up;
    for (std::size_t r = 0; r < depth.size(); ++r)
    {
        if (r <= turn.first) down.add (depth[r] - depth.front(), recorded.force[r]);
        if (r >= turn.last) up.add (depth[r] - depth.front() + backlash, recorded.force[r]);
    }

    const auto pressed = down.curve(), released = up.curve();
    if (pressed.x.size() < 2 || released.x.size() < 2)
        return detail::fitError ("fit/one_way", "the recording does not contain both a press and a release", "record down to the stop and back up");
    const double most = *std::ranges::max_element (pressed.y), start = pressed.y.front(), end = released.y.front();
    if (! (most > 0.0))
        return detail::fitError ("fit/no_contact", "the force is never above 0 on the way down", "give it positive where it pushes the finger up");
    if (std::max (start, end) > 0.05 * most)
        return detail::fitError ("fit/not_released",
                                 "at the top the force is " + numberText (start) + " N before and " + numberText (end) + " N after the stroke, not 0",
                                 "start above the key, and end after it is released");

    std::set<double> places { 0.0 };
    for (const auto* way : { &pressed, &released })
        for (const double place : way->x)
            if (place > 0.0 && place <= pressed.x.back()) places.insert (place);
    SwitchLoop loop;
    for (const double place : places)
    {
        loop.travel.push_back (place);
        loop.press.push_back (place == 0.0 ? 0.0 : pressed (place));
        loop.release.push_back (place == 0.0 ? 0.0 : released (place));
    }
    const double lost = lostEnergy (loop);
    if (! std::isfinite (lost)) return detail::fitError ("fit/not_finite", "the recorded numbers are too large", "check the columns and their units");
    if (lost < 0.0)
        return detail::fitError ("fit/gains_energy", "the key returns more energy than it takes", "record the press first, then the release");
    return loop;
}

double rounded (double value, double steps_per_unit) { return std::round (value * steps_per_unit) / steps_per_unit; }

/// The point between two others that deviates most from the straight lines between them; `from` if no deviation exceeds the
/// tolerance.
std::size_t worstBetween (const SwitchLoop& loop, std::size_t from, std::size_t to, double tolerance)
{
    double most = tolerance;
    std::size_t worst = from;
    for (std::size_t i = from + 1; i < to; ++i)
    {
        const double part = (loop.travel[i] - loop.travel[from]) / (loop.travel[to] - loop.travel[from]);
        const double off = std::max (std::abs (loop.press[i] - std::lerp (loop.press[from], loop.press[to], part)),
                                     std::abs (loop.release[i] - std::lerp (loop.release[from], loop.release[to], part)));
        if (off <= most) continue;
        most = off;
        worst = i;
    }
    return worst;
}

/// The nearest loop that does not release energy anywhere.
SwitchLoop withoutGain (SwitchLoop loop)
{
    for (std::size_t i = 0; i < loop.travel.size(); ++i)
        if (loop.release[i] > loop.press[i]) loop.press[i] = loop.release[i] = 0.5 * (loop.press[i] + loop.release[i]);
    return loop;
}

/// Recorded minus fitted force. The way up is a part of the loop whose positions are shifted by the backlash.
std::vector<double> residualsOf (const SwitchLoop& loop, const RecordedLoop& recorded, double backlash)
{
    const Curve press { loop.travel, loop.press }, release { loop.travel, loop.release };
    const Turn turn (recorded.depth);
    std::vector<double> residuals (recorded.depth.size());
    for (std::size_t r = 0; r < recorded.depth.size(); ++r)
    {
        const double travel = recorded.depth[r] - recorded.depth.front();
        residuals[r] = recorded.force[r] - (r <= turn.first ? press (travel) : release (travel + backlash));
    }
    return residuals;
}

/// The residual at every fifth row, of a loop that was fitted to the others. `usual` if these are too few for a fit.
double leftOutResidual (const RecordedLoop& recorded, double tolerance, double backlash, double usual)
{
    constexpr std::size_t every = 5;
    const Turn turn (recorded.depth);
    const auto is_left_out = [&] (std::size_t r) { return r % every == every / 2 && r != turn.first && r != turn.last; };
    RecordedLoop rest;
    for (std::size_t r = 0; r < recorded.depth.size(); ++r)
    {
        if (is_left_out (r)) continue;
        rest.depth.push_back (recorded.depth[r]);
        rest.force.push_back (recorded.force[r]);
    }
    const auto loop = loopOf (rest, backlash);
    if (! loop) return usual;
    const auto residuals = residualsOf (simplified (withoutGain (*loop), tolerance), recorded, backlash);
    std::vector<double> left_out;
    for (std::size_t r = 0; r < recorded.depth.size(); ++r)
        if (is_left_out (r)) left_out.push_back (residuals[r]);
    return left_out.empty() ? usual : detail::rootMeanSquare (left_out);
}

FitPicture pictureOf (const SwitchLoop& loop, const RecordedLoop& recorded)
{
    const Turn turn (recorded.depth);
    FitCurve down { .label = "recorded, down", .is_recorded = true }, up { .label = "recorded, up", .is_recorded = true };
    for (std::size_t r = 0; r < recorded.depth.size(); ++r)
    {
        auto& way = r <= turn.first ? down : up;
        way.x.push_back (recorded.depth[r] - recorded.depth.front());
        way.y.push_back (recorded.force[r]);
    }
    return { "travel", "m", "force", "N", { down, up, { "key, down", loop.travel, loop.press }, { "key, up", loop.travel, loop.release } } };
}

/// The lost energy is the work along the rows. Its error follows from that of the mean force of a block of rows: from how far blocks are off the
/// straight line between their neighbours. The median leaves out the kinks of the curve.
FitValue lostEnergyOf (const SwitchLoop& loop, const RecordedLoop& recorded)
{
    constexpr std::size_t blocks = 160;
    const auto n = recorded.depth.size(), rows = std::max<std::size_t> (1, n / blocks);
    std::vector<double> mean, travelled, off;
    for (std::size_t r = 0; r + rows <= n; r += rows)
    {
        const auto first = recorded.force.begin() + static_cast<std::ptrdiff_t> (r);
        mean.push_back (std::accumulate (first, first + static_cast<std::ptrdiff_t> (rows), 0.0) / static_cast<double> (rows));
        travelled.push_back (recorded.depth[std::min (r + rows, n - 1)] - recorded.depth[r]);
    }
    for (std::size_t b = 1; b + 1 < mean.size(); ++b)
        off.push_back (std::abs (mean[b - 1] - 2.0 * mean[b] + mean[b + 1]));
    std::ranges::nth_element (off, off.begin() + static_cast<std::ptrdiff_t> (off.size() / 2));
    constexpr double median_of_normal = 0.6745, in_median = 0.37;   // a median is as exact as the deviation of that part of the blocks
    const double of_mean = off[off.size() / 2] / (median_of_normal * std::sqrt (6.0));
    const double deviation = of_mean * std::sqrt (std::inner_product (travelled.begin(), travelled.end(), travelled.begin(), 0.0));
    return detail::withInterval ("lost energy", "J", lostEnergy (loop), deviation, in_median * static_cast<double> (off.size()));
}

void report (SwitchFit& fit, const RecordedLoop& recorded, double tolerance, double backlash)
{
    const auto residuals = residualsOf (fit.loop, recorded, backlash);
    auto& report = fit.report;
    report.rows = recorded.depth.size();
    report.residual_unit = "N";
    report.residual = detail::rootMeanSquare (residuals);
    report.left_out_residual = leftOutResidual (recorded, tolerance, backlash, report.residual);
    report.size = detail::rootMeanSquare (recorded.force);
    report.values.push_back (lostEnergyOf (fit.recorded, recorded));
    if (const double gain = lostEnergy (withoutGain (fit.recorded)) - lostEnergy (fit.recorded); gain > 0.0)
        report.notes.push_back ("in places the recorded key returns more energy than it takes, by " + roundedText (1e3 * gain, 3)
                                + " mJ; the graph never does");
    report.picture = pictureOf (fit.loop, recorded);
    judge (report, "Press slowly down to the stop and back up, with many rows where the force changes; --backlash corrects the play of the meter.");
}
}   // namespace

double lostEnergy (const SwitchLoop& loop)
{
    double area = 0.0;
    for (std::size_t i = 1; i < loop.travel.size(); ++i)
        area += 0.5 * (loop.press[i] - loop.release[i] + loop.press[i - 1] - loop.release[i - 1]) * (loop.travel[i] - loop.travel[i - 1]);
    return area;
}

SwitchLoop simplified (const SwitchLoop& loop, double tolerance)
{
    std::vector<bool> kept (loop.travel.size());
    kept.front() = kept.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open { { 0, loop.travel.size() - 1 } };
    while (! open.empty())
    {
        const auto [from, to] = open.back();
        open.pop_back();
        const auto worst = worstBetween (loop, from, to, tolerance);
        if (worst == from) continue;
        kept[worst] = true;
        open.push_back ({ from, worst });
        open.push_back ({ worst, to });
    }

    SwitchLoop few;
    for (std::size_t i = 0; i < kept.size(); ++i)
    {
        const double travel = rounded (loop.travel[i], 1e7);
        if (! kept[i] || (! few.travel.empty() && travel <= few.travel.back())) continue;
        few.travel.push_back (travel);
        few.press.push_back (rounded (loop.press[i], 5e3));
        few.release.push_back (rounded (loop.release[i], 5e3));
    }
    return few;
}

Curve meanOf (const SwitchLoop& loop)
{
    Curve mean;
    for (std::size_t i = 0; i < loop.travel.size(); ++i)
    {
        mean.x.push_back (loop.travel[i]);
        mean.y.push_back (rounded (0.5 * (loop.press[i] + loop.release[i]), 1e4));
    }
    const double beyond = 1e-4, steepest = Law { .kind = Law::Kind::table, .table = mean }.steepest();
    mean.y.push_back (rounded (mean.y.back() + beyond * steepest, 1e4));
    mean.x.push_back (rounded (mean.x.back() + beyond, 1e7));
    return mean;
}

Curve boundOf (const SwitchLoop& loop)
{
    Curve bound;
    for (std::size_t i = 0; i < loop.travel.size(); ++i)
    {
        bound.x.push_back (loop.travel[i]);
        bound.y.push_back (rounded (0.5 * (loop.press[i] - loop.release[i]), 1e4));
    }
    return bound;
}

Result<SwitchFit> fitSwitch (const RecordedLoop& recorded, double tolerance, double backlash, FitCourse* course)
{
    if (auto checked = detail::checkColumns ({ &recorded.depth, &recorded.force }, 3, "a key from the top down to the stop and back up"); ! checked)
        return checked.error();
    if (detail::isCancelled (course)) return detail::fitCancelled();
    auto loop = loopOf (recorded, backlash);
    if (! loop) return loop.error();
    SwitchFit fit { .recorded = std::move (*loop) };
    fit.loop = simplified (withoutGain (fit.recorded), tolerance);
    detail::setShare (course, 0.5);
    report (fit, recorded, tolerance, backlash);
    if (detail::isCancelled (course)) return detail::fitCancelled();
    return fit;
}

}   // namespace tactus
