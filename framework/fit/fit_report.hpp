// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/result.hpp>

#include <atomic>
#include <string>
#include <vector>

namespace tactus
{

/// A fitted parameter with its 95 % interval: if the recording were made 100 times with other noise, the interval would contain the true value
/// in about 95 of them. A bound that the recording does not determine is infinite.
struct FitValue
{
    std::string name;   ///< such as "mu"; plain words if the value is not a parameter of a node
    std::string unit;   ///< SI, as symbolOf writes it; empty: a ratio
    double value = 0.0, low = 0.0, high = 0.0;
    bool is_main = true;   ///< the verdict depends on its interval

    bool operator== (const FitValue&) const = default;
};

/// A curve in the plot of a fit.
struct FitCurve
{
    std::string label {};
    std::vector<double> x {}, y {};
    bool is_recorded = false;   ///< measured, so drawn as points or in the background
};

/// A plot of the recording and the fit in the same axes.
struct FitPicture
{
    std::string x_name {}, x_unit {}, y_name {}, y_unit {};
    std::vector<FitCurve> curves {};
};

/// The result of a fit: the parameters, how certain they are, and how well the model fits the recording.
struct FitReport
{
    std::vector<FitValue> values {};
    std::size_t rows = 0;                  ///< rows of the recording that were used
    std::string residual_unit {};          ///< of the three numbers below
    double residual = 0.0;                 ///< root mean square of recorded minus fitted
    double left_out_residual = 0.0;        ///< the same on a part of the recording that was left out of the fit
    double size = 0.0;                     ///< root mean square of the recording, to compare the residuals with
    bool is_good = false;                  ///< the verdict
    std::vector<std::string> lacking {};   ///< what makes the verdict poor, and which data would help; empty if it is good
    std::vector<std::string> notes {};     ///< what the fit assumed or changed
    FitPicture picture {};

    /// The value with this name. It must exist.
    const FitValue& at (const std::string& name) const;
};

/// A share of a whole: "2.7 %" with two digits, "140 %" with all that are whole.
std::string percentText (double share);

/// Sets the verdict. It is poor if the recording is not explained (the residual is larger than `most` times its size), if the part that was left
/// out is predicted much worse than the rest is fitted, if the interval of a main value is wider than +-25 %, or if something is already
/// missing. `record_more` says which data would help.
void judge (FitReport&, const std::string& record_more, double most = 0.25);

/// Lets another thread cancel a fit and read its progress.
struct FitCourse
{
    std::atomic<bool> cancelled { false };
    std::atomic<double> share { 0.0 };   ///< the progress, from 0 to 1
};

namespace detail
{
/// An error of a fit, with the id fit/…
Message fitError (const char* id, std::string text, std::string remedy);
Message fitCancelled();
inline bool isCancelled (const FitCourse* course) { return course && course->cancelled; }
inline void setShare (FitCourse* course, double share)
{
    if (course) course->share = share;
}
double rootMeanSquare (const std::vector<double>&);

/// Errors: fit/not_finite, if a number is nan or infinite; fit/too_short, if there are fewer than `fewest` rows, or the columns have different lengths.
Result<> checkColumns (const std::vector<const std::vector<double>*>& columns, std::size_t fewest, const std::string& what);

/// The mean time step between two rows, in s. Each step may be off by 10 % of the mean, and also by what rounding to the printed digits changes; each
/// time may be off by up to half a step. Errors: fit/time, fit/uneven.
Result<double> evenStep (const std::vector<double>& time);

/// The value of the last digit of rounded times, in s; 0 if the times are not rounded.
double roundedTo (const std::vector<double>& time);
}   // namespace detail

}   // namespace tactus
