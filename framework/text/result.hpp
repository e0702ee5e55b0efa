// SPDX-License-Identifier: MIT
#pragma once

#include "message.hpp"

#include <concepts>
#include <type_traits>
#include <utility>
#include <variant>

namespace tactus
{

/// True if a type, ignoring const and &, is none of the given types.
template <typename U, typename... Others>
inline constexpr bool is_none_of = (! std::same_as<std::remove_cvref_t<U>, Others> && ...);

/// A value, or the Message that explains why there is none: this is how every function in Tactus fails.
///
///     auto table = readTable (path);
///     if (! table) return table.error();
///     use (*table);
///
/// Functions that report several problems together return Messages instead, next to whatever they could read.
template <typename T = void>
class [[nodiscard]] Result
{
public:
    using value_type = T;

    Result (T v) : content (std::in_place_index<0>, std::move (v)) {}
    Result (Message m) : content (std::in_place_index<1>, std::move (m)) {}

    /// From anything else that a T can be constructed from.
    template <typename U>
    requires (is_none_of<U, T, Message, Result<T>>&& std::constructible_from<T, U>)
        Result (U&& v)
        : content (std::in_place_index<0>, std::forward<U> (v))
    {
    }

    explicit operator bool() const noexcept { return content.index() == 0; }
    bool has_value() const noexcept { return content.index() == 0; }

    /// The value. Call it only if there is one.
    T& operator*() & noexcept { return *std::get_if<0> (&content); }
    const T& operator*() const& noexcept { return *std::get_if<0> (&content); }
    T&& operator*() && noexcept { return std::move (*std::get_if<0> (&content)); }
    T* operator->() noexcept { return std::get_if<0> (&content); }
    const T* operator->() const noexcept { return std::get_if<0> (&content); }

    /// The value. Throws std::bad_variant_access if there is none.
    T& value() & { return std::get<0> (content); }
    const T& value() const& { return std::get<0> (content); }
    T&& value() && { return std::get<0> (std::move (content)); }

    /// The reason why there is no value. Call it only if there is none.
    const Message& error() const& noexcept { return *std::get_if<1> (&content); }
    Message&& error() && noexcept { return std::move (*std::get_if<1> (&content)); }

private:
    std::variant<T, Message> content;
};

/// Success, or the Message that explains the failure.
template <>
class [[nodiscard]] Result<void>
{
public:
    using value_type = void;

    Result() = default;
    Result (Message m) : failure (std::in_place_index<1>, std::move (m)) {}

    explicit operator bool() const noexcept { return failure.index() == 0; }
    bool has_value() const noexcept { return failure.index() == 0; }
    const Message& error() const& noexcept { return *std::get_if<1> (&failure); }
    Message&& error() && noexcept { return std::move (*std::get_if<1> (&failure)); }

private:
    std::variant<std::monostate, Message> failure;
};

}   // namespace tactus
