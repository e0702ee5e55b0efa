// SPDX-License-Identifier: MIT
#include "support/sketch.hpp"

#include <catch2/catch.hpp>

using namespace tactus;
using tactus::test::has;
using tactus::test::Sketch;

namespace
{
Sketch shock (const Json& damping, const Json& stiffness = { { "power", { 5e5, 1.5 } } })
{
    return Sketch {}
        .node ("one", "signal.constant", { { "value", 0.0 } })
        .node ("tap", "shock.hunt_crossley", Json::object(), { { "stiffness", stiffness }, { "damping", damping } })
        .wire ("one.out -> tap.hit");
}

Messages problems (const Sketch& sketch, CompileOptions options = {}) { return sketch.compile (std::move (options)).messages; }
}   // namespace

TEST_CASE ("a damping law may be a dissipation, but other laws may not", "[plan]")
{
    CHECK (problems (shock ({ { "dissipation", 0.8 } })).empty());
    CHECK (problems (shock ({ { "dissipation", "0.8 s/m" } })).empty());
    CHECK (problems (shock ({ { "power", { 5e5, 1.5 } } })).empty());

    CHECK (has (problems (shock ({ { "dissipation", "0.8 m/s" } })), "setting/value"));
    CHECK (has (problems (shock ({ { "dissipation", -1.0 } })), "setting/value"));
    CHECK (has (problems (shock ({ { "dissipation", { 1.0, 2.0 } } })), "setting/value"));

    const auto messages = problems (shock ({ { "power", { 5e5, 1.5 } } }, { { "dissipation", 0.8 } }));
    REQUIRE (has (messages, "setting/value"));
    CHECK (messages[0].text.find ("dissipation\"") == std::string::npos);   // the message does not suggest a form that would be refused
}

TEST_CASE ("a warning of a node does not keep the graph from running", "[plan]")
{
    const auto sketch = shock ({ { "dissipation", 1.0 } }, { { "power", { 1e9, 1.5 } } });
    const auto compiled = sketch.compile();
    INFO (tactus::test::text (compiled.messages));
    REQUIRE (compiled.plan);
    REQUIRE (has (compiled.messages, "node/warning"));
    CHECK (compiled.messages[0].severity == Message::Severity::warning);
    CHECK (compiled.messages[0].where == "/nodes/tap");
}
