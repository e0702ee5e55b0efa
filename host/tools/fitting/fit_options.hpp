// SPDX-License-Identifier: MIT
#pragma once

#include "fitting.hpp"

#include <vector>

namespace tactus::host
{

/// A number that the user may give to a fit, because the recording does not contain it.
struct FitOption
{
    FitKind kind;
    const char* name;     ///< "load", as in --load
    const char* unit;     ///< SI; empty: a plain number
    double least, most;   ///< range; the value may be neither below `least` nor above `most`
    bool is_whole = false;
    void (*set) (FitSettings&, double) = nullptr;
};

const std::vector<FitOption>& fitOptions();

/// The option of this kind with this name; null if there is none.
const FitOption* findFitOption (FitKind, std::string_view name);

/// A value that is not given to a fit as text, but with the names of the options: {"load": 2, "columns": {"force": "Fx"}, "units": {"force": "1 mN"},
/// "signs": {"depth": "-"}}. Amounts are SI numbers, or texts with a unit. Errors: fit/option, fit/unit.
Result<FitSettings> readFitSettings (FitKind, const Json&);

}   // namespace tactus::host
