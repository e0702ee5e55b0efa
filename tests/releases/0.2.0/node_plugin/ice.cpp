// SPDX-License-Identifier: MIT
#include "ice.hpp"

#include <tactus/plugin/node_plugin.hpp>

TACTUS_PLUGIN (my::Ice)
