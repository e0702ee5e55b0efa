// SPDX-License-Identifier: MIT
#include <tactus/plan/steps/inline_array.hpp>

#include <catch2/catch.hpp>

#include <atomic>
#include <numeric>

using tactus::plan::InlineArray;

TEST_CASE ("a list with room for a few elements holds any number of them", "[plan]")
{
    for (std::size_t size = 0; size < 6; ++size)
    {
        InlineArray<int, 2> list (size);
        CHECK (list.size() == size);
        CHECK (list.empty() == (size == 0));
        CHECK (std::accumulate (list.begin(), list.end(), 0) == 0);
        for (std::size_t i = 0; i < size; ++i)
            list[i] = static_cast<int> (i) + 1;
        CHECK (std::accumulate (list.begin(), list.end(), 0) == static_cast<int> (size * (size + 1) / 2));
    }
    InlineArray<std::atomic<int>, 1> atomics (3);
    atomics[2] = 5;
    CHECK (atomics[0] == 0);
    CHECK (atomics[2] == 5);
}
