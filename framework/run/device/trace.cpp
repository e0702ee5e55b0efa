// SPDX-License-Identifier: MIT
#include "trace.hpp"
#include <tactus/kit/state_archive.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/number_text.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace tactus
{
namespace
{

// Times in files are rounded, at worst to microseconds. A row that is late by less than this fraction of a tick counts
// as on time.
constexpr double slack = 1e-3;

/// The number in a column name: 3 for "button3". Does not accept numbers outside the given range.
std::optional<int> numberOf (std::string_view column, std::string_view prefix, int min, int max)
{
    if (! column.starts_with (prefix)) return {};

    const auto digits = column.substr (prefix.size());
    int number = -1;
    const auto [end, failure] = std::from_chars (digits.data(), digits.data() + digits.size(), number);
    const bool whole = failure == std::errc() && end == digits.data() + digits.size();
    if (! whole || number < min || number > max) return {};
    return number;
}

std::optional<int> buttonOf (std::string_view column) { return numberOf (column, "button", 0, Reading::most_buttons - 1); }
std::optional<int> signalOf (std::string_view column) { return numberOf (column, "signal", 1, Channels::most); }

constexpr std::string_view part_names[] { "t", "x", "y", "z", "rx", "ry", "rz", "pressure" };

bool isAxis (std::string_view column)
{
    return graph::isId (column) && std::ranges::find (part_names, column) == std::end (part_names) && ! column.starts_with ("button")
           && ! column.starts_with ("signal");
}

double* partOf (TraceData::Row& row, std::string_view column)
{
    const std::pair<std::string_view, double*> parts[] {
        { "t", &row.t },
        { "x", &row.position.x() },
        { "y", &row.position.y() },
        { "z", &row.position.z() },
        { "rx", &row.rotation.x() },
        { "ry", &row.rotation.y() },
        { "rz", &row.rotation.z() },
        { "pressure", &row.pressure },
    };
    for (const auto& [name, part] : parts)
        if (name == column) return part;
    return nullptr;
}

std::string rowName (std::size_t index) { return "row " + std::to_string (index + 1); }
std::string seconds (double t) { return numberText (t) + " s"; }

Messages checkColumns (std::span<const std::string> columns, std::size_t values)
{
    Messages messages;
    const auto add = [&] (const char* id, const char* where, std::string text,
                          std::string remedy) -> Message& { return messages.emplace_back (Message::error (id, where, std::move (text), std::move (remedy))); };
    const auto first = [&] (const auto& name) { return std::find (columns.begin(), columns.end(), name); };

    TraceData::Row row;
    int axes = 0;
    for (auto it = columns.begin(); it != columns.end(); ++it)
    {
        if (first (*it) != it)
            add ("trace/duplicate_column", "header", "the column " + quote (*it) + " appears twice", "remove one of them");
        else if (isAxis (*it) && ++axes <= Channels::most)
        {
            if (const auto meant = closestMatch (*it, part_names); it->size() > 2 && ! meant.empty())
                add ("trace/like_column", "header", "the column " + quote (*it) + " is read as an axis of this name; did you mean " + quote (meant) + "?",
                     "write " + quote (meant) + ", or give the axis a less similar name")
                    .severity = Message::Severity::warning;
        }
        else if (partOf (row, *it) == nullptr && ! buttonOf (*it) && ! signalOf (*it))
            add ("trace/unknown_column", "header", "the column " + quote (*it) + " is not part of a trace and is ignored",
                 "a trace has t,x,y,z and may have rx,ry,rz,pressure,button0 to button31, signal1 to signal32 and up to 32 axes by name "
                 "(lower case letters, digits and _)")
                .severity = Message::Severity::warning;
    }

    for (const char* needed : { "t", "x", "y", "z" })
        if (first (needed) == columns.end())
            add ("trace/missing_column", "header", "a trace needs a column " + quote (needed),
                 "give the columns t (in s) and x, y, z (in m), with these names in the first line");

    if (columns.empty() || values == 0)
        add ("trace/empty", "row 1", "the trace has no rows", "write at least one row of numbers below the header");
    else if (values % columns.size() != 0)
        add ("trace/ragged", "last row", "the last row is not complete", "give each row as many values as there are columns");

    return messages;
}

/// The first problem with the times, if any: one wrong time usually makes all later ones wrong.
Messages checkTimes (const std::vector<TraceData::Row>& rows)
{
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (! isFinite (rows[i].t))
            return { Message::error ("trace/bad_time", rowName (i), "the time of " + rowName (i) + " is not a finite number",
                                     "give every row a time; only the other columns may be nan") };

    for (std::size_t i = 1; i < rows.size(); ++i)
        if (rows[i].t <= rows[i - 1].t)
            return { Message::error ("trace/time_order", rowName (i),
                                     "the time does not increase: " + seconds (rows[i].t) + " in " + rowName (i) + " after " + seconds (rows[i - 1].t),
                                     "sort the rows by t, and keep only one row for each time") };

    return {};
}
}   // namespace

double TraceData::step() const
{
    if (rows.size() < 2) return 0.0;

    std::vector<double> steps;
    for (std::size_t i = 1; i < rows.size(); ++i)
        steps.push_back (rows[i].t - rows[i - 1].t);

    const auto middle = steps.begin() + static_cast<std::ptrdiff_t> (steps.size() / 2);
    std::nth_element (steps.begin(), middle, steps.end());
    return *middle;
}

double TraceData::duration() const { return rows.empty() ? 0.0 : rows.back().t + step(); }

namespace
{
/// Finds the columns of the axes, followed by those of the signals in the order of their numbers. A signal number without a
/// column has an empty entry.
std::vector<std::optional<std::size_t>> findFurther (std::span<const std::string> columns, TraceData& trace)
{
    std::vector<std::optional<std::size_t>> axes, signals;
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (const auto button = buttonOf (columns[c]))
            trace.buttons = std::max (trace.buttons, *button + 1);
        else if (const auto channel = signalOf (columns[c]))
        {
            trace.signals = std::max (trace.signals, *channel);
            signals.resize (static_cast<std::size_t> (trace.signals));
            signals[static_cast<std::size_t> (*channel - 1)] = c;
        }
        else if (isAxis (columns[c]) && axes.size() < static_cast<std::size_t> (Channels::most))
        {
            trace.axes.push_back (columns[c]);
            axes.emplace_back (c);
        }
    axes.insert (axes.end(), signals.begin(), signals.end());
    return axes;
}
}   // namespace

TraceResult readTrace (std::span<const std::string> columns, std::span<const double> values)
{
    TraceResult result { .trace = {}, .messages = checkColumns (columns, values.size()) };
    if (hasErrors (result.messages)) return result;

    const auto width = columns.size();
    result.trace.rows.resize (values.size() / width);
    const auto further = findFurther (columns, result.trace);

    for (std::size_t i = 0; i < result.trace.rows.size(); ++i)
    {
        auto& row = result.trace.rows[i];
        for (const auto c : further)
            result.trace.more.push_back (c ? values[i * width + *c] : 0.0);
        for (std::size_t c = 0; c < width; ++c)
        {
            const double value = values[i * width + c];
            if (double* part = partOf (row, columns[c]))
                *part = value;
            else if (const auto button = buttonOf (columns[c]); button && value >= 0.5)
                row.buttons |= std::uint32_t { 1 } << *button;
        }
    }

    auto wrong = checkTimes (result.trace.rows);
    result.messages.insert (result.messages.end(), wrong.begin(), wrong.end());
    if (! wrong.empty()) return result;

    const double start = result.trace.rows.front().t;
    for (auto& row : result.trace.rows)
        row.t -= start;
    return result;
}

TraceDevice::TraceDevice (std::shared_ptr<const TraceData> data) : trace (std::move (data)), lasts (trace->duration()) {}

void TraceDevice::prepare (double dt_s)
{
    dt = dt_s;
    tick = 0;
    row = 0;
}

Reading TraceDevice::read() noexcept
{
    const auto& rows = trace->rows;
    if (rows.empty()) return { .valid = false };

    const double now = static_cast<double> (tick) * dt;
    while (row + 1 < rows.size() && rows[row + 1].t <= now + slack * dt)
        ++row;

    const auto& held = rows[row];
    Reading reading;
    reading.position = held.position;
    reading.rotation = held.rotation;
    reading.pressure = held.pressure;
    reading.buttons = held.buttons;
    const auto axes = trace->axes.size(), signals = static_cast<std::size_t> (trace->signals);
    const double* more = trace->more.data() + row * (axes + signals);
    for (std::size_t i = 0; i < axes; ++i)
        reading.axes.set (static_cast<int> (i), more[i]);
    for (std::size_t i = 0; i < signals; ++i)
        reading.signals.set (static_cast<int> (i), more[axes + i]);
    reading.age = std::max (0.0, now - held.t);
    reading.valid = isFinite (held.position, held.rotation);
    return reading;
}

void TraceDevice::write (const Effort&) noexcept { ++tick; }

DeviceLayout TraceDevice::layout() const
{
    return { .axes = trace->axes, .buttons = std::vector<std::string> (static_cast<std::size_t> (trace->buttons)), .signal_inputs = trace->signals };
}

bool TraceDevice::serialize (StateArchive& archive)
{
    archive (tick);
    archive.index (row, trace->rows.size());
    if (tick < 0) archive.refuse ("has a device that has not begun");
    return true;
}

}   // namespace tactus
