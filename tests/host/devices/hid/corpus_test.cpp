// SPDX-License-Identifier: MIT
#include "hid.hpp"
#include "support/corpus.hpp"

#include <fuzz/descriptor_target.hpp>
#include <fuzz/profile_target.hpp>

using namespace tactus;

TEST_CASE ("every file of the descriptor corpus is read or refused") { CHECK (test::replay ("descriptor", fuzz::tryDescriptor) > 20); }
TEST_CASE ("every text of the profile corpus is read or refused") { CHECK (test::replay ("profile", fuzz::tryProfile) > 20); }
TEST_CASE ("every file of the report corpus is decoded or refused by every profile")
{
    const auto tryAll = [] (std::string_view report) {
        for (const auto& profile : test::profiles())
            fuzz::tryReport (profile, report);
    };
    CHECK (test::replay ("report", tryAll) > 20);
}
