// SPDX-License-Identifier: MIT
#include <tactus/node/lane_form.hpp>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <string>

using namespace tactus;

namespace
{
std::size_t lanesWith (const char* text)
{
    const char* before = std::getenv ("TACTUS_LANES");
    const std::string kept = before != nullptr ? before : "";
    setenv ("TACTUS_LANES", text, 1);
    const auto lanes = usualLanes();
    if (before != nullptr)
        setenv ("TACTUS_LANES", kept.c_str(), 1);
    else
        unsetenv ("TACTUS_LANES");
    return lanes;
}
}   // namespace

TEST_CASE ("TACTUS_LANES limits the width of packs, and counts as not set if it is not a number", "[lanes]")
{
    const auto widest = widestLanes();
    REQUIRE ((widest == 2 || widest == 4 || widest == 8));
    REQUIRE (lanesWith ("1") == 1);
    REQUIRE (lanesWith ("2") == 2);
    REQUIRE (lanesWith ("0") == 1);
    REQUIRE (lanesWith ("64") == widest);
    for (const auto* text : { "", "abc", "-1", "4x", " 2", "99999999999999999999999" })
    {
        INFO ('"' << text << '"');
        REQUIRE (lanesWith (text) == widest);
    }
}
