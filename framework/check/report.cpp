// SPDX-License-Identifier: MIT
#include "report.hpp"

#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::check
{

namespace
{
Json number (double v) { return std::isfinite (v) ? Json (v) : Json(); }

Json toJson (const DeviceNumbers& numbers)
{
    auto j = Json::object();
    for (const auto& row : deviceNumberRows())
        if (const auto& n = numbers.*row.member)
        {
            auto entry = Json::object();
            entry["value"] = number (n->value);
            if (! n->source.empty()) entry["source"] = n->source;
            if (n->guess) entry["guess"] = true;
            j[std::string (row.id)] = std::move (entry);
        }
    return j;
}

/// The demands of a role, the position at which its force is steepest, and the stiffness of each node there.
Json toJson (const Demand& demand, const RoleDemand& role)
{
    Json j { { "role", role.role } };
    if (! role.axis.empty()) j["axis"] = role.axis;
    j["peak_force"] = number (role.peak_force);
    j["fastest_force"] = number (role.fastest_force);
    j["speed"] = number (role.speed);
    j["path_delay"] = role.longest;
    if (! role.others.empty())
    {
        j["not_judged"] = Json::array();
        for (const auto& other : role.others)
            j["not_judged"].push_back (other);
    }
    const auto most = std::ranges::max_element (role.slopes, {}, &Slope::stiffness);
    if (most == role.slopes.end()) return j;
    j["stiffness"] = number (most->stiffness);
    j["lag"] = number (most->lag);
    j["damping"] = number (most->damping);
    j["t"] = number (most->t_s);
    j["position"] = Json::array();
    for (int i = 0; i < 3; ++i)
        j["position"].push_back (number (most->position[i]));
    j["nodes"] = Json::array();
    for (std::size_t n = 0; n < most->by_node.size(); ++n)
        if (most->by_node[n] > 0.0)
            j["nodes"].push_back (Json { { "node", demand.nodes[n].path }, { "type", demand.nodes[n].type }, { "stiffness", number (most->by_node[n]) } });
    return j;
}

Json toJson (const Condition& c)
{
    Json j { { "id", c.id }, { "role", c.role } };
    if (! c.axis.empty()) j["axis"] = c.axis;
    if (! c.node.empty()) j["node"] = c.node;
    j["law"] = c.law;
    j["verdict"] = c.verdict == Verdict::close ? "near" : c.verdict == Verdict::not_reached ? "not_reached"
                                                                                            : nameOf (c.verdict);
    j["value"] = number (c.value);
    j["limit"] = c.isKnown() ? number (c.limit) : Json();
    j["margin"] = c.isKnown() ? number (c.margin()) : Json();
    j["unit"] = c.unit;
    j["text"] = c.text;
    if (! c.remedy.empty()) j["remedy"] = c.remedy;
    if (! c.loops.empty()) j["loops"] = Json::array();
    for (const auto& loop : c.loops)
        j["loops"].push_back (Json { { "node", loop.node }, { "passive_up_to", number (loop.passive_up_to) }, { "may_grow", number (loop.may_grow) } });
    return j;
}
}   // namespace

Json toJson (const Demand& demand, std::span<const RoleDevice> devices, std::span<const Condition> conditions, const JudgeOptions& options)
{
    Json j { { "rate_hz", demand.rate_hz }, { "duration", demand.lasts_s } };
    j["scope"] = scopeOf (demand, options, "the motion");
    j["not_judged"] = Json::array();
    for (const auto& n : notJudged (demand, conditions, options))
    {
        Json entry { { "what", n.what }, { "why", n.why } };
        if (! n.role.empty()) entry["role"] = n.role;
        j["not_judged"].push_back (std::move (entry));
    }
    j["places"] = demand.linked.size();
    if (const auto* trials = options.trials; trials != nullptr)
        j["trials"] = Json { { "places", trials->places }, { "runs", trials->runs }, { "driven_away", trials->driven_away } };
    j["alpha"] = options.factors.alpha;
    j["beta"] = options.factors.beta;
    j["gamma"] = options.factors.gamma;
    if (options.speed > 0.0) j["speed"] = options.speed;
    j["roles"] = Json::array();
    for (const auto& role : demand.roles)
    {
        auto entry = toJson (demand, role);
        const auto device = std::ranges::find (devices, role.role, &RoleDevice::role);
        if (device != devices.end())
        {
            entry["device"] = device->name;
            entry["numbers"] = toJson (device->numbers);
        }
        j["roles"].push_back (std::move (entry));
    }
    j["conditions"] = Json::array();
    for (const auto& c : conditions)
        j["conditions"].push_back (toJson (c));
    j["broken"] = std::ranges::count_if (conditions, &Condition::isBroken);
    return j;
}

std::string scopeOf (const Demand& demand, const JudgeOptions& options, std::string_view motion)
{
    auto text = "judged along " + roundedText (demand.lasts_s, 3) + " s of " + std::string (motion)
                + ": slopes at " + std::to_string (demand.linked.size()) + " places";
    if (options.trials != nullptr)
        text += ", and " + std::to_string (options.trials->runs) + " trials of tools that are let go at " + std::to_string (options.trials->places) + " places";
    return text;
}

std::vector<NotJudged> notJudged (const Demand& demand, std::span<const Condition> conditions, const JudgeOptions& options)
{
    std::vector<NotJudged> all;
    for (const auto& role : demand.roles)
        for (const auto& other : role.others)
            all.push_back ({ role.role, other, "the check does not simulate it" });
    for (const auto& c : conditions)
    {
        const bool is_loop = c.id == "stiffness" || c.id == "coupling";
        if (c.verdict == Verdict::unknown)
            all.push_back ({ c.role, is_loop ? "whether " + (c.axis.empty() ? "the tool" : "the axis '" + c.axis + "'") + " comes to rest" : std::string (c.id),
                             c.remedy.substr (0, c.remedy.find (':')) });
        else if (c.verdict == Verdict::not_reached)
            all.push_back ({ c.role, "'" + c.node + "'", "the motion does not reach it" });
    }
    if (options.trials == nullptr)
        all.push_back ({ "", "tools that bounce, dry friction and steps of a sensor in a loop", "no tool was let go" });
    else
        for (const auto& t : options.trials->by_role)
        {
            const auto isItsLoop = [&] (const Condition& c) { return c.role == t.role && c.axis == t.axis && c.id == "stiffness"; };
            if (! t.is_tried && std::ranges::any_of (conditions, isItsLoop))
                all.push_back ({ t.role, "a tool that bounces, dry friction and steps of a sensor in its loop",
                                 "its tool could not be let go, or not as often as planned" });
        }
    all.push_back ({ "", "other motions, and forces beyond those of this one", "only the verdict passive holds for every motion" });
    return all;
}

std::string describe (const DeviceNumbers& numbers)
{
    struct Symbol
    {
        const char* name;
        DeviceNumbers::Number DeviceNumbers::*member;
        double factor;
        const char* unit;
    };
    constexpr Symbol symbols[] {
        { "M", &DeviceNumbers::mass, 1.0, " kg" },
        { "B", &DeviceNumbers::damping, 1.0, " N*s/m" },
        { "f_f", &DeviceNumbers::coulomb, 1.0, " N" },
        { "delta", &DeviceNumbers::quantum, 1e6, " um" },
        { "b", &DeviceNumbers::force_quantum, 1e3, " mN" },
        { "d", &DeviceNumbers::delay, 1.0, "" },
        { "F_0", &DeviceNumbers::first_mode, 1.0, " Hz" },
        { "f_max", &DeviceNumbers::peak_force, 1.0, " N" },
        { "1/T", &DeviceNumbers::rate, 1.0, " Hz" },
    };
    std::string text;
    for (const auto& s : symbols)
        if (const auto& n = numbers.*s.member)
        {
            const auto value = std::isfinite (n->value) ? roundedText (s.factor * n->value, 3) + s.unit : std::string ("infinite");
            addToList (text, std::string (s.name) + " " + value + (n->guess ? " (guess)" : ""));
        }
    return text.empty() ? "nothing is known" : text;
}

std::string describe (double value, double limit)
{
    int digits = 3;
    while (digits < 9 && value != limit && roundedText (value, digits) == roundedText (limit, digits))
        ++digits;
    return roundedText (value, digits) + " of " + roundedText (limit, digits);
}

}   // namespace tactus::check
