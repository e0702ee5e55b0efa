// SPDX-License-Identifier: MIT
#include "gauge.hpp"

#include <tactus/plan/plan.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace tactus::python
{

namespace
{
constexpr double never = std::numeric_limits<double>::quiet_NaN();

/// The columns of a port: itself, or its three components.
std::vector<std::size_t> columnsOf (const std::string& port, std::span<const std::string> names)
{
    std::vector<std::size_t> found;
    for (const auto* end : { "", ".x", ".y", ".z" })
        if (const auto at = std::ranges::find (names, port + end); at != names.end()) found.push_back (static_cast<std::size_t> (at - names.begin()));
    if (found.empty()) throw std::invalid_argument ("no column of the run belongs to '" + port + "'");
    return found;
}

bool isOfScalar (Gauge::Kind kind) { return kind != Gauge::Kind::peak && kind != Gauge::Kind::rms && kind != Gauge::Kind::work && kind != Gauge::Kind::given; }
bool isWork (Gauge::Kind kind) { return kind == Gauge::Kind::work || kind == Gauge::Kind::given; }
}   // namespace

Gauge::Gauge (Options o, std::span<const std::string> names)
    : options (std::move (o)), columns (columnsOf (options.port, names)), value (isWork (options.kind) ? 0.0 : never)
{
    if (isOfScalar (options.kind) && columns.size() != 1)
        throw std::invalid_argument ("'" + options.port + "' is a vector; name a component, such as " + options.port + ".z");
    if (! isWork (options.kind)) return;
    places = columnsOf (options.position, names);
    if (places.size() != columns.size()) throw std::invalid_argument ("'" + options.port + "' and '" + options.position + "' have different shapes");
    force_before.resize (columns.size());
    position_before.resize (columns.size());
}

double Gauge::magnitude (std::span<const Tap> taps) const noexcept
{
    double sum = 0.0;
    for (const auto c : columns)
        sum += *taps[c].value * *taps[c].value;
    return std::sqrt (sum);
}

void Gauge::add (std::span<const Tap> taps, double dt_s) noexcept
{
    const double now = *taps[columns.front()].value;
    const bool is_first = ticks++ == 0;
    switch (options.kind)
    {
    case Kind::peak:
        value = is_first ? magnitude (taps) : std::max (value, magnitude (taps));
        break;
    case Kind::largest:
        value = is_first ? now : std::max (value, now);
        break;
    case Kind::least:
        value = is_first ? now : std::min (value, now);
        break;
    case Kind::last:
        value = now;
        break;
    case Kind::mean:
        value = is_first ? now : value + now;
        break;
    case Kind::rms:
    {
        const double m = magnitude (taps);
        value = is_first ? m * m : value + m * m;
        break;
    }
    case Kind::misfit:
    {
        const double off = ticks <= options.reference.size() ? now - options.reference[ticks - 1] : never;
        value = is_first ? off * off : value + off * off;
        break;
    }
    case Kind::work:
    case Kind::given:
        for (std::size_t i = 0; i < columns.size(); ++i)
        {
            const double place = *taps[places[i]].value;
            if (! is_first) value += force_before[i] * (place - position_before[i]);
            force_before[i] = *taps[columns[i]].value;
            position_before[i] = place;
        }
        most = std::max (most, value);
        break;
    case Kind::reach:
    {
        if (! std::isnan (value)) break;
        const double t = static_cast<double> (ticks - 1) * dt_s;
        const bool is_past = options.is_above ? now >= options.level : now <= options.level;
        if (! is_past)
            since_s = -1.0;
        else if (since_s < 0.0)
            since_s = t;
        if (is_past && t - since_s >= options.hold_s - 1e-9) value = since_s;
        break;
    }
    }
}

double Gauge::result() const noexcept
{
    const auto n = static_cast<double> (ticks);
    if (ticks == 0) return never;
    switch (options.kind)
    {
    case Kind::mean:
        return value / n;
    case Kind::rms:
    case Kind::misfit:
        return std::sqrt (value / n);
    case Kind::given:
        return std::isnan (value) ? never : most;
    default:
        return value;
    }
}

}   // namespace tactus::python
