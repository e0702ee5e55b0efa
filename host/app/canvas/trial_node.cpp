// SPDX-License-Identifier: GPL-3.0-or-later
#include "trial_node.hpp"

#include <host/app/model/param_now.hpp>
#include <host/app/model/quantity_text.hpp>
#include <tactus/plan/settings.hpp>

#include <algorithm>
#include <cstring>
#include <new>

namespace tactus::host
{

namespace
{
bool isFileKind (SettingSheet::Kind k)
{
    using Kind = SettingSheet::Kind;
    return k == Kind::signal || k == Kind::image || k == Kind::table || k == Kind::surface;
}

bool canBeTried (const NodeType& type)
{
    const auto isList = [] (const PortSheet& p) { return p.list; };
    const auto isFile = [] (const auto& s) { return isFileKind (s.kind); };
    const auto readsFile = [&] (const SettingSheet& s) { return isFile (s) || std::ranges::any_of (s.fields, isFile); };
    return type.tick != nullptr && ! type.bind && ! std::ranges::any_of (type.inputs, isList) && ! std::ranges::any_of (type.params, isList)
           && ! std::ranges::any_of (type.outputs, isList) && ! std::ranges::any_of (type.settings, readsFile);
}

const PortSheet* sheetIn (const std::vector<PortSheet>& ports, std::string_view id) noexcept
{
    const auto found = std::ranges::find (ports, id, &PortSheet::id);
    return found == ports.end() ? nullptr : &*found;
}

void setParam (const NodeType& type, void* node, const PortSheet& sheet, const Json& value)
{
    auto* place = static_cast<std::byte*> (type.paramsOf (node)) + sheet.offset;
    if (! sheet.choices.empty())
    {
        if (! value.is_string()) return;
        const auto chosen = std::ranges::find (sheet.choices, value.get<std::string>());
        if (chosen == sheet.choices.end()) return;
        const int number = static_cast<int> (chosen - sheet.choices.begin());
        std::memcpy (place, &number, sizeof number);
        return;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t> (sheet.width); ++i)
    {
        const bool has_parts = sheet.width > 1 && value.is_array() && i < value.size();
        const double si = siOf (has_parts ? value[i] : value, sheet, sheet.initial[i]);
        std::memcpy (place + i * sizeof si, &si, sizeof si);
    }
}
}   // namespace

TrialNode::TrialNode (const NodeType& t)
    : type (&t), node (t.make()),
      outputs (static_cast<std::byte*> (::operator new (std::max<std::size_t> (1, t.outputs_size), std::align_val_t (t.outputs_align))),
               AlignedDelete { std::align_val_t (t.outputs_align) })
{
    for (const auto& p : t.inputs)
        inputs.insert (inputs.end(), p.initial, p.initial + p.width);
    t.initialiseOutputs (outputs.get());
}

std::optional<TrialNode> TrialNode::make (const graph::Graph& graph, const SeenPatch& patch, const graph::Node& node, const Face& face)
{
    if (face.type == nullptr || ! canBeTried (*face.type)) return std::nullopt;
    const auto& type = *face.type;
    TrialNode made (type);
    for (const auto& sheet : type.settings)
    {
        const auto written = node.settings.find (std::string (sheet.id));
        if (written == node.settings.end()) continue;
        std::string where;
        const auto value = plan::readSetting (*written, sheet, {}, where);
        if (! value) return std::nullopt;
        sheet.set (made.node.get(), *value);
    }
    for (const auto& port : face.params)
        setParam (type, made.node.get(), *port.sheet, paramNow (graph, patch, node, port).value);
    if (type.problem && ! type.problem (made.node.get()).empty()) return std::nullopt;
    if (type.prepare) type.prepare (made.node.get(), Setup { .rate_hz = graph.rate_hz });
    if (type.update != nullptr) type.update (made.node.get());
    for (const auto& value : made.inputs)
        made.sources.push_back (&value);
    return made;
}

void TrialNode::set (std::string_view input, const Vec3& value)
{
    std::size_t at = 0;
    for (const auto& p : type->inputs)
    {
        const auto width = static_cast<std::size_t> (p.width);
        if (p.id == input) std::copy_n (value.data(), width, inputs.begin() + static_cast<std::ptrdiff_t> (at));
        at += width;
    }
}

void TrialNode::tick() noexcept { type->tick (node.get(), sources.data(), outputs.get()); }

double TrialNode::output (std::string_view id, std::size_t component) const noexcept
{
    const auto* sheet = sheetIn (type->outputs, id);
    if (sheet == nullptr) return 0.0;
    double value = 0.0;
    std::memcpy (&value, outputs.get() + sheet->offset + component * sizeof value, sizeof value);
    return value;
}

double TrialNode::param (std::string_view id, double fallback) const noexcept
{
    const auto* sheet = sheetIn (type->params, id);
    if (sheet == nullptr || ! sheet->choices.empty()) return fallback;
    double value = 0.0;
    std::memcpy (&value, static_cast<const std::byte*> (type->paramsOf (node.get())) + sheet->offset, sizeof value);
    return value;
}

}   // namespace tactus::host
