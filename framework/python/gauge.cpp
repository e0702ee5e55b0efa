// SPDX-License-Identifier: MIT
#include "gauge.hpp"

#include <tactus/plan/plan.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

namespace tactus::python
{

namespace
{
constexpr double never = std::numeric_limits<double>::quiet_NaN();

double larger (double a, double b) { return std::isnan (b) || b > a ? b : a; }
double smaller (double a, double b) { return std::isnan (b) || b < a ? b : a; }
double sum (double a, double b) { return a + b; }
double first (double a, double b) { return std::isnan (a) ? b : a; }
double last (double, double b) { return b; }

double itself (double value, double) { return value; }
double root (double value, double) { return std::sqrt (value); }
double mean (double value, double ticks) { return value / ticks; }
double rootOfMean (double value, double ticks) { return std::sqrt (value / ticks); }

/// The columns of a port: itself, or its three components.
std::vector<std::size_t> columnsOf (const std::string& port, std::span<const std::string> names)
{
    std::vector<std::size_t> found;
    for (const auto* end : { "", ".x", ".y", ".z" })
        if (const auto at = std::ranges::find (names, port + end); at != names.end()) found.push_back (static_cast<std::size_t> (at - names.begin()));
    if (found.empty()) throw std::invalid_argument ("no column of the run belongs to '" + port + "'");
    return found;
}
}   // namespace

struct Gauge::Kind
{
    enum Of
    {
        square,   // of the magnitude of the port
        scalar,
        square_of_misfit,   // of a scalar from a column of a recording
        work,               // so far, of a force on a position; a force is held until the next tick
        time                // since when a scalar has passed the level for long enough; not a number if it has not
    } of;

    double (*joined) (double, double);         // with the ticks before
    double (*result) (double, double ticks);   // of the run
};

namespace
{
const std::map<std::string, Gauge::Kind> kinds {
    { "peak", { Gauge::Kind::square, larger, root } },
    { "rms", { Gauge::Kind::square, sum, rootOfMean } },
    { "max", { Gauge::Kind::scalar, larger, itself } },
    { "min", { Gauge::Kind::scalar, smaller, itself } },
    { "mean", { Gauge::Kind::scalar, sum, mean } },
    { "last", { Gauge::Kind::scalar, last, itself } },
    { "work", { Gauge::Kind::work, last, itself } },
    { "given", { Gauge::Kind::work, larger, itself } },
    { "misfit", { Gauge::Kind::square_of_misfit, sum, rootOfMean } },
    { "reach", { Gauge::Kind::time, first, itself } },
};
}   // namespace

Gauge::Gauge (Options o, std::span<const std::string> names) : options (std::move (o)), kind (&kinds.at (options.kind)), columns (columnsOf (options.port, names))
{
    if (kind->of == Kind::work)
        places = columnsOf (options.position, names);
    else if (kind->of != Kind::square && columns.size() != 1)
        throw std::invalid_argument ("'" + options.port + "' is a vector; name a component, such as " + options.port + ".z");
    if (kind->of == Kind::work && places.size() != columns.size())
        throw std::invalid_argument ("'" + options.port + "' and '" + options.position + "' have different shapes");
    force_before.resize (places.size());
    position_before.resize (places.size());
}

double Gauge::work (std::span<const Tap> taps) noexcept
{
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
        const double place = *taps[places[i]].value;
        if (ticks > 0) work_so_far += force_before[i] * (place - position_before[i]);
        force_before[i] = *taps[columns[i]].value;
        position_before[i] = place;
    }
    return work_so_far;
}

double Gauge::reached (double now, double dt_s) noexcept
{
    const double t = static_cast<double> (ticks) * dt_s;
    if (! (options.is_above ? now >= options.level : now <= options.level))
        since_s = -1.0;
    else if (since_s < 0.0)
        since_s = t;
    return since_s >= 0.0 && t - since_s >= options.hold_s - 1e-9 ? since_s : never;
}

void Gauge::add (std::span<const Tap> taps, double dt_s) noexcept
{
    double now = *taps[columns.front()].value;
    switch (kind->of)
    {
    case Kind::square:
        now = 0.0;
        for (const auto c : columns)
            now += *taps[c].value * *taps[c].value;
        break;
    case Kind::square_of_misfit:
        now -= ticks < options.reference.size() ? options.reference[ticks] : never;
        now *= now;
        break;
    case Kind::work:
        now = work (taps);
        break;
    case Kind::time:
        now = reached (now, dt_s);
        break;
    case Kind::scalar:
        break;
    }
    value = ticks++ == 0 ? now : kind->joined (value, now);
}

double Gauge::result() const noexcept { return ticks == 0 ? never : kind->result (value, static_cast<double> (ticks)); }

}   // namespace tactus::python
