// SPDX-License-Identifier: MIT
#pragma once

#include <framework/catalogue.hpp>
#include <framework/graph/graph.hpp>

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tactus::test
{

/// What a graph means, written as plainly as possible and as slowly: each tick pulls every output by name, through
/// subgraphs and wires. Plans are compared with it. For graphs that compile.
class Interpreter
{
public:
    Interpreter (const graph::Graph&, double rate_hz);

    void tick (const std::map<std::string, Reading>& readings);

    /// A component of an output, by its full name: "sub/n3.force.x".
    std::map<std::string, double> outputs() const;

private:
    struct Instance
    {
        const NodeType* type = nullptr;
        const graph::Node* source = nullptr;
        std::string role;
        std::shared_ptr<void> node;
        std::vector<double> outputs;   // as doubles: Outputs structs hold nothing else
        std::vector<std::vector<double>> params;
        int entries = 0;
        bool done = false;
    };
    struct End
    {
        std::string node, port;   // node by full path, port as "in", "in[2]"
        int component = -1;
    };
    struct Wire
    {
        End from, to;
        const graph::Wire* wire = nullptr;
        double gain = 1.0;
        std::map<int, std::deque<double>> line;   // by component
    };

    const graph::Graph& g;
    std::map<std::string, Instance> instances;
    std::vector<Wire> wires;
    std::map<std::string, std::unique_ptr<DeviceState>> roles;

    using Roles = std::map<std::string, std::string>;

    void expand (const graph::Patch&, const std::string& prefix, const Roles&);
    void expandInstances (const graph::Node&, const std::string& prefix, const Roles&);
    void add (const graph::Node&, const std::string& path, const Roles&);
    void override (const graph::Node&, const std::string& prefix);
    std::vector<End> resolve (const graph::Patch&, const std::string& prefix, const graph::Endpoint&, bool start) const;
    void evaluate (const std::string& path);
    double output (const End&, int component);
    bool driven (const std::string& path, const std::string& port, int component, bool add, double& value);
};

}   // namespace tactus::test
