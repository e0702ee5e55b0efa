// SPDX-License-Identifier: MIT
#include "support/rig.hpp"

#include <tactus/nodes/signal/expression.hpp>

#include <catch2/catch.hpp>

#include <string>

TEST_CASE ("expression node: computes its formula of its inputs", "[nodes][signal]")
{
    Rig rig { "signal.expression" };
    rig.set ("inputs", 3.0).set ("text", std::string { "in0 * abs (in1) + in[2]" });
    CHECK (rig.problem() == "");
    rig.prepare();
    rig.input ("in", 2.0, 0).input ("in", -3.0, 1).input ("in", 0.5, 2);
    rig.tick();
    CHECK (rig.out ("out") == 6.5);
}

TEST_CASE ("expression node: a result that is not finite is given as 0", "[nodes][signal]")
{
    Rig rig { "signal.expression" };
    rig.set ("text", std::string { "1 / in0" });
    rig.prepare();
    rig.tick();
    CHECK (rig.out ("out") == 0.0);
    rig.input ("in", 4.0, 0);
    rig.tick();
    CHECK (rig.out ("out") == 0.25);
}

TEST_CASE ("expression node: a formula that does not fit the node is a problem, and gives 0", "[nodes][signal]")
{
    Rig rig { "signal.expression" };
    rig.set ("text", std::string { "in0 + in2" });
    CHECK (rig.problem() == "column 7: there is no input 2; the inputs are in0 to in1");
    rig.prepare();
    rig.input ("in", 4.0, 0);
    rig.tick();
    CHECK (rig.out ("out") == 0.0);
}
