// SPDX-License-Identifier: MIT
#include "limits_report.hpp"
#include "refusal.hpp"

#include <host/base/command_line/command.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
/// The quantities of the options, after the options were checked.
std::vector<Varied> readAxes (const CheckedGraph& graph, const LimitsOptions& options)
{
    if (options.x.empty() != options.y.empty()) throw UsageError ("--x and --y: give both, or none");
    const auto& roles = graph.roles;
    if (! options.role.empty() && std::ranges::none_of (roles, [&] (const CheckedRole& r) { return r.device.role == options.role; }))
    {
        std::vector<std::string> names;
        for (const auto& r : roles)
            names.push_back (r.device.role);
        refuse (Message::error ("device/unknown_role", "--role", "the graph has no role " + quote (options.role) + didYouMean (options.role, names),
                                "name one of its roles"));
    }
    if (options.x.empty()) return {};
    std::vector<std::string> params;
    std::vector<Varied> axes { readVaried ("--x", options.x, *graph.plan, params), readVaried ("--y", options.y, *graph.plan, params) };
    if (axes[0].name == axes[1].name) throw UsageError ("--y", quote (axes[1].name) + " is already along --x");
    return axes;
}

Json toJson (const std::optional<Range>& r)
{
    if (! r) return {};
    Json range { { "from", r->low }, { "to", std::isfinite (r->high) ? Json (r->high) : Json() } };
    if (! r->is_low_known) range["unknown_below"] = r->low;
    if (! r->is_high_known) range["unknown_above"] = r->high;
    return range;
}

Json toJson (const Limits& l) { return Json { { "stiffness", toJson (l.stiffness) }, { "damping", toJson (l.damping) }, { "rate", toJson (l.rate) } }; }
}   // namespace

LimitsReport::LimitsReport (CheckedGraph& g, const LimitsOptions& options)
    : graph (g), axes (readAxes (g, options)), contact { g.subject, g.motion (options.duration_s), g.roles, *g.plan, options.role },
      regions { options.steps, contact, options.checkOn }
{
    regions.vary (axes);
    passive = regions.limitsOf (LimitRegions::Rule::passive);
    stable = regions.limitsOf (LimitRegions::Rule::stable);
    for (auto& v : axes)
    {
        if (v.what == Varied::What::stiffness) v.now = regions.workingPoint().stiffness;
        if (v.what == Varied::What::damping) v.now = regions.workingPoint().damping;
        if (v.what == Varied::What::rate) v.now = contact.rate();
    }
}

std::vector<View> LimitsReport::views() const
{
    if (axes.empty()) return regions.usualViews (stable);
    return { { "", axes[0], axes[1] } };
}

Json LimitsReport::json() const
{
    const auto& here = regions.workingPoint();
    Json all { { "graph", graph.loaded.graph.name },
               { "role", contact.device().device.role },
               { "device", contact.device().device.name },
               { "rate_hz", contact.rate() } };
    if (! contact.axis().empty()) all["axis"] = contact.axis();
    all["node"] = contact.node();
    all["t"] = contact.time();
    if (! contact.controller().empty()) all["controller"] = contact.controller();
    if (const auto& w = contact.weakest()) all["weakest"] = Json { { "node", w->node }, { "may_grow", w->may_grow } };
    all["stiffness"] = here.stiffness;
    all["damping"] = here.damping;
    all["stiffness_param"] = contact.stiffnessParam();
    all["damping_param"] = contact.dampingParam();
    all["load"] = here.load;
    all["radius"] = here.radius ? Json (*here.radius) : Json();
    all["largest_damper"] = here.largest_damper;
    all["passive"] = toJson (passive);
    all["passive"]["rule"] = "sufficient";
    all["stable"] = toJson (stable);
    if (std::isfinite (here.stiffest_held))
        all["quanta"] = Json { { "rule", "sufficient" }, { "stiffness", here.stiffest_held }, { "damping", here.quietest_damper } };
    return all;
}

Json LimitsReport::jsonWithRows() const
{
    auto all = json();
    all["columns"] = Json::array();
    for (const auto& column : regions.columns())
        all["columns"].push_back (column);
    all["rows"] = Json::array();
    for (const auto& row : regions.rows (views()))
    {
        auto entry = Json::array();
        for (const double v : row)
            entry.push_back (std::isfinite (v) ? Json (v) : Json());
        all["rows"].push_back (std::move (entry));
    }
    return all;
}

}   // namespace tactus::host
