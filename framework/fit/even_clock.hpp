// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"

#include <vector>

namespace tactus::detail
{

/// The clock of a recording, after its rows were brought onto it.
struct EvenClock
{
    double step = 0.0;         ///< s
    double jitter = 0.0;       ///< largest distance of a recorded time from the even one, in steps; 0: the rows are as they were
    double difference = 0.0;   ///< rms of the recorded values minus the even ones read back at the recorded times, over the rms of the former; the worst column

    /// Adds to a report that rows were interpolated and with which error, and makes the verdict poor if that is large.
    void tell (FitReport&) const;
};

/// Brings rows whose times jitter by less than half a step onto even times, in place: the values are read between the rows, on polynomials of
/// degree 5 through the six nearest ones. Times that were only rounded when they were written count as even, and are not changed. All columns
/// have as many rows as there are times, or none. Errors: fit/time, fit/uneven (larger gaps, or a row that is lost). Time: linear.
Result<EvenClock> ontoEvenClock (std::vector<double>& time, const std::vector<std::vector<double>*>& columns);

}   // namespace tactus::detail
