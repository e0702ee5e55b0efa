// SPDX-License-Identifier: MIT
#pragma once

#include "gauge.hpp"

#include <tactus/run/device/make_device.hpp>
#include <tactus/run/feed.hpp>
#include <tactus/run/run.hpp>

#include <optional>
#include <string>
#include <vector>

namespace tactus::python
{

/// The graph and options that all points share.
struct Job
{
    graph::Graph graph {};
    CompileOptions options {};              // with the values that all points share
    std::vector<std::string> names {};      // of what varies
    std::vector<DeviceOption> devices {};   // instead of those of the graph
    std::vector<Gauge::Options> gauges {};
    double seconds = 0.0;     // 0: as long as the feed, or the longest path of a hand
    bool keeps = false;       // the records, too
    std::size_t places = 0;   // of the check of stability; 0: none
    std::optional<Feed> feed {};

    /// The device that the job gives to a role, or null.
    const DeviceOption* deviceOf (const std::string& role) const;
};

/// Result of a point.
struct Outcome
{
    std::vector<double> numbers {}, rows {};   ///< rows: tick by tick
    Messages messages {};
    double seconds = 0.0;
};

/// A run that renders one point after another. The graph is compiled for the first one. For each other point, the run goes back to before its first
/// tick, and the parameters that differ are set; a graph whose state cannot be saved is compiled again. Both give the same bits and messages.
class PointRun final : RunListener
{
public:
    PointRun (const Job&, std::size_t points);   ///< how many points it will render

    /// `options`: with the values of the point. Throws std::invalid_argument if the columns do not have what a gauge needs.
    void render (const CompileOptions& options, Outcome&);

    // Of the columns of the last point that could be rendered.
    std::vector<std::string> columns {}, units {};
    double rate_hz = 0.0;

private:
    void after (const Plan&, std::uint64_t tick, bool halts) noexcept override;
    void begin (const CompileOptions&, Messages&);
    bool goBack (const CompileOptions&, Messages&);
    bool set (const plan::Flat&, std::size_t node);
    std::size_t ticks() const;

    const Job& job;
    bool goes_back;   // worth a try
    std::optional<Feed> feed {};
    std::vector<Gauge> fresh {}, gauges {};
    std::vector<double> rows {};
    std::vector<std::byte> state {};   // before the first tick; empty: none could be saved
    std::size_t row = 0;
    std::optional<Run> run {};   // declared last, so that it is destroyed first
};

}   // namespace tactus::python
