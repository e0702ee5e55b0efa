// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>

namespace tactus::host
{

/// Goes through a text line by line, whatever its line ends; a byte order mark is left out.
class Lines
{
public:
    explicit Lines (std::string_view text) noexcept : rest (text.starts_with ("\xef\xbb\xbf") ? text.substr (3) : text) {}

    /// The next line, or nothing after the last.
    std::optional<std::string_view> next() noexcept
    {
        if (rest.empty()) return std::nullopt;
        const auto line = rest.substr (0, rest.find_first_of ("\r\n"));
        rest.remove_prefix (line.size());
        rest.remove_prefix (rest.starts_with ("\r\n") ? 2 : rest.empty() ? 0
                                                                         : 1);
        ++count;
        return line;
    }

    std::size_t number() const noexcept { return count; }   ///< of the last line that was given, from 1
    std::string_view behind() const noexcept { return rest; }

private:
    std::string_view rest;
    std::size_t count = 0;
};

/// Takes the next word off the front of a line; empty if there is none.
inline std::string_view takeWord (std::string_view& line) noexcept
{
    constexpr std::string_view spaces = " \t\v\f";
    line.remove_prefix (std::min (line.find_first_not_of (spaces), line.size()));
    const auto word = line.substr (0, line.find_first_of (spaces));
    line.remove_prefix (word.size());
    return word;
}

/// The number that the whole text is, with a decimal point whatever the locale; T is double or a whole number.
template <typename T>
std::optional<T> numberIn (std::string_view text) noexcept
{
    // from_chars knows no plus sign, but some programs write one.
    if (text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+') text.remove_prefix (1);
    T value {};
    const auto [stop, problem] = std::from_chars (text.data(), text.data() + text.size(), value);
    if (problem != std::errc {} || stop != text.data() + text.size()) return std::nullopt;
    return value;
}

}   // namespace tactus::host
