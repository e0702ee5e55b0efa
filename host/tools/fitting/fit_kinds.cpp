// SPDX-License-Identifier: MIT
#include "fitting.hpp"
#include "pressing.hpp"

#include <algorithm>
#include <numeric>
#include <set>

namespace tactus::host
{

namespace
{
FitColumn column (const char* role, const char* unit, bool required, std::vector<std::string> names, const char* about)
{
    names.insert (names.begin(), role);
    return { role, unit, required, std::move (names), about };
}

FitColumn positive (FitColumn column)
{
    column.is_positive = true;
    return column;
}

/// Depth and force of a tool that is pressed on.
std::vector<FitColumn> pressed (std::vector<std::string> depth_names, const char* depth_about, const char* force_about)
{
    depth_names.insert (depth_names.begin(), { "indentation", "z", "height", "h", "extension", "compression", "deflection", "distance" });
    return { positive (column ("depth", "m", true, std::move (depth_names), depth_about)),
             positive (column ("force", "N", true, { "resistance", "fz", "fn", "f", "load", "normal_force" }, force_about)) };
}

std::vector<FitColumn> impact()
{
    auto columns = pressed ({ "displacement" }, "depth", "force out of the object");
    columns.push_back (column ("t", "s", false, { "time" }, "time"));
    return columns;
}

const std::vector<std::string> along { "x", "displacement", "travel", "position" };

std::vector<double> valuesOf (const Table& table, const FitColumn& wanted)
{
    auto values = columnOf (table, {}, wanted);
    return values ? *values : std::vector<double> {};
}

bool has (const Table& table, FitKind kind, const std::string& role)
{
    const auto& columns = infoOf (kind).columns;
    const auto found = std::ranges::find (columns, role, &FitColumn::role);
    return found != columns.end() && findColumn (table, *found);
}

/// Counts how many times a signal turns back by more than a fifth of its range.
int turns (const std::vector<double>& v)
{
    const auto [low, high] = std::ranges::minmax (v);
    double least = v[0], most = v[0];
    int count = 0, way = 0;
    for (const double now : v)
    {
        least = std::min (least, now);
        most = std::max (most, now);
        const bool falls = most - now > 0.2 * (high - low), rises = now - least > 0.2 * (high - low);
        if (! falls && ! rises) continue;
        const int next = falls ? -1 : 1;
        if (way != 0 && next != way) ++count;
        way = next;
        least = most = now;
    }
    return count;
}

/// True if a column says whether the contact of a key is closed.
bool saysClosed (const Table& table)
{
    static const std::set<std::string> names { "actuated", "actuation", "closed", "switch" };
    return std::ranges::any_of (table.columns, [] (const std::string& c) { return names.contains (bareName (c)); });
}

/// True if the force snaps on the way down, and is exceeded at the stop, as in the key of a keyboard, which travels a few millimetres. Compares means
/// over a fortieth of the way, so that noise is no snap.
bool snapsToStop (const std::vector<double>& depth, const std::vector<double>& force)
{
    constexpr double longest = 10e-3, much = 0.1;   // m; of the largest force
    const auto rows = static_cast<std::size_t> (std::ranges::max_element (depth) - depth.begin()) + 1;
    if (depth[rows - 1] - depth.front() > longest || rows > force.size()) return false;
    const auto block = std::max<std::size_t> (1, rows / 40);
    double most = 0.0, fall = 0.0, from = 0.0;
    for (std::size_t first = 0; first + block <= rows; first += block)
    {
        const auto begin = force.begin() + static_cast<std::ptrdiff_t> (first);
        const double mean = std::accumulate (begin, begin + static_cast<std::ptrdiff_t> (block), 0.0) / static_cast<double> (block);
        most = std::max (most, mean);
        if (most - mean <= fall) continue;
        fall = most - mean;
        from = most;
    }
    return fall > much * most && from < most;
}

/// True if the force falls while the tool goes in deeper. A soft body on which the tool rests lets go, too, but at the same depth.
bool bursts (const std::vector<double>& depth, const std::vector<double>& force)
{
    constexpr double deeper = 0.01, much = 0.2;   // of the largest depth; of the largest force
    const double step = deeper * *std::ranges::max_element (depth);
    double most = 0.0, at = 0.0, fall = 0.0;
    for (std::size_t i = 0; i < std::min (depth.size(), force.size()); ++i)
        if (force[i] > most)
        {
            most = force[i];
            at = depth[i];
        }
        else if (depth[i] > at + step)
            fall = std::max (fall, most - force[i]);
    return fall > much * most;
}

/// Depth and force may be a shock, a key, an indentation or a cut.
FitKind guessPressed (const Table& table)
{
    const auto t = valuesOf (table, infoOf (FitKind::shock).columns[2]);
    constexpr double brief = 0.1;   // s
    if (t.size() > 1 && t.back() - t.front() < brief) return FitKind::shock;
    const auto& columns = infoOf (FitKind::curve).columns;
    RecordedColumns recorded { { "depth", valuesOf (table, columns[0]) }, { "force", valuesOf (table, columns[1]) } };
    orient (columns, recorded, {}, { .is_looked_for = true });
    const auto &depth = recorded["depth"], &force = recorded["force"];
    if (depth.empty()) return FitKind::curve;
    const double deepest = *std::ranges::max_element (depth);
    if (depth.back() < 0.5 * deepest)   // pressed and released
        return saysClosed (table) || snapsToStop (depth, force) ? FitKind::key_switch : FitKind::curve;
    if (! has (table, FitKind::shock, "depth")) return FitKind::curve;   // what is called x need not be a depth
    return bursts (depth, force) ? FitKind::blade : FitKind::curve;
}
}   // namespace

const std::vector<FitKindInfo>& fitKinds()
{
    static const std::vector<FitKindInfo> kinds {
        { FitKind::friction,
          "friction",
          "Friction",
          "How a tool sticks and slides: friction.elasto_plastic",
          { column ("position", "m", true, { "x", "displacement", "travel", bareName (integrated_position) }, "position along the stroke"),
            column ("force", "N", true, { "friction", "friction_force", "drag", "fx", "ft" }, "friction force along the stroke"),
            positive (column ("load", "N", false, { "normal", "normal_force", "push", "fz", "fn" }, "normal force")) } },
        { FitKind::modes,
          "modes",
          "Ring",
          "The tones of a struck object: vibration.modal",
          { column ("t", "s", true, { "time" }, "time"),
            column ("value", "", true, { "acceleration", "accel", "acc", "velocity", "force", "sound", "signal", "a", "y", "column_2", "channel_1" },
                    "ring, in any unit") } },
        { FitKind::texture,
          "texture",
          "Texture",
          "The vibration of a tool on a rough surface: texture.noise",
          { column ("t", "s", true, { "time" }, "time"),
            column ("acceleration", "m/s2", true, { "accel", "acc", "vibration", "a" }, "acceleration of the tool"),
            column ("speed", "m/s", false, { "velocity", "v" }, "speed of the tool"),
            positive (column ("force", "N", false, { "normal", "normal_force", "load", "fz", "fn" }, "normal force")) } },
        { FitKind::grating,
          "grating",
          "Ridges",
          "The ridges of a scanned profile: texture.grating",
          { column ("position", "m", true, { "x", "distance", "displacement", "lateral", "column_1" }, "position along the scan"),
            column ("height", "m", true, { "z", "profile", "h", "raw", "column_2" }, "height") } },
        { FitKind::blade,
          "blade",
          "Cut",
          "How a sample bursts and is cut: cut.blade",
          pressed (along, "depth of the blade", "force against the blade") },
        { FitKind::curve,
          "curve",
          "Press",
          "Force over depth of a soft body: deform.surface",
          pressed (along, "depth", "force out of the object") },
        { FitKind::key_switch,
          "switch",
          "Key switch",
          "The force of a key, pressed and released: deform.plane and friction.elasto_plastic",
          pressed (along, "travel of the key", "force of the key") },
        { FitKind::shock,
          "shock",
          "Impact",
          "The spring and damper of an impact: shock.hunt_crossley",
          impact() },
    };
    return kinds;
}

const FitKindInfo& infoOf (FitKind kind) { return *std::ranges::find (fitKinds(), kind, &FitKindInfo::kind); }

std::optional<FitKind> guessKind (const Table& table)
{
    const auto fits = [&] (FitKind kind) {
        return std::ranges::all_of (infoOf (kind).columns, [&] (const FitColumn& c) { return ! c.required || findColumn (table, c); });
    };
    if (table.rows() < 2) return {};
    const bool is_scan = has (table, FitKind::grating, "height") && ! has (table, FitKind::curve, "force") && ! has (table, FitKind::friction, "force");
    if (is_scan && bareName (table.columns[0]) != "column_1" && fits (FitKind::grating)) return FitKind::grating;
    if (fits (FitKind::texture) && (has (table, FitKind::texture, "speed") || has (table, FitKind::texture, "force"))) return FitKind::texture;
    if (fits (FitKind::friction))
    {
        const auto position = valuesOf (table, infoOf (FitKind::friction).columns[0]);
        if (has (table, FitKind::friction, "load") || (! position.empty() && turns (position) >= 2)) return FitKind::friction;
    }
    if (fits (FitKind::curve)) return guessPressed (table);
    if (fits (FitKind::modes)) return FitKind::modes;
    if (fits (FitKind::grating)) return FitKind::grating;
    return {};
}

}   // namespace tactus::host
