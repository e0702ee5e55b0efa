// SPDX-License-Identifier: MIT
#include "support/rig.hpp"

#include <tactus/nodes/signal/add.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("add: an unwired input counts as 0", "[nodes][signal]")
{
    Rig rig { "signal.add" };
    rig.set ("inputs", 3.0);
    rig.prepare();
    rig.input ("in", 2.0, 0).input ("in", 0.5, 2);
    rig.tick();
    CHECK (rig.out ("out") == 2.5);
}

TEST_CASE ("add: one nan input silences the sum", "[nodes][signal]")
{
    Rig rig { "signal.add" };
    rig.prepare();
    rig.input ("in", 2.0, 0).input ("in", -tactus::inf, 1);
    rig.tick();
    CHECK (rig.out ("out") == 0.0);
}

TEST_CASE ("add: takes as many inputs as a list can have", "[nodes][signal]")
{
    Rig rig { "signal.add" };
    rig.set ("inputs", double { tactus::list_capacity });
    rig.prepare();
    for (int i = 0; i < tactus::list_capacity; ++i)
        rig.input ("in", i, i);
    rig.tick();
    CHECK (rig.out ("out") == 64 * 63 / 2);
}
