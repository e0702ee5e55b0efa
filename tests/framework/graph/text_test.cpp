// SPDX-License-Identifier: MIT
#include <tactus/graph/endpoint_text.hpp>

#include <catch2/catch.hpp>

using namespace tactus::graph;
using Catch::Matchers::Contains;

namespace
{
template <typename Result>
std::string refusal (const Result& result)
{
    return result ? "" : result.error().text;
}

std::string again (std::string_view wire)
{
    const auto result = parseWire (wire);
    return result ? toText (*result) : refusal (result);
}
}   // namespace

TEST_CASE ("an id consists of lower-case letters, digits and underscores")
{
    CHECK (isId ("a"));
    CHECK (isId ("d_max2"));
    CHECK_FALSE (isId (""));
    CHECK_FALSE (isId ("2d"));
    CHECK_FALSE (isId ("_a"));
    CHECK_FALSE (isId ("dMax"));
    CHECK_FALSE (isId ("a-b"));
    CHECK_FALSE (isId ("ä"));
}

TEST_CASE ("an endpoint is read part by part")
{
    CHECK (*parseEndpoint ("hand.position") == (Endpoint { "hand", "position", -1, -1 }));
    CHECK (*parseEndpoint ("hand.position.x") == (Endpoint { "hand", "position", -1, 0 }));
    CHECK (*parseEndpoint ("split.x") == (Endpoint { "split", "x", -1, -1 }));
    CHECK (*parseEndpoint ("mix.in[2]") == (Endpoint { "mix", "in", 2, -1 }));
    CHECK (*parseEndpoint ("mix.in[2].z") == (Endpoint { "mix", "in", 2, 2 }));
    CHECK (*parseEndpoint (" grain/wave.phase ") == (Endpoint { "grain/wave", "phase", -1, -1 }));
    CHECK (*parseEndpoint ("finger[3].x") == (Endpoint { "finger[3]", "x", -1, -1 }));
    CHECK (*parseEndpoint ("finger[*]/drag.mu") == (Endpoint { "finger[*]/drag", "mu", -1, -1 }));
    CHECK (*parseEndpoint ("finger[03]/drag.mu") == (Endpoint { "finger[3]/drag", "mu", -1, -1 }));
    CHECK (*parseOverride ("[3]/drag.mu") == (Endpoint { "[3]/drag", "mu", -1, -1 }));
    CHECK (*parseOverride ("drag.mu") == (Endpoint { "drag", "mu", -1, -1 }));
}

TEST_CASE ("a malformed endpoint is refused with a message that says what was expected")
{
    CHECK_THAT (refusal (parseEndpoint ("")), Contains ("found nothing"));
    CHECK_THAT (refusal (parseEndpoint ("hand")), Contains ("the port is missing"));
    CHECK_THAT (refusal (parseEndpoint ("hand.")), Contains ("expected the id of a port before the end"));
    CHECK_THAT (refusal (parseEndpoint (".x")), Contains ("expected the id of a node before '.x'"));
    CHECK_THAT (refusal (parseEndpoint ("Hand.x")), Contains ("lower-case letters"));
    CHECK_THAT (refusal (parseEndpoint ("hand.position.w")), Contains ("not .w"));
    CHECK_THAT (refusal (parseEndpoint ("grain.wave.phase")), Contains ("reached with a /"));
    CHECK_THAT (refusal (parseEndpoint ("mix.in[-1]")), Contains ("entry of an array port"));
    CHECK_THAT (refusal (parseEndpoint ("mix.in[9999999999]")), Contains ("entry of an array port"));
    CHECK_THAT (refusal (parseEndpoint ("finger[].x")), Contains ("instance"));
    CHECK_THAT (refusal (parseEndpoint ("finger[1.x")), Contains ("instance"));
    CHECK_THAT (refusal (parseEndpoint ("a.b.x.y")), Contains ("'.y'"));
    CHECK_THAT (refusal (parseEndpoint ("[3]/drag.mu")), Contains ("the id of a node"));
    CHECK_THAT (refusal (parseOverride ("[3].mu")), Contains ("a / should follow"));
}

TEST_CASE ("the text of a wire reads back as it was written")
{
    for (const auto* text : { "a.out -> b.in", "a.out -> [1] -> b.in", "a.out -> (+) b.mu", "a.out.x -> [3] -> (+) b.mu[2].y",
                              "finger[3]/drag.force -> motor.force", "finger[*].force -> motor.force" })
        CHECK (again (text) == text);
    CHECK (again ("  a.out->b.in ") == "a.out -> b.in");
    CHECK (again ("a.out->[ 2 ]->(+)b.in") == "a.out -> [2] -> (+) b.in");
}

TEST_CASE ("the text of a malformed wire is refused with the correct form")
{
    CHECK_THAT (refusal (parseWire ("a.out b.in")), Contains ("the -> is missing"));
    CHECK_THAT (refusal (parseWire ("a.out → b.in")), Contains ("the -> is missing"));
    CHECK_THAT (refusal (parseWire ("a -> b.in")), Contains ("the start of the wire") && Contains ("port is missing"));
    CHECK_THAT (refusal (parseWire ("a.out -> ")), Contains ("the end of the wire"));
    CHECK_THAT (refusal (parseWire ("a.out -> [0] -> b.in")), Contains ("from 1 to"));
    CHECK_THAT (refusal (parseWire ("a.out -> [1.5] -> b.in")), Contains ("whole number of ticks"));
    CHECK_THAT (refusal (parseWire ("a.out -> [99999999999] -> b.in")), Contains ("whole number of ticks"));
    CHECK_THAT (refusal (parseWire ("a.out -> [1] b.in")), Contains ("a -> should follow the delay"));
    CHECK_THAT (refusal (parseWire ("a.out -> [1] -> [2] -> b.in")), Contains ("more than one"));
    CHECK_THAT (refusal (parseWire ("a.out -> (+) [1] -> b.in")), Contains ("more than one"));
    CHECK_THAT (refusal (parseWire ("a.out -> b.in -> c.in")), Contains ("more than one"));
}
