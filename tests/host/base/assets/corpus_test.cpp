// SPDX-License-Identifier: MIT
#include "support/corpus.hpp"

#include <fuzz/image_target.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("every file of the image corpus is read or refused") { CHECK (test::replay ("image", fuzz::tryImage) > 10); }
