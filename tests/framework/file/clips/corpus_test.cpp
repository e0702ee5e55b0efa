// SPDX-License-Identifier: MIT
#include "support/corpus.hpp"

#include <fuzz/clip_target.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("every file of the clip corpus is read or refused", "[clips]") { CHECK (test::replay ("clip", fuzz::tryClip) > 20); }
