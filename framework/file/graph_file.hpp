// SPDX-License-Identifier: MIT
#pragma once

/// Graph files: text to graph and back. Messages:
///
///     file/unreadable       the file cannot be opened or read
///     file/too_large        exceeds the budget `file`, `values` or `reading` (framework/text/budget.hpp)
///     file/too_many         includes more files than the budget `files` allows
///     file/syntax           not JSON; with line, column and what was expected
///     file/too_deep         nested deeper than 64 levels, or a chain of more than 32 files
///     file/duplicate_key    a key twice in one object
///     file/not_a_graph      no object with "format": "tactus-graph"
///     file/newer_version    written by a newer Tactus
///     file/unknown_version  a version that never existed
///     file/migration        an old file that does not conform to its version
///     file/missing_key      a required key is missing
///     file/wrong_kind       a string instead of an object, …
///     file/bad_value        the right kind, but a meaningless value
///     file/unknown_key      warning: a key that is probably misspelt; it is kept
///     file/cycle            files that include each other
///     file/more             there are more problems than are listed
///     graph/bad_id          an id that is not [a-z][a-z0-9_]*
///     graph/bad_path        an invalid path to a port or parameter
///     wire/syntax           a wire that cannot be parsed
///     unit/syntax           a value with a unit that cannot be parsed
///     output/unwritable     the file cannot be written

#include <tactus/graph/graph.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/result.hpp>
#include <tactus/text/text_position.hpp>

#include <filesystem>
#include <string>
#include <string_view>

namespace tactus
{

struct LoadedGraph
{
    graph::Graph graph;   ///< everything that could be read; complete if there are no errors
    Messages messages;    ///< sorted by line and column
    TextPositions positions;
    double values = 0.0;   ///< how many JSON values the text has

    /// The position of the value at a pointer, or of its nearest parent that exists in the file; for messages of later steps.
    TextPosition positionOf (std::string_view pointer) const;
};

/// Reads a graph file (contract section 4): syntax, known keys and their kinds, wires, ids, version and migrations.
/// Everything that needs the catalogue is checked by compile. Does not throw; accepts any text. A text with more than `most_values`
/// JSON values is refused. [main thread]
LoadedGraph readGraph (std::string_view text, double most_values = budgets().values);

/// Reads a file and the "file:" subgraphs it refers to, relative to its folder. Each message has the name of its file.
/// [main thread]
LoadedGraph loadGraph (const std::filesystem::path&);

/// The text of a graph, with one node or wire per line where it fits. Loading and saving it again gives the same bytes.
std::string writeGraph (const graph::Graph&);

/// Writes through a temporary file in the same folder, so that a crash leaves either the old file or the new one.
/// Error: output/unwritable. [main thread]
Result<> saveGraph (const graph::Graph&, const std::filesystem::path&);

}   // namespace tactus
