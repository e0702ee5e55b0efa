// SPDX-License-Identifier: MIT
#pragma once

#include "directory.hpp"

#include <set>
#include <span>

namespace tactus::plan
{

/// A value given from outside, as by --set: "drag.mu" to "0.3", or a control's id to 0…1. It outranks the file.
struct Override
{
    std::string name;
    Json value;
};

struct Flattened
{
    Flat flat;
    std::unique_ptr<Scope> top;           ///< to find ports by name; lives as long as the graph
    std::set<const graph::Patch*> used;   ///< the patches that were expanded
};

/// Expands, resolves and reads. Unknown node types become placeholders, with the message node/unknown_type.
Flattened flatten (const graph::Graph&, const Catalogue&, std::span<const Override>, Assets*);

/// The same for a subgraph that no node uses, as if it stood alone.
Flattened flattenUnused (const graph::Graph&, const std::string& subgraph, const Catalogue&, Assets*);

}   // namespace tactus::plan
