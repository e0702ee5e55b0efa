// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>

namespace tactus
{

/// A number at the start of a text.
struct NumberAt
{
    double value = 0.0;
    std::size_t size = 0;       ///< how many characters of the text it takes; 0: the text does not begin with a number
    bool is_in_range = false;   ///< false also for a number that is too large
};

/// True if a number that is out of range is too small, from the power of ten of its first digit. [any thread]
inline bool isTooSmall (std::string_view number) noexcept
{
    const auto e = std::min (number.find_first_of ("eE"), number.size());
    const auto digits = number.substr (0, e);
    const auto first = std::min (digits.find_first_of ("123456789"), e), point = std::min (digits.find ('.'), e);
    auto power = static_cast<long long> (point) - static_cast<long long> (first);
    auto exponent = number.substr (std::min (e + 1, number.size()));
    const bool is_negative = exponent.starts_with ('-');
    if (is_negative || exponent.starts_with ('+')) exponent.remove_prefix (1);
    constexpr long long huge = 1'000'000'000'000;
    long long written = 0;
    if (std::from_chars (exponent.data(), exponent.data() + exponent.size(), written).ec == std::errc::result_out_of_range) written = huge;
    power += is_negative ? -std::min (written, huge) : std::min (written, huge);
    return power < 0;
}

/// The one way in which the numbers in files, options and fields are read: decimal, with a point in any locale, and rounded once, to the nearest
/// double, however small: 1e-310 is itself, and 1e-400 is 0. "inf" and "nan" are numbers. A plus sign is allowed, because some instruments write one.
inline NumberAt readNumber (std::string_view text) noexcept
{
    const bool has_plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
    NumberAt number;
    const auto* const begin = text.data() + (has_plus ? 1 : 0);
    const auto [end, problem] = std::from_chars (begin, text.data() + text.size(), number.value);
    number.size = problem == std::errc::invalid_argument ? 0 : static_cast<std::size_t> (end - text.data());
    number.is_in_range = problem == std::errc {};
    if (problem == std::errc::result_out_of_range && isTooSmall ({ begin, end }))
    {
        number.value = *begin == '-' ? -0.0 : 0.0;
        number.is_in_range = true;
    }
    return number;
}

/// The number that this text is; empty if it is none, is out of range, or has something else behind it.
inline std::optional<double> wholeNumber (std::string_view text) noexcept
{
    const auto number = readNumber (text);
    return number.is_in_range && number.size == text.size() ? std::optional (number.value) : std::nullopt;
}

}   // namespace tactus
