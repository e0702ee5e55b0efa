// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"

#include <vector>

namespace tactus::detail
{

/// The even clock of a recording, and the errors of bringing its rows onto it.
struct EvenClock
{
    double step = 0.0;         ///< s
    double jitter = 0.0;       ///< largest distance of a recorded time from the even one, in steps; 0: the rows are as they were
    double difference = 0.0;   ///< between recorded values and even ones that are read back at the recorded times: rms, over that of the column; the worst one

    /// Adds a note about the interpolation and its error to a report. A large error makes the verdict of the fit poor.
    void tell (FitReport&) const;
};

/// Brings rows whose times jitter by less than half a step onto even times, in place. A value comes from a polynomial of degree 5 through the six nearest
/// rows. Even times that are only rounded stay as they are. Each column has as many rows as there are times, or none. Errors: fit/time, fit/uneven (larger
/// gaps, or a lost row). Time: linear.
Result<EvenClock> ontoEvenClock (std::vector<double>& time, const std::vector<std::vector<double>*>& columns);

}   // namespace tactus::detail
