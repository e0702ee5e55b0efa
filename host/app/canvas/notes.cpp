// SPDX-License-Identifier: GPL-3.0-or-later
#include "notes.hpp"

#include <host/app/model/patch.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tactus::host
{

namespace
{
constexpr float smallest = 48.0f, largest = 1e5f;

Json uiOf (const graph::Graph& g, const std::string& patch)
{
    const auto* in = patch.empty() ? nullptr : g.find (patch);
    if (in == nullptr && ! patch.empty()) return Json::object();
    const auto& extra = in == nullptr ? g.extra : in->extra;
    const auto ui = extra.find ("ui");
    return ui != extra.end() && ui->is_object() ? *ui : Json::object();
}

std::optional<Note> readNote (const Json& json)
{
    if (! json.is_object()) return std::nullopt;
    const auto at = readPoint (json, "at"), size = readPoint (json, "size");
    const auto text = json.find ("text");
    if (! at || ! size || text == json.end() || ! text->is_string()) return std::nullopt;
    const auto corner = at->toFloat(), extent = size->toFloat();
    const juce::Rectangle<float> area { corner.x, corner.y, std::clamp (extent.x, smallest, largest), std::clamp (extent.y, smallest, largest) };
    Note note { area, text->get<std::string>(), {}, json };
    const auto colour = json.value ("colour", Json());
    if (colour.is_string() && std::ranges::count (note_colours, colour.get<std::string>()) > 0) note.colour = colour.get<std::string>();
    return note;
}

Json pairOf (float x, float y) { return Json::array ({ std::round (static_cast<double> (x)), std::round (static_cast<double> (y)) }); }

Json toJson (const Note& note)
{
    auto json = note.extra;
    json["at"] = pairOf (note.area.getX(), note.area.getY());
    json["size"] = pairOf (std::max (note.area.getWidth(), smallest), std::max (note.area.getHeight(), smallest));
    json["text"] = note.text;
    if (note.isRegion())
        json["colour"] = note.colour;
    else
        json.erase ("colour");
    return json;
}
}   // namespace

std::vector<Note> notesOf (const graph::Graph& g, const std::string& patch)
{
    std::vector<Note> notes;
    const auto ui = uiOf (g, patch);
    if (const auto all = ui.find ("notes"); all != ui.end() && all->is_array())
        for (const auto& json : *all)
            if (auto note = readNote (json)) notes.push_back (std::move (*note));
    return notes;
}

graph::Command setNotes (const graph::Graph& g, const std::string& patch, const std::vector<Note>& notes, std::string step)
{
    auto ui = uiOf (g, patch);
    auto all = Json::array();
    if (const auto before = ui.find ("notes"); before != ui.end() && before->is_array())
        for (const auto& json : *before)
            if (! readNote (json)) all.push_back (json);
    for (const auto& note : notes)
        all.push_back (toJson (note));
    if (all.empty())
        ui.erase ("notes");
    else
        ui["notes"] = std::move (all);
    graph::SetHeader header { patch };
    header.ui = ui.empty() ? Json() : std::move (ui);
    return graph::Batch { std::move (step), { std::move (header) } };
}

}   // namespace tactus::host
