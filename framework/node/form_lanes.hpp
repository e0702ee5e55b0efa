// SPDX-License-Identifier: MIT
#pragma once

/// Makes the LaneForm of a node. Only for files that are compiled for one kind of processor; see <tactus/kit/pack.hpp>. Include it first.

#define TACTUS_ONLY_LANES

#include "lane_form.hpp"
#include "node.hpp"

#include <tactus/kit/pack.hpp>

#include <cstring>
#include <memory>
#include <new>
#include <tuple>
#include <type_traits>

namespace tactus
{

namespace detail
{
template <typename T>
inline constexpr bool is_list = false;
template <typename T>
inline constexpr bool is_list<InputList<T>> = true;

template <typename N>
struct InLanes
{
    using Inputs = typename N::Inputs;
    using Outputs = typename N::Outputs;

    template <typename T>
    static constexpr bool is_vector = requires
    {
        typename T::Scalar;
    };

    template <typename T>
    static T load ([[maybe_unused]] const N& node, const double* const*& sources) noexcept
    {
        if constexpr (is_vector<T>)
        {
            using V = typename T::Scalar;
            sources += 3;
            return { V::load (sources[-3]), V::load (sources[-2]), V::load (sources[-1]) };
        }
        else if constexpr (is_list<T>)
            return { sources, node.settings.inputs };   // the only input of its node
        else
            return T::load (*sources++);
    }

    static Inputs gather (const N& node, const double* const* sources) noexcept
    {
        Inputs in;
        const auto fill = [&] (const auto& row) {
            using R = std::remove_cvref_t<decltype (row)>;
            if constexpr (R::role == Role::input) in.*row.member = load<typename R::Value> (node, sources);
        };
        std::apply ([&] (const auto&... row) { (fill (row), ...); },
                    N::ports);
        return in;
    }

    static void make (void* pack, const void* settings) noexcept
    {
        auto& node = *new (pack) N;
        (void)node, (void)settings;
        if constexpr (requires { node.settings; })
            if constexpr (! std::is_empty_v<decltype (node.settings)>) std::memcpy (&node.settings, settings, sizeof node.settings);
    }

    static void update (void* pack) noexcept { static_cast<N*> (pack)->update(); }

    static void tick (void* packs, std::size_t count, const double* const* sources, std::size_t inputs, void* outputs) noexcept
    {
        auto* node = static_cast<N*> (packs);
        auto* out = static_cast<Outputs*> (outputs);
        for (std::size_t i = 0; i < count; ++i, sources += inputs)
            new (out + i) Outputs (node[i].tick (gather (node[i], sources)));
    }
};

template <typename T>
consteval std::size_t wordsIn();

template <typename... T>
consteval std::size_t wordsIn (const std::tuple<T...>*)
{
    return (wordsIn<std::remove_cvref_t<T>>() + ... + 0);
}

/// The number of words that WordPlaces notes for a member.
template <typename T>
consteval std::size_t wordsIn()
{
    if constexpr (requires { typename T::Scalar; })
        return 3;
    else if constexpr (requires (T & member) { member.members(); })
        return wordsIn (static_cast<const decltype (std::declval<T&>().members())*> (nullptr));
    else
        return 1;
}

template <typename N>
consteval std::size_t wordsOf()
{
    constexpr auto param = [] (const auto& row) {
        using R = std::remove_cvref_t<decltype (row)>;
        if constexpr (R::role == Role::param)
            return wordsIn<typename R::Value>();
        else
            return std::size_t { 0 };
    };
    auto words = std::apply ([param] (const auto&... row) { return (param (row) + ... + 0); }, N::ports);
    if constexpr (requires (N & node) { node.state(); }) words += wordsIn (static_cast<const decltype (std::declval<N&>().state())*> (nullptr));
    return words;
}

/// Notes where the words of lane 0 are.
struct WordPlaces
{
    const void* pack;
    LaneForm& form;
    std::size_t count = 0;

    template <typename T>
    void operator() (T& member) noexcept
    {
        if constexpr (requires { typename T::Scalar; })
            for (int i = 0; i < 3; ++i)
                (*this) (member[i]);
        else if constexpr (requires { member.members(); })
            std::apply ([this] (auto&... m) { ((*this) (m), ...); },
                        member.members());
        else
            form.offsets[count++] = static_cast<std::uint32_t> (reinterpret_cast<const char*> (&member) - static_cast<const char*> (pack));
    }
};
}   // namespace detail

/// `N` is the template of a node, `width` the number of lanes.
template <template <typename> typename N, int width>
LaneForm formLanes() noexcept
{
    using Lanes = N<Pack<width>>;
    using Here = detail::InLanes<Lanes>;
    static_assert (std::is_trivially_destructible_v<Lanes>);
    static_assert (detail::wordsOf<Lanes>() <= LaneForm::most_words, "too many params and members of state() for lanes");
    static_assert (! Peekable<Lanes>, "a node that peeks cannot run in lanes");
    static_assert (sizeof (typename Lanes::Outputs) == width * sizeof (typename N<double>::Outputs), "outputs are doubles and vectors");

    LaneForm form { .width = width, .size = sizeof (Lanes), .outputs_size = sizeof (typename Lanes::Outputs) };
    Lanes lanes;
    detail::WordPlaces places { &lanes, form };
    const auto param = [&] (const auto& row) {
        if constexpr (std::remove_cvref_t<decltype (row)>::role == Role::param) places (lanes.params.*row.member);
    };
    std::apply ([&] (const auto&... row) { (param (row), ...); },
                Lanes::ports);
    form.params = places.count;
    if constexpr (requires { lanes.state(); })
        std::apply ([&] (auto&... member) { (places (member), ...); },
                    lanes.state());
    form.state = places.count - form.params;
    form.make = &Here::make;
    if constexpr (requires { lanes.update(); }) form.update = &Here::update;
    form.tick = &Here::tick;
    return form;
}

}   // namespace tactus
