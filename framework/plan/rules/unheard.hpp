// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/text/message.hpp>

#include <span>
#include <string>

namespace tactus::plan
{

/// Warns about nodes that are computed for nothing (node/no_effect): their outputs reach no node that drives a device, no exposed output,
/// none of the ports that are recorded or probed ("drag.force"), and no section with `times`, which is there to be heard or recorded. Of
/// a chain of such nodes, only the last is named. A wire that is switched off counts. A graph without any end, which somebody is going
/// to record, gets no warning. compile() does not call this, because a graph that is being edited often has such nodes. [main thread]
Messages unheardNodes (const graph::Graph&, const Catalogue&, std::span<const std::string> recorded = {});

}   // namespace tactus::plan
