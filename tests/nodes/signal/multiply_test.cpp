// SPDX-License-Identifier: MIT
#include "support/rig.hpp"

#include <tactus/nodes/signal/multiply.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("multiply: an unwired input counts as 1", "[nodes][signal]")
{
    Rig rig { "signal.multiply" };
    rig.set ("inputs", 3.0);
    rig.prepare();
    rig.tick();
    CHECK (rig.out ("out") == 1.0);

    rig.input ("in", 2.0, 0).input ("in", 0.25, 2);
    rig.tick();
    CHECK (rig.out ("out") == 0.5);
}
