// SPDX-License-Identifier: MIT
#pragma once

#include <host/code/generate/sources/code.hpp>
#include <host/code/generate/sources/sources.hpp>
#include <host/code/generate/walk/plan_addresses.hpp>
#include <host/code/generate/walk/plan_walk.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace tactus::host
{

/// A node of a plan as exported code names it.
struct ExportedNode : PlanNode
{
    bool is_inner = false;        ///< inside a part of the graph that runs at another rate
    bool is_read = true;          ///< something reads its outputs
    std::size_t parameters = 0;   ///< number of its first parameter
};

/// Names everything that the records of a plan point to. What one part of the tick passes to another within the same tick is a local
/// variable; what lasts, and everything inside a section, is a member of `state`.
class PlanNames
{
public:
    using PluginClasses = std::map<std::string, NodeClass, std::less<>>;   ///< by id

    /// The plan must outlive this object. `taken` are the names of members that exist anyway; `of_plugins` are the classes of nodes that
    /// are not in nodes/.
    PlanNames (const Plan&, const std::vector<std::string>& feeds, std::set<std::string> taken, PluginClasses of_plugins = {});

    const Plan& plan;
    std::vector<ExportedNode> nodes;                               ///< nodes that run, in the order of Plan::instances
    std::map<const plan::RunningSection*, std::string> sections;   ///< names: "heard"
    std::vector<std::pair<std::string, std::string>> kept;         ///< type and name of each member of `state`
    std::vector<std::pair<std::size_t, std::size_t>> hits;         ///< by hit input: number in Plan::instances, and index in Knobs::pulses
    std::vector<std::string> hit_names;                            ///< as in `tactus hit`: "ring.hit"
    std::vector<std::string> role_names, role_ports;               ///< by role: the member of the class, and of Inputs and Outputs
    std::vector<std::string> feed_names, tap_names;                ///< members of Inputs and of Outputs

    /// The value that a pointer of the plan leads to, as an expression. Notes that it is read: see noteReads().
    std::string valueAt (const double*);

    /// Three pointers as a vector. `type` comes before a list in braces.
    std::string valueAt (const double* const* three, const std::string& type = {});

    /// Starts a new record of what is read. From now on, is_read and isRead report what was read between the last call and this one;
    /// until the second call, everything counts as read. Returns false if nothing has changed.
    bool noteReads();

    /// True if something reads a value that is a local variable.
    bool isRead (const double* value) const { return ! has_noted || known_reads.contains (value); }

    ExportedNode* nodeOf (const void* node);
    const plan::FlatNode& flat (const ExportedNode& n) const { return plan.flat().nodes[n.instance]; }
    const NodeType& type (const ExportedNode& n) const { return *flat (n).type; }

    /// The variable that holds a node's outputs.
    static std::string outputsOf (const ExportedNode& n) { return (n.is_inner ? "state." : "") + n.name + "_out"; }

    /// The left side of the assignment of a record's value: "const double motor_force_x", or a member of `state`.
    std::string target (const double* value, const std::string& type = "double") const;

    /// The member that is the rate converter or delay line at this address.
    std::string object (const void* of) const { return objects.at (of); }

    /// The number of the tick of a section, or of the graph: "state.heard_ticks".
    std::string ticksOf (const std::uint64_t* number) const;

    std::size_t hitOf (const plan::Pulse* pulse) const { return by_pulse.at (pulse); }

    /// A component of a port as a member of its struct: "mu", "direction.x()", "gain[2]".
    static std::string memberOf (const PortSheet&, int slot);

    /// The same as a name: "mu", "direction_x", "gain_2".
    static std::string nameOf (const PortSheet&, int slot);

private:
    void nameNodes();
    void nameOutside (const std::vector<std::string>& feeds);
    void nameConsumers();
    void nameDriven (const plan::DrivenNode&);
    void nameRecords (std::span<const Record>, bool is_inner);
    void nameSection (const plan::RunningSection&);
    void nameValue (const double* value, const std::string& fallback, bool is_inner);
    std::string nameOf (const PlanAddresses::Found&) const;
    std::string nameObject (const void* object, const double* out, const double* from, const std::string& type);
    int sectionOf (std::span<const Record>) const;

    const PlanAddresses addresses;
    Names members;
    PluginClasses plugin_classes;
    std::set<const double*> reads, known_reads;   // values of records
    std::set<std::size_t> node_reads;             // nodes whose outputs are read
    bool has_noted = false;
    std::unordered_map<const double*, std::string> consumers;   // the input or parameter that reads a value: "motor_force_x"
    std::unordered_map<const double*, std::string> values;      // how to read a value
    std::unordered_map<const void*, std::string> objects;
    std::unordered_map<const void*, std::size_t> by_address;    // the number in `nodes`, by the address of the node
    std::unordered_map<std::size_t, std::size_t> by_instance;   // the number in `nodes`, by the number of the instance
    std::map<const plan::Pulse*, std::size_t> by_pulse;
};

}   // namespace tactus::host
