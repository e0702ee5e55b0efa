// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/io/csv.hpp>

#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// A CSV whose columns drive ports of a graph. Without a rate asked for, each row is a tick; with one, the rows of a
/// table with times are held to the grid of ticks.
class Feed
{
public:
    /// `rate_hz` 0: 1/median dt of the column `t`, or else the graph's rate. Ids of errors: feed/bad_time,
    /// feed/time_order, feed/empty.
    static tl::expected<Feed, Error> make (Table, const std::string& name, double rate_hz, double graph_rate_hz);

    double rate() const noexcept { return rate_hz; }
    std::size_t ticks() const noexcept { return count; }

    /// The columns but for `t`.
    const std::vector<std::string>& ports() const noexcept { return names; }

    /// Puts the values of tick k where the ports read them. Ticks come in order.
    void operator() (std::size_t k, std::span<double> values) noexcept;

private:
    Table table;
    std::vector<std::string> names;
    std::vector<std::size_t> columns;
    std::optional<std::size_t> time;
    bool held = false;
    double rate_hz = 0.0;
    std::size_t count = 0, row = 0;
};

}   // namespace tactus::host
