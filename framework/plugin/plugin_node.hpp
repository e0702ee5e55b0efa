// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_plugin.h>

#include <tactus/node/catalogue.hpp>
#include <tactus/text/result.hpp>

#include <cstdint>
#include <memory>
#include <string>

namespace tactus::plugin
{

/// Checks a node of a plugin, and makes a node type of it. `library` stays loaded as long as the type or one of its nodes exists.
/// Error: plugin/bad_node, which names the file, the node and the row. [main thread]
/// For `state_layout`, see NodeType. `build` tells builds of the plugin apart, for saved states.
Result<NodeType> readNode (const tactus_plugin_node*, const std::string& file, std::shared_ptr<const void> library, std::uint32_t build,
                           std::string state_layout = {});

/// The fault of a node or its datasheet, as a sentence; empty if there is none. [main thread]
std::string faultOf (const tactus_plugin_node*);

}   // namespace tactus::plugin
