// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/device.hpp>
#include <framework/message.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// A recorded hand: one row a sample, times rising and starting at 0.
struct TraceData
{
    struct Row
    {
        double t = 0.0;                 ///< s since the first row
        Vec3 position = Vec3::Zero();   ///< m
        Vec3 rotation = Vec3::Zero();   ///< rotation vector, rad
        double pressure = 0.0;          ///< N
        std::uint32_t buttons = 0;      ///< bit i: button i is down
    };

    std::vector<Row> rows;

    std::vector<std::string> axes {};   ///< names of what else was recorded
    int signals = 0;                    ///< channels
    int buttons = 0;
    std::vector<double> more {};   ///< of each row the axes, then the signals

    /// The median time from row to row; 0 for a single row.
    double step() const;

    /// The last row lasts as long as the others, so that n rows at the rate of a run drive n ticks. 0 for a single
    /// row, which goes on for ever.
    double duration() const;
};

struct TraceResult
{
    TraceData trace;   ///< only to be used if there are no errors
    Messages messages;
};

/// Reads columns `t,x,y,z[,rx,ry,rz,pressure,button0…,signal1…]` in any order, values row after row; any other column whose
/// name could be that of a node is an axis of this name. The first t becomes 0. nan and inf are values, except in t. A column
/// of another name is ignored with a warning, and one that looks like a misspelt one of those gets one too.
///
/// Ids: trace/missing_column, trace/duplicate_column, trace/unknown_column (warning), trace/like_column (warning), trace/ragged, trace/empty,
/// trace/bad_time, trace/time_order. `where` is the row, counted from 1 under the header.
TraceResult readTrace (std::span<const std::string> columns, std::span<const double> values);

/// A recording in the place of a device, sampled and held: at a tick it tells the latest row that is not after it.
///
/// Good to know
///  - Forces are accepted and change nothing: the hand that moved cannot feel any more.
///  - A row whose position or rotation is not finite is handed on as it is, with valid = false.
///  - The age is that of the row; after the end the last row is held and grows older.
class TraceDevice final : public Device
{
public:
    explicit TraceDevice (std::shared_ptr<const TraceData>);

    void prepare (double dt_s) override;
    Reading read() noexcept override;
    void write (const Effort& guarded) noexcept override;
    DeviceLayout layout() const override;
    double duration() const noexcept override { return lasts; }

private:
    std::shared_ptr<const TraceData> trace;
    double lasts = 0.0;
    double dt = 1e-3;
    std::int64_t tick = 0;
    std::size_t row = 0;
};

}   // namespace tactus::host
