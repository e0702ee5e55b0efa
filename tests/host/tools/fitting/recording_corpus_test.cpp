// SPDX-License-Identifier: MIT
#include "support/corpus.hpp"

#include <fuzz/recording_target.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("every file of the recording corpus is fitted or refused", "[fit]") { CHECK (test::replay ("recording", fuzz::tryRecording) > 10); }
