// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/cli/program.hpp"

#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

using namespace tactus;
using tactus::test::runTactus;

TEST_CASE ("bench confirms that all variants agree, and reports every ratio", "[cli]")
{
    const auto ran = runTactus ({ "bench", "--json", "--quick" });
    INFO (ran.err);
    REQUIRE (ran.status == 0);
    const auto result = Json::tryParse (ran.out).value_or (Json());
    REQUIRE (result.is_object());

    CHECK (result.at ("agree") == true);
    CHECK (result.at ("bytes_per_node").get<double>() > 0.0);
    CHECK (result.at ("bytes_per_node").get<double>() <= 128.0);
    std::vector keys { "plan/hand", "light_plan/hand", "dry_wood_plan/hand", "export/hand", "export/faust_chain100", "juce/plan", "juce_tree100/plan",
                       "plan/faust_chain100", "juce_rebuild1000/compile1000", "compile10000/compile1000", "fused/hand", "juce/fused",
                       "juce_tree100/fused", "takeover10000/tick", "knob10000/tick" };
    for (const auto* key : keys)
    {
        INFO (key);
        const auto& ratio = result.at ("ratios").at (key);
        const auto low = ratio.at ("low").get<double>(), median = ratio.at ("median").get<double>(), high = ratio.at ("high").get<double>();
        CHECK ((0.0 < low && low <= median && median <= high && std::isfinite (high)));
    }
}
