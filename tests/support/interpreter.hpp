// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/node/catalogue.hpp>

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tactus::test
{

/// Evaluates a graph in the plainest (and slowest) way: each tick pulls every output by name, through subgraphs and
/// wires, in and out of sections with their own rates. Tests compare compiled plans with it. It handles only graphs that
/// compile, and asks the compiler whether a port carries hits or a signal.
class Interpreter
{
public:
    Interpreter (const graph::Graph&, double rate_hz);

    void tick (const std::map<std::string, Reading>& readings);

    /// The components of all outputs, by full name: "sub/n3.force.x".
    std::map<std::string, double> outputs() const;

private:
    struct Instance
    {
        const NodeType* type = nullptr;
        const graph::Node* source = nullptr;
        std::string role;
        std::shared_ptr<void> node;
        std::vector<double> outputs;   // as doubles: Outputs structs contain nothing else
        std::vector<std::vector<double>> params;
        int entries = 0;
        int section = 0;
        bool done = false;
    };
    struct Section
    {
        int around = -1;
        int every = 1, times = 1;
        bool linear = false;
        double up = 1.0, down = 1.0;   // number of its ticks per tick of the graph: up / down
        std::uint64_t number = 0;      // number of its current tick, counted in its own ticks
        bool done = false;             // has run in this tick of the enclosing section
    };
    struct End
    {
        std::string node, port;   // full path of the node; port as "in" or "in[2]"
        int component = -1;
    };
    struct Crossing
    {
        double out = 0.0, gathered = 0.0, before = 0.0, newest = 0.0;
        bool begun = false;
    };
    struct Wire
    {
        End from, to;
        const graph::Wire* wire = nullptr;
        int section = 0;   // the section in which the wire is written
        double gain = 1.0;
        bool hits = false, steps = false;                           // what the wire carries; if neither is set, a signal
        std::vector<int> leaves, enters;                            // the sections that the wire crosses
        std::map<int, std::deque<double>> line;                     // delayed values, by component
        std::map<int, std::map<int, Crossing>> leaving, entering;   // by component, then by section
    };

    const graph::Graph& g;
    std::map<std::string, Instance> instances;
    std::vector<Wire> wires;
    std::map<std::string, std::vector<std::size_t>> wires_to;   // indices into `wires`, by the node where the wires end
    std::vector<Section> sections { {} };
    std::map<std::string, std::unique_ptr<DeviceState>> roles;

    using Roles = std::map<std::string, std::string>;

    void expand (const graph::Patch&, const std::string& prefix, const Roles&, int section);
    void expandInstances (const graph::Node&, const std::string& prefix, const Roles&, int section);
    int sectionOf (const graph::Node&, int around);
    void add (const graph::Node&, const std::string& path, const Roles&, int section);
    void override (const graph::Node&, const std::string& prefix);
    static void choose (Instance&, const PortSheet&, const Json& word);
    void route();
    void findWhatIsCarried();
    const PortSheet& sheet (const End&, bool start) const;
    std::vector<int> components (const Wire&) const;
    static int fromComponent (const Wire&, int component);
    std::vector<End> resolve (const graph::Patch&, const std::string& prefix, const graph::Endpoint&, bool start) const;
    void evaluate (const std::string& path);
    void run (int section);
    void step (int section);
    double enteringValue (Wire&, int section, int component);
    double leavingValue (Wire&, int section, int component);
    double arrives (Wire&, int component, std::size_t sections_entered);
    double currentValue (const End&, int component) const;
    double output (const End&, int component);
    bool driven (const std::string& path, const std::string& port, int component, bool add, double& value);
};

}   // namespace tactus::test
