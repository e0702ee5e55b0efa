// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The removal of nodes, with what was made for them.

#include <tactus/graph/edit.hpp>
#include <tactus/node/catalogue.hpp>

namespace tactus::host::compose
{

/// A command that removes nodes, extended by what they leave without effect: the controls that set nothing else, and the layers of mixers into which only
/// removed subgraphs were wired, with the gates between them, but not the last layer of a mixer.
graph::Command withLeftovers (const graph::Graph&, graph::Batch removal, const Catalogue&);

}   // namespace tactus::host::compose
