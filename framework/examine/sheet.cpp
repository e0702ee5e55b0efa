// SPDX-License-Identifier: MIT
#include "parts.hpp"

#include <algorithm>
#include <set>

namespace tactus::examine
{

namespace
{

bool isSentence (std::string_view s) { return s.ends_with ('.'); }

bool areOrdered (const Limits& l) { return l.hard.min <= l.hard.max && l.usual.min <= l.usual.max; }
bool isInside (const Limits& limits, double v) { return areOrdered (limits) && limits.hard.contains (v) && limits.usual.contains (v); }

std::string choiceFault (const PortSheet& p)
{
    if (p.choices.empty()) return {};
    const std::set<std::string_view> different (p.choices.begin(), p.choices.end());
    if (! (p.initial[0] >= 0.0 && p.initial[0] < static_cast<double> (p.choices.size()))) return "its default is not one of its alternatives";
    if (different.contains ("")) return "one of its alternatives has no name";
    if (p.choices.size() < 2) return "it has only one alternative";
    return different.size() == p.choices.size() ? "" : "two of its alternatives have the same name";
}

std::string paramFault (const PortSheet& p)
{
    if (p.role != Role::param) return {};
    if (! p.choices.empty()) return choiceFault (p);
    for (int i = 0; i < p.width; ++i)
        if (! isInside (p.limits, p.initial[i])) return say ("its default ", p.initial[i], " is outside of its range");
    return {};
}

std::string fieldFault (const SettingSheet& s)
{
    for (const auto& f : s.fields)
    {
        const auto* v = std::get_if<double> (&f.initial);
        if (v != nullptr && ! f.limits.hard.contains (*v)) return say (f.id, ": its default ", *v, " is outside of its range");
        if (auto fault = fieldFault (f); ! fault.empty()) return say (f.id, ": ", fault);
    }
    return {};
}

std::string settingFault (const SettingSheet& s)
{
    const auto* v = std::get_if<double> (&s.initial);
    if (v != nullptr && ! isInside (s.limits, *v)) return say ("its default ", *v, " is outside of its range");
    return fieldFault (s);
}

std::string listFault (const NodeType& type)
{
    const auto isList = [] (const PortSheet& p) { return p.list; };
    if (std::ranges::none_of (type.inputs, isList) && std::ranges::none_of (type.params, isList) && std::ranges::none_of (type.outputs, isList)) return {};
    const auto at = std::ranges::find (type.settings, std::string_view { "inputs" }, &SettingSheet::id);
    if (at == type.settings.end()) return "it has a list, but no setting `inputs` for its length";
    const bool is_length = at->kind == SettingSheet::Kind::integer && at->limits.hard == Interval { 1, list_capacity };
    return is_length ? "" : say ("its setting `inputs` must be an integer from 1 to ", list_capacity);
}
}   // namespace

std::string sheetFault (const NodeType& type, unsigned)
{
    if (! isSentence (type.info.summary)) return "its summary does not end with a full stop";
    if (type.info.source.empty()) return "it names no source";
    for (const auto& p : type.params)
        if (auto fault = paramFault (p); ! fault.empty()) return say (p.id, ": ", fault);
    std::set<std::string_view> in_names;
    for (const auto* ports : { &type.inputs, &type.params })
        for (const auto& p : *ports)
            if (! in_names.insert (p.id).second) return say ("two rows have the name ", p.id);
    for (const auto& s : type.settings)
    {
        if (! in_names.insert (s.id).second) return say ("two rows have the name ", s.id);
        if (auto fault = settingFault (s); ! fault.empty()) return say (s.id, ": ", fault);
    }
    return listFault (type);
}

}   // namespace tactus::examine
