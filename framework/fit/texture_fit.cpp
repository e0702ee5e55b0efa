// SPDX-License-Identifier: MIT
#include "texture_fit.hpp"
#include "even_clock.hpp"
#include "spectrum_model.hpp"

#include <tactus/kit/math/math.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>

namespace tactus
{

namespace
{
using detail::fitError;
using Stretch = std::span<const double>;

constexpr std::size_t fewest_texture_rows = 256, shortest_stretch = 128;

/// Divides values into groups, at most four, and as few as possible with all values of a group within about 15 % of its centre.
std::vector<int> groupsOf (const std::vector<double>& values, const std::vector<bool>& counts)
{
    constexpr int most = 4;
    constexpr double near = 0.15;
    std::vector<double> sorted;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (counts[i]) sorted.push_back (values[i]);
    std::ranges::sort (sorted);
    std::vector<double> centres;
    for (int k = 1; k <= most && ! sorted.empty(); ++k)
    {
        centres.clear();
        for (int c = 0; c < k; ++c)
            centres.push_back (sorted[(2 * static_cast<std::size_t> (c) + 1) * sorted.size() / (2 * static_cast<std::size_t> (k))]);
        double off = 0.0;
        for (int pass = 0; pass < 30; ++pass)   // Lloyd's method
        {
            std::vector<double> sum (centres.size()), count (centres.size());
            off = 0.0;
            std::size_t c = 0;
            for (const double v : sorted)
            {
                while (c + 1 < centres.size() && std::abs (centres[c + 1] - v) < std::abs (centres[c] - v))
                    ++c;
                sum[c] += v;
                count[c] += 1.0;
                const double away = (v - centres[c]) / std::max (std::abs (centres[c]), 1e-12);
                off += away * away;
            }
            for (std::size_t j = 0; j < centres.size(); ++j)
                if (count[j] > 0.0) centres[j] = sum[j] / count[j];
        }
        if (std::sqrt (off / static_cast<double> (sorted.size())) < near) break;
    }
    std::vector<int> groups;
    for (const double v : values)
        groups.push_back (static_cast<int> (std::ranges::min_element (centres, {}, [v] (double c) { return std::abs (c - v); }) - centres.begin()));
    return groups;
}

/// The rows at one speed and force.
struct Group
{
    std::vector<Stretch> stretches {};
    double speed = 0.0, force = 0.0, rows = 0.0;   // sums, then means
};

/// A mean from the sums of groups.
struct Mean
{
    double sum = 0.0, rows = 0.0;

    void add (double more, double count)
    {
        sum += more;
        rows += count;
    }
    double value() const { return sum / rows; }
};

/// Groups with enough rows. The node interpolates in a grid of speeds and forces. So groups that were meant to have the same speed get exactly the
/// same one, and the same holds for forces.
std::vector<Group> onGrid (const std::map<std::pair<int, int>, Group>& groups)
{
    std::map<int, Mean> speeds, forces;
    const auto has_enough = [] (const Group& group) { return group.rows >= static_cast<double> (fewest_texture_rows); };
    for (const auto& [key, group] : groups)
        if (has_enough (group))
        {
            speeds[key.first].add (group.speed, group.rows);
            forces[key.second].add (group.force, group.rows);
        }
    std::vector<Group> enough;
    for (const auto& [key, group] : groups)
        if (has_enough (group)) enough.push_back ({ group.stretches, speeds[key.first].value(), forces[key.second].value(), group.rows });
    return enough;
}

std::vector<Group> groupsOf (const RecordedTexture& r)
{
    const auto n = r.acceleration.size();
    const auto speed = r.speed.empty() ? std::vector (n, r.assumed_speed) : r.speed, force = r.force.empty() ? std::vector (n, r.assumed_force) : r.force;
    std::vector<double> fast;
    for (const double v : speed)
        fast.push_back (std::abs (v));
    const double slowest = 0.05 * *std::ranges::max_element (fast), lightest = 0.05 * *std::ranges::max_element (force);
    std::vector<bool> counts;
    for (std::size_t i = 0; i < n; ++i)
        counts.push_back (fast[i] > slowest && force[i] > lightest && fast[i] > 0.0);
    const auto by_speed = groupsOf (fast, counts), by_force = groupsOf (force, counts);

    std::map<std::pair<int, int>, Group> groups;
    for (std::size_t from = 0; from < n;)
    {
        auto to = from + 1;
        while (to < n && counts[to] == counts[from] && by_speed[to] == by_speed[from] && by_force[to] == by_force[from])
            ++to;
        if (counts[from] && to - from >= shortest_stretch)
        {
            auto& group = groups[{ by_speed[from], by_force[from] }];
            group.stretches.push_back (Stretch (r.acceleration).subspan (from, to - from));
            for (auto i = from; i < to; ++i)
            {
                group.speed += fast[i];
                group.force += force[i];
            }
            group.rows += static_cast<double> (to - from);
        }
        from = to;
    }
    return onGrid (groups);
}

/// The sum of squares of the errors of predictions from one row to the next, and the number of these predictions.
std::pair<double, double> predictionErrors (const std::vector<Stretch>& stretches, const std::vector<double>& a)
{
    double sum = 0.0, count = 0.0;
    for (const auto y : stretches)
    {
        const double mean = std::accumulate (y.begin(), y.end(), 0.0) / static_cast<double> (y.size());
        for (std::size_t i = a.size(); i < y.size(); ++i)
        {
            double off = y[i] - mean;
            for (std::size_t k = 0; k < a.size(); ++k)
                off -= a[k] * (y[i - 1 - k] - mean);
            sum += off * off;
            count += 1.0;
        }
    }
    return { sum, count };
}

/// Cuts each stretch in the middle. Returns the first halves, and the second halves.
std::pair<std::vector<Stretch>, std::vector<Stretch>> halves (const std::vector<Stretch>& all)
{
    std::pair<std::vector<Stretch>, std::vector<Stretch>> both;
    for (const auto y : all)
    {
        both.first.push_back (y.first (y.size() / 2));
        both.second.push_back (y.subspan (y.size() / 2));
    }
    return both;
}

void addModel (const Group& group, const detail::SpectrumModel& found, TextureFit& result)
{
    auto& values = result.report.values;
    const auto name = "model " + std::to_string (result.models.size() + 1);
    const double freedom = group.rows;
    result.models.push_back ({ group.speed, group.force, found.coefficients, found.variance, found.floor, static_cast<std::size_t> (group.rows) });
    const auto order = static_cast<Eigen::Index> (found.coefficients.size());
    for (Eigen::Index k = 0; k < order; ++k)
        values.push_back (detail::withInterval (name + " a" + std::to_string (k + 1), "", found.coefficients[static_cast<std::size_t> (k)],
                                                std::sqrt (found.covariance (k, k)), freedom, false));
    values.push_back (detail::withLogInterval (name + " variance", "m2/s4", found.variance, std::sqrt (found.covariance (order, order)), freedom));
    const double half = detail::halfWidth95 (freedom) * std::sqrt (found.covariance (order + 1, order + 1));
    values.push_back ({ name + " sensor noise", "m2/s4", found.floor, std::max (0.0, found.floor - half), found.floor + half, false });
}

/// Adds a lack if most of the power is in a single tone, or if the recorded spectrum differs from the model by more than about 2 dB and more than chance
/// explains. In noise, a tone changes too few lines for the second test.
void judgeSpectrum (const Group& group, const detail::Periodogram& data, const detail::SpectrumModel& model, TextureFit& result)
{
    constexpr double most_in_tone = 0.4;                                                      // a tone with half of the power, between two lines
    constexpr double of_noise = 2.0 * std::numbers::egamma, deviation = 1.607, clear = 0.3;   // of the deviance of a line
    const double chance = 3.0 * deviation * std::sqrt (data.widening / static_cast<double> (data.power.size()));
    const auto name = "model " + std::to_string (result.models.size());
    if (const double share = detail::shareOfTones (group.stretches); share > most_in_tone)
        result.report.lacking.push_back ("a single tone has " + percentText (share) + " of the power in the spectrum of " + name
                                         + ": a tone cannot be played as noise");
    else if (model.deviance > of_noise + clear + chance)
        result.report.lacking.push_back ("the spectrum of " + name + " is not that of the recording: a tone, or single events, cannot be played as noise");
}

/// The spectrum of the strongest group, averaged over bands, and of its model.
FitPicture spectrumPicture (const detail::Periodogram& data, const detail::SpectrumModel& model, double rate)
{
    constexpr int bands = 120;
    std::vector<double> sum (bands), count (bands);
    for (std::size_t i = 0; i < data.frequency.size(); ++i)
    {
        const auto band = static_cast<std::size_t> (std::min (bands - 1.0, data.frequency[i] / std::numbers::pi * bands));
        sum[band] += data.power[i];
        count[band] += 1.0;
    }
    FitPicture picture { "frequency", "Hz", "level", "dB", { { "recorded", {}, {}, true }, { "fitted", {}, {} } } };
    for (int b = 0; b < bands; ++b)
    {
        const double w = std::numbers::pi * (b + 0.5) / bands, hertz = w * rate / (2.0 * std::numbers::pi);
        double re = 1.0, im = 0.0;
        for (std::size_t k = 0; k < model.coefficients.size(); ++k)
        {
            const auto [s, c] = math::sinCos (w * static_cast<double> (k + 1));
            re -= model.coefficients[k] * c;
            im += model.coefficients[k] * s;
        }
        const auto add = [hertz] (FitCurve& curve, double power) {
            curve.x.push_back (hertz);
            curve.y.push_back (10.0 * math::log10 (std::max (power, 1e-30)));
        };
        const auto band = static_cast<std::size_t> (b);
        if (count[band] > 0.0) add (picture.curves[0], sum[band] / count[band]);
        add (picture.curves[1], model.variance / (re * re + im * im) + model.floor);
    }
    return picture;
}
}   // namespace

Result<TextureFit> fitTexture (const RecordedTexture& given, FitCourse* course)
{
    auto recorded = given;
    std::vector<const std::vector<double>*> columns { &recorded.acceleration, &recorded.time };
    for (const auto* column : { &recorded.speed, &recorded.force })
        if (! column->empty()) columns.push_back (column);
    if (auto checked = detail::checkColumns (columns, fewest_texture_rows, "several seconds at each speed and force"); ! checked) return checked.error();
    const auto clock = detail::ontoEvenClock (recorded.time, { &recorded.acceleration, &recorded.speed, &recorded.force });
    if (! clock) return clock.error();
    const auto groups = groupsOf (recorded);
    if (groups.empty())
        return fitError ("fit/at_rest", "no stretch of " + std::to_string (fewest_texture_rows) + " rows has a steady speed and force above 0",
                         "drag the tool at a steady speed and force for at least a second");

    TextureFit result { .rate = 1.0 / clock->step };
    auto& report = result.report;
    double sum = 0.0, count = 0.0, left_out = 0.0, left_out_count = 0.0, squares = 0.0, most_rows = 0.0;
    for (std::size_t i = 0; i < groups.size(); ++i)
    {
        detail::setShare (course, static_cast<double> (i) / static_cast<double> (groups.size()));
        const auto& group = groups[i];
        const auto data = detail::periodogramOf (group.stretches);
        const auto found = detail::fitSpectrum (data, group.stretches, recorded.most_coefficients, course);
        const auto [first, second] = halves (group.stretches);
        const auto half =
            detail::fitSpectrum (detail::periodogramOf (first), first, static_cast<int> (std::max<std::size_t> (1, found.coefficients.size())), course);
        if (detail::isCancelled (course)) return detail::fitCancelled();
        if (found.coefficients.empty())
            return fitError ("fit/silent", "the acceleration at some speed and force does not vary, or is a pure tone, which cannot be played as noise",
                             "check which column is read");
        addModel (group, found, result);
        judgeSpectrum (group, data, found, result);
        const auto [off, rows] = predictionErrors (group.stretches, found.coefficients);
        const auto [off_left_out, rows_left_out] = predictionErrors (second, half.coefficients);
        sum += off;
        count += rows;
        left_out += off_left_out;
        left_out_count += rows_left_out;
        squares += predictionErrors (group.stretches, {}).first;
        report.rows += static_cast<std::size_t> (group.rows);
        if (group.rows <= most_rows) continue;
        most_rows = group.rows;
        report.picture = spectrumPicture (data, found, result.rate);
    }
    report.residual_unit = "m/s2";
    report.residual = std::sqrt (sum / count);
    report.left_out_residual = std::sqrt (left_out / std::max (1.0, left_out_count));
    report.size = std::sqrt (squares / count);
    report.notes.push_back ("the residual is the part of each row that the previous rows do not predict; a texture is noise, so the residual is large");
    if (recorded.speed.empty()) report.notes.push_back ("the speed was not recorded: it is taken as " + roundedText (recorded.assumed_speed) + " m/s");
    if (recorded.force.empty()) report.notes.push_back ("the force was not recorded: it is taken as " + roundedText (recorded.assumed_force) + " N");
    clock->tell (report);
    judge (report, "Record at least three seconds at each speed and force, and hold both steady.", std::numeric_limits<double>::infinity());
    return result;
}

}   // namespace tactus
