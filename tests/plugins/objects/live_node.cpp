// SPDX-License-Identifier: MIT
#include <tactus/plugin/node_plugin.hpp>

#include "live_node.hpp"

TACTUS_PLUGIN (live::Growing)
