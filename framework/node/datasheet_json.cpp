// SPDX-License-Identifier: MIT
#include "datasheet_json.hpp"

#include <tactus/text/json.hpp>

namespace tactus
{

std::string unitText (const UnitRule& u)
{
    switch (u.kind)
    {
    case UnitRule::Kind::fixed:
        return std::string (u.unit.symbol);
    case UnitRule::Kind::open:
    case UnitRule::Kind::each:
        return "as wired";
    case UnitRule::Kind::same:
        return "as " + std::string (u.a) + (u.unit == unit::count ? "" : " * " + std::string (u.unit.symbol));
    case UnitRule::Kind::product:
        break;
    }
    return std::string (u.a) + (u.b.empty() ? "[0] * " + std::string (u.a) + "[1] …" : " * " + std::string (u.b));
}

namespace
{
Json number (double v) { return isFinite (v) ? Json (v) : Json(); }

Json toJson (const UnitRule& u)
{
    Json j = { { "unit", unitText (u) } };
    if (u.kind == UnitRule::Kind::fixed) j["quantity"] = name (u.unit.quantity);
    return j;
}

void add (Json& j, const Limits& l)
{
    if (! (l.hard == Interval {})) j["hard_range"] = { number (l.hard.min), number (l.hard.max) };
    if (! (l.usual == Interval {})) j["usual_range"] = { number (l.usual.min), number (l.usual.max) };
    if (l.latch) j["latch"] = true;
}

Json initialOf (const PortSheet& p)
{
    if (! p.choices.empty()) return std::string (p.choices[static_cast<std::size_t> (p.initial[0])]);
    if (p.width == 1) return number (p.initial[0]);
    return { p.initial[0], p.initial[1], p.initial[2] };
}

Json toJson (const PortSheet& p)
{
    Json j = { { "id", p.id } };
    if (p.choices.empty())
        j.update (toJson (p.unit));
    else
        j["choices"] = std::vector<std::string> (p.choices.begin(), p.choices.end());
    if (p.width == 3) j["components"] = { "x", "y", "z" };
    if (p.list) j["array"] = true;
    if (p.role != Role::output) j["default"] = initialOf (p);
    add (j, p.limits);
    j["about"] = p.about;
    return j;
}

Json toJson (const SettingSheet& s)
{
    Json j = { { "id", s.id }, { "kind", name (s.kind) } };
    if (const auto* v = std::get_if<double> (&s.initial)) j["default"] = number (*v);
    if (const auto* v = std::get_if<std::string> (&s.initial)) j["default"] = *v;
    j.update (toJson (s.unit));
    add (j, s.limits);
    for (const auto& f : s.fields)
        j["fields"].push_back (toJson (f));
    j["about"] = s.about;
    return j;
}
}   // namespace

Json datasheetJson (const NodeType& t)
{
    Json j = { { "id", t.info.id }, { "name", t.info.name }, { "summary", t.info.summary }, { "source", t.info.source } };
    if (! t.origin.empty()) j["plugin"] = t.origin;
    const auto all = [&] (const char* key, const auto& sheets) {
        j[key] = Json::array();
        for (const auto& s : sheets)
            j[key].push_back (toJson (s));
    };
    all ("inputs", t.inputs);
    all ("params", t.params);
    all ("settings", t.settings);
    all ("outputs", t.outputs);
    return j;
}

}   // namespace tactus
