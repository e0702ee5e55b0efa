// SPDX-License-Identifier: MIT
#include "support/corpus.hpp"

#include <fuzz/wav_target.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("every file of the wav corpus is read or refused, as a recording and as a clip") { CHECK (test::replay ("wav", fuzz::tryWav) > 20); }
