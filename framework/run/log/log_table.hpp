// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/json.hpp>
#include <tactus/text/result.hpp>

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace tactus
{

/// A column of numbers, one for each tick.
struct NumberColumn
{
    std::string name;   ///< "stylus.position.x"
    std::string unit;   ///< SI; "" if unknown
    std::vector<double> values {};
};

/// The numbers of a log, or of a replay, tick by tick, and what else there is to say, as JSON.
struct NumberTable
{
    std::uint64_t first = 0;   ///< the tick of the first row
    std::vector<NumberColumn> columns {};
    Json about {};
};

/// The part of a run that is read.
struct TickRange
{
    std::uint64_t from = 0, until = std::numeric_limits<std::uint64_t>::max();   ///< ticks; `until` is the one after the last

    /// The ticks between two times in s; an infinite end is that of the run.
    static TickRange between (double from_s, double until_s, double rate_hz);
};

/// Reads what a log says about each tick: `passed` (s), and for each role the fields of its reading, and the feeds. What has not changed is repeated.
/// `about` has the first line of the log in `head`, other inputs in `events`, each with `tick`, `kind`, `name` and `value`, and `is_cut_off`. Nothing is
/// played. Ids: those of RunLogReader, log/empty, take/too_large. [main thread]
Result<NumberTable> readLogTable (const std::string& log, double from_s, double until_s);

/// An error if so many numbers exceed the budget. Id: take/too_large.
Result<> checkNumbers (double numbers);

}   // namespace tactus
