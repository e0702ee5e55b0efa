// SPDX-License-Identifier: MIT
#include "support/corpus.hpp"

#include <tests/fuzz/graph_target.hpp>
#include <tests/fuzz/units_target.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("every text of the units corpus is read or refused") { CHECK (test::replay ("units", fuzz::tryUnits) > 20); }
TEST_CASE ("every text of the graph corpus is stable, and runs, or is refused") { CHECK (test::replay ("graph", fuzz::tryGraph) > 20); }
