// SPDX-License-Identifier: GPL-3.0-or-later
#include "notes.hpp"

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
    const auto* in = patch.empty() ? &g.extra : g.find (patch) != nullptr ? &g.find (patch)->extra
                                                                          : nullptr;
    if (in == nullptr) return Json::object();
    const auto ui = in->find ("ui");
    return ui != in->end() && ui->is_object() ? *ui : Json::object();
}

std::optional<juce::Point<float>> readPair (const Json& note, const char* key)
{
    const auto pair = note.find (key);
    if (pair == note.end() || ! pair->is_array() || pair->size() != 2 || ! (*pair)[0].is_number() || ! (*pair)[1].is_number()) return std::nullopt;
    const auto x = (*pair)[0].get<double>(), y = (*pair)[1].get<double>();
    if (! (std::abs (x) < 1e6 && std::abs (y) < 1e6)) return std::nullopt;
    return juce::Point<float> (static_cast<float> (x), static_cast<float> (y));
}

std::optional<Note> readNote (const Json& json)
{
    if (! json.is_object()) return std::nullopt;
    const auto at = readPair (json, "at"), size = readPair (json, "size");
    const auto text = json.find ("text");
    if (! at || ! size || text == json.end() || ! text->is_string()) return std::nullopt;
    Note note { { at->x, at->y, std::clamp (size->x, smallest, largest), std::clamp (size->y, smallest, largest) }, text->get<std::string>(), {}, json };
    if (const auto colour = json.find ("colour"); colour != json.end() && colour->is_string() && std::ranges::count (note_colours, colour->get<std::string>()) > 0)
        note.colour = colour->get<std::string>();
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
