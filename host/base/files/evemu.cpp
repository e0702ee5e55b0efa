// SPDX-License-Identifier: MIT
#include "evemu.hpp"

#include <tactus/text/quote.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{
namespace
{
// linux/input-event-codes.h
constexpr int ev_syn = 0, ev_key = 1, ev_abs = 3;
constexpr int syn_report = 0;
constexpr int abs_x = 0x00, abs_y = 0x01, abs_pressure = 0x18;
constexpr int first_tool = 0x140, last_tool = 0x147, btn_touch = 0x14a;

struct Event
{
    std::int64_t us = 0;
    int type = 0, code = 0;
    std::int64_t value = 0;
};

/// An axis as described in the header.
struct Axis
{
    int code = 0;
    double maximum = 0.0, resolution = 0.0;   // in units, and in units/mm
};

/// One report of the tablet.
struct Report
{
    double t = 0.0;            // time since the first report, in s
    double x = 0.0, y = 0.0;   // units
    double pressure = 0.0;     // in units; 0 while the tip does not touch
    bool touches = false;
    bool seen = true;   // true while the pen is in range
};

struct Recording
{
    std::vector<Report> reports;
    double units_per_mm = 0.0;
    double most_pressure = 0.0;   // the maximum according to the header, in units
};

/// Splits a line into words.
struct Tokenizer
{
    std::string_view rest;

    std::string_view next()
    {
        rest.remove_prefix (std::min (rest.find_first_not_of (" \t\r"), rest.size()));
        const auto word = rest.substr (0, rest.find_first_of (" \t\r"));
        rest.remove_prefix (word.size());
        return word;
    }
};

template <typename T>
bool readWhole (std::string_view word, T& value, int base = 10)
{
    const auto [end, failure] = std::from_chars (word.data(), word.data() + word.size(), value, base);
    return failure == std::errc() && end == word.data() + word.size();
}

/// Parses a time such as "1364787581.497486" into microseconds; the point and six digits are always present.
std::optional<std::int64_t> microseconds (std::string_view word)
{
    constexpr std::int64_t longest = 1'000'000'000'000;   // in s; about thirty thousand years

    const auto point = word.find ('.');
    std::int64_t s = 0, us = 0;
    if (point == word.npos || word.size() != point + 7) return {};
    if (! readWhole (word.substr (0, point), s) || ! readWhole (word.substr (point + 1), us) || s < 0 || s > longest || us < 0) return {};
    return s * 1'000'000 + us;
}

std::optional<Event> readEvent (Tokenizer words)
{
    Event event;
    const auto us = microseconds (words.next());
    if (! us || ! readWhole (words.next(), event.type, 16) || ! readWhole (words.next(), event.code, 16) || ! readWhole (words.next(), event.value)
        || ! words.next().empty())
        return {};
    event.us = *us;
    return event;
}

/// Parses "18 0 2047 0 0 0": code, minimum, maximum, fuzz, flat and, in newer versions, the resolution.
std::optional<Axis> readAxis (Tokenizer words)
{
    Axis axis;
    std::int64_t minimum = 0, maximum = 0, fuzz = 0, flat = 0, resolution = 0;
    if (! readWhole (words.next(), axis.code, 16) || ! readWhole (words.next(), minimum) || ! readWhole (words.next(), maximum)
        || ! readWhole (words.next(), fuzz) || ! readWhole (words.next(), flat))
        return {};
    if (const auto word = words.next(); ! word.empty() && ! readWhole (word, resolution)) return {};
    axis.maximum = static_cast<double> (maximum);
    axis.resolution = static_cast<double> (resolution);
    return axis;
}

/// Tracks the state of the tablet from event to event.
class Tablet
{
public:
    void take (const Event& event)
    {
        const auto value = static_cast<double> (event.value);
        if (event.type == ev_abs && event.code == abs_x) x = value;
        if (event.type == ev_abs && event.code == abs_y) y = value;
        if (event.type == ev_abs && event.code == abs_pressure) pressure = value;
        if (event.type == ev_key && event.code == btn_touch) touch = event.value != 0;
        if (event.type == ev_key && event.code >= first_tool && event.code <= last_tool)
        {
            const unsigned bit = 1u << (event.code - first_tool);
            tools = event.value != 0 ? tools.value_or (0u) | bit : tools.value_or (0u) & ~bit;
        }
    }

    /// Empty until the position of the pen is known.
    std::optional<Report> report (double t) const
    {
        if (! x || ! y) return {};
        const bool touches = touch.value_or (pressure > 0.0);

        // Without tool events, the only sign that the pen has left is a jump to the corner.
        const bool seen = tools ? *tools != 0u : touches || *x != 0.0 || *y != 0.0;
        return Report { .t = t, .x = *x, .y = *y, .pressure = touches && seen ? pressure : 0.0, .touches = touches && seen, .seen = seen };
    }

private:
    std::optional<double> x, y;
    double pressure = 0.0;
    std::optional<bool> touch;
    std::optional<unsigned> tools;   // one bit each: pen, rubber, …
};

Result<Recording> readRecording (std::string_view text)
{
    Recording recording;
    Tablet tablet;
    std::optional<std::int64_t> start, last;

    for (int line_number = 1; ! text.empty(); ++line_number)
    {
        const auto line = text.substr (0, text.find ('\n'));
        text.remove_prefix (std::min (line.size() + 1, text.size()));

        const auto refuse = [&] (const char* id, const std::string& what, const char* remedy) {
            return Message::error (id, "line " + std::to_string (line_number), what + ": " + quote (line), remedy);
        };

        Tokenizer words { line.substr (0, line.find ('#')) };
        const auto kind = words.next();
        if (kind.empty() || kind == "N:" || kind == "I:" || kind == "P:" || kind == "B:" || kind == "L:" || kind == "S:") continue;

        if (kind == "A:")
        {
            const auto axis = readAxis (words);
            if (! axis) return refuse ("evemu/bad_line", "not an axis", "an axis is A: code minimum maximum fuzz flat resolution, the code in hex");
            if (axis->code == abs_x) recording.units_per_mm = axis->resolution;
            if (axis->code == abs_pressure) recording.most_pressure = axis->maximum;
            continue;
        }

        const auto event = kind == "E:" ? readEvent (words) : std::nullopt;
        if (! event) return refuse ("evemu/bad_line", "not an event", "an event is E: seconds.microseconds type code value, type and code in hex");
        if (last && event->us < *last) return refuse ("evemu/time_order", "earlier than the previous line", "keep the events in the recorded order");

        last = event->us;
        tablet.take (*event);
        if (event->type != ev_syn || event->code != syn_report) continue;

        const auto report = tablet.report (1e-6 * static_cast<double> (event->us - start.value_or (event->us)));
        if (! report || (recording.reports.empty() && ! report->seen)) continue;
        if (! start) start = event->us;

        if (! recording.reports.empty() && recording.reports.back().t == report->t)
            recording.reports.back() = *report;
        else
            recording.reports.push_back (*report);
    }

    if (! recording.reports.empty()) return recording;
    return Message::error ("evemu/no_motion", "end", "the recording contains no pen position", "record a tablet that reports ABS_X and ABS_Y");
}

/// While the pen is out of range, its position stays where it was last seen.
void holdUnseen (std::vector<Report>& reports)
{
    for (std::size_t i = 1; i < reports.size(); ++i)
        if (! reports[i].seen)
        {
            reports[i].x = reports[i - 1].x;
            reports[i].y = reports[i - 1].y;
        }
}

double leastJerk (double u) { return u * u * u * (10.0 + u * (6.0 * u - 15.0)); }

/// Makes evenly spaced rows. At this stage z jumps between pen down and pen up.
TraceData evenRows (const Recording& recording, const EvemuOptions& options)
{
    const auto& reports = recording.reports;
    const auto [left, right] = std::ranges::minmax (reports, {}, &Report::x);
    const auto [far, near] = std::ranges::minmax (reports, {}, &Report::y);
    const double x_middle = 0.5 * (left.x + right.x), y_middle = 0.5 * (far.y + near.y);

    constexpr double wacom = 5e-6;   // m
    const double said = recording.units_per_mm > 0.0 ? 1e-3 / recording.units_per_mm : wacom;
    const double pitch = options.pitch > 0.0 ? options.pitch : said;

    const double most = std::ranges::max (reports, {}, &Report::pressure).pressure;
    const double usual = recording.most_pressure > 0.0 ? recording.most_pressure : std::max (2047.0, most);
    const double full = options.full_pressure > 0.0 ? options.full_pressure : usual;

    // Adds enough time after the last report to lift the pen.
    const auto count = static_cast<std::size_t> (std::floor ((reports.back().t + options.landing) * options.rate_hz + 1e-6)) + 1;
    TraceData trace;
    trace.rows.resize (count);
    std::size_t i = 0;
    for (std::size_t k = 0; k < count; ++k)
    {
        const double t = static_cast<double> (k) / options.rate_hz;
        while (i + 1 < reports.size() && reports[i + 1].t <= t)
            ++i;

        const auto& a = reports[i];
        const auto& b = reports[std::min (i + 1, reports.size() - 1)];
        const double way = b.t > a.t ? (t - a.t) / (b.t - a.t) : 0.0;
        const double u = a.seen ? way : leastJerk (way);

        const double next_pressure = b.touches ? b.pressure : a.pressure;
        const double share = a.touches ? std::min (1.0, std::lerp (a.pressure, next_pressure, way) / full) : 0.0;
        auto& row = trace.rows[k];
        row.t = t;
        row.position = { pitch * (std::lerp (a.x, b.x, u) - x_middle), -pitch * (std::lerp (a.y, b.y, u) - y_middle),
                         a.touches ? -options.full_depth * share : options.lift };
        row.pressure = options.full_force * share;
    }
    return trace;
}

/// Smooths z by a centred raised cosine, so that a landing has a finite speed and no delay.
void smoothLandings (TraceData& trace, const EvemuOptions& options)
{
    const auto reach = static_cast<int> (0.5 * options.landing * options.rate_hz);
    if (reach < 1) return;

    std::vector<double> weights, z;
    for (int j = -reach; j <= reach; ++j)
        weights.push_back (1.0 + std::cos (std::numbers::pi * j / (reach + 1)));
    for (const auto& row : trace.rows)
        z.push_back (row.position.z());

    const int last = static_cast<int> (z.size()) - 1;
    for (int k = 0; k <= last; ++k)
    {
        double sum = 0.0, total = 0.0;
        for (int j = -reach; j <= reach; ++j)
        {
            const double weight = weights[static_cast<std::size_t> (j + reach)];
            sum += weight * z[static_cast<std::size_t> (std::clamp (k + j, 0, last))];
            total += weight;
        }
        trace.rows[static_cast<std::size_t> (k)].position.z() = sum / total;
    }
}
}   // namespace

Result<TraceData> readEvemu (std::string_view text, const EvemuOptions& options)
{
    constexpr double most_rows = 1e7;   // a few hours at 1 kHz; if the clock was changed, a recording can seem to last for years
    auto recording = readRecording (text);
    if (! recording) return recording.error();
    const double lasts = recording->reports.back().t;
    if (lasts * options.rate_hz > most_rows)
        return Message::error ("evemu/too_long", "end", "the recording is too long: it lasts " + std::to_string (std::llround (lasts)) + " s",
                               "cut out the part you need, or use a lower rate");

    holdUnseen (recording->reports);
    auto trace = evenRows (*recording, options);
    smoothLandings (trace, options);
    return trace;
}

}   // namespace tactus::host
