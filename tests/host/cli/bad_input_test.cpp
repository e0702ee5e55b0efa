// SPDX-License-Identifier: GPL-3.0-or-later
// Problems are reported with their id, their location and a remedy. The exit status shows whether the input or the usage
// is wrong. No output file is left half written.

#include "program.hpp"

#include <catch2/catch.hpp>

#include <filesystem>

using namespace tactus::test;

namespace
{
std::string graph (const std::string& nodes, const std::string& wires = "", const std::string& rest = "")
{
    return R"({ "format": "tactus-graph", "version": 1, "name": "Bad",
  "nodes": { )"
           + nodes + R"( },
  "wires": [ )"
           + wires + " ]" + rest + "}";
}

const std::string hand = R"("hand": { "type": "device.position", "role": "stylus" })", motor = R"("motor": { "type": "device.force", "role": "stylus" })",
                  drag = R"("drag": { "type": "friction.elasto_plastic" })", amp = R"("amp": { "type": "signal.gain" })";
}   // namespace

TEST_CASE ("each kind of bad file is refused with its id and its place", "[cli]")
{
    const Scratch scratch;
    const auto [id, place, text] = GENERATE_COPY (table<std::string, std::string, std::string> ({
        { "node/unknown_type", ":2:", graph (R"("a": { "type": "friction.elastoplastic" })") },
        { "param/unknown", ":2:", graph (R"("drag": { "type": "friction.elasto_plastic", "params": { "mue": 1 } })") },
        { "node/unknown_setting", ":2:", graph (R"("d": { "type": "signal.delay", "settings": { "tick": 1 } })") },
        { "port/unknown", ":3:", graph (hand + "," + drag, R"("hand.position -> drag.positon")") },
        { "port/unknown_node", ":3:", graph (hand, R"("hand.position -> drag.position")") },
        { "port/wrong_side", ":3:", graph (hand + "," + drag, R"("drag.position -> drag.position")") },
        { "unit/syntax", ":2:", graph (R"("drag": { "type": "friction.elasto_plastic", "params": { "d_max": "0.4 parsec" } })") },
        { "param/unit", ":2:", graph (R"("drag": { "type": "friction.elasto_plastic", "params": { "d_max": "0.4 N" } })") },
        { "param/out_of_range", ":2:", graph (R"("drag": { "type": "friction.elasto_plastic", "params": { "d_max": 0 } })") },
        { "param/unknown_choice", ":2:", graph (R"("drag": { "type": "friction.elasto_plastic", "params": { "adhesion": "glue" } })") },
        { "wire/unit", ":3:", graph (hand + "," + motor, R"("hand.position -> motor.force")") },
        { "wire/width", ":3:", graph (hand + "," + amp, R"("hand.position -> amp.in")") },
        { "wire/two_into_one", ":3:", graph (hand + "," + drag, R"("hand.position -> drag.position", "hand.position -> drag.position")") },
        { "wire/syntax", ":3:", graph (hand + "," + drag, R"("hand.position => drag.position")") },
        { "graph/loop", ":3:", graph (amp, R"("amp.out -> amp.in")") },
        { "graph/bad_id", ":2:", graph (R"("Amp": { "type": "signal.gain" })") },
        { "graph/unknown_subgraph", ":2:", graph (R"("a": { "type": "graph:nowhere" })") },
        { "node/no_role", ":2:", graph (R"("hand": { "type": "device.position" })") },
        { "node/problem", ":2:", graph (R"("f": { "type": "signal.expression", "settings": { "text": "in[0] +" } })") },
        { "setting/value", ":2:", graph (R"("bar": { "type": "vibration.modal", "settings": { "modes": [ { "frequency": "nan" } ] } })") },
        { "file/newer_version", ":1:", R"({ "format": "tactus-graph", "version": 99, "nodes": {}, "wires": [] })" },
        { "file/not_a_graph", ":1:", R"({ "format": "cooking-recipe", "version": 1 })" },
        { "file/syntax", ":1:", R"({ "format": "tactus-graph", "version": 1, "no)" },
        { "file/syntax", ":2:", graph (R"("bar": { "type": "vibration.modal", "settings": { "modes": [ { "frequency": NaN } ] } })") },
        { "file/too_deep", ":1:", std::string (5'000'000, '[') },
        { "file/duplicate_key", ":2:", graph (hand + "," + hand) },
        { "device/unknown_driver", ":", graph (hand, "", R"(, "devices": { "stylus": { "driver": "magic" } })") },
        { "device/out_of_range", ":", graph (hand, "", R"(, "devices": { "stylus": { "driver": "sim", "mass": -1 } })") },
        { "device/unknown_gesture", ":", graph (hand, "", R"(, "devices": { "stylus": { "driver": "gesture", "path": "wave" } })") },
        { "csv/unreadable", ":", graph (hand, "", R"(, "devices": { "stylus": { "driver": "trace", "path": "missing.csv" } })") },
    }));
    INFO (id);
    const auto file = scratch.write ("bad.json", text);
    const auto ran = runTactus ({ "validate", file });
    INFO (ran.err.substr (0, 2000));
    CHECK (ran.status == 1);
    CHECK (ran.out.empty());
    CHECK (ran.err.find ("[" + id + "]") != std::string::npos);
    CHECK (ran.err.find (file + place) != std::string::npos);
}

TEST_CASE ("a misspelt control after --set is named, together with those that exist", "[cli]")
{
    const Scratch scratch;
    const auto out = scratch.path ("out.csv");
    const std::string wood = TACTUS_SOURCE_DIR "/graphs/dry_wood.json";
    const auto ran = runTactus ({ "render", wood, "--duration", "0.01", "--set", "roughnes=1", "--out", out });
    INFO (ran.err);
    CHECK (ran.status == 1);
    CHECK (ran.err.find ("--set roughnes: error: there is no control 'roughnes' (did you mean 'roughness'?)") != std::string::npos);
    CHECK (ran.err.find ("[control/unknown]") != std::string::npos);
    CHECK_FALSE (std::filesystem::exists (out));
    const auto param = runTactus ({ "render", wood, "--duration", "0.01", "--set", "drag.m=1", "--out", out });
    CHECK (param.err.find ("[param/unknown]") != std::string::npos);
    const auto bare = runTactus ({ "render", scratch.write ("bare.json", graph (hand)), "--duration", "0.01", "--set", "roughnes=1", "--out", out });
    CHECK (bare.err.find ("[param/name]") != std::string::npos);   // it has no controls
}

TEST_CASE ("a folder without plugins after --plugins is a warning, and a folder that does not exist, too", "[cli][plugins]")
{
    const Scratch scratch;
    scratch.write ("readme.txt", "no plugin");
    const auto folder = std::filesystem::path (scratch.path ("readme.txt")).parent_path().string();
    const auto empty = runTactus ({ "nodes", "--plugins", folder });
    CHECK (empty.status == 0);
    CHECK (empty.err.find (folder + ": warning: --plugins names a folder without plugins") != std::string::npos);
    CHECK (empty.err.find ("[plugin/none]") != std::string::npos);
    scratch.write ("arm.tactus-device", "");
    CHECK (runTactus ({ "nodes", "--plugins", folder }).err.empty());   // a driver, which is loaded when a device is opened
    const auto absent = runTactus ({ "nodes", "--plugins", folder + "/none" });
    CHECK (absent.err.find ("[plugin/no_folder]") != std::string::npos);
    CHECK (absent.err.find ("[plugin/none]") == std::string::npos);
}

TEST_CASE ("a graph with a node of an unknown type is not run", "[cli]")
{
    const Scratch scratch;
    const auto file = scratch.write ("bad.json", graph (hand + "," + motor + R"(, "a": { "type": "friction.elastoplastic" })"));
    const auto out = scratch.path ("out.csv");
    for (const auto& command : { std::vector<std::string> { "render", file, "--duration", "0.01", "--out", out },
                                 std::vector<std::string> { "play", file, "--duration", "0.01", "--session", "off", "--device", "stylus=sim" } })
    {
        const auto ran = runTactus (command);
        INFO (ran.err);
        CHECK (ran.status == 1);
        CHECK (ran.err.find ("[node/unknown_type]") != std::string::npos);
        CHECK (ran.err.find (file + ":2:") != std::string::npos);
        CHECK (ran.err.find ("warning") == std::string::npos);
    }
    CHECK_FALSE (std::filesystem::exists (out));
}

TEST_CASE ("a name of a megabyte is cut in the messages about it", "[cli]")
{
    const Scratch scratch;
    const std::string name (1'000'000, 'a');
    const auto ran = runTactus ({ "validate", scratch.write ("long.json", graph ('"' + name + R"(": { "type": ")" + name + R"(" })")) });
    CHECK (ran.status == 1);
    CHECK_FALSE (ran.err.empty());
    CHECK (ran.out.size() + ran.err.size() < 100'000);
}

TEST_CASE ("all problems in all files are reported in one go", "[cli]")
{
    const Scratch scratch;
    const auto a = scratch.write ("a.json",
                                  graph (R"("a": { "type": "signal.gian" }, "b": { "type": "signal.gain", "params": { "gain": "loud", "gian": 2 } })",
                                         R"("a.out => b.in", "x.out -> b.in")"));
    const auto b = scratch.write ("b.json", "{");
    const auto fine = scratch.write ("fine.json", graph (amp));
    const auto warned = scratch.write ("warned.json", graph (R"("hand": { "type": "device.position", "role": "stylus" })", ""));   // no device
    const auto ran = runTactus ({ "validate", a, b, fine, warned, scratch.path ("missing.json") });
    INFO (ran.err);
    CHECK (ran.status == 1);
    for (const auto* id : { "wire/syntax", "file/syntax", "file/unreadable" })
        CHECK (ran.err.find ("[" + std::string (id) + "]") != std::string::npos);
    CHECK (ran.out.find ("fine.json: ok\n") != std::string::npos);
    CHECK (ran.out.find ("warned.json: ok, with warnings\n") != std::string::npos);
}

TEST_CASE ("a command that is used wrongly exits with status 2 and prints its usage", "[cli]")
{
    const auto arguments = GENERATE (std::vector<std::string> {}, std::vector<std::string> { "fly" }, std::vector<std::string> { "render" },
                                     std::vector<std::string> { "render", "x.json", "--rate", "fast" },
                                     std::vector<std::string> { "render", "x.json", "--wings" });
    const auto ran = runTactus (arguments);
    CHECK (ran.status == 2);
    CHECK_FALSE (ran.err.empty());
}

TEST_CASE ("an argument with control characters or line ends disturbs no message", "[cli]")
{
    const std::string forged = "a\nb: error: \x1b[2J";
    for (const auto& arguments : { std::vector<std::string> { "nodes", forged }, std::vector<std::string> { "validate", "x.json", "--" + forged },
                                   std::vector<std::string> { "render", "x.json", "--rate", forged } })
    {
        const auto ran = runTactus (arguments);
        INFO (ran.err);
        CHECK (ran.status != 0);
        CHECK (ran.err.find ('\x1b') == std::string::npos);
        CHECK (ran.err.find ("a\nb") == std::string::npos);
        CHECK (ran.err.find ("a\\x0Ab: error: \\x1B[2J") != std::string::npos);
    }
}

TEST_CASE ("thousands of unknown keys of devices are not all reported", "[cli]")
{
    const Scratch scratch;
    std::string keys, devices;
    for (int i = 0; i < 200; ++i)
        keys += ", \"k" + std::to_string (i) + "\": 1";
    for (int i = 0; i < 30; ++i)
        devices += (i == 0 ? "\"r" : ", \"r") + std::to_string (i) + R"(": { "driver": "sim")" + keys + " }";
    const auto ran = runTactus ({ "validate", scratch.write ("many.json", graph (hand, "", ", \"devices\": { " + devices + " }")) });
    CHECK (ran.status == 1);
    std::size_t shown = 0;
    for (auto at = ran.err.find ("[device/unknown_key]"); at != std::string::npos; at = ran.err.find ("[device/unknown_key]", at + 1))
        ++shown;
    CHECK (shown >= 1000);
    CHECK (shown <= 1200);
    CHECK (ran.err.find ("100 more keys here are not known") != std::string::npos);
    CHECK (ran.err.find ("the other devices are not checked") != std::string::npos);
}

TEST_CASE ("the help of every command has examples", "[cli]")
{
    for (const auto* command : { "nodes", "validate", "render", "play" })
    {
        const auto ran = runTactus ({ command, "--help" });
        CHECK (ran.status == 0);
        CHECK (ran.out.find ("Examples:") != std::string::npos);
    }
    CHECK (runTactus ({ "--help" }).out.find ("Examples:") != std::string::npos);
}

TEST_CASE ("a render that cannot run reports the reason and leaves no file", "[cli]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", graph (hand + "," + motor + "," + drag, R"("hand.position -> drag.position", "drag.force -> motor.force")"));
    scratch.write ("feed.csv", "t,drag.normal_force\n0,1\n0.001,2\n");
    scratch.write ("bad_time.csv", "t,drag.normal_force\n0,1\n0,2\n");
    scratch.write ("unknown.csv", "drag.weight\n1\n");
    scratch.write ("whole.csv", "drag.position\n1\n");
    scratch.write ("words.csv", "drag.normal_force\nheavy\n");

    using Case = std::pair<std::string, std::vector<std::string>>;
    const auto [id, options] = GENERATE (values<Case> ({
        // a leading @ stands for the temporary folder
        { "run/no_length", {} },
        { "output/unwritable", { "--duration", "0.1", "--out", "/nowhere/at/all.csv" } },
        { "output/unwritable", { "--duration", "0.1", "--out", "/nowhere/at/all.wav" } },
        { "output/unwritable", { "--duration", "0.1", "--plot", "/nowhere/at/all.png" } },
        { "output/kind", { "--duration", "0.1", "--out", "@out.mp3" } },
        { "wav/sample_rate", { "--duration", "0.1", "--rate", "1000.5", "--out", "@out.wav" } },
        { "port/unknown", { "--duration", "0.1", "--record", "drag.weight", "--out", "@out.csv" } },
        { "record/choice", { "--duration", "0.1", "--record", "drag.adhesion", "--out", "@out.csv" } },
        { "param/unknown", { "--duration", "0.1", "--set", "drag.weight=3", "--out", "@out.csv" } },
        { "param/unit", { "--duration", "0.1", "--set", "drag.d_max=3 N", "--out", "@out.csv" } },
        { "device/unknown_role", { "--duration", "0.1", "--device", "left=sim", "--out", "@out.csv" } },
        { "device/option", { "--duration", "0.1", "--device", "stylus", "--out", "@out.csv" } },
        { "device/unknown_gesture", { "--device", "stylus=gesture:wave", "--out", "@out.csv" } },
        { "csv/unreadable", { "--device", "stylus=trace:missing.csv", "--out", "@out.csv" } },
        { "csv/unreadable", { "--feed", "missing.csv", "--out", "@out.csv" } },
        { "feed/time_order", { "--feed", "@bad_time.csv", "--out", "@out.csv" } },
        { "port/unknown", { "--feed", "@unknown.csv", "--out", "@out.csv" } },
        { "feed/width", { "--feed", "@whole.csv", "--out", "@out.csv" } },
        { "csv/not_a_number", { "--feed", "@words.csv", "--out", "@out.csv" } },
        { "plot/not_recorded", { "--feed", "@feed.csv", "--plot", "@p.png", "--over", "drag.state" } },
    }));
    std::vector<std::string> arguments { "render", file };
    for (const auto& option : options)
        arguments.push_back (option.starts_with ('@') ? scratch.path (option.substr (1)) : option);
    const auto ran = runTactus (arguments);
    INFO (id);
    INFO (ran.err);
    CHECK (ran.status == 1);
    CHECK (ran.err.find ("[" + id + "]") != std::string::npos);
    for (const auto* name : { "out.csv", "out.wav", "out.mp3", "p.png" })
        CHECK_FALSE (std::filesystem::exists (scratch.path (name)));
}
