// SPDX-License-Identifier: MIT
#pragma once

#include <framework/graph/graph.hpp>
#include <framework/message.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace tactus
{

struct TextPosition
{
    int line = 1, column = 1;
};

/// Where each key and element of a file stands, by JSON pointer.
using TextPositions = std::map<std::string, TextPosition, std::less<>>;

struct LoadedGraph
{
    graph::Graph graph;   ///< as much as could be read; whole if there are no errors
    Messages messages;
    TextPositions positions;   ///< to turn Message::where into line and column

    /// The position of a pointer or of its nearest parent that stands in the file.
    TextPosition positionOf (std::string_view pointer) const;
};

/// Reads a graph file (contract section 4): syntax, known keys and their kinds, wire texts, ids, version and migrations.
/// What only the catalogue knows is checked by compile. Never throws; text may be anything. [main thread]
LoadedGraph readGraph (std::string_view text);

/// Reads a file and the "file:" subgraphs it refers to, relative to its folder. [main thread]
LoadedGraph loadGraph (const std::filesystem::path&);

/// The text of a graph: stable under load-save-load, byte for byte, one node or wire a line where it fits.
std::string writeGraph (const graph::Graph&);

/// Writes through a temporary file beside it, so that a crash leaves the old file or the new one. [main thread]
Messages saveGraph (const graph::Graph&, const std::filesystem::path&);

}   // namespace tactus
