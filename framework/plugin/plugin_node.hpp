// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_plugin.h>

#include <tactus/node/catalogue.hpp>
#include <tactus/text/result.hpp>

#include <memory>
#include <string>

namespace tactus::plugin
{

/// Checks a node of a plugin, and makes a node type of it. `library` stays loaded as long as the type or one of its nodes exists.
/// Error: plugin/bad_node, which names the file, the node and the row. [main thread]
/// For `state_layout`, see sharesState.
Result<NodeType> readNode (const tactus_plugin_node*, const std::string& file, std::shared_ptr<const void> library, std::string state_layout = {});

/// True if a node of `now` may adopt a node of `then`: both types are from plugins, have the same id, and were read with the same
/// `state_layout`, which is not empty. In doing so, the caller of readNode states that their nodes have the same layout in memory. [any
/// thread]
bool sharesState (const NodeType& now, const NodeType& then);

/// What is wrong with a node and its datasheet, as a sentence; empty if nothing is. [main thread]
std::string faultOf (const tactus_plugin_node*);

}   // namespace tactus::plugin
