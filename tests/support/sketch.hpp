// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/graph.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/engine.hpp>

#include <string>

namespace tactus::test
{

/// A graph built in code: Sketch {}.node ("a", "signal.gain").wire ("a.out -> b.in").
struct Sketch
{
    graph::Graph graph;

    Sketch& node (std::string name, std::string type);
    Sketch& node (std::string name, std::string type, Json params);
    Sketch& node (std::string name, std::string type, Json params, Json settings);
    Sketch& wire (const std::string& text);

    static graph::Node makeNode (std::string name, std::string type);
    static graph::Node makeNode (std::string name, std::string type, Json params);
    static graph::Node makeNode (std::string name, std::string type, Json params, Json settings);

    Sketch& add (graph::Patch&, std::string name, std::string type);
    Sketch& add (graph::Patch&, std::string name, std::string type, Json params);
    Sketch& add (graph::Patch&, std::string name, std::string type, Json params, Json settings);
    Sketch& add (graph::Patch&, const std::string& wire);

    graph::Patch& subgraph (const std::string& name);

    Compiled compile (const CompileOptions& = {}) const;
};

/// True if there is a message with this id.
bool has (const Messages&, std::string_view id);

/// The messages as text, for INFO.
std::string text (const Messages&);

}   // namespace tactus::test
