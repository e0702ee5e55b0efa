// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_model.hpp"

#include <host/app/run/traces.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace tactus::host
{

using TraceList = std::vector<std::shared_ptr<const Trace>>;

/// The lowest and highest value of the ticks in a column of pixels, so that no peak is lost.
struct TraceColumn
{
    Extent extent;   ///< empty where there is a gap
};

/// A range of ticks in columns of equal width. Columns are aligned to tick 0, so that a moving window does not shimmer.
struct TraceColumns
{
    double ticks_each = 1.0;
    double first = 0.0;   ///< the first tick of the first column
    std::vector<TraceColumn> all;
};

TraceColumns columnsOf (const Trace&, double from, double to, std::size_t at_most);

/// The columns of a window that moves along a trace while the trace grows: the same as those of columnsOf, but only new ticks are read.
class MovingColumns
{
public:
    const TraceColumns& update (const std::shared_ptr<const Trace>&, double from, double to, std::size_t at_most);
    const TraceColumns& columns() const noexcept { return shown; }

    /// The extent of all ticks in the window.
    Extent extent() const noexcept;

    std::uint64_t ticksRead() const noexcept { return read; }   ///< by all updates together

private:
    TraceColumns shown;
    std::shared_ptr<const Trace> of;
    std::uint64_t beginnings = 0;
    double whole_from = 0.0, whole_to = 0.0;   // the columns whose ticks have all been read, by number since tick 0
    std::uint64_t read = 0;
};

/// The extent of a trace over a range of ticks.
Extent extentOf (const Trace&, double from, double to);
Extent extentOf (const Trace&, std::uint64_t from, std::uint64_t to);

/// The latest tick before a limit at which a trace crosses the trigger level on the selected edge, after it was on the other side by
/// at least the hysteresis. A gap resets the trigger.
std::optional<std::uint64_t> latestCrossing (const Trace&, const ScopeTrigger&, double hysteresis, std::uint64_t before);

struct TickWindow
{
    static constexpr double before_trigger = 0.2;   ///< the part of the window that lies before the trigger, as a fraction

    double from = 0.0, to = 0.0;   ///< ticks
    std::optional<std::uint64_t> trigger;
};

/// The ticks that an oscilloscope shows: around the latest trigger, or up to the newest tick if nothing triggers.
TickWindow windowOf (const TraceList&, double seconds, const ScopeTrigger&, double hysteresis);

/// One past the newest tick of all traces.
std::uint64_t endOf (const TraceList&);

/// The latest samples of a trace. In a gap, the previous value is held.
struct LatestSamples
{
    std::vector<double> values;
    std::size_t missing = 0;
};
LatestSamples latestSamples (const Trace&, double seconds);

}   // namespace tactus::host
