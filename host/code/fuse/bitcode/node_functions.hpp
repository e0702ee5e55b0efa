// SPDX-License-Identifier: MIT
#pragma once

/// The functions of a node that wiring calls (host/code/fuse/wiring_writer.hpp). The build compiles them to bitcode, for each node.

#include <tactus/node/catalogue.hpp>

#include <new>

namespace tactus::host
{

template <typename N>
struct NodeFunctions
{
    using Outputs = typename N::Outputs;

    static void tickStored ([[maybe_unused]] void* node, [[maybe_unused]] const void* stored, [[maybe_unused]] const double* const* sources,
                            [[maybe_unused]] void* outputs) noexcept
    {
        if constexpr (KnowsStored<N>) tactus::detail::NodeAdapter<N>::tickStored (node, stored, sources, outputs);
    }

    static void peek ([[maybe_unused]] void* node, [[maybe_unused]] void* outputs) noexcept
    {
        if constexpr (Peekable<N>) tactus::detail::NodeAdapter<N>::peek (node, nullptr, outputs);
    }

    static void update ([[maybe_unused]] void* node) noexcept
    {
        if constexpr (Updatable<N>) static_cast<N*> (node)->update();
    }
};

}   // namespace tactus::host

/// Defines the functions. Fused code asks that they are inlined, because their arguments are known there.
#define TACTUS_NODE_FUNCTIONS(N, name)                                                                           \
    extern "C"                                                                                                   \
    {                                                                                                            \
        void tactus_fused_tick_##name (void* node, const double* const* sources, void* outputs) noexcept         \
        {                                                                                                        \
            tactus::detail::NodeAdapter<N>::tick (node, sources, outputs);                                       \
        }                                                                                                        \
        void tactus_fused_tick_stored_##name (void* node, const void* stored, const double* const* sources,      \
                                              void* outputs) noexcept                                            \
        {                                                                                                        \
            tactus::host::NodeFunctions<N>::tickStored (node, stored, sources, outputs);                         \
        }                                                                                                        \
        void tactus_fused_peek_##name (void* node, void* outputs) noexcept                                       \
        {                                                                                                        \
            tactus::host::NodeFunctions<N>::peek (node, outputs);                                                \
        }                                                                                                        \
        void tactus_fused_update_##name (void* node) noexcept { tactus::host::NodeFunctions<N>::update (node); } \
        void tactus_fused_initialise_##name (void* outputs) noexcept { new (outputs) N::Outputs(); }             \
    }
