// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/edit.hpp>

#include <string>
#include <string_view>
#include <vector>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// A comment on the canvas. With a colour it is a region behind a group of nodes; moving the region moves them.
struct Note
{
    juce::Rectangle<float> area;   ///< canvas units
    std::string text, colour;      ///< colour: one of note_colours, or empty
    Json extra = Json::object();   ///< unknown keys

    bool isRegion() const noexcept { return ! colour.empty(); }
};

inline constexpr std::string_view note_colours[] { "blue", "orange", "green", "purple", "yellow", "grey" };

/// Reads the notes of a patch from its `ui`. Entries that are not notes are kept but not shown.
std::vector<Note> notesOf (const graph::Graph&, const std::string& patch);

/// Replaces the notes of a patch as one undo step of that name.
graph::Command setNotes (const graph::Graph&, const std::string& patch, const std::vector<Note>&, std::string step);

/// A note is identified by its index. In a selection it gets an id that no node or wire has.
constexpr graph::Id note_bit = graph::Id { 1 } << 63;
constexpr graph::Id noteId (std::size_t i) noexcept { return note_bit | i; }
constexpr bool isNote (graph::Id id) noexcept { return (id & note_bit) != 0; }
constexpr std::size_t noteOf (graph::Id id) noexcept { return static_cast<std::size_t> (id & ~note_bit); }

}   // namespace tactus::host
