// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/edit.hpp>

namespace tactus::host
{

/// Snapshots and sources are stored under `ui`, by the names of nodes. Returns the command together with what keeps them right if it
/// renames, groups or ungroups nodes; otherwise, the command as it is.
graph::Command withNamesKept (const graph::Graph&, graph::Command);

}   // namespace tactus::host
