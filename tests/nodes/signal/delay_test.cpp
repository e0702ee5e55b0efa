// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/delay.hpp>

#include <catch2/catch.hpp>

using tactus::nodes::Delay;

namespace
{
Delay delayOf (int ticks)
{
    Delay node;
    node.settings.ticks = ticks;
    node.prepare ({});
    return node;
}
}   // namespace

TEST_CASE ("delay: gives each sample that many ticks later, and 0 before the first", "[nodes][signal]")
{
    const int ticks = GENERATE (1, 2, 7);
    auto node = delayOf (ticks);
    for (int k = 0; k < 50; ++k)
    {
        CHECK (node.peek().out == (k < ticks ? 0.0 : 100.0 + k - ticks));
        node.tick ({ .in = 100.0 + k });
    }
}

TEST_CASE ("delay: a line of a different length keeps the samples that fit", "[nodes][signal]")
{
    auto old = delayOf (3);
    for (const double v : { 1.0, 2.0, 3.0, 4.0 })
        old.tick ({ .in = v });   // 2, 3, 4 are in the line

    SECTION ("a shorter one keeps the newest")
    {
        auto node = delayOf (2);
        node.adopt (old);
        CHECK (node.peek().out == 3.0);
        node.tick ({ .in = 5.0 });
        CHECK (node.peek().out == 4.0);
        node.tick ({ .in = 6.0 });
        CHECK (node.peek().out == 5.0);
    }
    SECTION ("a longer one repeats the oldest, without a step to 0")
    {
        auto node = delayOf (5);
        node.adopt (old);
        for (const double expected : { 2.0, 2.0, 2.0, 3.0, 4.0, 9.0 })
        {
            CHECK (node.peek().out == expected);
            node.tick ({ .in = 9.0 });
        }
    }
}
