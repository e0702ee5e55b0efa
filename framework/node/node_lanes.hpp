// SPDX-License-Identifier: MIT
#pragma once

/// How a node moves into a lane and out of it: the part of NodeLanes that every processor can run.

#include "lane_form.hpp"
#include "node.hpp"

#include <bit>
#include <cstdint>
#include <tuple>
#include <type_traits>

namespace tactus
{

namespace detail
{
/// Writes members as words, one after another.
struct WordWriter
{
    std::uint64_t* words;

    template <typename T>
    void operator() (const T& member) noexcept
    {
        if constexpr (std::is_same_v<T, double>)
            *words++ = std::bit_cast<std::uint64_t> (member);
        else if constexpr (std::is_same_v<T, bool>)
            *words++ = member ? ~std::uint64_t {} : 0;
        else if constexpr (std::is_enum_v<T>)
            *words++ = static_cast<std::uint64_t> (member);
        else if constexpr (std::is_same_v<T, Vec3>)
            for (int i = 0; i < 3; ++i)
                (*this) (member[i]);
        else
        {
            auto tick = member.tick();
            std::apply ([this] (const auto&... m) { ((*this) (m), ...); },
                        tick.members());
        }
    }
};

struct WordReader
{
    const std::uint64_t* words;

    template <typename T>
    void operator() (T& member) noexcept
    {
        if constexpr (std::is_same_v<T, double>)
            member = std::bit_cast<double> (*words++);
        else if constexpr (std::is_same_v<T, bool>)
            member = *words++ != 0;
        else if constexpr (std::is_enum_v<T>)
            member = static_cast<T> (*words++);
        else if constexpr (std::is_same_v<T, Vec3>)
            for (int i = 0; i < 3; ++i)
                (*this) (member[i]);
        else
        {
            auto tick = member.tick();
            std::apply ([this] (auto&... m) { ((*this) (m), ...); },
                        tick.members());
            member.setTick (tick);
        }
    }
};
}   // namespace detail

/// `N` is the node for a single instance. `forms` make its forms by rising width; only those that this processor can run are called.
template <Node N>
NodeLanes laneNode (LaneForm (*const (&forms)[NodeLanes::most_forms])() noexcept)
{
    NodeLanes lanes;
    for (std::size_t i = 0, width = 2; i < NodeLanes::most_forms && width <= widestLanes(); ++i, width *= 2)
        if (forms[i] != nullptr) lanes.forms[i] = forms[i]();
    lanes.fit = [] (const void* node) noexcept {
        if constexpr (requires (const N n) { n.fitsLanes(); })
            return static_cast<const N*> (node)->fitsLanes();
        else
            return node != nullptr;
    };
    lanes.settings = [] (const void* node) noexcept -> const void* {
        if constexpr (requires (const N n) { n.settings; })
            return &static_cast<const N*> (node)->settings;
        else
            return nullptr;
    };
    lanes.saveParams = [] (void* node, std::uint64_t* words) noexcept {
        detail::WordWriter write { words };
        const auto param = [&] (const auto& row) {
            if constexpr (std::remove_cvref_t<decltype (row)>::role == Role::param) write (static_cast<N*> (node)->params.*row.member);
        };
        std::apply ([&] (const auto&... row) { (param (row), ...); },
                    N::ports);
    };
    lanes.saveState = [] ([[maybe_unused]] void* node, std::uint64_t* words) noexcept {
        if constexpr (requires (N n) { n.state(); })
            std::apply ([write = detail::WordWriter { words }] (const auto&... m) mutable { (write (m), ...); },
                        static_cast<N*> (node)->state());
    };
    lanes.restoreState = [] ([[maybe_unused]] void* node, const std::uint64_t* words) noexcept {
        if constexpr (requires (N n) { n.state(); })
            std::apply ([read = detail::WordReader { words }] (auto&... m) mutable { (read (m), ...); },
                        static_cast<N*> (node)->state());
    };
    return lanes;
}

}   // namespace tactus
