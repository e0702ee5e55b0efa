// SPDX-License-Identifier: MIT
#include "support/corpus.hpp"

#include <fuzz/csv_target.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("every text of the csv corpus is read or refused") { CHECK (tactus::test::replay ("csv", tactus::fuzz::tryCsv) > 20); }
