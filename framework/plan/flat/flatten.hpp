// SPDX-License-Identifier: MIT
#pragma once

#include "directory.hpp"

#include <set>
#include <span>

namespace tactus::plan
{

/// A value given from outside, for example with --set: 0.3 for "drag.mu", or 0…1 for the id of a control. It takes precedence
/// over the file.
struct Override
{
    std::string name;
    Json value;
};

struct Flattened
{
    Flat flat;
    std::unique_ptr<Scope> top;           ///< for finding ports by name; valid as long as the graph exists
    std::set<const graph::Patch*> used;   ///< the patches that were expanded
};

/// The treatment of settings that name files.
enum class SettingFiles
{
    read,
    left_out   ///< their nodes are not whole, and not asked about problems
};

/// Expands subgraphs, resolves names and reads values. Unknown node types become placeholders, with the message node/unknown_type.
Flattened flatten (const graph::Graph&, const Catalogue&, std::span<const Override>, Assets*, SettingFiles = SettingFiles::read);

/// Does the same for a subgraph that no node uses, as if it were a graph on its own. `spent` is the cost of compiling so far.
Flattened flattenUnused (const graph::Graph&, const std::string& subgraph, const graph::Patch&, const Catalogue&, Assets*, const Spent&,
                         SettingFiles = SettingFiles::read);

}   // namespace tactus::plan
