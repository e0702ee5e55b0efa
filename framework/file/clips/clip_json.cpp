// SPDX-License-Identifier: MIT
#include "clip_json.hpp"

#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <utility>

namespace tactus::readers
{

std::string Spot::pointer() const
{
    if (up == nullptr) return {};
    return up->pointer() + "/" + (key.empty() ? std::to_string (index) : pointerPart (key));
}

ClipJson::ClipJson (std::string_view text, std::string_view name_) : name (name_), read (readRelaxedJson (text)), top { &read.json.root }
{
    for (const auto& m : read.json.messages)
    {
        const auto place = name + ":" + std::to_string (m.line) + ":" + std::to_string (m.column);
        if (m.id == "file/duplicate_key")
        {
            if (notes.size() < most_messages) notes.push_back (Message::warning ("clip/habit", place, m.text + "; the first one counts", m.remedy));
        }
        else
            throw ClipProblem { Message::error (m.id == "file/too_large" ? "clip/too_large" : "clip/syntax", place, m.text, m.remedy) };
    }
    for (const auto& habit : read.habits)
    {
        const auto place = name + ":" + std::to_string (habit.first.line) + ":" + std::to_string (habit.first.column);
        const auto more = habit.count > 1 ? ", " + std::to_string (habit.count) + " times" : std::string {};
        notes.push_back (Message::warning ("clip/habit", place, "the file has " + habit.what + more + ", which plain JSON does not allow; they are accepted",
                                           "no action is needed, or remove them for stricter programs"));
    }
    if (! read.json.root.is_object())
        throw ClipProblem { Message::error ("clip/kind", name + ":1:1", "the file is not a JSON object", "check that it is a clip") };
}

std::string ClipJson::placeOf (const Spot& spot) const
{
    const auto position = positionOf (read.json.positions, spot.pointer());
    return name + ":" + std::to_string (position.line) + ":" + std::to_string (position.column);
}

void ClipJson::refuse (const Spot& spot, std::string id, std::string text, std::string remedy) const
{
    const auto pointer = spot.pointer();
    throw ClipProblem { Message::error (std::move (id), placeOf (spot), (pointer.empty() ? "" : pointer + ": ") + std::move (text), std::move (remedy)) };
}

void ClipJson::note (const Spot& spot, std::string id, std::string text, std::string remedy)
{
    auto kind = id + " " + text;
    std::erase_if (kind, [] (char c) { return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e'; });
    const auto pointer = spot.pointer();
    if (const auto known = groups.find (kind); known != groups.end())
    {
        ++known->second.count;
        known->second.last = pointer;
        return;
    }
    if (notes.size() >= most_messages)
    {
        ++dropped;
        return;
    }
    groups[kind] = { .index = notes.size() };
    notes.push_back (Message::warning (std::move (id), placeOf (spot), (pointer.empty() ? "" : pointer + ": ") + std::move (text), std::move (remedy)));
}

void ClipJson::noteOthers (const Spot& spot, std::initializer_list<std::string_view> known)
{
    if (! spot.json->is_object()) return;
    for (const auto& [key, value] : spot.json->items())
        if (std::ranges::find (known, key) == known.end())
            note ({ &value, &spot, key }, "clip/not_carried", quote (key) + " is left out: the format has no such key here", "check its spelling");
}

Messages ClipJson::takeNotes()
{
    for (const auto& [kind, group] : groups)
        if (group.count > 1) notes[group.index].text += "; and " + std::to_string (group.count - 1) + " more like it, the last at " + group.last;
    groups.clear();
    if (dropped > 0) notes.back().text += "; " + std::to_string (dropped) + " other warnings are not listed";
    return std::move (notes);
}

std::optional<Spot> ClipJson::find (const Spot& spot, std::string_view key) const
{
    for (const auto& [name_here, value] : spot.json->items())
        if (name_here == key) return Spot { &value, &spot, name_here };
    return {};
}

Spot ClipJson::need (const Spot& spot, std::string_view key) const
{
    if (const auto found = find (spot, key)) return *found;
    refuse (spot, "clip/missing", "there is no " + quote (key), "add it, or check its spelling");
}

Spot ClipJson::object (const Spot& spot) const
{
    if (! spot.json->is_object()) refuse (spot, "clip/kind", std::string ("it is a ") + spot.json->type_name() + ", not an object", "check the format");
    return spot;
}

Spot ClipJson::list (const Spot& spot) const
{
    if (! spot.json->is_array()) refuse (spot, "clip/kind", std::string ("it is a ") + spot.json->type_name() + ", not a list", "check the format");
    return spot;
}

const std::string& ClipJson::text (const Spot& spot) const
{
    if (! spot.json->is_string()) refuse (spot, "clip/kind", std::string ("it is a ") + spot.json->type_name() + ", not a text", "check the format");
    return spot.json->asString();
}

double ClipJson::number (const Spot& spot) const
{
    if (! spot.json->is_number()) refuse (spot, "clip/kind", std::string ("it is a ") + spot.json->type_name() + ", not a number", "check the format");
    return spot.json->get<double>();
}

double ClipJson::number (const Spot& spot, double min, double max) const
{
    const double v = number (spot);
    if (! (v >= min && v <= max))
        refuse (spot, "clip/range", numberText (v) + " is not between " + numberText (min) + " and " + numberText (max), "correct it");
    return v;
}

double ClipJson::numberOr (const Spot& spot, std::string_view key, double otherwise, double min, double max) const
{
    const auto found = find (spot, key);
    return found ? number (*found, min, max) : otherwise;
}

bool ClipJson::isText (const Spot& spot, std::string_view key, std::string_view value) const
{
    const auto found = find (spot, key);
    return found && found->json->is_string() && found->json->asString() == value;
}

}   // namespace tactus::readers
