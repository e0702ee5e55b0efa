// SPDX-License-Identifier: MIT
#include "even_clock.hpp"

#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace tactus::detail
{

namespace
{
constexpr std::size_t knots = 6;   // of a polynomial

/// The value at a time between rows, from the polynomial through the nearest rows. `row` is the last row at or before that time, or 0.
double valueBetween (const std::vector<double>& time, const std::vector<double>& value, double t, std::size_t row)
{
    const auto count = std::min (knots, time.size()), first = std::min (row >= knots / 2 - 1 ? row - (knots / 2 - 1) : 0, time.size() - count);
    double sum = 0.0;
    for (std::size_t i = first; i < first + count; ++i)
    {
        double weight = 1.0;
        for (std::size_t k = first; k < first + count; ++k)
            if (k != i) weight *= (t - time[k]) / (time[i] - time[k]);
        sum += weight * value[i];
    }
    return sum;
}

/// The values at other times, which increase. A time before the first row or after the last one gets the value of that row.
std::vector<double> valuesAt (const std::vector<double>& wanted, const std::vector<double>& time, const std::vector<double>& value)
{
    std::vector<double> made;
    made.reserve (wanted.size());
    std::size_t row = 0;
    for (const double t : wanted)
    {
        while (row + 1 < time.size() && time[row + 1] <= t)
            ++row;
        made.push_back (valueBetween (time, value, std::clamp (t, time.front(), time.back()), row));
    }
    return made;
}

/// The least-squares line of times over row numbers, and the sum of the squares of its residual.
struct RowLine
{
    double start = 0.0, step = 0.0, left = 0.0;
};

/// The sums over rows for a line through their times. Times count from the middle of the recording, in mean steps, so the sums stay small.
struct RowSums
{
    double n = 0.0, k = 0.0, kk = 0.0, t = 0.0, kt = 0.0, tt = 0.0;

    void add (double number, double time)
    {
        n += 1.0;
        k += number;
        kk += number * number;
        t += time;
        kt += number * time;
        tt += time * time;
    }

    RowLine line() const
    {
        const double spread = kk - k * k / n, together = kt - k * t / n, step = together / spread;
        return { (t - step * k) / n, step, tt - t * t / n - step * together };
    }

    /// The sums after the numbers of the rows in `later`, a part of these rows, have gone up by 1.
    RowSums withGapBefore (const RowSums& later) const
    {
        RowSums s = *this;
        s.k += later.n;
        s.kk += 2.0 * later.k + later.n;
        s.kt += later.t;
        return s;
    }
};

/// The row after a gap where a row seems to be lost: with one number left out there, the times lie closer to a line. 0 if no row seems to be lost.
std::size_t lostBefore (const std::vector<double>& scaled, const RowSums& all)
{
    constexpr double wide = 1.5;   // steps; the gap of a lost row is 2 steps, give or take the jitter
    const double left = all.line().left, middle = 0.5 * static_cast<double> (scaled.size() - 1);
    RowSums later;
    for (std::size_t i = scaled.size() - 1; i > 0; --i)
    {
        later.add (static_cast<double> (i) - middle, scaled[i]);
        if (scaled[i] - scaled[i - 1] > wide && all.withGapBefore (later).line().left < left) return i;
    }
    return 0;
}
}   // namespace

void EvenClock::tell (FitReport& report) const
{
    constexpr double much = 0.1;
    if (! (jitter > 0.0)) return;
    report.notes.push_back ("the times of the rows jitter by up to " + percentText (jitter) + " of a step, so the rows were interpolated at even times; "
                            + "read back at the recorded times, they differ by " + percentText (difference) + " (rms)");
    if (difference > much)
        report.lacking.push_back ("the values change too fast for times that jitter: interpolation changed them by " + percentText (difference) + " (rms)");
}

Result<EvenClock> ontoEvenClock (std::vector<double>& time, const std::vector<std::vector<double>*>& columns)
{
    const auto even = evenStep (time);
    if (! even && even.error().id != "fit/uneven") return even.error();
    const auto rows = time.size();
    const double mean = (time.back() - time.front()) / static_cast<double> (rows - 1), middle = 0.5 * static_cast<double> (rows - 1), zero = time[rows / 2];

    std::vector<double> scaled;
    RowSums all;
    for (std::size_t i = 0; i < rows; ++i)
    {
        scaled.push_back ((time[i] - zero) / mean);
        all.add (static_cast<double> (i) - middle, scaled[i]);
    }
    const auto line = all.line();
    EvenClock clock { .step = line.step * mean };
    const auto evenTime = [&] (std::size_t i) { return zero + mean * (line.start + line.step * (static_cast<double> (i) - middle)); };
    for (std::size_t i = 0; i < rows; ++i)
        clock.jitter = std::max (clock.jitter, std::abs (time[i] - evenTime (i)) / clock.step);

    // Rounding moves a time by at most half of its last digit, and the line by less.
    constexpr double half = 0.5, negligible = 0.01, rounding = 0.7;
    if (even && clock.jitter <= std::max (negligible, rounding * roundedTo (time) / *even)) return EvenClock { .step = *even };
    if (! (clock.jitter < half)) return even ? Result<EvenClock> (EvenClock { .step = *even }) : Result<EvenClock> (even.error());
    if (const auto row = lostBefore (scaled, all); row > 0)
        return fitError ("fit/uneven", "the rows are not evenly spaced: a row seems to be lost before row " + std::to_string (row + 1),
                         "record at a constant rate without losing rows, or resample the recording");

    std::vector<double> wanted;
    for (std::size_t i = 0; i < rows; ++i)
        wanted.push_back (evenTime (i));
    for (auto* column : columns)
    {
        if (column->empty()) continue;
        auto made = valuesAt (wanted, time, *column);
        auto off = valuesAt (time, wanted, made);
        for (std::size_t i = 0; i < rows; ++i)
            off[i] -= (*column)[i];
        if (const double size = rootMeanSquare (*column); size > 0.0) clock.difference = std::max (clock.difference, rootMeanSquare (off) / size);
        *column = std::move (made);
    }
    time = std::move (wanted);
    return clock;
}

}   // namespace tactus::detail
