// SPDX-License-Identifier: MIT
#include "support/corpus.hpp"

#include <fuzz/mesh_target.hpp>
#include <fuzz/table_target.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("every file of the mesh corpus is read or refused") { CHECK (test::replay ("mesh", fuzz::tryMesh) > 20); }
TEST_CASE ("every text of the table corpus is read or refused") { CHECK (test::replay ("table", fuzz::tryTable) > 20); }
