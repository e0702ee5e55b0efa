// SPDX-License-Identifier: MIT
#include "support/corpus.hpp"

#include <fuzz/graph_target.hpp>
#include <fuzz/units_target.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("every file of the units corpus is either read or refused") { CHECK (test::replay ("units", fuzz::tryUnits) > 20); }
TEST_CASE ("every file of the graph corpus is either stable and runs, or is refused") { CHECK (test::replay ("graph", fuzz::tryGraph) > 20); }
