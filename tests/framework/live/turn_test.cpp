// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/run/turn.hpp>

#include "support/sketch.hpp"

#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

namespace
{
graph::Graph wood() { return loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph; }

/// The value of a parameter after its ramp.
double arrived (Engine& engine, const std::string& name)
{
    for (int k = 0; k < 200; ++k)
        engine.tick();
    const auto param = *engine.param (name);
    return param.knobs->all[param.index].value;
}

/// The value of parameter `name` in a plan that was compiled with `value` for the parameter or control `set`.
double compiled (const graph::Graph& graph, const std::string& set, const Json& value, const std::string& name)
{
    Engine engine { compile (graph, catalogue(), { .overrides = { { set, value } } }).plan };
    return arrived (engine, name);
}

std::string idOf (const Result<>& result) { return result ? "" : result.error().id; }
}   // namespace

TEST_CASE ("a parameter turned live becomes bit-identical to one given with --set", "[turn]")
{
    const auto graph = wood();
    Engine engine { compile (graph, catalogue()).plan };
    engine.tick();
    const auto same = [&] (const std::string& name, const std::string& text, const std::string& component) {
        INFO (text);
        CHECK (idOf (turnParam (engine, name, readValue (text))) == "");
        CHECK (arrived (engine, component) == compiled (graph, name, readValue (text), component));
    };
    same ("drag.mu", "0.1", "drag.mu");
    same ("drag.d_max", "20 um", "drag.d_max");
    same ("drag.adhesion", "dahl", "drag.adhesion");
    same ("board.normal", "[0.1, 0, 1]", "board.normal.z");
    same ("board.normal.x", "0.3", "board.normal.x");
    same ("grain.angle", "30 deg", "grain.angle");
}

TEST_CASE ("a control turned live moves all its targets to the same values as the same setting in the file", "[turn]")
{
    const auto graph = wood();
    Engine engine { compile (graph, catalogue()).plan };
    engine.tick();
    test::property ("any value of the control", [&] {
        const double at = *rc::gen::inRange (0, 1001) / 1000.0;
        RC_ASSERT (idOf (turnControl (engine, graph, "roughness", at)) == "");
        for (const auto* target : { "grain.amplitude", "drag.mu" })
            RC_ASSERT (arrived (engine, target) == compiled (graph, "roughness", at, target));
    });
}

TEST_CASE ("an impossible turn is refused with a reason and has no effect", "[turn]")
{
    const auto graph = wood();
    Engine engine { compile (graph, catalogue()).plan };
    const auto refused = [&] (const std::string& name, const std::string& text) { return idOf (turnParam (engine, name, readValue (text))); };
    CHECK (refused ("drug.mu", "1") == "port/unknown_node");
    CHECK (refused ("drag.nu", "1") == "param/unknown");
    CHECK (refused ("drag.mu", "-1") == "param/out_of_range");
    CHECK (refused ("drag.mu", "1 kg") == "param/unit");
    CHECK (refused ("drag.mu", "much") == "param/value");
    CHECK (refused ("drag.mu", "[1, 2, 3]") == "param/shape");
    CHECK (refused ("drag.mu.x", "1") == "param/shape");
    CHECK (refused ("drag.adhesion", "dahll") == "param/unknown_choice");
    CHECK (refused ("board.normal", "1") == "param/shape");
    CHECK (refused ("board.normal", "[0.5, \"x\", 1]") != "");
    CHECK (refused ("", "1") == "param/name");
    CHECK (refused ("drag.mu", std::string (100000, '[')) != "");
    CHECK (refused ("drag.mu", "\xff\xfe") != "");
    CHECK (refused ("\xff.\xfe", "1") != "");
    CHECK (arrived (engine, "board.normal.x") == 0.0);

    CHECK (idOf (turnControl (engine, graph, "rough", 0.5)) == "control/unknown");
    for (const double bad : { -0.1, 1.1, std::nan ("") })
        CHECK (idOf (turnControl (engine, graph, "roughness", bad)) == "control/value");
}
