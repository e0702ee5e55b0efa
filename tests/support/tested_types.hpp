// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/catalogue.hpp>

namespace tactus::test
{

/// The node types that every_node_test.cpp and every_datasheet_test.cpp examine. Each test program has its own:
/// tactus_node_tests the whole catalogue, tactus_plugin_tests the nodes of a plugin.
const Catalogue& testedTypes();

}   // namespace tactus::test
