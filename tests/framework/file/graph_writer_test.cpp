// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/text/json_writer.hpp>

#include <framework/graph/wild_graph.hpp>

#include <catch2/catch.hpp>

#include <charconv>
#include <cstring>

using namespace tactus;

TEST_CASE ("a graph is written in a fixed order, with one node or wire per line")
{
    const auto loaded =
        readGraph (R"({ "ui": {}, "format": "tactus-graph", "wires": [ { "wire": "a.out->b.in" }, { "gain": 0.5, "wire": "a.out -> b.in", "note": 1 } ],
        "nodes": { "b": { "ui": { "at": [1, 2] }, "note": "kept", "params": { "gain": "2 N" }, "type": "signal.gain" }, "a": { "type": "signal.lfo" } },
        "version": 1, "author": "me", "name": "Two" })");
    REQUIRE (loaded.messages.empty());
    CHECK (writeGraph (loaded.graph) == R"({
  "format": "tactus-graph",
  "version": 2,
  "name": "Two",
  "rate_hz": 4000,
  "nodes": {
    "b": { "type": "signal.gain", "params": { "gain": "2 N" }, "note": "kept", "ui": { "at": [1, 2] } },
    "a": { "type": "signal.lfo" }
  },
  "wires": [
    "a.out -> b.in",
    { "wire": "a.out -> b.in", "gain": 0.5, "note": 1 }
  ],
  "author": "me",
  "ui": {}
}
)");
}

TEST_CASE ("the name of the schema is kept, unread, and stands at the top of the file")
{
    const auto loaded = readGraph (R"({ "format": "tactus-graph", "version": 2, "nodes": {}, "wires": [], "$schema": "graph.schema.json", "mine": 1 })");
    CHECK (loaded.messages.empty());
    const auto text = writeGraph (loaded.graph);
    CHECK (text.starts_with ("{\n  \"$schema\": \"graph.schema.json\",\n  \"format\""));
    CHECK (text.find ("$schema", 10) == text.npos);
    CHECK (writeGraph (readGraph (text).graph) == text);
}

TEST_CASE ("long lines are broken, and numbers are packed")
{
    Json table = Json::array(), rows = Json::array();
    for (int i = 0; i < 60; ++i)
        table.push_back (i * 0.25);
    for (int i = 0; i < 20; ++i)
        rows.push_back (Json::array ({ i, 0.0, 1e-7 }));
    const auto text = writeJson (Json { { "table", table }, { "rows", rows }, { "short", Json::array ({ 1, 2 }) } });
    CHECK (Json::parse (text) == (Json { { "table", table }, { "rows", rows }, { "short", Json::array ({ 1, 2 }) } }));
    CHECK (text.find ("\n    [3, 0.0, 1e-7],\n") != std::string::npos);
    CHECK (text.find ("\n  \"short\": [1, 2]\n") != std::string::npos);
    std::size_t longest = 0;
    for (std::size_t begin = 0, end; (end = text.find ('\n', begin)) != std::string::npos; begin = end + 1)
        longest = std::max (longest, end - begin);
    CHECK (longest <= 120);
    CHECK (longest > 100);
}

TEST_CASE ("numbers are short and read back to the same double")
{
    CHECK (jsonNumber (0.0) == "0.0");
    CHECK (jsonNumber (-0.0) == "-0.0");
    CHECK (jsonNumber (100.0) == "100.0");
    CHECK (jsonNumber (0.0004) == "0.0004");
    CHECK (jsonNumber (1e-5) == "1e-5");
    CHECK (jsonNumber (1.5e-12) == "1.5e-12");
    CHECK (jsonNumber (1e22) == "1e22");
    CHECK (jsonNumber (-2.5e100) == "-2.5e100");
    CHECK (jsonNumber (5e-324) == "5e-324");
    test::property ("any finite double", [] {
        const auto bits = *rc::gen::arbitrary<std::uint64_t>();
        double value = 0.0, back = 0.0;
        std::memcpy (&value, &bits, sizeof value);
        RC_PRE (value - value == 0.0);
        const auto text = jsonNumber (value);
        std::from_chars (text.data(), text.data() + text.size(), back);
        RC_ASSERT (std::memcmp (&value, &back, sizeof value) == 0);
        RC_ASSERT (Json::parse (text).is_number_float());
    });
}

TEST_CASE ("files do not change when loaded and saved, byte for byte")
{
    test::property ("random graphs", [] {
        const auto seed = *rc::gen::arbitrary<std::uint64_t>();
        const auto text = writeGraph (test::wildGraph (seed));
        const auto loaded = readGraph (text);
        RC_ASSERT (! hasErrors (loaded.messages));
        RC_ASSERT (writeGraph (loaded.graph) == text);
    });
}

TEST_CASE ("text that is not UTF-8 cannot break a file")
{
    graph::Graph g;
    g.name = "\xFF broken";
    const auto text = writeGraph (g);
    CHECK (readGraph (text).messages.empty());
    CHECK (writeGraph (readGraph (text).graph) == text);
}
