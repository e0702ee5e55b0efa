// SPDX-License-Identifier: MIT
#pragma once

/// What a node is. Start here, then read nodes/signal/clamp.hpp, which has no state, nodes/filter/one_pole.hpp, which has a hook, and
/// nodes/cut/scissors.hpp, a law of the chapter with its state and energies.
///
/// A node is a plain struct. It inherits from nothing and knows nothing of graphs, threads or hosts:
///
///   Inputs, Params, Outputs   plain structs of double, Vec3 and arrays, SI units, with defaults. Generic nodes may take
///                             theirs from framework/node/generic.hpp. Places in space, and what is kept of them, are Position, all
///                             other vectors Vec3. Both are the same type here, but in a single-precision export only Position
///                             keeps enough digits (framework/kit/fine.hpp)
///   Settings                  optional; what shapes the node and is fixed while it runs
///   info, ports               its datasheet: names, units, ranges, sources (framework/node/datasheet.hpp)
///   tick (in) -> Outputs      one sample; the only function on the hot path
///   appearance                optional; what it looks like in a picture of the scene (framework/node/appearance.hpp)
///
/// Optional hooks, which the compiler detects:
///
///   problem() -> string       what is wrong with the settings, as a sentence for the user; empty if nothing is. Called with
///                             params and settings in place, before prepare. A graph with a problem does not run. Only for
///                             what the limits in the datasheet cannot express.                          [main thread]
///   cost() -> Cost            what checking and preparing the node take at most, if this depends on its settings: a graph that
///                             exceeds the budgets does not run. Called first, so settings may have a problem. [main thread]
///   warning (setup) -> string what will not work well at this rate, as a sentence; empty if everything does. Called after
///                             problem. The graph still runs.                                            [main thread]
///   prepare (setup)           before the first tick, with params and settings in place; may allocate    [main thread]
///   update()                  once after prepare, and after a parameter moved, before the tick: computes coefficients, so
///                             that a filter does not pay for `tan` on each tick                         [tick thread]
///   peek() -> Outputs         for a node whose outputs do not depend on this tick's inputs: returns them before tick,
///                             which then returns nothing. This is how a delay opens a loop.             [tick thread]
///   delay() -> int            the number of ticks between a peeking node's inputs and outputs; 1 if absent
///   tick (in, stored)         called instead of tick (in) where wires or feeds drive params: `stored` holds the Params as set by
///                             file and knobs, without wires and feeds. Such Params must be plain numbers and choices [tick thread]
///   adopt (old)               takes over the state of the instance this one replaces                    [tick thread]
///   serialize (archive)       lists the members that are its state, so that a run can be saved and restored
///                             (framework/kit/state_archive.hpp): those that a tick changes, and nothing that follows from params,
///                             settings, prepare and update. A node without it cannot be saved, unless its tick is const [tick thread]
///   claims() -> Claims        what tests and the validator can hold the node to
///   bind (state)              gives a device node the DeviceState of its role: before prepare, with the settings in place,
///                             and again when the role gets its device, then without allocating          [main or tick thread]
///   missing (layout) -> string  the part that a device node needs and the device of its role lacks, worded to follow "has";
///                             empty if none. Without that part the node reads 0, or has no effect       [main thread]
///   learn (mechanics)         tells a node that is not bound to a device what is known of the device that its inputs come from,
///                             directly or through other nodes, or, if it has no such inputs, of the device that its outputs
///                             go to. Called before warning and prepare, with what the graph describes, and again when the
///                             role gets its device, then without allocating                             [main or tick thread]
///   effort() -> Effort        makes the node a sink: the effort that it adds to its role, after tick    [tick thread]
///
/// A tick is noexcept and total. On a non-finite input it gives 0 on all outputs (-1 on `state`), re-opens the contact, and
/// continues with the next finite sample as if nothing had been touched before.
///
/// If tick is const, the node has no state: its outputs depend on nothing but its inputs, params and settings. Where these do not change,
/// the node is computed only once.
///
/// The line TACTUS_NODE (MyNode) at the end of the header checks all this at compile time. The build looks for this line to put
/// the node in the catalogue; there is no other list to edit.

#include "appearance.hpp"
#include "datasheet.hpp"
#include "device.hpp"

#include <concepts>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>

namespace tactus
{

class NearestTriangle;
class PreparedData;
class QueryService;
class StateArchive;

/// The services that a host lends to the nodes of a graph. Each may be missing; nodes work without it.
struct Services
{
    std::function<std::unique_ptr<NearestTriangle> (std::shared_ptr<const Mesh>)> nearest_triangle {};   ///< makes an index of a large mesh; call it in prepare
    QueryService* answers = nullptr;                                                                     ///< answers the async queries; null: answered when due
    PreparedData* prepared = nullptr;                                                                    ///< data that plans share; null: each prepares its own
};

/// The rate and the services that the engine gives every node before it runs.
struct Setup
{
    double rate_hz = 4000.0;
    Services services {};

    double dt_s() const noexcept { return 1.0 / rate_hz; }
};

/// The guarantees of a node with its current params and settings.
struct Claims
{
    bool passive = false;             ///< it generates no energy over any closed path
    double stiffness = 0.0;           ///< largest slope of force against position, N/m
    double damping = 0.0;             ///< smallest damping it adds, N s/m
    double spatial_frequency = 0.0;   ///< highest spatial frequency it renders, 1/m
    double amplitude = inf;           ///< its outputs never exceed this, in their own unit
};

/// The most that checking and preparing a node can cost, estimated from its settings. See the budgets of these names
/// (framework/text/budget.hpp).
struct Cost
{
    double work = 0.0;     ///< in units of about 5 ns
    double memory = 0.0;   ///< bytes
};

// clang-format 14 breaks requirements badly.
// clang-format off
template <typename N>
concept Peekable = requires (const N node) { { node.peek() } noexcept -> std::same_as<typename N::Outputs>; };

template <typename N>
concept Node = std::default_initializable<N>
    && requires {
           typename N::Inputs;
           typename N::Params;
           typename N::Outputs;
           requires std::same_as<std::remove_cvref_t<decltype (N::info)>, Info>;
           N::ports;
       }
    && requires (N node, const typename N::Inputs in) {
           requires std::same_as<decltype (node.params), typename N::Params>;
           requires ! requires { typename N::Settings; } || requires { node.settings; };
           requires (Peekable<N> && requires { { node.tick (in) } noexcept -> std::same_as<void>; })
               || (! Peekable<N> && requires { { node.tick (in) } noexcept -> std::same_as<typename N::Outputs>; });
       };

template <typename N>
concept Visible = requires { requires std::same_as<std::remove_cvref_t<decltype (N::appearance)>, Appearance>; };

template <typename N>
concept KnowsStored = requires (N node, const typename N::Inputs in, const typename N::Params stored) {
    { node.tick (in, stored) } noexcept -> std::same_as<typename N::Outputs>;
};

template <typename N>
concept Costly = requires (const N node) { { node.cost() } -> std::same_as<Cost>; };

template <typename N>
concept SelfChecking = requires (const N node) { { node.problem() } -> std::same_as<std::string>; };

template <typename N>
concept Warning = requires (const N node, Setup setup) { { node.warning (setup) } -> std::same_as<std::string>; };

template <typename N>
concept Preparable = requires (N node, Setup setup) { node.prepare (setup); };

template <typename N>
concept Updatable = requires (N node) { { node.update() } noexcept; };

template <typename N>
concept Delaying = Peekable<N> && requires (const N node) { { node.delay() } noexcept -> std::same_as<int>; };

template <typename N>
concept Adoptable = requires (N node, const N old) { { node.adopt (old) } noexcept; };

template <typename N>
concept Savable = requires (N node, StateArchive& archive) { node.serialize (archive); };

template <typename N>
concept Claiming = requires (const N node) { { node.claims() } -> std::same_as<Claims>; };

template <typename N>
concept DeviceBound = requires (N node, const DeviceState& state) { node.bind (state); };

template <typename N>
concept NamesDeviceParts = DeviceBound<N> && requires (const N node, const DeviceLayout& layout) { { node.missing (layout) } -> std::same_as<std::string>; };

template <typename N>
concept LearnsOfDevice = ! DeviceBound<N> && requires (N node, const DeviceMechanics& device) { { node.learn (device) } noexcept; };

template <typename N>
concept Sink = DeviceBound<N> && requires (const N node) { { node.effort() } noexcept -> std::same_as<Effort>; };

template <typename N>
concept Unchanging = requires (const N node, const typename N::Inputs in) { { node.tick (in) } noexcept -> std::same_as<typename N::Outputs>; };

template <typename N>
concept Stateless = Unchanging<N> && ! DeviceBound<N> && ! LearnsOfDevice<N>;
// clang-format on

}   // namespace tactus

#include "node_mistake.hpp"

// The build defines this where it adds a node to the catalogue (catalogue.cmake). It has no effect elsewhere.
#define TACTUS_REGISTER(N)

// Nothing: nodes compute one instance at a time. Headers of version 0.2 may still have this line; it goes in the next version.
#define TACTUS_LANES(...) static_assert (true)

#define TACTUS_NODE(N)     \
    TACTUS_CHECK_NODE (N); \
    TACTUS_REGISTER (N)    \
    TACTUS_CHECK_ROWS (N)
