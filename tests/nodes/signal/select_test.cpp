// SPDX-License-Identifier: MIT
#include "support/rig.hpp"

#include <tactus/nodes/signal/select.hpp>

#include <catch2/catch.hpp>

TEST_CASE ("select: passes the input whose number is nearest", "[nodes][signal]")
{
    const auto [index, expected] = GENERATE (table<double, double> ({
        { 0.0, 10.0 },
        { 0.4, 10.0 },
        { 0.6, 11.0 },
        { 0.9999999, 11.0 },
        { 2.0, 12.0 },
        { 63.0, 12.0 },
    }));
    Rig rig { "signal.select" };
    rig.set ("inputs", 3.0).param ("index", index);
    rig.prepare();
    for (int i = 0; i < 3; ++i)
        rig.input ("in", 10.0 + i, i);
    rig.tick();
    INFO (index);
    CHECK (rig.out ("out") == expected);
}
