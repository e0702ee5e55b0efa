// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/text/message.hpp>

namespace tactus::host
{

/// Warnings about a graph that cannot be felt: one that has nodes, but none that reads a device (graph/no_hand), or none that drives one
/// (graph/no_motor). fixOf() adds what is missing.
Messages missingEnds (const graph::Graph&);

}   // namespace tactus::host
