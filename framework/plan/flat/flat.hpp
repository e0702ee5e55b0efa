// SPDX-License-Identifier: MIT
#pragma once

/// A flat graph: subgraphs expanded, names resolved against the catalogue, values read. The later steps of compiling work on
/// it. compile.hpp lists all steps; flatten.hpp makes the flat graph.

#include <tactus/graph/graph.hpp>
#include <tactus/kit/at.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/text/message.hpp>

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tactus::plan
{

/// A step on the path to the place where something was written. The path becomes text only for a message.
struct Place
{
    enum class Kind
    {
        file,    ///< `text` is the name of an included file; the path begins here
        name,    ///< a member called `text`
        entry,   ///< entry `number` of a list
        as_is    ///< `text` verbatim: the rest of a JSON pointer, or an option of the command line
    };

    const Place* around;
    std::string_view text;
    int number;
    Kind kind;
};

/// The place where something was written, for messages; null for the graph itself. The names it refers to must outlive it.
using Origin = const Place*;

Origin fileOf (Origin) noexcept;

/// Identifies a node or wire in a graph with its subgraphs expanded.
struct Identity
{
    int scope = 0;      ///< the patch it is in: number in Flat::scopes
    graph::Id id = 0;   ///< id of the node or wire
    int instance = 0;   ///< for a subgraph node with a count: which instance

    bool operator== (const Identity&) const = default;
};

/// The cost of compiling so far; see the budgets of the same names (framework/text/budget.hpp).
struct Spent
{
    double nodes = 0.0, wires = 0.0;   ///< in the flat graphs before this one; each unused subgraph is flattened on its own, after the graph
    double work = 0.0, memory = 0.0;
    bool is_over = false;   ///< a budget is exceeded, which has been reported
};

/// The measured cost of compiling one value of a graph, in units of work (work_unit_s).
inline constexpr double work_per_value = 50.0;

/// A port of a flat node, or an entry or a component of it.
struct PortRef
{
    int node = -1;
    Role role = Role::input;
    int port = -1;        ///< row among the inputs, params or outputs of the node type
    int index = -1;       ///< entry of an array port; -1 for other ports
    int component = -1;   ///< -1 for all components

    bool operator== (const PortRef&) const = default;
};

/// An assignment to a parameter: low + amount * (high - low).
struct Assignment
{
    PortRef to;
    const Json *low, *high;
    double amount = 0.0;
    Origin origin;
};

struct FlatNode
{
    std::string path;   ///< "grain/wave"
    Identity identity {};
    const NodeType* type = nullptr;
    std::string role {};
    Origin origin {};
    bool bypass = false;
    bool muted = false;     ///< inside a bypassed subgraph: does not run
    bool is_whole = true;   ///< false if a setting was left out (see Flat::reads_files) or could not be read: no further messages about the node
    int section = 0;        ///< number in Flat::sections; the node runs at the rate of that section
    std::vector<SettingValue> settings {};
    std::size_t values = 0;   ///< index in Flat::values of the first value of its params
    int list_size = 0;

    bool runs() const noexcept { return ! muted && ! bypass; }

    const std::vector<PortSheet>& ports (Role role_) const noexcept
    {
        if (role_ == Role::input) return type->inputs;
        return role_ == Role::param ? type->params : type->outputs;
    }

    /// The number of values that a row holds: the components of a vector, or the entries of an array port.
    int slots (const PortSheet& row) const noexcept { return row.width * (row.list ? list_size : 1); }
};

struct FlatWire
{
    std::optional<PortRef> from;   ///< empty for the output of a placeholder, which is 0
    PortRef to;
    int delay = 0;
    bool add = false;
    double gain = 1.0;
    std::optional<Dimension> gain_dimension {};   ///< dimension of the gain; empty if it has no unit
    Origin origin {};
    const graph::Wire* written = nullptr;   ///< the wire in the graph; valid only during compiling
    Identity identity {};                   ///< shared by all flat wires that one wire of the graph becomes between instances
    int section = 0;                        ///< the section it is written in, which encloses both ends; its delay counts ticks of this section
    bool crosses = false;                   ///< one of its ends is in an inner section
};

/// A part of the graph that runs as a whole at its own rate: the graph itself, and the inside of each subgraph node with
/// `every` or `times`.
struct Section
{
    enum class Kind
    {
        every,   ///< on every `factor`-th tick of the enclosing section
        times    ///< `factor` times in each tick of the enclosing section
    };

    int around = -1;   ///< number in Flat::sections; -1 for the graph itself
    Kind kind = Kind::every;
    int factor = 1;
    bool linear = false;   ///< its outputs are interpolated linearly between its runs
    std::string path {};   ///< path of the subgraph node
    Origin origin {};
};

struct Flat
{
    Catalogue catalogue {};        ///< keeps the types of the nodes alive
    std::vector<FlatNode> nodes;   ///< in file order; where a subgraph node was, there are the nodes of its subgraph
    std::vector<FlatWire> wires;
    std::vector<double> values;                                            ///< values of all params, node by node and row by row
    std::vector<Assignment> assignments;                                   ///< in order of precedence, lowest first
    std::deque<NodeType> made_types;                                       ///< types of bypassed subgraphs
    std::deque<std::string> made_names;                                    ///< text that no graph contains: port names of made_types, text of origins
    std::deque<Place> places;                                              ///< what origins point to
    std::vector<Identity> scopes { { -1, 0 } };                            ///< the graph itself, then the subgraph node of each patch that was expanded
    std::vector<Section> sections { {} };                                  ///< the graph itself, then the inner sections, each after the one that encloses it
    std::unordered_map<graph::Id, std::vector<graph::Ancestor>> origins;   ///< by the id of a copy: what it was copied from
    bool reads_files = true;                                               ///< if not, settings that name files are left out, without a message
    Messages messages;
    Spent spent;

    const FlatNode& node (int n) const { return nodes[tactus::at (n)]; }
    const FlatNode& node (const PortRef& r) const { return node (r.node); }
    const PortSheet& sheet (const PortRef& r) const { return node (r).ports (r.role)[tactus::at (r.port)]; }
    const Section& section (int s) const { return sections[tactus::at (s)]; }

    int nodeCount() const noexcept { return static_cast<int> (nodes.size()); }
    int sectionCount() const noexcept { return static_cast<int> (sections.size()); }

    /// The values of a param of a node.
    std::span<double> param (int node, std::size_t row) noexcept;
    std::span<const double> param (int node, std::size_t row) const noexcept { return const_cast<Flat*> (this)->param (node, row); }

    /// "grain/wave.phase", "mix.in[2]", "hand.position.x".
    std::string nameOf (const PortRef&) const;

    /// The number of components that a reference covers.
    int widthOf (const PortRef& r) const { return r.component >= 0 ? 1 : sheet (r).width; }

    /// The sections on the way from `around` (not included) to `within` (included, last).
    std::vector<int> sectionsBetween (int around, int within) const;

    /// Ticks of a section per tick of the graph.
    double speed (int section) const;

    /// The number of ticks of the graph that one tick of a section lasts. A `times` section counts as long as the section that encloses it, because
    /// no path leads from it back to the hand.
    int ticksOf (int section) const;

    /// True if the section, or one that encloses it, does not run on every tick.
    bool rests (int section) const;

    /// The periods, in ticks, of the sections that do not run on every tick: in rising order, each once.
    std::vector<std::uint64_t> restPeriods() const;

    /// True once there are too many problems to store more. Callers can then skip writing the message.
    bool isFull() const noexcept { return messages.size() >= most_messages; }

    Origin at (Origin around, std::string_view name) { return &places.emplace_back (Place { around, name, 0, Place::Kind::name }); }
    Origin at (Origin around, std::string_view name, std::string_view inner) { return at (at (around, name), inner); }
    Origin entry (Origin list, int number) { return &places.emplace_back (Place { list, {}, number, Place::Kind::entry }); }
    Origin inFile (std::string_view name) { return &places.emplace_back (Place { nullptr, name, 0, Place::Kind::file }); }
    Origin asIs (Origin around, std::string text)
    {
        return &places.emplace_back (Place { around, made_names.emplace_back (std::move (text)), 0, Place::Kind::as_is });
    }

    /// Counts what follows toward the budgets `time` and `memory`. Call it before anything that multiplies the number of nodes,
    /// wires or values. False if a budget is exceeded; the first time, it reports this as an error.
    bool spend (double work, double memory, Origin);

    /// Adds a message. A problem that several instances share is reported for the first one only.
    void error (std::string id, Origin, std::string text, std::string remedy);
    void warn (std::string id, Origin, std::string text, std::string remedy);

private:
    void add (Message);

    std::unordered_set<std::string> reported;   ///< the messages about instances that were added, with the instance numbers removed
};

}   // namespace tactus::plan
