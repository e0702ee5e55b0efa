// SPDX-License-Identifier: MIT
#include "support/rig.hpp"

#include <tactus/nodes/signal/mix.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("mix: each input has its own gain, 1 by default", "[nodes][signal]")
{
    Rig rig { "signal.mix" };
    rig.set ("inputs", 3.0).param ("gain", 0.5, 2);
    rig.prepare();
    rig.input ("in", 1.0, 0).input ("in", 10.0, 1).input ("in", 100.0, 2);
    rig.tick();
    CHECK (rig.out ("out") == 61.0);
}
