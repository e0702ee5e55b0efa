// SPDX-License-Identifier: GPL-3.0-or-later
#include "fixes.hpp"

#include <host/app/canvas/actions.hpp>
#include <host/app/compose/banks.hpp>
#include <host/app/model/fragment.hpp>
#include <host/app/model/obvious_wires.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/text/file_path.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>
#include <span>
#include <vector>

namespace tactus::host
{

namespace
{
const graph::Wire* wireOf (const graph::Graph& g, const ProblemLocation& c)
{
    const auto* patch = findPatch (g, c.patch);
    if (patch == nullptr) return nullptr;
    const auto found = std::ranges::find (patch->wires, c.id, &graph::Wire::id);
    return found == patch->wires.end() ? nullptr : &*found;
}

/// The type that was probably meant: one with a similar id, else the only one whose id ends like this. Empty if there is none.
std::string likelyType (const std::string& unknown)
{
    const auto endOf = [] (std::string_view id) { return id.substr (id.find_last_of ('.') + 1); };
    std::vector<std::string_view> ids, ends;
    for (const auto& type : catalogue())
    {
        ids.push_back (type.info.id);
        ends.push_back (endOf (type.info.id));
    }
    if (const auto id = closestMatch (unknown, ids); ! id.empty()) return std::string (id);
    const auto end = closestMatch (endOf (unknown), ends);
    if (end.empty() || std::ranges::count (ends, end) != 1) return {};
    return std::string (ids[static_cast<std::size_t> (std::ranges::find (ends, end) - ends.begin())]);
}

/// A node of this type with its wires. The canvas finds a place for it.
Fix add (const graph::Graph& g, const std::string& type, const juce::String& label, const char* step)
{
    graph::Id made = 0;
    graph::Batch all { step, { addNode (g, {}, type, {}, made) } };
    auto with = g;
    if (graph::apply (with, all))
        all.commands.push_back (wiring::obviousWires (with, {}, std::ranges::find (with.root.nodes, made, &graph::Node::id)->name, catalogue()));
    return { label.toStdString(), std::move (all) };
}

/// The wires that a node lacks. Empty if it is not clear which.
std::optional<Fix> wireUp (const graph::Graph& g, const ProblemLocation& at, const juce::String& label)
{
    auto wires = wiring::obviousWires (g, at.patch, at.node, catalogue());
    if (wires.commands.empty()) return std::nullopt;
    return Fix { label.toStdString(), std::move (wires) };
}

/// The wires that a node without effect lacks. Empty if they would not lead to a motor.
std::optional<Fix> leadToMotor (const graph::Graph& g, const ProblemLocation& at)
{
    constexpr std::size_t most_nodes = 100;   // among more, it is not clear where, and looking for each of many such nodes would be slow
    const auto* patch = findPatch (g, at.patch);
    if (patch == nullptr || patch->nodes.size() > most_nodes) return std::nullopt;
    auto fix = wireUp (g, at, filled (TRANS ("Wire %1"), at.node));
    const auto isToMotor = [&] (const graph::Command& c) {
        const auto* added = std::get_if<graph::AddWire> (&c.edit);
        const auto* end = added == nullptr ? nullptr : patch->find (added->wire.to.node);
        return end != nullptr && end->type == "device.force";
    };
    if (! fix || std::ranges::none_of (std::get<graph::Batch> (fix->command.edit).commands, isToMotor)) return std::nullopt;
    return fix;
}
}   // namespace

std::optional<Fix> fixOf (const graph::Graph& g, const Message& m)
{
    const auto location = locationOf (g, m);
    const auto* wire = wireOf (g, location);
    if (m.id == "graph/loop" && wire != nullptr)
    {
        auto delayed = *wire;
        delayed.delay = std::max (1, wire->delay);
        return Fix { TRANS ("Delay wire by a tick").toStdString(),
                     graph::Batch { NEEDS_TRANS ("break loop"), { graph::ChangeWire { location.patch, location.id, std::move (delayed) } } } };
    }
    if (m.id == "graph/no_hand") return add (g, "device.position", TRANS ("Add a hand"), NEEDS_TRANS ("add a hand"));
    if (m.id == "graph/no_motor") return add (g, "device.force", TRANS ("Add a motor"), NEEDS_TRANS ("add a motor"));
    if (m.id == "mixer/bypassed" || m.id == "mixer/none")
        for (const auto& b : compose::bypassedBanks (g, catalogue()))
            if (graph::firstNameOf (b.sink) == location.node && m.text.find (b.sources.front()) != std::string::npos)
                if (auto mixed = compose::mixIn (g, b.sink, b.port, catalogue()))
                    return Fix { (! b.has_bank ? TRANS ("Mix them") : b.mixer.empty() ? TRANS ("Mix it in")
                                                                                      : filled (TRANS ("Mix it in %1"), b.mixer))
                                     .toStdString(),
                                 std::move (*mixed) };
    if (m.id == "node/no_effect") return leadToMotor (g, location);
    if (m.id == "graph/hand_unwired" || m.id == "graph/motor_unwired" || m.id == "node/no_input" || m.id == "envelope/no_gate")
        return wireUp (g, location, filled (TRANS ("Wire %1"), location.node));
    if (m.severity != Message::Severity::error) return std::nullopt;
    const auto& [patch, id, node, param, role, setting, within] = location;
    if (wire != nullptr)
        return Fix { TRANS ("Remove the wire").toStdString(), graph::Batch { NEEDS_TRANS ("remove wire"), { graph::RemoveWire { patch, id } } } };
    if (! param.empty())
        return Fix { filled (TRANS ("Reset %1"), param).toStdString(),
                     graph::Batch { filled (TRANS ("reset %1"), param).toStdString(), { graph::SetParam { patch, node, param } } } };
    if (m.id == "node/no_role")
    {
        const bool has_device = ! g.devices.empty();
        const auto name = has_device ? g.devices.front().first : std::string ("stylus");
        graph::Batch all { has_device ? NEEDS_TRANS ("assign role") : NEEDS_TRANS ("add stylus"), {} };
        if (! has_device) all.commands.push_back (graph::SetDevice { name, newTool() });
        all.commands.push_back (graph::SetNodeKey { patch, node, "role", Json (name) });
        return Fix { filled (has_device ? TRANS ("Assign to %1") : TRANS ("Add a %1"), name).toStdString(), std::move (all) };
    }
    if (node.empty() || m.id != "node/unknown_type") return std::nullopt;
    if (const auto type = likelyType (findPatch (g, patch)->find (node)->type); ! type.empty())
        return Fix { filled (TRANS ("Change to %1"), type).toStdString(),
                     graph::Batch { NEEDS_TRANS ("change type"), { graph::SetNodeKey { patch, node, "type", Json (type) } } } };
    return Fix { TRANS ("Remove the node").toStdString(), graph::Batch { NEEDS_TRANS ("remove node"), { graph::RemoveNode { patch, node } } } };
}

namespace
{
/// The kind of file that a part of a setting names; empty if it names none.
std::optional<SettingSheet::Kind> fileKindAt (const SettingSheet& sheet, std::span<const std::string> within)
{
    using Kind = SettingSheet::Kind;
    const auto inField = [&] (std::size_t place) -> std::optional<Kind> {
        const auto field = place < within.size() ? std::ranges::find (sheet.fields, within[place], &SettingSheet::id) : sheet.fields.end();
        return field == sheet.fields.end() ? std::nullopt : fileKindAt (*field, within.subspan (place + 1));
    };
    switch (sheet.kind)
    {
    case Kind::signal:
    case Kind::image:
    case Kind::table:
        return within.empty() ? std::optional (sheet.kind) : std::nullopt;
    case Kind::surface:
        return within.size() == 1 && within[0] == "mesh" ? std::optional (sheet.kind) : std::nullopt;
    case Kind::record:
        return inField (0);
    case Kind::records:
        return inField (1);   // after the number of the record
    default:
        return std::nullopt;
    }
}
}   // namespace

std::optional<MissingFile> missingFileOf (const graph::Graph& g, const Message& m)
{
    auto at = locationOf (g, m);
    if (m.id == "clip/no_file") at.setting = "clip";
    const auto* patch = findPatch (g, at.patch);
    const auto* node = patch == nullptr ? nullptr : patch->find (at.node);
    const auto* type = node == nullptr ? nullptr : catalogue().find (node->type);
    if (type == nullptr || at.setting.empty()) return std::nullopt;
    const auto sheet = std::ranges::find (type->settings, at.setting, &SettingSheet::id);
    const auto kind = sheet == type->settings.end() ? std::nullopt : fileKindAt (*sheet, pointerParts (at.within));
    if (! kind) return std::nullopt;

    const JsonPointer place ("/" + pointerPart (at.setting) + at.within);
    const auto* named = node->settings.contains (place) ? &node->settings.at (place) : nullptr;
    if (named == nullptr && ! at.within.empty()) return std::nullopt;
    if (named == nullptr || (named->is_string() && named->asString().empty())) return MissingFile { std::move (at), *kind, {} };
    if (! named->is_string()) return std::nullopt;
    std::filesystem::path expected = resolved (named->asString(), g.folder);
    std::error_code failed;
    if (std::filesystem::exists (expected, failed)) return std::nullopt;
    return MissingFile { std::move (at), *kind, std::move (expected) };
}

graph::Command useFile (const graph::Graph& g, const MissingFile& missing, const std::filesystem::path& chosen)
{
    const auto& at = missing.at;
    const auto* patch = findPatch (g, at.patch);
    const auto* node = patch == nullptr ? nullptr : patch->find (at.node);
    auto value = node == nullptr || ! node->settings.contains (at.setting) ? Json() : node->settings[at.setting];
    const Json path (pathFrom (chosen, g.folder));
    if (at.within.empty())
        value = path;
    else
        value[JsonPointer (at.within)] = path;
    return graph::SetSetting { at.patch, at.node, at.setting, std::move (value) };
}

}   // namespace tactus::host
