// SPDX-License-Identifier: MIT
#include <tactus/run/device/path.hpp>
#include <tactus/run/device/trace.hpp>

#include <support/no_allocation.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace tactus;

namespace
{
const double not_a_number = std::numeric_limits<double>::quiet_NaN();
const std::vector<std::string> txyz { "t", "x", "y", "z" };

std::vector<std::string> idsOf (const Messages& messages)
{
    std::vector<std::string> ids;
    for (const auto& message : messages)
        ids.push_back (message.id);
    return ids;
}

std::shared_ptr<const TraceData> traceOf (const std::vector<double>& values, const std::vector<std::string>& columns = txyz)
{
    auto [trace, messages] = readTrace (columns, values);
    REQUIRE (messages.empty());
    return std::make_shared<const TraceData> (std::move (trace));
}

TraceDevice playing (const std::vector<double>& values, double dt, const std::vector<std::string>& columns = txyz)
{
    TraceDevice device (traceOf (values, columns));
    device.prepare (dt);
    return device;
}

Reading next (TraceDevice& device)
{
    const auto reading = device.read();
    device.write ({});
    return reading;
}
}   // namespace

TEST_CASE ("trace: a tick sees the latest row at or before its time", "[host][devices]")
{
    auto device = playing ({ 0.000, 1, 0, 0,
                             0.004, 2, 0, 0,
                             0.009, 3, 0, 0 },
                           2e-3);

    const double expected[] { 1, 1, 2, 2, 2, 3, 3 };
    for (const double x : expected)
        CHECK (next (device).position.x() == x);
}

TEST_CASE ("trace: a run starts at the first row, regardless of its time", "[host][devices]")
{
    auto device = playing ({ 1364787581.25, 1, 2, 3,
                             1364787581.50, 4, 5, 6 },
                           0.25);

    CHECK (next (device).position == Vec3 (1, 2, 3));
    CHECK (next (device).position == Vec3 (4, 5, 6));
}

TEST_CASE ("trace: one row per tick remains one row per tick, although files contain rounded times", "[host][devices]")
{
    const double rate = GENERATE (1000.0, 3000.0, 4000.0, 44100.0);
    std::vector<double> values;
    for (int k = 0; k < 5000; ++k)
    {
        const double t = std::round (k / rate * 1e9) / 1e9;
        values.insert (values.end(), { 17.0 + t, 1.0 * k, 0, 0 });
    }
    auto device = playing (values, 1 / rate);

    int missed = 0;
    for (int k = 0; k < 5000; ++k)
        missed += next (device).position.x() != k;
    CHECK (missed == 0);
    CHECK (std::lround (device.duration() * rate) == 5000);
}

TEST_CASE ("trace: the age of a reading is the age of its row, and the last row is held", "[host][devices]")
{
    auto device = playing ({ 0, 1, 0, 0,
                             0.01, 2, 0, 0 },
                           4e-3);

    CHECK (next (device).age == 0.0);
    CHECK (next (device).age == Approx (0.004));
    CHECK (next (device).age == Approx (0.008));
    CHECK (next (device).age == Approx (0.002));
    for (int k = 4; k < 100; ++k)
        CHECK (next (device).position.x() == 2.0);
    CHECK (next (device).age == Approx (0.39));
    CHECK (next (device).valid);
}

TEST_CASE ("trace: an untracked hand still gives a reading, marked invalid", "[host][devices]")
{
    auto device = playing ({ 0, 1, 0, 0,
                             1, 2, not_a_number, 0,
                             2, 3, 0, 0 },
                           1.0);

    CHECK (next (device).valid);
    const auto unseen = next (device);
    CHECK (! unseen.valid);
    CHECK (unseen.position.x() == 2.0);
    CHECK (std::isnan (unseen.position.y()));
    CHECK (next (device).valid);
}

TEST_CASE ("trace: rotation, pressure and buttons are read, with columns in any order", "[host][devices]")
{
    const std::vector<std::string> columns { "button3", "z", "pressure", "y", "rz", "x", "ry", "t", "rx", "button0" };
    auto device = playing ({ 1, 3, 0.5, 2, 0.3, 1, 0.2, 0, 0.1, 0,
                             0, 3, 0.7, 2, 0.3, 1, 0.2, 1, 0.1, 1 },
                           1.0, columns);

    const auto first = next (device), second = next (device);
    CHECK (first.position == Vec3 (1, 2, 3));
    CHECK (first.rotation == Vec3 (0.1, 0.2, 0.3));
    CHECK (first.pressure == 0.5);
    CHECK (first.buttons == 8u);
    CHECK (second.pressure == 0.7);
    CHECK (second.buttons == 1u);
}

TEST_CASE ("trace: all problems with the columns are reported together", "[host][devices]")
{
    const auto result = readTrace (std::vector<std::string> { "x", "x", "Force [N]", "button99" }, {});
    CHECK (idsOf (result.messages) == std::vector<std::string> {
               "trace/duplicate_column",
               "trace/unknown_column",
               "trace/unknown_column",
               "trace/missing_column",
               "trace/missing_column",
               "trace/missing_column",
               "trace/empty",
           });
}

TEST_CASE ("trace: an unknown column gives a warning, and the rest is read", "[host][devices]")
{
    const auto result = readTrace (std::vector<std::string> { "t", "x", "y", "z", "Mood" }, std::vector<double> { 0, 1, 2, 3, 99 });
    CHECK (idsOf (result.messages) == std::vector<std::string> { "trace/unknown_column" });
    CHECK (! hasErrors (result.messages));
    CHECK (result.trace.rows.at (0).position == Vec3 (1, 2, 3));
}

TEST_CASE ("trace: other columns are axes by name, and signals by channel", "[host][devices]")
{
    const std::vector<std::string> columns { "t", "signal3", "x", "trigger", "y", "z", "signal1", "stick", "button4" };
    auto device = playing ({ 0, 0.3, 1, 0.5, 2, 3, 0.1, -1, 0,
                             1, 0.6, 1, not_a_number, 2, 3, 0.2, 0, 1 },
                           1.0, columns);
    CHECK (device.layout() == DeviceLayout { .axes = { "trigger", "stick" }, .buttons = std::vector<std::string> (5), .signal_inputs = 3 });
    const auto first = next (device), second = next (device);
    CHECK (first.axes.size() == 2);
    CHECK (first.axes[0] == 0.5);
    CHECK (first.axes[1] == -1.0);
    CHECK (first.signals.size() == 3);
    CHECK (first.signals[0] == 0.1);
    CHECK (first.signals[1] == 0.0);
    CHECK (first.signals[2] == 0.3);
    CHECK (second.signals[2] == 0.6);
    CHECK (std::isnan (second.axes[0]));
    CHECK (second.valid);
}

TEST_CASE ("trace: a column whose name looks misspelt is read as an axis, with a warning", "[host][devices]")
{
    const auto result = readTrace (std::vector<std::string> { "t", "x", "y", "z", "presure", "signal33" }, std::vector<double> { 0, 1, 2, 3, 4, 5 });
    CHECK (idsOf (result.messages) == std::vector<std::string> { "trace/like_column", "trace/unknown_column" });
    CHECK (result.trace.axes == std::vector<std::string> { "presure" });
    CHECK (result.trace.rows.at (0).pressure == 0.0);
}

TEST_CASE ("trace: the number of axes is limited, and the rest are ignored with a warning", "[host][devices]")
{
    std::vector<std::string> columns { "t", "x", "y", "z" };
    std::vector<double> values { 0, 1, 2, 3 };
    for (int i = 0; i < Channels::most + 2; ++i)
    {
        columns.push_back ("joint" + std::to_string (i));
        values.push_back (i);
    }
    const auto result = readTrace (columns, values);
    CHECK (idsOf (result.messages) == std::vector<std::string> { "trace/unknown_column", "trace/unknown_column" });
    CHECK (result.trace.axes.size() == static_cast<std::size_t> (Channels::most));
    CHECK (result.trace.more.back() == Channels::most - 1.0);
}

TEST_CASE ("trace: times must be numbers that increase", "[host][devices]")
{
    const auto [t0, t1, id, where] = GENERATE (table<double, double, std::string, std::string> ({
        { 0.0, 0.0, "trace/time_order", "row 2" },
        { 0.1, 0.0, "trace/time_order", "row 2" },
        { 0.0, not_a_number, "trace/bad_time", "row 2" },
        { -std::numeric_limits<double>::infinity(), 0.0, "trace/bad_time", "row 1" },
    }));

    const auto result = readTrace (txyz, std::vector<double> { t0, 0, 0, 0, t1, 0, 0, 0 });
    REQUIRE (result.messages.size() == 1);
    CHECK (result.messages[0].id == id);
    CHECK (result.messages[0].where == where);
}

TEST_CASE ("trace: an incomplete row is reported", "[host][devices]")
{
    CHECK (idsOf (readTrace (txyz, std::vector<double> { 0, 0, 0, 0, 1 }).messages) == std::vector<std::string> { "trace/ragged" });
}

TEST_CASE ("trace: a single row is held forever", "[host][devices]")
{
    auto device = playing ({ 5.0, 1, 2, 3 }, 1e-3);
    CHECK (device.duration() == 0.0);
    for (int k = 0; k < 10; ++k)
        CHECK (next (device).position == Vec3 (1, 2, 3));
}

TEST_CASE ("trace: a tick allocates nothing", "[host][devices]")
{
    auto device = playing ({ 0, 1, 0, 0, 0.01, 2, 0, 0 }, 1e-3);
    const NoAllocation watch;
    for (int k = 0; k < 30; ++k)
        next (device);
    CHECK (watch.allocations() == 0);
}

TEST_CASE ("trace: as the path of a hand it has no steps, even where tracking was lost", "[host][devices]")
{
    const TracePath path (*traceOf ({ 0, 0, 0, 0,
                                      1, 1, 0, 0,
                                      2, not_a_number, 0, 0,
                                      3, 3, 0, 4 }),
                          { .offset = { 0, 0, 10 }, .scale = 2.0 });

    CHECK (path.at (0.5).position == Vec3 (1, 0, 10));
    CHECK (path.at (0.5).velocity == Vec3 (2, 0, 0));
    CHECK (path.at (2.0).position == Vec3 (4, 0, 14));
    CHECK (path.at (2.0).velocity == Vec3 (2, 0, 4));
    CHECK (path.at (9.0).position == Vec3 (6, 0, 18));
    CHECK (path.at (9.0).velocity == Vec3 (0, 0, 0));
}
