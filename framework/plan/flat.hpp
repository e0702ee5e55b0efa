// SPDX-License-Identifier: MIT
#pragma once

/// A graph with its subgraphs expanded, its names resolved against the catalogue and its values read: what the later
/// steps of compiling work on. See compile.hpp for the whole, flatten.hpp for how it is made.

#include <framework/catalogue.hpp>
#include <framework/graph/graph.hpp>
#include <framework/message.hpp>

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace tactus::plan
{

/// A step on the way to where something was written. Only a message puts the way in words.
struct Place
{
    enum class Kind
    {
        file,    ///< `text` is an included file's name; the way begins here
        name,    ///< a member called `text`
        entry,   ///< entry `number` of a list
        as_is    ///< `text` as it stands: the rest of a JSON pointer, or an option of the command line
    };

    const Place* around;
    std::string_view text;
    int number;
    Kind kind;
};

/// Where something was written, for messages; null for the graph itself. What it names has to stay as long.
using Origin = const Place*;

Origin fileOf (Origin) noexcept;

/// Identity in a graph with its subgraphs expanded.
struct Identity
{
    int scope = 0;      ///< where it stands: in which of Flat::scopes
    graph::Id id = 0;   ///< its own
    int instance = 0;   ///< of a subgraph node with a count: which one

    bool operator== (const Identity&) const = default;
};

/// A port of a flat node, or an entry or a component of it.
struct PortRef
{
    int node = -1;
    Role role = Role::input;
    int port = -1;        ///< row among the inputs, params or outputs of the node's type
    int index = -1;       ///< entry of an array port; -1 if the port is none
    int component = -1;   ///< -1 for all components

    bool operator== (const PortRef&) const = default;
};

/// A value given to a parameter: the point `amount` of the way from low to high.
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
    bool muted = false;   ///< inside a bypassed subgraph: takes no part
    int section = 0;      ///< of Flat::sections, whose rate it runs at
    std::vector<SettingValue> settings {};
    std::size_t values = 0;   ///< where those of its params begin in Flat::values
    int list_size = 0;

    bool runs() const noexcept { return ! muted && ! bypass; }

    const std::vector<PortSheet>& ports (Role role_) const noexcept
    {
        return role_ == Role::input ? type->inputs : role_ == Role::param ? type->params
                                                                          : type->outputs;
    }

    /// How many numbers a row stands for: the components of a vector, the entries of an array port.
    int slots (const PortSheet& row) const noexcept { return row.width * (row.list ? list_size : 1); }
};

struct FlatWire
{
    std::optional<PortRef> from;   ///< nothing: a placeholder's output, which is 0
    PortRef to;
    int delay = 0;
    bool add = false;
    double gain = 1.0;
    std::optional<Dimension> gain_dimension {};   ///< if the gain has a unit
    Origin origin {};
    const graph::Wire* written = nullptr;   ///< in the graph, as long as it is being compiled
    Identity identity {};                   ///< of all wires that one wire of the graph stands for, where its ends are instances
    int section = 0;                        ///< where it is written, and in whose ticks its delay counts: at its ends, or around them
    bool crosses = false;                   ///< an end of it is in a section within
};

/// What runs as a whole, at a rate of its own: the graph itself, and the inside of each subgraph node with `every` or
/// `times`.
struct Section
{
    enum class Kind
    {
        every,   ///< on each `factor`-th tick of the section around
        times    ///< `factor` times in each tick of the section around
    };

    int around = -1;   ///< of Flat::sections; -1 for the graph itself
    Kind kind = Kind::every;
    int factor = 1;
    bool linear = false;   ///< its outputs go from value to value in straight lines
    std::string path {};   ///< of the subgraph node
    Origin origin {};
};

struct Flat
{
    std::vector<FlatNode> nodes;   ///< in file order, a subgraph's nodes where it stands
    std::vector<FlatWire> wires;
    std::vector<double> values;                                            ///< of all params, node by node and row by row
    std::vector<Assignment> assignments;                                   ///< in order of precedence, lowest first
    std::deque<NodeType> made_types;                                       ///< of bypassed subgraphs
    std::deque<std::string> made_names;                                    ///< text that stands in no graph: of their ports, of origins
    std::deque<Place> places;                                              ///< what origins point to
    std::vector<Identity> scopes { { -1, 0 } };                            ///< the graph itself, then the subgraph node of each patch that was expanded
    std::vector<Section> sections { {} };                                  ///< the graph itself, then those within, each after the one around it
    std::unordered_map<graph::Id, std::vector<graph::Ancestor>> origins;   ///< of copies
    Messages messages;

    const PortSheet& sheet (const PortRef& r) const { return nodes[static_cast<std::size_t> (r.node)].ports (r.role)[static_cast<std::size_t> (r.port)]; }
    const FlatNode& node (const PortRef& r) const { return nodes[static_cast<std::size_t> (r.node)]; }

    /// The values of a node's param.
    std::span<double> param (int node, std::size_t row) noexcept;
    std::span<const double> param (int node, std::size_t row) const noexcept { return const_cast<Flat*> (this)->param (node, row); }

    /// "grain/wave.phase", "mix.in[2]", "hand.position.x".
    std::string nameOf (const PortRef&) const;

    /// How many components a reference stands for.
    int widthOf (const PortRef& r) const { return r.component >= 0 ? 1 : sheet (r).width; }

    const Section& section (int s) const { return sections[static_cast<std::size_t> (s)]; }

    /// The sections on the way from one, which is not among them, to one within, which comes last.
    std::vector<int> sectionsBetween (int around, int within) const;

    /// Ticks of a section in one of the graph.
    double speed (int section) const;

    /// How many ticks of the graph one of a section lasts. In a `times` section, where nothing returns to the hand, as
    /// many as one of the section around.
    int ticksOf (int section) const;

    /// True if the section, or one around it, rests on some ticks.
    bool rests (int section) const;

    /// True once so much is wrong that nobody reads on; what is found beyond is not kept, so need not be put in words.
    bool isFull() const noexcept { return messages.size() >= 1000; }

    Origin at (Origin around, std::string_view name) { return &places.emplace_back (Place { around, name, 0, Place::Kind::name }); }
    Origin at (Origin around, std::string_view name, std::string_view inner) { return at (at (around, name), inner); }
    Origin entry (Origin list, int number) { return &places.emplace_back (Place { list, {}, number, Place::Kind::entry }); }
    Origin inFile (std::string_view name) { return &places.emplace_back (Place { nullptr, name, 0, Place::Kind::file }); }
    Origin asIs (Origin around, std::string text) { return &places.emplace_back (Place { around, made_names.emplace_back (std::move (text)), 0, Place::Kind::as_is }); }

    /// What is wrong with several instances of one thing is said of the first.
    void error (std::string id, Origin, std::string text, std::string remedy);
    void warn (std::string id, Origin, std::string text, std::string remedy);

private:
    void say (Message);

    std::unordered_set<std::string> said;   ///< about instances, whichever they were
};

}   // namespace tactus::plan
