// SPDX-License-Identifier: MIT
#pragma once

#include "is_digit.hpp"
#include "json.hpp"
#include "read_number.hpp"
#include "text_position.hpp"
#include "utf8.hpp"

#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace tactus
{

/// Reads the tokens of JSON at `here`: white space, numbers and strings, and counts lines.
class JsonScanner
{
public:
    explicit JsonScanner (std::string_view text) noexcept : here (text.data()), end (here + text.size())
    {
        if (text.starts_with ("\xEF\xBB\xBF")) here += 3;   // a byte order mark
        line_begin = here;
    }

    bool atEnd() const noexcept { return here == end; }
    char peek() const noexcept { return here < end ? *here : '\0'; }
    bool take (char c) noexcept
    {
        if (here == end || *here != c) return false;
        ++here;
        return true;
    }
    bool takeWord (std::string_view word) noexcept
    {
        if (! rest().starts_with (word)) return false;
        here += word.size();
        return true;
    }
    std::string_view rest() const noexcept { return { here, end }; }
    TextPosition position() const noexcept { return { line, static_cast<int> (here - line_begin) - continued + 1 }; }

    void skipSpace() noexcept
    {
        const auto* next = here;   // most white space is indentation, so this loop is a tight one
        while (true)
        {
            while (next < end && *next == ' ')
                ++next;
            if (next == end) break;
            if (*next == '\n')
            {
                ++line;
                line_begin = next + 1;
                continued = 0;
            }
            else if (*next != '\t' && *next != '\r')
                break;
            ++next;
        }
        here = next;
    }

    /// Replaces null, which has nothing to free. An assignment would first look at what both hold.
    template <typename T>
    static Json& put (Json& null, T&& content)
    {
        return *std::construct_at (&null, std::forward<T> (content));
    }

    //==============================================================================
    enum class NumberFault
    {
        none,
        not_a_number,
        too_large
    };

    /// After a fault, `here` is where it was.
    NumberFault number (Json& into)
    {
        const auto* const begin = here;
        const auto fault = numberFrom (begin, into);
        if (fault != NumberFault::none) here = begin;
        return fault;
    }

    //==============================================================================
    enum class StringFault
    {
        none,
        open_at_end,
        open_at_line_end,
        control_character,
        not_utf8,
        bad_escape
    };

    /// A string in which all characters stand for themselves, as in most. For any other string, nothing is read.
    std::optional<std::string_view> plainString() noexcept
    {
        const auto* const begin = here++;
        const auto text = plain();
        if (take ('"')) return text;
        here = begin;
        return {};
    }

    /// Any string. After a fault, `here` is at the character that is wrong.
    StringFault string (std::string& into)
    {
        ++here;
        const auto first = plain();
        into.assign (first.data(), first.size());
        while (! take ('"'))
        {
            if (here == end) return StringFault::open_at_end;
            if (*here == '\\')
            {
                if (! escape (into)) return here == end ? StringFault::open_at_end : StringFault::bad_escape;
            }
            else if (! rune (into))
                return *here == '\n' || *here == '\r' ? StringFault::open_at_line_end
                       : isControl (*here)            ? StringFault::control_character
                                                      : StringFault::not_utf8;
            into += plain();
        }
        return StringFault::none;
    }

private:
    NumberFault numberFrom (const char* begin, Json& into)
    {
        const bool is_negative = take ('-');
        if (! take ('0') && ! digits()) return NumberFault::not_a_number;
        const auto* const end_of_integer = here;
        if (take ('.') && ! digits()) return NumberFault::not_a_number;
        if (take ('e') || take ('E'))
        {
            if (! take ('+')) take ('-');
            if (! digits()) return NumberFault::not_a_number;
        }
        if (here == end_of_integer && (is_negative ? isInteger (begin, std::int64_t {}, into) : isInteger (begin, std::uint64_t {}, into)))
            return NumberFault::none;
        const auto read = wholeNumber ({ begin, here });
        if (! read) return NumberFault::too_large;
        put (into, *read);
        return NumberFault::none;
    }

    bool digits() noexcept
    {
        const auto* const begin = here;
        while (isDigit (peek()))
            ++here;
        return here > begin;
    }

    /// False if the number does not fit into this type.
    template <typename T>
    bool isInteger (const char* begin, T number, Json& into) const
    {
        if (std::from_chars (begin, here, number).ec != std::errc()) return false;
        put (into, number);
        return true;
    }

    /// The next characters that stand for themselves.
    std::string_view plain() noexcept
    {
        const auto* const begin = here;
        if constexpr (std::endian::native == std::endian::little)
            for (; end - here >= step; here += step)
                if (const auto special = specialAmong (here); special != 0) return { begin, here += std::countr_zero (special) / 8 };
        while (here < end && isPlain (*here))
            ++here;
        return { begin, here };
    }

    static constexpr std::ptrdiff_t step = 8;

    /// Eight characters as a number whose lowest byte is the first. In the result, the highest bit of a byte is set if the character is not
    /// plain. The first one is exact. After it, a plain character may be marked too, because a subtraction borrows from the next byte.
    static std::uint64_t specialAmong (const char* text) noexcept
    {
        constexpr std::uint64_t ones = 0x0101010101010101u;
        std::uint64_t all;
        std::memcpy (&all, text, sizeof all);
        return (all | (all - 0x20 * ones) | ((all ^ ('"' * ones)) - ones) | ((all ^ ('\\' * ones)) - ones)) & (0x80 * ones);
    }

    static bool isControl (char c) noexcept { return static_cast<unsigned char> (c) < 0x20; }
    static bool isPlain (char c) noexcept { return ! isControl (c) && static_cast<unsigned char> (c) < 0x80 && c != '"' && c != '\\'; }

    bool escape (std::string& into)
    {
        static constexpr std::string_view names = "\"\\/bfnrt", meanings = "\"\\/\b\f\n\r\t";
        ++here;
        if (peek() == 'u') return escapedRune (into);
        const auto which = here < end ? names.find (*here) : std::string_view::npos;
        if (which == std::string_view::npos) return false;
        into += meanings[which];
        ++here;
        return true;
    }

    /// \uXXXX, or two of them for a rune beyond U+FFFF.
    bool escapedRune (std::string& into)
    {
        auto rune = hexadecimal();
        if (rune >= 0xD800 && rune < 0xDC00)
        {
            if (! take ('\\') || peek() != 'u') return false;
            const auto low = hexadecimal();
            if (low < 0xDC00 || low > 0xDFFF) return false;
            rune = 0x10000 + ((rune - 0xD800) << 10) + (low - 0xDC00);
        }
        else if (rune < 0 || (rune >= 0xDC00 && rune <= 0xDFFF))
            return false;
        appendRune (static_cast<std::uint32_t> (rune), into);
        return true;
    }

    /// The number after "u"; -1 if it is not one.
    std::int32_t hexadecimal() noexcept
    {
        constexpr int size = 4;
        if (end - here <= size) return -1;
        std::uint32_t number = 0;
        if (std::from_chars (here + 1, here + 1 + size, number, 16).ptr != here + 1 + size) return -1;
        here += 1 + size;
        return static_cast<std::int32_t> (number);
    }

    static void appendRune (std::uint32_t rune, std::string& into)
    {
        const auto add = [&into] (std::uint32_t byte) { into += static_cast<char> (byte); };
        if (rune < 0x80) return add (rune);
        if (rune < 0x800)
            add (0xC0 | rune >> 6);
        else
        {
            if (rune < 0x10000)
                add (0xE0 | rune >> 12);
            else
            {
                add (0xF0 | rune >> 18);
                add (0x80 | (rune >> 12 & 0x3F));
            }
            add (0x80 | (rune >> 6 & 0x3F));
        }
        add (0x80 | (rune & 0x3F));
    }

    /// A character of several bytes.
    bool rune (std::string& into)
    {
        const auto size = characterSize (rest());
        if (size < 2) return false;
        into.append (here, size);
        here += size;
        continued += static_cast<int> (size) - 1;
        return true;
    }

    const char *here, *const end, *line_begin;
    int line = 1, continued = 0;   // continued: bytes of this line that continue a character
};

}   // namespace tactus
