// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>

namespace tactus::readers
{

/// Reads text line by line, with any line endings; skips a byte order mark.
class Lines
{
public:
    explicit Lines (std::string_view text) noexcept : rest (text.starts_with ("\xef\xbb\xbf") ? text.substr (3) : text) {}

    /// The next line; empty after the last one.
    std::optional<std::string_view> next() noexcept
    {
        if (rest.empty()) return std::nullopt;
        const auto line = rest.substr (0, rest.find_first_of ("\r\n"));
        rest.remove_prefix (line.size());
        rest.remove_prefix (rest.starts_with ("\r\n") ? 2 : std::min<std::size_t> (1, rest.size()));
        ++count;
        return line;
    }

    std::size_t number() const noexcept { return count; }   ///< number of the latest line, from 1
    std::string_view behind() const noexcept { return rest; }

private:
    std::string_view rest;
    std::size_t count = 0;
};

/// Removes the next word from the front of a line; empty if there is none.
inline std::string_view takeWord (std::string_view& line) noexcept
{
    constexpr std::string_view spaces = " \t\v\f";
    line.remove_prefix (std::min (line.find_first_not_of (spaces), line.size()));
    const auto word = line.substr (0, line.find_first_of (spaces));
    line.remove_prefix (word.size());
    return word;
}

/// Parses an entire string as a number, with a decimal point in any locale; T is double or an integer type.
template <typename T>
std::optional<T> numberIn (std::string_view text) noexcept
{
    if constexpr (std::is_same_v<T, double>) return wholeNumber (text);
    if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix (1);
    T value {};
    const auto [stop, problem] = std::from_chars (text.data(), text.data() + text.size(), value);
    if (problem != std::errc {} || stop != text.data() + text.size()) return std::nullopt;
    return value;
}

}   // namespace tactus::readers
