// SPDX-License-Identifier: MIT
#pragma once

#include "relaxed_json.hpp"

#include <tactus/text/message.hpp>

#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace tactus::readers
{

/// Thrown by the functions below, and caught where a clip file is read.
struct ClipProblem
{
    Message message;
};

/// A value in a file, and the way to it, so that a message can name its place. It refers to its parent, which must outlive it.
struct Spot
{
    const Json* json;
    const Spot* up = nullptr;
    std::string_view key = {};
    std::size_t index = 0;   ///< used if there is no key

    std::string pointer() const;
};

/// A clip file as JSON, with functions that return what they ask for or refuse the file.
class ClipJson
{
public:
    ClipJson (std::string_view text, std::string_view name);

    const Spot& root() const noexcept { return top; }

    [[noreturn]] void refuse (const Spot&, std::string id, std::string text, std::string remedy) const;

    /// A warning. Notes that differ only in their numbers are one, with a count.
    void note (const Spot&, std::string id, std::string text, std::string remedy);
    /// Warns of each key of an object that is not in a list: clip/not_carried.
    void noteOthers (const Spot& object, std::initializer_list<std::string_view> known);
    Messages takeNotes();   ///< all of them, at most most_messages

    std::optional<Spot> find (const Spot& object, std::string_view key) const;
    Spot need (const Spot& object, std::string_view key) const;   ///< refuses a missing key: clip/missing
    Spot object (const Spot&) const;                              ///< the same spot, if it is an object; else clip/kind
    Spot list (const Spot&) const;
    const std::string& text (const Spot&) const;
    double number (const Spot&) const;
    double number (const Spot&, double min, double max) const;   ///< else clip/range
    double numberOr (const Spot& object, std::string_view key, double otherwise, double min, double max) const;
    bool isText (const Spot& object, std::string_view key, std::string_view value) const;

    static Spot entry (const Spot& list, std::size_t index) { return { &(*list.json)[index], &list, {}, index }; }

    // A spot refers to its parent, so the parent must have a name.
    std::optional<Spot> find (const Spot&&, std::string_view) const = delete;
    Spot need (const Spot&&, std::string_view) const = delete;
    static Spot entry (const Spot&&, std::size_t) = delete;

private:
    struct Group
    {
        std::size_t index = 0, count = 1;   // in notes
        std::string last {};                // where the last of them was
    };

    std::string placeOf (const Spot&) const;

    std::string name;
    RelaxedJson read;
    Spot top;
    Messages notes;
    std::map<std::string, Group> groups;   // by the text without its numbers
    std::size_t dropped = 0;
};

}   // namespace tactus::readers
