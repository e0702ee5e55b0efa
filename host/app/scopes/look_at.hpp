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

/// The lowest and the highest of the ticks that share a column of pixels, so that no peak is lost however many there are.
struct TraceColumn
{
    Extent extent;   ///< empty where there is a gap
};

/// From one tick to another, a column every so many ticks; a column begins where a whole number of them has passed since tick
/// 0, so that what moves through the window does not shimmer.
struct TraceColumns
{
    double ticks_each = 1.0;
    double first = 0.0;   ///< the tick where the first column begins
    std::vector<TraceColumn> all;
};

TraceColumns columnsOf (const Trace&, double from, double to, std::size_t at_most);

/// Of all that is held from one tick to another.
Extent extentOf (const Trace&, double from, double to);

/// The latest tick before a limit on which a trace has passed a level the wanted way, having been beyond it by the
/// hysteresis; a gap begins anew.
std::optional<std::uint64_t> latestCrossing (const Trace&, const ScopeTrigger&, double hysteresis, std::uint64_t before);

struct TickWindow
{
    static constexpr double before_trigger = 0.2;   ///< of the window

    double from = 0.0, to = 0.0;   ///< ticks
    std::optional<std::uint64_t> trigger;
};

/// What a scope over time shows: up to the newest tick, or around the latest one that triggers, if one does.
TickWindow windowOf (const TraceList&, double seconds, const ScopeTrigger&, double hysteresis);

/// One after the newest tick of all.
std::uint64_t endOf (const TraceList&);

}   // namespace tactus::host
