// SPDX-License-Identifier: MIT
#pragma once

/// Why a struct is not a node, or why one of its hooks would never be called. node.hpp includes this file; TACTUS_NODE turns each mistake into
/// an error of the compiler in the file of the node.

#include "node.hpp"

#include <concepts>
#include <type_traits>

namespace tactus
{

enum class NodeMistake
{
    none,
    construction,
    structs,
    info,
    ports,
    params,
    settings,
    peek,
    tick,
    tick_may_throw,
    tick_result,
    tick_stored,
    update,
    delay,
    adopt,
    learn,
    effort,
    prepare,
    reports,   ///< cost, problem, warning or claims
    appearance
};

namespace detail
{
// clang-format off
/// The first mistake in what every node has.
template <typename N>
consteval NodeMistake essentialMistake()
{
    using enum NodeMistake;
    if constexpr (! std::default_initializable<N>) return construction;
    else if constexpr (! requires { typename N::Inputs; typename N::Params; typename N::Outputs; }) return structs;
    else if constexpr (! requires { requires std::same_as<std::remove_cvref_t<decltype (N::info)>, Info>; }) return info;
    else if constexpr (! requires { N::ports; }) return ports;
    else if constexpr (! requires (N n) { requires std::same_as<decltype (n.params), typename N::Params>; }) return params;
    else if constexpr (requires { typename N::Settings; } && ! requires (N n) { n.settings; }) return settings;
    else if constexpr (requires (N n) { n.peek(); } && ! Peekable<N>) return peek;
    else if constexpr (! requires (N n, const typename N::Inputs in) { n.tick (in); }) return tick;
    else if constexpr (! requires (N n, const typename N::Inputs in) { { n.tick (in) } noexcept; }) return tick_may_throw;
    else if constexpr (! Node<N>) return tick_result;
    else return none;
}

/// The first hook of a node that the engine would never call, because it is not what node.hpp says.
template <typename N>
consteval NodeMistake hookMistake()
{
    using enum NodeMistake;
    using In = const typename N::Inputs;
    using Params = const typename N::Params;
    if constexpr (requires (N n, In in, Params p) { n.tick (in, p); } && ! KnowsStored<N>) return tick_stored;
    else if constexpr (requires (N n) { n.update(); } && ! Updatable<N>) return update;
    else if constexpr (requires (N n) { n.delay(); } && ! Delaying<N>) return delay;
    else if constexpr (requires (N n, N& old) { n.adopt (old); } && ! Adoptable<N>) return adopt;
    else if constexpr (requires (N n, DeviceMechanics& d) { n.learn (d); } && ! LearnsOfDevice<N>) return learn;
    else if constexpr (requires (N n) { n.effort(); } && ! Sink<N>) return effort;
    else if constexpr (requires (N n) { n.prepare(); } && ! Preparable<N>) return prepare;
    else if constexpr ((requires (N n) { n.cost(); } && ! Costly<N>) || (requires (N n) { n.problem(); } && ! SelfChecking<N>)
                       || (requires (N n, Setup s) { n.warning (s); } && ! Warning<N>) || (requires (N n) { n.claims(); } && ! Claiming<N>)) return reports;
    else if constexpr (requires { N::appearance; } && ! Visible<N>) return appearance;
    else return none;
}
// clang-format on
}   // namespace detail

template <typename N>
consteval NodeMistake nodeMistake()
{
    constexpr auto mistake = detail::essentialMistake<N>();
    if constexpr (mistake != NodeMistake::none)
        return mistake;
    else
        return detail::hookMistake<N>();
}

/// True if the datasheet has exactly one row per member of a struct, or if there is another mistake to correct first.
template <typename N, Role role>
consteval bool hasRows()
{
    if constexpr (detail::essentialMistake<N>() != NodeMistake::none)
        return true;
    else
    {
        constexpr auto rows = detail::rowCount<role> (N::ports);
        if constexpr (role == Role::input)
            return rows == detail::memberCount<typename N::Inputs>();
        else if constexpr (role == Role::param)
            return rows == detail::memberCount<typename N::Params>();
        else if constexpr (role == Role::setting)
            return rows == detail::memberCount<typename detail::SettingsOf<N>::Type>();
        else
            return rows == detail::memberCount<typename N::Outputs>();
    }
}

}   // namespace tactus

#define TACTUS_NODE_HAS_NO(mistake, N, text) \
    static_assert (::tactus::nodeMistake<N>() != ::tactus::NodeMistake::mistake, #N text)

#define TACTUS_NODE_HAS_ROWS(role, N, what) \
    static_assert (::tactus::hasRows<N, ::tactus::Role::role>(), #N "::ports must have exactly one row per member of " what)

#define TACTUS_CHECK_NODE(N)                                                                                                                          \
    TACTUS_NODE_HAS_NO (construction, N, " is not a node: it cannot be made without arguments; give it a public default constructor");                \
    TACTUS_NODE_HAS_NO (structs, N, " is not a node: it lacks one of the public structs Inputs, Params and Outputs");                                 \
    TACTUS_NODE_HAS_NO (info, N, " is not a node: it lacks `static constexpr Info info`");                                                            \
    TACTUS_NODE_HAS_NO (ports, N, " is not a node: it lacks its datasheet, `static constexpr std::tuple ports`");                                     \
    TACTUS_NODE_HAS_NO (params, N, " is not a node: it lacks the public member `Params params`");                                                     \
    TACTUS_NODE_HAS_NO (settings, N, " is not a node: it has Settings, but lacks the public member `Settings settings`");                             \
    TACTUS_NODE_HAS_NO (peek, N, " is not a node: `peek` must be `Outputs peek() const noexcept`");                                                   \
    TACTUS_NODE_HAS_NO (tick, N, " is not a node: it lacks a public `tick` that takes `const Inputs&`");                                              \
    TACTUS_NODE_HAS_NO (tick_may_throw, N, " is not a node: `tick` is not noexcept; write `Outputs tick (const Inputs& in) noexcept`");               \
    TACTUS_NODE_HAS_NO (tick_result, N, " is not a node: `tick` must return Outputs, or nothing if there is a `peek`");                               \
    TACTUS_NODE_HAS_NO (tick_stored, N, ": `tick (in, stored)` would never be called; write `Outputs tick (const Inputs&, const Params&) noexcept`"); \
    TACTUS_NODE_HAS_NO (update, N, ": `update` would never be called, because it is not noexcept; write `void update() noexcept`");                   \
    TACTUS_NODE_HAS_NO (delay, N, ": `delay` would never be called; it must be `int delay() const noexcept`, and needs a `peek`");                    \
    TACTUS_NODE_HAS_NO (adopt, N, ": `adopt` would never be called; write `void adopt (const T& old) noexcept`, with T the node itself");             \
    TACTUS_NODE_HAS_NO (learn, N, ": `learn` would never be called; write `void learn (const DeviceMechanics&) noexcept`, without a `bind`");         \
    TACTUS_NODE_HAS_NO (effort, N, ": `effort` would never be called; it must be `Effort effort() const noexcept`, and needs a `bind`");              \
    TACTUS_NODE_HAS_NO (prepare, N, ": `prepare` would never be called; write `void prepare (const Setup&)`");                                        \
    TACTUS_NODE_HAS_NO (reports, N, ": cost, problem, warning or claims would never be called; they are const, and return what node.hpp says");       \
    TACTUS_NODE_HAS_NO (appearance, N, ": `appearance` must be `static constexpr Appearance appearance`")

#define TACTUS_CHECK_ROWS(N)                       \
    TACTUS_NODE_HAS_ROWS (input, N, "Inputs");     \
    TACTUS_NODE_HAS_ROWS (param, N, "Params");     \
    TACTUS_NODE_HAS_ROWS (setting, N, "Settings"); \
    TACTUS_NODE_HAS_ROWS (output, N, "Outputs")
