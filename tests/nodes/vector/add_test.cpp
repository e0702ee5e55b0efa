// SPDX-License-Identifier: MIT
#include "support/rig.hpp"

#include <tactus/nodes/vector/add.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("vector add: adds by component, unwired inputs as 0", "[nodes][vector]")
{
    Rig rig { "vector.add" };
    rig.set ("inputs", 3.0);
    rig.prepare();
    for (int i = 0; i < 3; ++i)
        rig.input ("in", 1.0 + i, i).input ("in", 10.0 * i, 6 + i);
    rig.tick();
    CHECK (rig.vector ("out") == tactus::Vec3 { 1.0, 12.0, 23.0 });
}
