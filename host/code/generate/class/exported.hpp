// SPDX-License-Identifier: MIT
#pragma once

/// The data that the parts of the generator share: the graph to export, read from a plan and a run.

#include "node_memory.hpp"
#include "plan_names.hpp"

#include <tactus/graph/graph.hpp>
#include <tactus/run/guard.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// One component of a parameter that can be set at run time.
struct ExportedParameter
{
    std::string name;         ///< "drag.mu", as in --set
    std::string enumerator;   ///< "drag_mu"
    std::size_t node = 0;     ///< number in PlanNames::nodes
    const PortSheet* sheet = nullptr;
    int slot = 0;   ///< component or entry
    std::size_t knob = 0;
    double value = 0.0;
    std::string unit {};   ///< SI symbol, "" if unknown
};

struct ExportedControl
{
    /// A parameter, and its values when the control is at 0 and at 1.
    struct Target
    {
        std::size_t parameter;
        double low, high;
    };

    std::string id, enumerator, name;
    double value = 0.0;
    std::vector<Target> to;
};

struct ExportedRole
{
    std::string name;
    GuardLimits limits;
    DeviceLayout layout;
};

/// A graph on its way into C++.
struct Exported
{
    const graph::Graph& graph;
    PlanNames& wiring;
    std::string file;         ///< of the graph: "dry_wood.json"
    std::string stem;         ///< of the files: "dry_wood"
    std::string class_name;   ///< "DryWood"
    std::string program;      ///< "tactus 0.2.0"
    bool is_single = false;   ///< see ExportOptions
    bool has_makefile = true;
    bool has_plugins = false;   ///< nodes of plugins, whose headers are not ours
    std::vector<ExportedParameter> parameters;
    std::vector<ExportedControl> controls;
    std::vector<std::string> hits;   ///< enumerators
    std::vector<ExportedRole> roles;
    std::vector<std::string> feed_units {};   ///< by feed: SI symbol, "" if unknown
    NodeMemory memory {};
};

}   // namespace tactus::host
