// SPDX-License-Identifier: MIT
#include "support/parted.hpp"

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::test;

TEST_CASE ("the delay of a section on the path from hand to motor is reported in ticks of the graph", "[plan][rates]")
{
    const auto warnings = [] (Json rate, const std::string& inside, const std::string& outside = "sec.out -> motor.force.x") {
        auto graph = fromHandToMotor (std::move (rate), inside, outside);
        return graph.compile().messages;
    };
    CHECK (warnings (every (4), "split.x -> late.in").empty());

    const auto inside = warnings (every (4), "split.x -> [2] -> late.in");
    REQUIRE (inside.size() == 1);
    CHECK (inside[0].id == "rate/late");
    CHECK (inside[0].where == "/graphs/part/wires/0");
    CHECK (inside[0].text.find ("'hand' to 'motor' by 8 ticks") != std::string::npos);

    const auto lines = warnings (every (4, "linear"), "split.x -> late.in");
    REQUIRE (lines.size() == 1);
    CHECK (lines[0].id == "rate/late");
    CHECK (lines[0].where == "/wires/1");
    CHECK (lines[0].text.find ("by 4 ticks") != std::string::npos);

    const auto outside = warnings (every (4), "split.x -> late.in", "sec.out -> [2] -> motor.force.x");
    REQUIRE (outside.size() == 1);
    CHECK (outside[0].text.find ("by 2 ticks") != std::string::npos);
}

TEST_CASE ("a delaying node between hand and motor is reported, but one in a loop is not", "[plan][rates]")
{
    auto sketch = Sketch {}
                      .node ("hand", "device.position")
                      .node ("split", "vector.split")
                      .node ("f", "signal.multiply")
                      .node ("k", "signal.constant", { { "value", "1 N/m" } })
                      .node ("late", "signal.delay", Json::object(), { { "ticks", 3 } })
                      .node ("motor", "device.force");
    sketch.wire ("hand.position -> split.in").wire ("split.x -> f.in[0]").wire ("k.out -> f.in[1]");
    SECTION ("between")
    {
        sketch.wire ("f.out -> late.in").wire ("late.out -> motor.force.x");
        const auto messages = sketch.compile().messages;
        REQUIRE (has (messages, "rate/late"));
        CHECK (messages[0].text.find ("'late' (signal.delay) delays the path from 'hand' to 'motor' by 3 ticks") != std::string::npos);
    }
    SECTION ("in a loop")
    {
        sketch.node ("sum", "signal.add")
            .wire ("f.out -> sum.in[0]")
            .wire ("sum.out -> late.in")
            .wire ("late.out -> sum.in[1]")
            .wire ("sum.out -> motor.force.x");
        CHECK (sketch.compile().messages.empty());
    }
    SECTION ("on a path that does not start at the hand")
    {
        sketch.node ("beat", "signal.lfo")
            .node ("n", "signal.multiply")
            .node ("one", "signal.constant", { { "value", "1 N" } })
            .wire ("beat.out -> late.in")
            .wire ("late.out -> n.in[0]")
            .wire ("one.out -> n.in[1]")
            .wire ("n.out -> motor.force.x")
            .wire ("f.out -> motor.force.x");
        CHECK (sketch.compile().messages.empty());
    }
}
