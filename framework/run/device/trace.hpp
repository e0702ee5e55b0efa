// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device.hpp>
#include <tactus/text/message.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tactus
{

/// A recorded hand: one row per sample; times start at 0 and increase.
struct TraceData
{
    struct Row
    {
        double t = 0.0;                 ///< time since the first row, in s
        Vec3 position = Vec3::Zero();   ///< m
        Vec3 rotation = Vec3::Zero();   ///< rotation vector, rad
        double pressure = 0.0;          ///< N
        std::uint32_t buttons = 0;      ///< bit i: button i is down
    };

    std::vector<Row> rows;

    std::vector<std::string> axes {};   ///< names of the recorded axes
    int signals = 0;                    ///< number of signal channels
    int buttons = 0;
    std::vector<double> more {};   ///< values of the axes and signals, row by row; in each row, the axes come first

    /// The median time between rows; 0 for a single row.
    double step() const;

    /// The last row lasts as long as the other rows, so that n rows at the rate of a run drive n ticks. 0 for a single row,
    /// which lasts forever.
    double duration() const;
};

struct TraceResult
{
    TraceData trace;   ///< valid only if there are no errors
    Messages messages;
};

/// Reads columns `t,x,y,z[,rx,ry,rz,pressure,button0…,signal1…]` in any order; the values come row by row. Any other column
/// with a valid node name is an axis of this name. The times are shifted so that the first one is 0. nan and inf are values, except in t. A column with
/// any other name is ignored with a warning; a name that looks misspelt gets a warning too.
///
/// Ids: trace/missing_column, trace/duplicate_column, trace/unknown_column (warning), trace/like_column (warning), trace/ragged, trace/empty,
/// trace/bad_time, trace/time_order. `where` is the row, counted from 1 below the header.
TraceResult readTrace (std::span<const std::string> columns, std::span<const double> values);

/// Plays a recording as a device, with sample-and-hold: a tick reads the latest row at or before its time.
///
/// Good to know
///  - Forces are accepted but have no effect: the recorded hand cannot feel them.
///  - A row whose position or rotation is not finite is passed on unchanged, with valid = false.
///  - The age of a reading is the age of its row. After the end, the last row is held and its age increases.
class TraceDevice final : public Device
{
public:
    explicit TraceDevice (std::shared_ptr<const TraceData>);

    void prepare (double dt_s) override;
    Reading read() noexcept override;
    void write (const Effort& guarded) noexcept override;
    bool serialize (StateArchive&) override;
    DeviceLayout layout() const override;
    double duration() const noexcept override { return lasts; }

private:
    std::shared_ptr<const TraceData> trace;
    double lasts = 0.0;
    double dt = 1e-3;
    std::int64_t tick = 0;
    std::size_t row = 0;
};

}   // namespace tactus
