// SPDX-License-Identifier: GPL-3.0-or-later
// A graph file, or an edit, may put a subgraph into itself. compile() refuses the graph; the window still shows it.
#include <host/app/layers/mixer.hpp>
#include <host/app/model/face.hpp>
#include <host/app/scopes/scope_ports.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/plan/compile.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;

namespace
{
/// Three instances of a subgraph, which contains three of itself. They would be 3^32 at the depth to which the window looks.
graph::Graph recursive()
{
    const std::string three = R"("x": { "type": "graph:a" }, "y": { "type": "graph:a" }, "z": { "type": "graph:a" })";
    auto read = readGraph (R"({ "format": "tactus-graph", "version": 1, "name": "recursive", "nodes": { )" + three
                           + R"( }, "graphs": { "a": { "nodes": { "mix": { "type": "layer.mix", "settings": { "inputs": 2 } }, )" + three
                           + R"( }, "expose": { "inputs": { "p": "x.p", "q": "y.q", "r": "z.p", "m": "mix.in[0]" } } } } })");
    REQUIRE (read.graph.root.nodes.size() == 3);
    return std::move (read.graph);
}
}   // namespace

TEST_CASE ("a subgraph that contains itself is shown as often as it is written", "[app]")
{
    const auto g = recursive();
    CHECK_FALSE (compile (g, catalogue(), {}).plan);

    CHECK (mixersOf (g).size() == 1);

    const auto ports = scopePorts (g, catalogue());
    CHECK (std::ranges::count (ports, "x/mix.out", &ScopePort::name) == 1);
    CHECK (std::ranges::none_of (ports, [] (const ScopePort& p) { return p.name.starts_with ("x/x/"); }));

    const auto face = faceOf (g, g.root, g.root.nodes.front(), catalogue());
    REQUIRE (face.inputs.size() == 4);
    for (const auto& port : face.inputs)
        CHECK ((port.sheet != nullptr) == (port.id == "m"));   // the others lead to no node
}
