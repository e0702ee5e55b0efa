// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/plan/flat/grouped.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tactus::plan;

TEST_CASE ("grouped: each group keeps its items in order", "[plan][grouped]")
{
    tactus::test::property ("like a list per group", [] {
        constexpr std::size_t groups = 7;
        const auto items = *rc::gen::container<std::vector<std::pair<std::size_t, int>>> (
            rc::gen::pair (rc::gen::inRange<std::size_t> (0, groups), rc::gen::arbitrary<int>()));
        std::vector<std::vector<int>> wanted (groups);
        for (const auto& [group, item] : items)
            wanted[group].push_back (item);

        const Grouped<int> grouped (groups, [&] (auto visit) {
            for (const auto& [group, item] : items)
                visit (group, item);
        });
        for (std::size_t g = 0; g < groups; ++g)
            RC_ASSERT (std::ranges::equal (grouped[g], wanted[g]));
    });
}
