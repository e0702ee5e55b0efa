// SPDX-License-Identifier: MIT
#include <tactus/text/valid_json.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <random>
#include <string>
#include <string_view>
#include <vector>

using namespace tactus;

namespace
{
/// Writes JSON of all kinds, in odd ways that are valid.
class OddWriter
{
public:
    explicit OddWriter (unsigned seed) : random (seed) {}

    std::size_t dice (std::size_t n) { return random() % n; }

    std::string value (int depth)
    {
        static const std::vector<std::string> scalars { "null", "true", "false", "0", "-0", "-0.0",
                                                        "3", "-17", "1.5e3", "1E-5", "2.5e+300", "18446744073709551615",
                                                        "1844674407370955161600", "-9223372036854775808", "-9223372036854775809", "0.1",
                                                        "123456789012345678901234567890.5", "4.9e-324", "2.2250738585072011e-308", "9007199254740993" };
        const auto kind = dice (depth > 0 ? 4 : 2);
        if (kind == 0) return space() + scalars[dice (scalars.size())] + space();
        if (kind == 1) return space() + text() + space();
        std::string all = kind == 2 ? "[" : "{";
        const auto size = dice (20) == 0 ? 30 : dice (5);
        for (std::size_t i = 0; i < size; ++i)
            all += (i > 0 ? "," : "") + (kind == 2 ? std::string() : space() + key (i) + space() + ":") + value (depth - 1);
        return space() + all + (size == 0 ? space() : "") + (kind == 2 ? "]" : "}") + space();
    }

private:
    std::string space()
    {
        static const std::vector<std::string> spaces { "", "", "", " ", "\n", "\t", "\r\n", " \n  " };
        return spaces[dice (spaces.size())];
    }

    std::string text() { return '"' + inside() + '"'; }
    std::string key (std::size_t i) { return '"' + inside() + (dice (50) == 0 ? "" : std::to_string (i)) + '"'; }

    std::string inside()
    {
        static const std::vector<std::string> parts { "a", "bc", "~", "/", "'", "\x7f", "ü", "€", "\U0001F600", "\uFFFF", "\\\"", "\\\\", "\\/",
                                                      "\\b", "\\f", "\\n", "\\r", "\\t", "\\u0000", "\\u00e4", "\\u20AC", "\\uD83D\\uDE00", "\\ud7ff",
                                                      "\\uE000" };
        std::string all;
        for (auto n = dice (5); n > 0; --n)
            all += parts[dice (parts.size())];
        return all;
    }

    std::mt19937 random;
};

bool samePositions (const JsonText& a, const JsonText& b, const Json& value, const std::string& pointer)
{
    if (a.positions.find (pointer) != b.positions.find (pointer)) return false;
    if (value.is_object())
    {
        for (const auto& [key, inner] : value.asObject())
            if (! samePositions (a, b, inner, pointer + '/' + pointerPart (key))) return false;
    }
    else if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i)
            if (! samePositions (a, b, value[i], pointer + '/' + std::to_string (i))) return false;
    return true;
}

/// Numbers of different types compare as equal, but are written differently.
bool isSame (const JsonText& valid, const JsonText& any)
{
    return any.messages.empty() && valid.messages.empty() && valid.root == any.root && valid.root.dump() == any.root.dump() && valid.values == any.values
           && samePositions (valid, any, any.root, "");
}

constexpr double most = 1e6;

/// True if the text is refused, or read as the other parser does.
bool agree (std::string_view text)
{
    const auto valid = readValidJson (text, most);
    return ! valid || isSame (*valid, readAnyJson (text, most));
}
}   // namespace

TEST_CASE ("valid JSON is read in one pass as the careful parser reads it", "[json][property]")
{
    int valid = 0, refused = 0;
    rc::prop ("any text", [&] {
        OddWriter odd (*rc::gen::arbitrary<unsigned>());
        for (int k = 0; k < 20; ++k)
        {
            auto text = (odd.dice (10) == 0 ? "\xEF\xBB\xBF" : "") + odd.value (4);
            const auto any = readAnyJson (text, most);
            const auto read = readValidJson (text, most);
            RC_ASSERT (read.has_value() == any.messages.empty());   // the only mistake so far is a key that occurs twice
            RC_ASSERT (! read || isSame (*read, any));
            ++valid;

            static constexpr char all_bytes[] = "\0\x01\n\"\\/{}[],:0129-+.eEutfn \x7f\x80\xBF\xC0\xC2\xE0\xED\xF0\xF4\xF5\xFF";
            static constexpr std::string_view bytes (all_bytes, sizeof all_bytes - 1);
            for (auto n = odd.dice (3); n > 0 && ! text.empty(); --n)
            {
                const auto at = odd.dice (text.size());
                switch (odd.dice (3))
                {
                case 0:
                    text[at] = bytes[odd.dice (bytes.size())];
                    break;
                case 1:
                    text.insert (at, 1, bytes[odd.dice (bytes.size())]);
                    break;
                default:
                    text.erase (at, 1);
                }
            }
            RC_ASSERT (agree (text));
            refused += ! readValidJson (text, most);
        }
    });
    CHECK (valid >= 400);
    CHECK (4 * refused > valid);
}

TEST_CASE ("valid JSON is also refused where a limit or the careful parser would complain", "[json]")
{
    for (const auto* text : { "", " ", "{", "[1,]", "{\"a\":1,}", "{\"a\":1,\"a\":2}", "01", "1.", ".5", "-", "+1", "1e", "1e400", "nul", "NaN", "\"a",
                              "\"\n\"", "\"\\x\"", "\"\\ud800\"", "\"\\udc00\"", "\"\\ud800\\u0041\"", "\"\xC0\x80\"", "\"\xED\xA0\x80\"",
                              "\"\xF4\x90\x80\x80\"",
                              "\"\xE2\x82\"", "1 2", "'a'", "// c\n1" })
    {
        INFO (text);
        CHECK_FALSE (readValidJson (text, most).has_value());
        CHECK_FALSE (readAnyJson (text, most).messages.empty());
    }
    CHECK (readValidJson ("[1, 2]", 3.0));
    CHECK_FALSE (readValidJson ("[1, 2]", 2.0));
    const auto nested = [] (int n) { return std::string (static_cast<std::size_t> (n), '[') + std::string (static_cast<std::size_t> (n), ']'); };
    CHECK (readValidJson (nested (deepest_nesting), most));
    CHECK_FALSE (readValidJson (nested (deepest_nesting + 1), most));
}

TEST_CASE ("valid JSON: a string is read correctly whatever its length, and wherever a special character is", "[json]")
{
    const std::vector<std::string> specials { "\\\"", "\\\\", "\\n", "\\u00e4", "ü", "€", "\U0001F600", "\x7f", " ", "!", "#", "[", "]" };
    const std::vector<std::string> meanings { "\"", "\\", "\n", "ä", "ü", "€", "\U0001F600", "\x7f", " ", "!", "#", "[", "]" };
    int wrong = 0;
    for (std::size_t size = 0; size < 20; ++size)
        for (std::size_t where = 0; where <= size; ++where)
            for (std::size_t k = 0; k < specials.size(); ++k)
            {
                const std::string before (where, 'a'), after (size - where, 'z');
                const auto read = readValidJson ('"' + before + specials[k] + after + '"', most);
                wrong += ! read || read->root != Json (before + meanings[k] + after);
                for (const auto* bad : { "\n", "\x1f", "\x01", "\xff", "\x80" })
                    wrong += readValidJson ('"' + before + bad + after + '"', most).has_value();
                wrong += readValidJson ('"' + before + '"' + after + "\"", most).has_value();
            }
    CHECK (wrong == 0);
}
