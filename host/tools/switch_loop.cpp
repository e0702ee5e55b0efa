// SPDX-License-Identifier: MIT
#include "switch_loop.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/kit/law.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

namespace tactus::host
{
namespace
{
constexpr double gram_force = 9.80665e-3;   // N

struct Column
{
    std::size_t index;
    double factor;   // converts to SI
};

Result<Column> findColumn (const Table& table, const std::string& file, const std::string& prefix, const Unit& unit, const std::string& example)
{
    for (std::size_t i = 0; i < table.columns.size(); ++i)
    {
        if (! table.columns[i].starts_with (prefix)) continue;

        const auto symbol = table.columns[i].substr (prefix.size());
        if (symbol == "gf" && unit == unit::newton) return Column { i, gram_force };

        const auto measure = parseMeasure ("1 " + symbol);
        if (! measure || measure->dimension != unit.dimension)
            return Message::error ("switch/unknown_unit", file, quote (table.columns[i]) + " does not end in a unit of " + std::string (name (unit.quantity)),
                                   "name the column " + example);
        return Column { i, measure->value };
    }
    return Message::error ("switch/missing_column", file, "there is no column " + prefix + "…", "name the column " + example);
}

/// Sorts readings into a curve; averages readings at the same position.
class Readings
{
public:
    void add (double x, double force)
    {
        auto& [sum, count] = places[x];
        sum += force;
        ++count;
    }

    Curve curve() const
    {
        Curve c;
        for (const auto& [x, readings] : places)
        {
            c.x.push_back (x);
            c.y.push_back (std::max (0.0, readings.first / readings.second));
        }
        return c;
    }

private:
    std::map<double, std::pair<double, int>> places;
};

double rounded (double value, double steps_per_unit) { return std::round (value * steps_per_unit) / steps_per_unit; }

/// The point between two others that deviates most from the straight lines between them; `from` if no deviation exceeds the
/// tolerance.
std::size_t worstBetween (const SwitchLoop& loop, std::size_t from, std::size_t to, double tolerance)
{
    double most = tolerance;
    std::size_t worst = from;
    for (std::size_t i = from + 1; i < to; ++i)
    {
        const double part = (loop.travel[i] - loop.travel[from]) / (loop.travel[to] - loop.travel[from]);
        const double off = std::max (std::abs (loop.press[i] - std::lerp (loop.press[from], loop.press[to], part)),
                                     std::abs (loop.release[i] - std::lerp (loop.release[from], loop.release[to], part)));
        if (off <= most) continue;
        most = off;
        worst = i;
    }
    return worst;
}

/// The law of the plane. An additional point beyond the loop sets the slope with which the law continues.
Curve meanOf (const SwitchLoop& loop)
{
    Curve mean;
    for (std::size_t i = 0; i < loop.travel.size(); ++i)
    {
        mean.x.push_back (loop.travel[i]);
        mean.y.push_back (rounded (0.5 * (loop.press[i] + loop.release[i]), 1e4));
    }
    const double beyond = 1e-4, steepest = Law { .kind = Law::Kind::table, .table = mean }.steepest();
    mean.y.push_back (rounded (mean.y.back() + beyond * steepest, 1e4));
    mean.x.push_back (rounded (mean.x.back() + beyond, 1e7));
    return mean;
}

Curve boundOf (const SwitchLoop& loop)
{
    Curve bound;
    for (std::size_t i = 0; i < loop.travel.size(); ++i)
    {
        bound.x.push_back (loop.travel[i]);
        bound.y.push_back (rounded (0.5 * (loop.press[i] - loop.release[i]), 1e4));
    }
    return bound;
}

Json asJson (const Curve& curve) { return { curve.x, curve.y }; }
}   // namespace

Result<SwitchLoop> switchFrom (const Table& table, const std::string& file, double backlash)
{
    const auto x = findColumn (table, file, "x_", unit::metre, "x_um or x_mm");
    if (! x) return x.error();
    const auto force = findColumn (table, file, "force_", unit::newton, "force_gf or force_mN");
    if (! force) return force.error();

    std::vector<double> travel;
    for (std::size_t r = 0; r < table.rows(); ++r)
    {
        travel.push_back (x->factor * table.at (r, x->index));
        if (! std::isfinite (travel.back()) || ! std::isfinite (table.at (r, force->index)))
            return Message::error ("switch/not_finite", file, "row " + std::to_string (r + 1) + " is not finite", "leave out rows without a measurement");
    }
    const auto one_way =
        Message::error ("switch/one_way", file, "the recording does not contain both a press and a release", "record down to the stop and back up");
    if (travel.empty()) return one_way;

    const double top = travel.front(), bottom = *std::ranges::max_element (travel);
    const auto first = std::ranges::find (travel, bottom) - travel.begin();
    const auto last = std::find (travel.rbegin(), travel.rend(), bottom).base() - travel.begin() - 1;
    Readings down, up;
    for (std::size_t r = 0; r < table.rows(); ++r)
    {
        const double f = force->factor * table.at (r, force->index);
        if (static_cast<std::ptrdiff_t> (r) <= first) down.add (travel[r] - top, f);
        if (static_cast<std::ptrdiff_t> (r) >= last) up.add (travel[r] - top + backlash, f);
    }

    const auto pressed = down.curve(), released = up.curve();
    if (pressed.x.size() < 2 || released.x.size() < 2) return one_way;
    const double most = *std::ranges::max_element (pressed.y), start = pressed.y.front(), end = released.y.front();
    if (std::max (start, end) > 0.05 * most)
        return Message::error ("switch/not_released", file,
                               "at the top the force is " + numberText (start) + " N before and " + numberText (end) + " N after the stroke, not 0",
                               "start above the key, and end after it is released");

    std::set<double> places { 0.0 };
    for (const auto* way : { &pressed, &released })
        for (const double place : way->x)
            if (place > 0.0 && place <= pressed.x.back()) places.insert (place);
    SwitchLoop loop;
    for (const double place : places)
    {
        loop.travel.push_back (place);
        loop.press.push_back (place == 0.0 ? 0.0 : pressed (place));
        loop.release.push_back (place == 0.0 ? 0.0 : released (place));
    }
    if (loss (loop) < 0.0)
        return Message::error ("switch/no_loss", file, "the key returns more energy than it takes", "record the press first, then the release");
    return loop;
}

double loss (const SwitchLoop& loop)
{
    double area = 0.0;
    for (std::size_t i = 1; i < loop.travel.size(); ++i)
        area += 0.5 * (loop.press[i] - loop.release[i] + loop.press[i - 1] - loop.release[i - 1]) * (loop.travel[i] - loop.travel[i - 1]);
    return area;
}

SwitchLoop withoutGain (SwitchLoop loop)
{
    for (std::size_t i = 0; i < loop.travel.size(); ++i)
        if (loop.release[i] > loop.press[i]) loop.press[i] = loop.release[i] = 0.5 * (loop.press[i] + loop.release[i]);
    return loop;
}

SwitchLoop simplified (const SwitchLoop& loop, double tolerance)
{
    std::vector<bool> kept (loop.travel.size());
    kept.front() = kept.back() = true;
    std::vector<std::pair<std::size_t, std::size_t>> open { { 0, loop.travel.size() - 1 } };
    while (! open.empty())
    {
        const auto [from, to] = open.back();
        open.pop_back();
        const auto worst = worstBetween (loop, from, to, tolerance);
        if (worst == from) continue;
        kept[worst] = true;
        open.push_back ({ from, worst });
        open.push_back ({ worst, to });
    }

    SwitchLoop few;
    for (std::size_t i = 0; i < kept.size(); ++i)
    {
        const double travel = rounded (loop.travel[i], 1e7);
        if (! kept[i] || (! few.travel.empty() && travel <= few.travel.back())) continue;
        few.travel.push_back (travel);
        few.press.push_back (rounded (loop.press[i], 5e3));
        few.release.push_back (rounded (loop.release[i], 5e3));
    }
    return few;
}

graph::Graph keyFrom (const SwitchLoop& loop, const std::string& name, double stiffness)
{
    const Json key = {
        { "format", "tactus-graph" },
        { "version", 2 },
        { "name", name },
        { "about", "A measured key. A stroke down and up loses " + numberText (rounded (1e3 * loss (loop), 1e4)) + " mJ." },
        { "tags", { "key", "press", "measured" } },
        { "rate_hz", 4000 },
        { "devices",
          { { "finger",
              { { "driver", "sim" },
                { "mass", "50 g" },
                { "damping", "3 N*s/m" },
                { "hand", { { "stiffness", "800 N/m" }, { "damping", "6 N*s/m" }, { "path", "press" }, { "scale", 1.3 } } },
                { "guard", { { "max_force", "6 N" } } } } } } },
        { "nodes",
          { { "hand", { { "type", "device.position" }, { "role", "finger" } } },
            { "key", { { "type", "deform.plane" }, { "settings", { { "law", { { "table", asJson (meanOf (loop)) } } } } } } },
            { "bound", { { "type", "signal.map" }, { "settings", { { "curve", asJson (boundOf (loop)) } } } } },
            { "rub", { { "type", "friction.elasto_plastic" }, { "params", { { "mu", 1 }, { "stiffness", stiffness } } } } },
            { "motor", { { "type", "device.force" }, { "role", "finger" } } } } },
        { "wires",
          { "hand.position -> key.position",
            "key.depth -> bound.in",
            "key.depth -> rub.position.x",
            "bound.out -> rub.normal_force",
            "key.force -> motor.force",
            { { "wire", "rub.force.x -> motor.force.z" }, { "gain", -1 } } } },
    };
    return readGraph (key.dump()).graph;
}

}   // namespace tactus::host
