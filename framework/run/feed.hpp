// SPDX-License-Identifier: MIT
#pragma once

#include "run.hpp"

#include <tactus/file/csv.hpp>

#include <span>
#include <string>
#include <vector>

namespace tactus
{

/// A CSV whose columns drive ports of a graph. Each row is a tick, unless a rate is requested and the CSV has times: then each
/// tick uses the latest row at or before its time.
class Feed final : public RunListener
{
public:
    /// If `rate_hz` is 0, the rate is 1/median dt of the column `t`, or the graph's rate if there is no such column. Ids:
    /// feed/bad_time, feed/time_order, feed/empty, run/too_long.
    static Result<Feed> make (Table, const std::string& name, double rate_hz, double graph_rate_hz);

    double rate() const noexcept { return rate_hz; }
    std::size_t ticks() const noexcept { return count; }

    /// The driven ports: all columns except `t`.
    const std::vector<std::string>& drives() const noexcept { return names; }

    /// Writes the values of tick k to the feeds of the plan. Call it with ticks in order.
    void operator() (std::size_t k, std::span<double> values) noexcept;

    void before (Plan& plan, std::uint64_t tick) noexcept override { (*this) (tick, plan.feeds()); }

private:
    Table table;
    std::vector<std::string> names;
    std::vector<std::size_t> columns;
    std::optional<std::size_t> time;
    bool held = false;
    double rate_hz = 0.0;
    std::size_t count = 0, row = 0;
};

}   // namespace tactus
