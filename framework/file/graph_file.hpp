// SPDX-License-Identifier: MIT
#pragma once

/// Graph files: text to graph and back. Ids of the messages:
///
///     file/unreadable       the file cannot be opened or read
///     file/too_large        more than 64 MB
///     file/syntax           not JSON; line, column and what was expected there
///     file/too_deep         nested deeper than 64 levels, or a chain of more than 32 files
///     file/duplicate_key    a key twice in one object
///     file/not_a_graph      no object with "format": "tactus-graph"
///     file/newer_version    written by a newer Tactus
///     file/unknown_version  a version that never was
///     file/migration        an old file that is not as its version should be
///     file/missing_key      a key that must be there is not
///     file/wrong_kind       a text where an object belongs, …
///     file/bad_value        the right kind, but not a value that means anything there
///     file/unknown_key      warning: a key that is probably a misspelt one; it is kept
///     file/cycle            files that contain each other
///     file/more             there are more problems than are listed
///     graph/bad_id          an id that is not [a-z][a-z0-9_]*
///     graph/bad_path        a path to a port or parameter that cannot be read
///     wire/syntax           a wire text that cannot be read
///     unit/syntax           a text with a unit that cannot be read
///     output/unwritable     the file cannot be written

#include "text_position.hpp"

#include <framework/graph/graph.hpp>
#include <framework/message.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace tactus
{

struct LoadedGraph
{
    graph::Graph graph;   ///< as much as could be read; whole if there are no errors
    Messages messages;    ///< by line and column, which they carry
    TextPositions positions;

    /// The position of a pointer or of its nearest parent that stands in the file: for messages of later steps.
    TextPosition positionOf (std::string_view pointer) const;
};

/// Reads a graph file (contract section 4): syntax, known keys and their kinds, wire texts, ids, version and migrations.
/// What only the catalogue knows is checked by compile. Never throws; text may be anything. [main thread]
LoadedGraph readGraph (std::string_view text);

/// Reads a file and the "file:" subgraphs it refers to, relative to its folder. Its messages carry the name of the file
/// they are about. [main thread]
LoadedGraph loadGraph (const std::filesystem::path&);

/// The text of a graph: stable under load-save-load, byte for byte, one node or wire a line where it fits.
std::string writeGraph (const graph::Graph&);

/// Writes through a temporary file beside it, so that a crash leaves the old file or the new one. [main thread]
Messages saveGraph (const graph::Graph&, const std::filesystem::path&);

}   // namespace tactus
