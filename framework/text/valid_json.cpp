// SPDX-License-Identifier: MIT
#include "valid_json.hpp"

#include "is_digit.hpp"
#include "read_number.hpp"
#include "seen_keys.hpp"

#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <utility>

namespace tactus
{
namespace
{
/// Each function reads one thing at `here` and returns false if it is not there.
class ValidReader
{
public:
    ValidReader (std::string_view text, JsonText& r, double most) : here (text.data()), end (here + text.size()), result (r), most_values (most)
    {
        if (text.starts_with ("\xEF\xBB\xBF")) here += 3;
        line_begin = here;
    }

    bool file()
    {
        skipSpace();
        if (! value (result.root, result.positions.addRoot (position()), 0)) return false;
        skipSpace();
        return here == end;
    }

private:
    char peek() const noexcept { return here < end ? *here : '\0'; }
    bool take (char c) noexcept
    {
        if (peek() != c) return false;
        ++here;
        return true;
    }

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

    bool value (Json& into, std::uint32_t place, int depth)
    {
        if (++result.values > most_values) return false;
        switch (peek())
        {
        case '{':
            return depth < deepest_nesting && object (put (into, Json::Object()).asObject(), place, depth + 1);
        case '[':
            return depth < deepest_nesting && list (put (into, Json::Array()).asArray(), place, depth + 1);
        case '"':
            if (const auto text = plainString()) return put (into, std::string (*text)), true;
            return string (put (into, std::string()).asString());
        case 't':
            return word ("true", into, Json (true));
        case 'f':
            return word ("false", into, Json (false));
        case 'n':
            return word ("null", into, Json());
        default:
            return number (into);
        }
    }

    bool word (std::string_view wanted, Json& into, Json meaning)
    {
        if (! std::string_view (here, end).starts_with (wanted)) return false;
        here += wanted.size();
        put (into, std::move (meaning));
        return true;
    }

    /// Makes a long list grow faster than it would by itself, because moving its values takes longer than anything else.
    template <typename List>
    static void makeRoom (List& list)
    {
        constexpr std::size_t is_long = 64, growth = 4;
        if (list.size() == list.capacity() && list.size() >= is_long) list.reserve (growth * list.size());
    }

    bool object (Json::Object& members, std::uint32_t place, int depth)
    {
        ++here;
        skipSpace();
        if (take ('}')) return true;
        constexpr std::size_t usual = 2;   // so that most objects are allocated once
        members.reserve (usual);
        SeenKeys seen;
        do
        {
            skipSpace();
            const auto begin = position();
            const auto key = readKey();
            if (! key || ! seen.add (members, *key)) return false;
            const auto inside = result.positions.addMember (place, *key, begin);
            makeRoom (members);
            auto& added = members.emplace_back (std::piecewise_construct, std::forward_as_tuple (*key), std::tuple()).second;
            skipSpace();
            if (! take (':')) return false;
            skipSpace();
            if (! value (added, inside, depth)) return false;
            skipSpace();
        } while (take (','));
        return take ('}');
    }

    bool list (Json::Array& elements, std::uint32_t place, int depth)
    {
        constexpr std::size_t first_entries = 1000;
        ++here;
        skipSpace();
        if (take (']')) return true;
        do
        {
            skipSpace();
            const auto index = elements.size();
            const bool is_bulk = peek() == '[' || peek() == '-' || isDigit (peek());
            const auto inside = ! is_bulk || index < first_entries ? result.positions.addElement (place, index, position()) : TextPositions::none;
            makeRoom (elements);
            if (! value (elements.emplace_back(), inside, depth)) return false;
            skipSpace();
        } while (take (','));
        return take (']');
    }

    //==============================================================================
    bool number (Json& into)
    {
        const auto* const begin = here;
        const bool is_negative = take ('-');
        if (! take ('0') && ! digits()) return false;
        const auto* const end_of_integer = here;
        if (take ('.') && ! digits()) return false;
        if (take ('e') || take ('E'))
        {
            if (! take ('+')) take ('-');
            if (! digits()) return false;
        }
        if (here == end_of_integer && (is_negative ? isRead (begin, std::int64_t {}, into) : isRead (begin, std::uint64_t {}, into))) return true;
        return isRead (begin, 0.0, into);
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
    bool isRead (const char* begin, T number, Json& into) const
    {
        if constexpr (std::is_same_v<T, double>)
        {
            const auto read = wholeNumber ({ begin, here });
            number = read.value_or (0.0);
            if (! read) return false;
        }
        else if (std::from_chars (begin, here, number).ec != std::errc())
            return false;
        put (into, number);
        return true;
    }

    //==============================================================================
    /// The key of a member. It is valid until the next key is read.
    std::optional<std::string_view> readKey()
    {
        if (peek() != '"') return {};
        if (const auto text = plainString()) return text;
        return string (rare_key) ? std::optional<std::string_view> (rare_key) : std::nullopt;
    }

    /// A string in which all characters stand for themselves, as in most. For any other string, nothing is read.
    std::optional<std::string_view> plainString() noexcept
    {
        const auto* const begin = here++;
        const auto text = plain();
        if (take ('"')) return text;
        here = begin;
        return {};
    }

    bool string (std::string& into)
    {
        ++here;
        const auto first = plain();
        into.assign (first.data(), first.size());
        while (! take ('"'))
        {
            if (here == end || ! (*here == '\\' ? escape (into) : rune (into))) return false;
            into += plain();
        }
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

    static bool isPlain (char c) noexcept { return static_cast<unsigned char> (c) >= 0x20 && static_cast<unsigned char> (c) < 0x80 && c != '"' && c != '\\'; }

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

    /// A character of several bytes, as RFC 3629 allows it: the shortest form, no surrogates, up to U+10FFFF.
    bool rune (std::string& into)
    {
        const auto byte = [this] (int i) { return static_cast<unsigned char> (here[i]); };
        const auto first = byte (0);
        const int size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3
                                                           : 2;
        if (first < 0xC2 || first > 0xF4 || end - here < size) return false;
        for (int i = 1; i < size; ++i)
            if ((byte (i) & 0xC0) != 0x80) return false;
        const auto second = byte (1);
        if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) || (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F))
            return false;
        into.append (here, static_cast<std::size_t> (size));
        here += size;
        continued += size - 1;
        return true;
    }

    const char *here, *const end, *line_begin;
    int line = 1, continued = 0;   // continued: bytes of this line that continue a character
    JsonText& result;
    const double most_values;
    std::string rare_key;   // the last one that was not a plain string
};
}   // namespace

std::optional<JsonText> readValidJson (std::string_view text, double most_values)
{
    JsonText result;
    if (! ValidReader (text, result, most_values).file()) return std::nullopt;
    return result;
}

}   // namespace tactus
