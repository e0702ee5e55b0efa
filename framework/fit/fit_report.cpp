// SPDX-License-Identifier: MIT
#include "fit_report.hpp"

#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace tactus
{

const FitValue& FitReport::at (const std::string& name) const { return *std::ranges::find (values, name, &FitValue::name); }

std::string percentText (double share)
{
    constexpr double two_digits = 10.0, most = 1e6;   // percent
    const double percent = 100.0 * share, size = std::abs (percent);
    return roundedText (size >= two_digits ? std::round (percent) : percent, size >= two_digits && size < most ? 6 : 2) + " %";
}

void judge (FitReport& report, const std::string& record_more, double most)
{
    constexpr double wide = 0.25, much_worse = 1.5;
    if (! (report.residual <= most * report.size))
        report.lacking.push_back ("the model leaves " + percentText (report.residual / report.size) + " of the recording unexplained");
    if (! (report.left_out_residual <= much_worse * report.residual + 1e-3 * report.size))
        report.lacking.push_back (
            "the model predicts a part that was left out much worse than it fits the rest: the recording is too short, or the object changed");
    std::string unsure;
    for (const auto& v : report.values)
        if (v.is_main && ! (v.high - v.low <= 2.0 * wide * std::abs (v.value))) addToList (unsure, v.name);
    if (! unsure.empty()) report.lacking.push_back ("the recording does not contain enough information about: " + unsure);
    report.is_good = report.lacking.empty();
    if (! report.is_good) report.lacking.push_back (record_more);
}

namespace detail
{

Message fitError (const char* id, std::string text, std::string remedy) { return Message::error (id, {}, std::move (text), std::move (remedy)); }

Message fitCancelled() { return fitError ("fit/cancelled", "the fit was cancelled", "start it again"); }

double rootMeanSquare (const std::vector<double>& values)
{
    double sum = 0.0;
    for (const double v : values)
        sum += v * v;
    return values.empty() ? 0.0 : std::sqrt (sum / static_cast<double> (values.size()));
}

Result<> checkColumns (const std::vector<const std::vector<double>*>& columns, std::size_t fewest, const std::string& what)
{
    const auto n = columns.front()->size();
    if (n < fewest || ! std::ranges::all_of (columns, [n] (const auto* c) { return c->size() == n; }))
        return fitError ("fit/too_short", "the recording has " + std::to_string (n) + " rows; a fit needs at least " + std::to_string (fewest),
                         "record " + what);
    for (const auto* column : columns)
        if (! std::ranges::all_of (*column, [] (double v) { return std::isfinite (v); }))
            return fitError ("fit/not_finite", "the recording contains nan or inf", "leave out the rows without a measurement");
    return {};
}

namespace
{
/// The size of 1 in the last digit of each time; 0 if the times were not rounded. A time whose last digits are 0 counts like its neighbours.
std::vector<double> lastDigits (const std::vector<double>& time)
{
    constexpr int most = 9, around = 5;
    std::vector<double> own, least;
    for (const double t : time)
    {
        double unit = 1.0;
        int digits = 0;
        for (; digits <= most && std::abs (t / unit - std::round (t / unit)) > 1e-4; ++digits)
            unit *= 0.1;
        own.push_back (digits <= most ? unit : 0.0);
    }
    for (auto i = own.begin(); i != own.end(); ++i)
        least.push_back (*std::min_element (i - std::min<std::ptrdiff_t> (around, i - own.begin()), i + std::min<std::ptrdiff_t> (around + 1, own.end() - i)));
    return least;
}
}   // namespace

double roundedTo (const std::vector<double>& time)
{
    const auto digits = lastDigits (time);
    return *std::ranges::max_element (digits);
}

Result<double> evenStep (const std::vector<double>& time)
{
    const double step = (time.back() - time.front()) / static_cast<double> (time.size() - 1);
    if (std::ranges::adjacent_find (time, std::ranges::greater_equal {}) != time.end() || ! (step > 0.0))
        return fitError ("fit/time", "the times do not increase from row to row", "sort the rows by time");
    constexpr double tolerance = 0.1, nearly = 0.02;
    const auto digits = lastDigits (time);
    for (std::size_t i = 1; i < time.size(); ++i)
    {
        // Rounding changes each of a series of even steps to the next smaller or larger number of units.
        const double next = time[i] - time[i - 1], unit = std::max (digits[i], 1e-9 * step), units = step / unit;
        const bool is_even = next > unit * std::floor (units + nearly) - tolerance * step && next < unit * std::ceil (units - nearly) + tolerance * step;
        if (! is_even)
            return fitError ("fit/uneven",
                             "the rows are not evenly spaced: row " + std::to_string (i + 1) + " comes " + roundedText (next / step, 3)
                                 + " mean steps after the row before it",
                             "record at a constant rate without losing rows, or resample the recording");
    }
    for (std::size_t i = 1; i < time.size(); ++i)
        if (std::abs (time[i] - time.front() - step * static_cast<double> (i)) > 0.5 * step + digits[i])
            return fitError ("fit/uneven", "the rows are not evenly spaced: row " + std::to_string (i + 1) + " is off by more than half a step",
                             "record at a constant rate, or resample the recording");
    return step;
}

}   // namespace detail

}   // namespace tactus
