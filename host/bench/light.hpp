// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "variant.hpp"

#include <tactus/graph/graph.hpp>
#include <tactus/node/catalogue.hpp>

#include <memory>

namespace tactus::bench
{

/// The wiring of the reference graph with the kernels of light_nodes.hpp in place of the large ones, and the types of these.
graph::Graph lightGraph();
Catalogue lightTypes();

/// The same as one would write it without a framework.
std::unique_ptr<Variant> lightByHand();

}   // namespace tactus::bench
