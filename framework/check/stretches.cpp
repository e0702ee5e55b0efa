// SPDX-License-Identifier: MIT
#include "stretches.hpp"

#include <tactus/plan/steps/knobs.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::check
{

namespace
{
constexpr double felt_drag = 0.5;   // of the largest drag

const PortSheet* find (std::span<const PortSheet> rows, std::string_view id)
{
    const auto row = std::ranges::find (rows, id, &PortSheet::id);
    return row == rows.end() ? nullptr : &*row;
}

const NodeType& typeOf (const Plan& plan, std::size_t node) { return *plan.flat().nodes[node].type; }
}   // namespace

double valueInFile (const Plan& plan, std::size_t node, std::string_view id, double fallback)
{
    const auto& params = typeOf (plan, node).params;
    const auto row = std::ranges::find (params, id, &PortSheet::id);
    return row == params.end() ? fallback : plan.flat().param (static_cast<int> (node), static_cast<std::size_t> (row - params.begin()))[0];
}

double settingInFile (const Plan& plan, std::size_t node, std::string_view id, double fallback)
{
    const auto& settings = typeOf (plan, node).settings;
    const auto row = std::ranges::find (settings, id, &SettingSheet::id);
    if (row == settings.end()) return fallback;
    const auto* value = std::get_if<double> (&plan.flat().nodes[node].settings[static_cast<std::size_t> (row - settings.begin())]);
    return value != nullptr ? *value : fallback;
}

std::optional<StretchWatch> StretchWatch::of (const Plan& plan, std::size_t node)
{
    if (! plan.flat().nodes[node].runs()) return std::nullopt;
    const auto& type = typeOf (plan, node);
    const auto has = [] (std::span<const PortSheet> rows, std::string_view id) { return find (rows, id) != nullptr; };
    if (has (type.inputs, "position") && has (type.outputs, "contact") && has (type.outputs, "normal") && has (type.outputs, "depth"))
        return StretchWatch { plan, node, Kind::surface };
    const auto* d_max = find (type.params, "d_max");
    if (d_max == nullptr || d_max->unit.unit.symbol != "m") return std::nullopt;
    const bool follows_load = has (type.inputs, "normal_force") && has (type.outputs, "deflection") && has (type.params, "mu")
                              && valueInFile (plan, node, "load", 1.0) == 0.0;
    return StretchWatch { plan, node, follows_load ? Kind::bound : Kind::fixed };
}

StretchWatch::StretchWatch (const Plan& plan, std::size_t n, Kind k) : its_node (n), kind (k), forces (plan, n)
{
    if (valueInFile (plan, n, "adhesion", 0.0) == 0.0) static_ratio = valueInFile (plan, n, "static_ratio", 1.0);   // only `stick` has teeth
    if (k != Kind::surface) its_softer = valueInFile (plan, n, "stiffness", 0.0) > 0.0 ? Stretch::Softer::stiffness : Stretch::Softer::d_max;
}

void StretchWatch::poll (const Plan& plan, std::size_t tick)
{
    now = tick;
    if (! (forces.largest() > 0.0)) return;
    kind == Kind::surface ? lookAtSurface (plan) : lookAtFriction (plan);
}

void StretchWatch::lookAtFriction (const Plan& plan)
{
    const double drag = forces.largest(), d_max = param (plan, "d_max");
    if (kind == Kind::fixed) return seen.push_back ({ now, drag, d_max });
    const double stretch = vectorOutput (plan, "deflection").norm(), normal_force = input (plan, "normal_force");
    if (! (stretch > 0.0)) return;
    const double holds = param (plan, "mu") * normal_force;   // the drag while it slides
    seen.push_back ({ now, holds, holds * stretch / drag * d_max / valueInFile (plan, its_node, "d_max", d_max) });
}

void StretchWatch::lookAtSurface (const Plan& plan)
{
    const Vec3 p { input (plan, "position", 0), input (plan, "position", 1), input (plan, "position", 2) };
    const Vec3 n = vectorOutput (plan, "normal"), d = p - vectorOutput (plan, "contact");
    const double depth = output (plan, "depth");
    if (! (depth > 0.0)) return;
    if (output (plan, "state") == 2.0) ratio = std::max (ratio, (d - n.dot (d) * n).norm() / depth);
    seen.push_back ({ now, forces.largest(), depth });
}

double StretchWatch::largestDrag() const noexcept
{
    double most = 0.0;
    for (const auto& s : seen)
        most = std::max (most, s.drag);
    return most;
}

std::vector<std::size_t> StretchWatch::feltTicks() const
{
    std::vector<std::size_t> ticks;
    const double most = largestDrag();
    for (const auto& s : seen)
        if (s.drag >= felt_drag * most) ticks.push_back (s.tick);
    return ticks;
}

double StretchWatch::shortest() const noexcept
{
    double least = std::numeric_limits<double>::infinity();
    const double most = largestDrag();
    for (const auto& s : seen)
        if (s.drag >= felt_drag * most) least = std::min (least, s.stretch);
    if (kind != Kind::surface) return least;
    constexpr double frictionless = 1e-3;   // a contact without friction stays within this ratio of the projection of the tool
    return ratio > frictionless ? ratio * least : std::numeric_limits<double>::infinity();
}

double StretchWatch::teeth() const noexcept { return static_ratio > 1.0 ? (static_ratio - 1.0) * shortest() : 0.0; }

double StretchWatch::input (const Plan& plan, std::string_view id, int component) const
{
    std::size_t before = 0;   // number of components of the inputs before this one
    for (const auto& row : typeOf (plan, its_node).inputs)
    {
        if (row.id == id) return *plan.instances()[its_node].sources[before + static_cast<std::size_t> (component)];
        before += static_cast<std::size_t> (row.width);
    }
    return 0.0;
}

double StretchWatch::output (const Plan& plan, std::string_view id, int component) const
{
    const auto* row = find (typeOf (plan, its_node).outputs, id);
    if (row == nullptr) return 0.0;
    return *plan.instances()[its_node].output (row->offset + sizeof (double) * static_cast<std::size_t> (component));
}

Vec3 StretchWatch::vectorOutput (const Plan& plan, std::string_view id) const
{
    return { output (plan, id, 0), output (plan, id, 1), output (plan, id, 2) };
}

double StretchWatch::param (const Plan& plan, std::string_view id) const
{
    const auto& type = typeOf (plan, its_node);
    const auto row = std::ranges::find (type.params, id, &PortSheet::id);
    return *plan.instances()[its_node].param (plan::Knobs::indexOf (type, static_cast<std::size_t> (row - type.params.begin()), 0));
}

}   // namespace tactus::check
