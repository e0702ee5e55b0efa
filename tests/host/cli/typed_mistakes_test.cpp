// SPDX-License-Identifier: GPL-3.0-or-later
// What people mistype in a graph file: `tactus validate` says where it is, and what would be right.

#include "program.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <set>

using namespace tactus::test;

namespace
{
const std::string right = R"({
  "format": "tactus-graph",
  "version": 2,
  "name": "Board",
  "tags": ["wood"],
  "rate_hz": 4000,
  "devices": {
    "stylus": {
      "driver": "sim",
      "mass": "50 g",
      "damping": 2.0,
      "hand": { "stiffness": 100, "damping": 2.0, "path": "stroke" },
      "guard": { "max_force": "3 N", "max_slew": "2000 N/s", "watchdog": "50 ms" }
    }
  },
  "nodes": {
    "hand": { "type": "device.position", "role": "stylus" },
    "board": { "type": "deform.plane", "params": { "stiffness": "2 N/mm", "damping": 1.0 }, "settings": { "window": "1 ms" } },
    "drag": { "type": "friction.elasto_plastic", "params": { "mu": 0.4, "d_max": "0.4 mm", "adhesion": "stick" } },
    "grain": { "type": "graph:grain", "count": 2, "every": 2, "params": { "amplitude": "60 mN" }, "overrides": { "wave.phase": 1 } },
    "finger": { "type": "graph:finger", "roles": { "tip": "stylus" } },
    "motor": { "type": "device.force", "role": "stylus" }
  },
  "wires": [
    "hand.position -> board.position",
    "hand.position -> drag.position",
    "board.resistance -> drag.normal_force",
    "hand.position -> grain.position",
    "board.force -> motor.force",
    "drag.force -> motor.force",
    { "wire": "grain.force -> motor.force", "gain": 1.0, "enabled": true }
  ],
  "controls": {
    "roughness": { "name": "Roughness", "value": 0.5, "to": { "grain.amplitude": [0, "0.12 N"], "drag.mu": [0.2, 0.6] } }
  },
  "graphs": {
    "grain": {
      "nodes": {
        "wave": { "type": "texture.grating", "params": { "spatial_frequency": "600 1/m" } }
      },
      "wires": [],
      "expose": {
        "inputs": { "position": "wave.position" },
        "outputs": { "force": "wave.force" },
        "params": { "amplitude": "wave.amplitude" }
      }
    },
    "finger": {
      "nodes": {
        "tip": { "type": "device.position", "role": "tip" },
        "skin": { "type": "deform.plane", "params": { "stiffness": 200.0 } },
        "pad": { "type": "device.force", "role": "tip" }
      },
      "wires": [
        "tip.position -> skin.position",
        "skin.force -> pad.force"
      ]
    }
  }
}
)";

/// A mistake: what is typed instead of what, the id of the message, the text at which it points, and a part of it that says what is right.
struct Mistake
{
    std::string what, right, typed, id, at, remedy;
};

const std::vector<Mistake> mistakes {
    // clang-format off
    { "a comma is missing", R"("mu": 0.4, "d_max")", R"("mu": 0.4 "d_max")", "file/syntax", R"("d_max": "0.4)", "add the comma" },
    { "a comma is left at the end", "[0.2, 0.6]", "[0.2, 0.6,]", "file/syntax", "] } }", "remove the comma" },
    { "a string in single quotes", R"("board.force -> motor.force")", "'board.force -> motor.force'",
      "file/syntax", "'board.force", "double quotes" },
    { "a key without quotes", R"("rate_hz": 4000)", "rate_hz: 4000",
      "file/syntax", "rate_hz: 4000", "put the key in double quotes" },
    { "a value with a unit outside of a string", R"("d_max": "0.4 mm")", R"("d_max": 0.4 mm)",
      "file/syntax", R"(mm, "adhesion")", R"("0.4 mm")" },
    { "a comma as decimal point", R"("0.4 mm")", R"("0,4 mm")", "unit/syntax", R"("d_max")", "text with a unit" },
    { "no format", "  \"format\": \"tactus-graph\",\n", "", "file/not_a_graph", "{\n  \"version\"", R"("version": 2)" },
    { "the version of a newer Tactus", R"("version": 2)", R"("version": 3)",
      "file/newer_version", R"("version")", "newer Tactus" },
    { "the version as text", R"("version": 2)", R"("version": "2")", "file/wrong_kind", R"("version")", "write a number" },
    { "a key that is misspelt", R"("params": { "stiffness": "2)", R"("parms": { "stiffness": "2)",
      "file/unknown_key", R"("parms")", "'params'" },
    { "a key in upper case", R"("params": { "stiffness": "2)", R"("PARAMS": { "stiffness": "2)",
      "file/unknown_key", R"("PARAMS")", "'params'" },
    { "a key with another ending", R"("params": { "stiffness": "2)", R"("parameters": { "stiffness": "2)",
      "file/unknown_key", R"("parameters")", "'params'" },
    { "half a key", R"("rate_hz")", R"("rate")", "file/unknown_key", R"("rate")", "'rate_hz'" },
    { "a type that is misspelt", R"("friction.elasto_plastic")", R"("friction.elastoplastic")",
      "node/unknown_type", R"("type": "friction)", "did you mean" },
    { "a type without its family", R"("deform.plane", "params": { "stiffness": "2)", R"("plane", "params": { "stiffness": "2)",
      "node/unknown_type", R"("type": "plane")", "did you mean 'deform.plane'" },
    { "a subgraph without graph:", R"("graph:grain")", R"("grain")",
      "node/unknown_type", R"("type": "grain")", "did you mean 'graph:grain'" },
    { "no type", R"("type": "deform.plane", "params": { "stiffness": "2)", R"("params": { "stiffness": "2)",
      "file/missing_key", R"("board": {)", R"(add "type")" },
    { "a parameter that is misspelt", R"("d_max")", R"("dmax")", "param/unknown", R"("dmax")", "did you mean 'd_max'" },
    { "a parameter in the wrong case", R"("stiffness": "2)", R"("Stiffness": "2)",
      "graph/bad_id", R"("Stiffness")", "'stiffness'" },
    { "a setting among the parameters", R"("damping": 1.0 }, "settings": { "window": "1 ms" })", R"("damping": 1.0, "window": "1 ms" })",
      "param/unknown", R"("window")", "`settings`" },
    { "a parameter among the settings", R"("window": "1 ms")", R"("window": "1 ms", "offset": 0)",
      "node/unknown_setting", R"("offset")", "move it to params" },
    { "a unit that is misspelt", R"("0.4 mm")", R"("0.4 milimeter")", "unit/syntax", R"("d_max")", "text with a unit" },
    { "the unit of something else", R"("2 N/mm")", R"("2 N")", "param/unit", R"("stiffness": "2 N")", "N/m" },
    { "a number of mm without a unit", R"("d_max": "0.4 mm")", R"("d_max": 0.4)",
      "param/unusual", R"("d_max")", "check its unit" },
    { "a negative friction", R"("mu": 0.4)", R"("mu": -0.4)", "param/out_of_range", R"("mu")", "at least 0" },
    { "a vector of two numbers", R"("damping": 1.0 })", R"("damping": 1.0, "normal": [0, 1] })",
      "param/shape", R"("normal")", "[0, 0, 1]" },
    { "a choice that is misspelt", R"("stick")", R"("Stik")", "param/unknown_choice", R"("adhesion")", "did you mean 'stick'" },
    { "a wire with one dash", R"("hand.position -> drag.position")", R"("hand.position - drag.position")",
      "wire/syntax", R"("hand.position - drag)", R"("hand.position -> drag.position")" },
    { "a wire with a double arrow", R"("hand.position -> drag.position")", R"("hand.position => drag.position")",
      "wire/syntax", R"("hand.position => drag)", R"("hand.position -> drag.position")" },
    { "a wire into a subgraph with a dot", R"("hand.position -> grain.position")", R"("hand.position -> grain.wave.position")",
      "wire/syntax", R"("hand.position -> grain)", R"("hand.position -> grain/wave.position")" },
    { "a wire without ports", R"("drag.force -> motor.force")", R"("drag -> motor")",
      "wire/syntax", R"("drag -> motor")", "node.port" },
    { "a delay of no ticks", R"("drag.force -> motor.force")", R"("drag.force -> [0] -> motor.force")",
      "wire/syntax", R"("drag.force -> [0])", "[1]" },
    { "a port that is misspelt", R"("hand.position -> drag.position")", R"("hand.positon -> drag.position")",
      "port/unknown", R"("hand.positon)", "did you mean 'position'" },
    { "half a port", R"("hand.position -> drag.position")", R"("hand.position -> drag.pos")",
      "port/unknown", R"("hand.position -> drag.pos")", "did you mean 'position'" },
    { "a node that is misspelt", R"("hand.position -> drag.position")", R"("hnad.position -> drag.position")",
      "port/unknown_node", R"("hnad)", "did you mean 'hand'" },
    { "a wire backwards", R"("drag.force -> motor.force")", R"("motor.force -> drag.force")",
      "port/wrong_side", R"("motor.force -> drag)", "has: applied" },
    { "a wire between different units", R"("drag.force -> motor.force")", R"("hand.position -> motor.force")",
      "wire/unit", R"("hand.position -> motor)", "a gain in N/m" },
    { "a vector into a scalar", R"("board.resistance -> drag.normal_force")", R"("board.force -> drag.normal_force")",
      "wire/width", R"("board.force -> drag)", "board.force.x" },
    { "a gain with a unit too many", R"("gain": 1.0)", R"("gain": "2 N")", "wire/unit", R"({ "wire")", "without a unit" },
    { "true in quotes", R"("enabled": true)", R"("enabled": "true")", "file/wrong_kind", R"("enabled")", "write true or false" },
    { "a role that is misspelt", R"("motor": { "type": "device.force", "role": "stylus")", R"("motor": { "type": "device.force", "role": "stilus")",
      "device/undescribed", R"("role": "stilus")", "did you mean 'stylus'" },
    { "a role in the wrong case", R"("motor": { "type": "device.force", "role": "stylus")", R"("motor": { "type": "device.force", "role": "Stylus")",
      "graph/bad_id", R"("role": "Stylus")", "'stylus'" },
    { "no role", R"("motor": { "type": "device.force", "role": "stylus")", R"("motor": { "type": "device.force")",
      "node/no_role", R"("motor": {)", R"("role": "stylus")" },
    { "a node with a dash in its name", R"("board": { "type)", R"("my-board": { "type)",
      "graph/bad_id", R"("my-board")", "'my_board'" },
    { "a name twice", R"("motor": { "type")", R"("drag": { "type")",
      "file/duplicate_key", R"("drag": { "type": "device)", "rename one of them" },
    { "a driver in the wrong case", R"("driver": "sim")", R"("driver": "Sim")",
      "device/unknown_driver", R"("driver")", "did you mean 'sim'" },
    { "a weight in newtons", R"("mass": "50 g")", R"("mass": "50 N")", "device/unit", R"("mass")", "1 kg" },
    { "a key of a device that is misspelt", "\"damping\": 2.0,\n      \"hand\"", "\"dampening\": 2.0,\n      \"hand\"",
      "device/unknown_key", R"("dampening")", "did you mean 'damping'" },
    { "a gesture that is misspelt", R"("path": "stroke")", R"("path": "strok")",
      "device/unknown_gesture", R"("path")", "did you mean 'stroke'" },
    { "a limit that is misspelt", R"("max_force")", R"("maxforce")",
      "device/unknown_key", R"("maxforce")", "did you mean 'max_force'" },
    { "a force in kilograms", R"("3 N")", R"("3 kg")", "device/unit", R"("max_force")", "1 N" },
    { "a limit below zero", R"("3 N")", "-3", "device/out_of_range", R"("max_force")", "at least 0 N" },
    { "a stop that takes seconds", R"("2000 N/s")", R"("1 N/s")", "device/slow_stop", R"("max_slew")", "at least 6" },
    { "a subgraph that is misspelt", R"("graph:grain")", R"("graph:grian")",
      "graph/unknown_subgraph", R"("type": "graph:grian")", "did you mean 'grain'" },
    { "half an instance", R"("count": 2)", R"("count": 2.5)", "file/bad_value", R"("count")", "write 1" },
    { "instances of a plain node", R"("board": { "type": "deform.plane")", R"("board": { "type": "deform.plane", "count": 2)",
      "node/needless_count", R"("count": 2, "params")", "remove the `count`" },
    { "never, as a rate", R"("every": 2)", R"("every": 0)", "file/bad_value", R"("every")", "remove the key" },
    { "less and more often", R"("every": 2)", R"("every": 2, "times": 4)", "rate/both", R"("times")", "remove one of them" },
    { "more often, back to the hand", R"("every": 2)", R"("times": 2)", "rate/to_the_hand", R"("times")", "leave out `times`" },
    { "a hold that is misspelt", R"("every": 2)", R"("every": 2, "hold": "lineer")",
      "file/bad_value", R"("hold")", "did you mean 'linear'" },
    { "an exposed parameter that is misspelt", R"("params": { "amplitude": "60 mN" })", R"("params": { "amplitud": "60 mN" })",
      "param/unknown", R"("amplitud")", "did you mean 'amplitude'" },
    { "an override that is misspelt", R"("wave.phase": 1)", R"("wave.phas": 1)",
      "param/unknown", R"("wave.phas")", "did you mean 'phase'" },
    { "an override of an instance too many", R"("wave.phase": 1)", R"("[2]/wave.phase": 1)",
      "port/no_instance", R"("[2]/wave)", "smaller number" },
    { "roles for two instances of one", R"("roles": { "tip": "stylus" })", R"("roles": { "tip": ["stylus", "thumb"] })",
      "node/bad_roles", R"("tip": ["stylus")", "one name for each" },
    { "a role that the subgraph lacks", R"("roles": { "tip": "stylus" })", R"("roles": { "top": "stylus" })",
      "node/unknown_role", R"("top")", "name a role" },
    { "an exposed port that is misspelt", R"("outputs": { "force": "wave.force" })", R"("outputs": { "force": "wave.forse" })",
      "port/unknown", R"("force": "wave.forse")", "did you mean 'force'" },
    { "a port that is misspelt inside a subgraph", R"("tip.position -> skin.position")", R"("tip.position -> skin.positions")",
      "port/unknown", R"("tip.position -> skin.positions")", "did you mean 'position'" },
    { "a control that moves an unknown parameter", R"("drag.mu": [)", R"("drag.muu": [)",
      "param/unknown", R"("drag.muu")", "did you mean 'mu'" },
    { "a control that moves an input", R"("drag.mu": [)", R"("drag.normal_force": [)",
      "port/wrong_side", R"("drag.normal_force": [)", "signal.constant" },
    { "a control with one value", "[0.2, 0.6]", "0.6", "file/wrong_kind", R"("drag.mu": 0.6)", "[value at 0, value at 1]" },
    { "a control in other units", R"([0, "0.12 N"])", R"([0, "0.12 mm"])", "param/unit", R"("grain.amplitude": [)", "in N" },
    { "a control at 50", R"("value": 0.5)", R"("value": 50)", "file/bad_value", R"("value")", "ranges in" },
    { "a control without targets", R"("to": {)", R"("targets": {)", "file/missing_key", R"("roughness": {)", R"(add "to")" },
    { "a node that is wired to nothing", "    \"drag.force -> motor.force\",\n", "",
      "node/no_effect", R"("drag": {)", "device.force" },
    // clang-format on
};

/// "12:5" for the line and column of a byte.
std::string placeOf (const std::string& text, std::size_t byte)
{
    const auto before = text.substr (0, byte);
    const auto line = std::ranges::count (before, '\n') + 1;
    return std::to_string (line) + ':' + std::to_string (before.size() - (before.rfind ('\n') + 1) + 1);
}

int timesIn (const std::string& text, const std::string& part)
{
    int times = 0;
    for (auto at = text.find (part); at != text.npos; at = text.find (part, at + 1))
        ++times;
    return times;
}

/// The message with an id at a place, with its remedy; "" if there is none.
std::string messageAt (const std::string& all, const std::string& place, const std::string& id)
{
    for (auto begin = all.find (place + ": "); begin != all.npos; begin = all.find (place + ": ", begin + 1))
    {
        const auto message = all.substr (begin, all.find ("]\n", all.find ("\n    ", begin) + 1) + 1 - begin);
        if (message.ends_with ('[' + id + ']')) return message;
    }
    return {};
}
}   // namespace

TEST_CASE ("a graph without mistakes has no message", "[cli]")
{
    const Scratch scratch;
    const auto ran = runTactus ({ "validate", scratch.write ("graph.json", right) });
    CHECK (ran.status == 0);
    CHECK (ran.err.empty());
}

TEST_CASE ("at least 40 typed mistakes are each reported with line, column and what would be right", "[cli]")
{
    const Scratch scratch;
    std::set<std::string> seen;
    for (const auto& m : mistakes)
    {
        INFO (m.what);
        REQUIRE (timesIn (right, m.right) == 1);
        REQUIRE (seen.insert (m.typed + '/' + m.right).second);
        auto text = right;
        text.replace (text.find (m.right), m.right.size(), m.typed);
        REQUIRE (timesIn (text, m.at) == 1);

        const auto file = scratch.write ("typed.json", text);
        const auto ran = runTactus ({ "validate", file });
        INFO (ran.err);
        const auto place = file + ':' + placeOf (text, text.find (m.at));
        const auto message = messageAt (ran.err, place, m.id);
        INFO (place << " [" << m.id << "]");
        REQUIRE_FALSE (message.empty());
        CHECK (message.find (m.remedy) != message.npos);
        CHECK (message.find ("\n    ") + 5 < message.rfind (" ["));   // there is a remedy
        CHECK (ran.status == (message.find (": error: ") != message.npos ? 1 : 0));
    }
    CHECK (seen.size() >= 40);
}

TEST_CASE ("tactus says that the variable TACTUS_LANES has no effect, and renders the same", "[cli]")
{
    const Scratch scratch;
    const auto render = [&] (const std::string& out) {
        const auto ran = runTactus ({ "render", TACTUS_SOURCE_DIR "/graphs/two_fingers.json", "--duration", "0.2", "--out", scratch.path (out) });
        CHECK (ran.status == 0);
        return ran.err.find ("TACTUS_LANES has no effect") != std::string::npos;
    };
    CHECK_FALSE (render ("without.csv"));
    setenv ("TACTUS_LANES", "1", 1);
    CHECK (render ("with.csv"));
    unsetenv ("TACTUS_LANES");
    CHECK (textOf (scratch.path ("with.csv")) == textOf (scratch.path ("without.csv")));
}
