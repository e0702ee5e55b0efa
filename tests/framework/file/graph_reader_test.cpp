// SPDX-License-Identifier: MIT
#include <tactus/file/graph_file.hpp>
#include <tactus/file/migrate.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/closest_match.hpp>

#include <catch2/catch.hpp>

#include <array>

using namespace tactus;
using Catch::Matchers::Contains;

namespace
{
std::string file (const std::string& members) { return R"({ "format": "tactus-graph", "version": 2, )" + members + " }"; }

std::string inNode (const std::string& members) { return file (R"("nodes": { "a": { "type": "signal.gain", )" + members + " } }"); }

/// "id where" of every message, joined by commas.
std::string complaints (const std::string& text)
{
    std::string all;
    for (const auto& m : readGraph (text).messages)
        all += (all.empty() ? "" : ", ") + m.id + ' ' + m.where;
    return all;
}

void rename (Json& file, const char* from, const char* to)
{
    file[to] = file.at (from);
    file.erase (from);
}
}   // namespace

TEST_CASE ("a graph file is read into plain data, with values as written")
{
    const auto loaded = readGraph (R"({
  "format": "tactus-graph", "version": 1,
  "name": "Dry wood", "about": "A stylus.", "tags": ["wood", "texture"], "rate_hz": 4000,
  "devices": { "stylus": { "driver": "sim", "mass": "50 g" } },
  "nodes": {
    "hand":  { "type": "device.position", "role": "stylus" },
    "drag":  { "type": "friction.elasto_plastic", "params": { "d_max": "0.4 mm" }, "settings": { "s": 1 }, "bypass": true, "colour": "red" },
    "grain": { "type": "graph:grain", "count": 3, "roles": { "tip": ["thumb", "index"] }, "overrides": { "[1]/wave.phase": 1 } }
  },
  "wires": [
    "hand.position -> drag.position",
    { "wire": "drag.force -> [1] -> (+) grain.amplitude", "gain": "1e-4 m/N", "enabled": false, "ui": { "bend": 3 } }
  ],
  "controls": { "roughness": { "name": "Roughness", "value": 0.25, "to": { "grain.amplitude": [0, "0.12 N"] } } },
  "graphs": { "grain": { "nodes": { "wave": { "type": "texture.grating" } }, "wires": [],
      "expose": { "inputs": { "position": "wave.position" }, "outputs": {}, "params": { "amplitude": "wave.amplitude" } } } },
  "ui": { "zoom": 2 }, "author": "me"
})");
    REQUIRE (loaded.messages.empty());
    const auto& g = loaded.graph;
    CHECK (g.name == "Dry wood");
    CHECK (g.tags == std::vector<std::string> { "wood", "texture" });
    CHECK (g.rate_hz == 4000.0);
    CHECK (g.devices.at (0).second["mass"] == "50 g");
    REQUIRE (g.root.nodes.size() == 3);
    CHECK (g.root.find ("hand")->role == "stylus");
    CHECK (g.root.find ("drag")->params["d_max"] == "0.4 mm");
    CHECK (g.root.find ("drag")->bypass);
    CHECK (g.root.find ("drag")->extra["colour"] == "red");
    CHECK (g.root.find ("grain")->extra["count"] == 3);
    CHECK (g.root.find ("grain")->roles["tip"][1] == "index");
    CHECK (g.root.find ("grain")->overrides.contains ("[1]/wave.phase"));
    REQUIRE (g.root.wires.size() == 2);
    CHECK (graph::toText (g.root.wires[1]) == "drag.force -> [1] -> (+) grain.amplitude");
    CHECK (g.root.wires[1].gain == "1e-4 m/N");
    CHECK (g.root.wires[1].enabled == false);
    CHECK (g.root.wires[1].extra["ui"]["bend"] == 3);
    CHECK (g.controls.at (0).value == 0.25);
    CHECK (g.controls.at (0).to.at (0).high == "0.12 N");
    CHECK (g.find ("grain")->expose.params.at (0).second.port == "amplitude");
    CHECK (g.extra["author"] == "me");
    CHECK (loaded.positionOf ("/nodes/drag/params/d_max") == (TextPosition { 7, 63 }));
    CHECK (loaded.positionOf ("/wires/1").line == 12);
}

TEST_CASE ("anything other than a graph of this version is refused first")
{
    CHECK (complaints ("[]") == "file/not_a_graph ");
    CHECK (complaints ("{}") == "file/not_a_graph ");
    CHECK (complaints (R"({ "format": "other", "version": 1, "nodes": 3 })") == "file/not_a_graph /format");
    CHECK (complaints (R"({ "format": "tactus-graph", "nodes": 3 })") == "file/missing_key ");
    CHECK (complaints (R"({ "format": "tactus-graph", "version": "1" })") == "file/wrong_kind /version");
    CHECK (complaints (R"({ "format": "tactus-graph", "version": 1.5 })") == "file/bad_value /version");
    CHECK (complaints (R"({ "format": "tactus-graph", "version": 0 })") == "file/unknown_version /version");
    CHECK (complaints (R"({ "format": "tactus-graph", "version": 3, "nodes": 3 })") == "file/newer_version /version");
    CHECK (complaints ("{") == "file/syntax ");
}

TEST_CASE ("a newer version is refused with a single message")
{
    const auto messages = readGraph (R"({ "format": "tactus-graph", "version": 7 })").messages;
    REQUIRE (messages.size() == 1);
    CHECK (messages[0].text == "the file is version 7, but this Tactus reads only versions up to 2");
}

TEST_CASE ("old versions are migrated step by step")
{
    static constexpr std::array<Migration, 2> steps { {
        { 2, [] (Json& f) { rename (f, "title", "name"); } },
        { 1, [] (Json& f) { rename (f, "heading", "title"); } },
    } };
    const FileFormat third { 3, steps };

    auto loaded = readGraph (R"({ "format": "tactus-graph", "version": 1, "heading": "Wood" })", third);
    CHECK (loaded.messages.empty());
    CHECK (loaded.graph.name == "Wood");
    CHECK (loaded.graph.extra.empty());

    loaded = readGraph (R"({ "format": "tactus-graph", "version": 2, "title": "Wood" })", third);
    CHECK (loaded.messages.empty());
    CHECK (loaded.graph.name == "Wood");

    loaded = readGraph (R"({ "format": "tactus-graph", "version": 2 })", third);
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].id == "file/migration");

    loaded = readGraph (R"({ "format": "tactus-graph", "version": 0 })", third);
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].id == "file/unknown_version");
}

TEST_CASE ("each kind of mistake is reported with its own id and place")
{
    CHECK (complaints (file (R"("name": 3)")) == "file/wrong_kind /name");
    CHECK (complaints (file (R"("tags": ["a", 1])")) == "file/wrong_kind /tags/1");
    CHECK (complaints (file (R"("rate_hz": "4 kHz")")) == "file/wrong_kind /rate_hz");
    CHECK (complaints (file (R"("rate_hz": 0)")) == "file/bad_value /rate_hz");
    CHECK (complaints (file (R"("devices": { "Left hand": {} })")) == "graph/bad_id /devices/Left hand");
    CHECK (complaints (file (R"("ui": 3)")) == "file/wrong_kind /ui");
    CHECK (complaints (file (R"("nodes": [])")) == "file/wrong_kind /nodes");
    CHECK (complaints (file (R"("nodes": { "A": { "type": "x.y" } })")) == "graph/bad_id /nodes/A");
    CHECK (complaints (file (R"("nodes": { "a": {} })")) == "file/missing_key /nodes/a");
    CHECK (complaints (file (R"("nodes": { "a": "signal.gain" })")) == "file/wrong_kind /nodes/a");
    CHECK (complaints (file (R"("nodes": { "a": { "type": "" } })")) == "file/bad_value /nodes/a/type");
    CHECK (complaints (file (R"("nodes": { "a": { "type": "graph:No" } })")) == "graph/bad_id /nodes/a/type");
    CHECK (complaints (file (R"("nodes": { "a": { "type": "file:" } })")) == "file/bad_value /nodes/a/type");
    CHECK (complaints (inNode (R"("role": "Left")")) == "graph/bad_id /nodes/a/role");
    CHECK (complaints (inNode (R"("params": [])")) == "file/wrong_kind /nodes/a/params");
    CHECK (complaints (inNode (R"("params": { "d max": 1 })")) == "graph/bad_id /nodes/a/params/d max");
    CHECK (complaints (inNode (R"("settings": { "/": 1 })")) == "graph/bad_id /nodes/a/settings/~1");
    CHECK (complaints (inNode (R"("roles": { "tip": 3, "base": ["x", 1] })")) == "file/wrong_kind /nodes/a/roles/tip, file/wrong_kind /nodes/a/roles/base/1");
    CHECK (complaints (inNode (R"("overrides": { "mu": 3 })")) == "graph/bad_path /nodes/a/overrides/mu");
    CHECK (complaints (inNode (R"("bypass": 1)")) == "file/wrong_kind /nodes/a/bypass");
    CHECK (complaints (inNode (R"("count": 0, "every": 1.5, "times": "2", "hold": "slow")"))
           == "file/bad_value /nodes/a/count, file/bad_value /nodes/a/every, file/wrong_kind /nodes/a/times, file/bad_value /nodes/a/hold");
    CHECK (complaints (inNode (R"("count": 3, "every": 2, "hold": "linear", "times": 4)")).empty());
    CHECK (complaints (file (R"("wires": ["a -> b", 3, {}, { "wire": "a.x -> b.y", "gain": "much" }, { "wire": "a.x -> b.y", "gain": [], "enabled": 1 }])"))
           == "wire/syntax /wires/0, file/wrong_kind /wires/1, file/missing_key /wires/2, unit/syntax /wires/3/gain, file/wrong_kind /wires/4/gain, "
              "file/wrong_kind /wires/4/enabled");
    CHECK (complaints (file (R"("controls": { "c": { "value": 1.5, "to": { "mu": [0, 1], "a.mu": [0], "b.mu": [0, "x"] } } })"))
           == "file/bad_value /controls/c/value, graph/bad_path /controls/c/to/mu, file/wrong_kind /controls/c/to/a.mu, unit/syntax /controls/c/to/b.mu/1");
    CHECK (complaints (file (R"("graphs": { "g": { "nodes": { "a": {} }, "expose": { "inputs": { "x": "a", "Y": "a.y" }, "outputs": [] } } })"))
           == "file/missing_key /graphs/g/nodes/a, graph/bad_path /graphs/g/expose/inputs/x, graph/bad_id /graphs/g/expose/inputs/Y, file/wrong_kind "
              "/graphs/g/expose/outputs");
}

TEST_CASE ("all problems of a file are reported together, in file order, with line and column")
{
    const auto loaded =
        readGraph ("{ \"format\": \"tactus-graph\", \"version\": 1,\n\"wires\": [\"a\"],\n\"nodes\": { \"a\": {},\n  \"a\": {} },\n\"rate_hz\": -1 }");
    REQUIRE (loaded.messages.size() == 5);
    CHECK (loaded.messages[0].id == "wire/syntax");
    CHECK (loaded.messages[0].line == 2);
    CHECK (loaded.messages[0].column == 11);
    CHECK (loaded.messages[3].id == "file/duplicate_key");
    CHECK (loaded.messages[3].line == 4);
    CHECK (loaded.messages[4].id == "file/bad_value");
}

TEST_CASE ("a file with a million mistakes lists the first thousand")
{
    std::string wires = "\"wires\": [\"a\"";
    for (int i = 0; i < 5000; ++i)
        wires += ",\"a\"";
    const auto loaded = readGraph (file (wires + "]"));
    CHECK (loaded.messages.size() == 1001);
    CHECK (loaded.messages.back().id == "file/more");
}

TEST_CASE ("a misspelt key is kept, with a warning that suggests the correct one")
{
    const auto loaded = readGraph (file (R"("wire": [], "my_wires": 1, "nodes": { "a": { "type": "x", "parms": {}, "at": 3 } })"));
    REQUIRE (loaded.messages.size() == 2);
    CHECK (loaded.messages[0].severity == Message::Severity::warning);
    CHECK (loaded.messages[0].id == "file/unknown_key");
    CHECK_THAT (loaded.messages[0].text, Contains ("'wires'"));
    CHECK_THAT (loaded.messages[1].text, Contains ("'params'"));
    CHECK (loaded.graph.extra.contains ("wire"));
    CHECK (loaded.graph.extra.contains ("my_wires"));
    CHECK (loaded.graph.root.find ("a")->extra.contains ("parms"));
}

TEST_CASE ("the distance between words counts typing errors")
{
    CHECK (editDistance ("", "abc") == 3);
    CHECK (editDistance ("wires", "wires") == 0);
    CHECK (editDistance ("wries", "wires") == 1);
    CHECK (editDistance ("wire", "wires") == 1);
    CHECK (editDistance ("kitten", "sitting") == 3);
}

TEST_CASE ("the word that was meant is near, or differs in case, or is the only one that goes on like this")
{
    const std::vector<std::string_view> known { "rate_hz", "params", "roles", "role", "wires", "name" };
    const auto meant = [&] (std::string_view word) { return std::string (closestMatch (word, known)); };
    CHECK (meant ("parms") == "params");
    CHECK (meant ("Params") == "params");
    CHECK (meant ("PARAMS") == "params");
    CHECK (meant ("parameters") == "params");
    CHECK (meant ("rate") == "rate_hz");
    CHECK (meant ("ro").empty());   // too short, and two go on like this
    CHECK (meant ("namesake").empty());
    CHECK (meant ("wireless").empty());
    CHECK (meant ("colour").empty());
}
