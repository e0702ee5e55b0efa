// SPDX-License-Identifier: MIT
#include "described.hpp"

namespace tactus::plugin
{

Described::Described (const NodeType& type)
{
    for (const auto* rows : { &type.inputs, &type.params, &type.outputs })
        for (const auto& p : *rows)
            port_list.push_back (port (p));
    for (const auto& s : type.settings)
        setting_list.push_back (setting (s));
    node.size = sizeof node;
    node.id = text (type.info.id);
    node.name = text (type.info.name);
    node.summary = text (type.info.summary);
    node.source = text (type.info.source);
    node.ports = port_list.data();
    node.port_count = port_list.size();
    node.settings = setting_list.data();
    node.setting_count = setting_list.size();
    node.params_size = type.params_size;
    node.outputs_size = type.outputs_size;
    node.outputs_align = type.outputs_align;
    if (type.appearance) node.appearance = look (*type.appearance);
}

Described::~Described() = default;

const char* Described::text (std::string_view t) { return texts.emplace_back (t).c_str(); }

const tactus_plugin_unit* Described::unit (const UnitRule& u)
{
    const auto& d = u.unit.dimension;
    return &units.emplace_back (tactus_plugin_unit { sizeof (tactus_plugin_unit), static_cast<int> (u.kind), text (name (u.unit.quantity)), d.m, d.kg, d.s,
                                                     text (u.unit.symbol), text (u.a), text (u.b), u.adds_up });
}

const tactus_plugin_limits* Described::limit (const Limits& l)
{
    return &limits.emplace_back (
        tactus_plugin_limits { sizeof (tactus_plugin_limits), l.latch, l.hard.min, l.hard.max, l.usual.min, l.usual.max });
}

const tactus_plugin_port* Described::port (const PortSheet& p)
{
    auto& names = choices.emplace_back();
    for (const auto& choice : p.choices)
        names.push_back (text (choice));
    const auto* u = unit (p.unit);
    const auto* l = limit (p.limits);
    const int role = static_cast<int> (p.role);
    const auto& d = p.initial;
    const char *id = text (p.id), *about = text (p.about);
    const auto n = names.size();
    return &ports.emplace_back (
        tactus_plugin_port { sizeof (tactus_plugin_port), role, id, about, u, l, names.data(), n, p.width, p.list, p.offset, { d[0], d[1], d[2] } });
}

const tactus_plugin_setting* Described::setting (const SettingSheet& s)
{
    std::vector<const tactus_plugin_setting*> inner;
    for (const auto& field : s.fields)
        inner.push_back (setting (field));
    const auto& kept = fields.emplace_back (std::move (inner));
    return &settings.emplace_back (tactus_plugin_setting { sizeof (tactus_plugin_setting), static_cast<int> (s.kind), text (s.id), text (s.about),
                                                           unit (s.unit), unit (s.x_unit), limit (s.limits), kept.data(), kept.size(),
                                                           initial (initials.emplace_back (s.initial)) });
}

const tactus_plugin_appearance* Described::look (const Appearance& a)
{
    for (const auto& part : appearance_parts)
    {
        if ((a.*part.row).empty()) continue;
        part_names.push_back (text (part.name));
        part_rows.push_back (text (a.*part.row));
    }
    appearance = { sizeof appearance, text (name (a.kind)), part_names.data(), part_rows.data(), part_names.size() };
    return &appearance;
}

}   // namespace tactus::plugin
