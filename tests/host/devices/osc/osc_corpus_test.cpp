// SPDX-License-Identifier: MIT
#include "support/corpus.hpp"

#include <fuzz/osc_target.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("every packet of the osc corpus is read or dropped") { CHECK (test::replay ("osc", fuzz::tryOsc) > 20); }
