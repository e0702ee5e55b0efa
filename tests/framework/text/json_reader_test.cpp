// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/utf8.hpp>

#include <catch2/catch.hpp>

#include <array>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

using namespace tactus;

namespace
{
/// Writes JSON of all kinds, in odd ways that are valid, and knows what it means and where each part is.
class OddWriter
{
public:
    explicit OddWriter (unsigned seed) : random (seed) {}

    std::size_t dice (std::size_t n) { return random() % n; }

    Json value (int depth, const std::string& pointer)
    {
        static const std::vector<std::pair<std::string, Json>> scalars {
            { "null", Json() }, { "true", Json (true) }, { "false", Json (false) }, { "0", Json (0) }, { "-0", Json (0) }, { "-0.0", Json (-0.0) }, { "3", Json (3) }, { "-17", Json (-17) }, { "1.5e3", Json (1500.0) }, { "1E-5", Json (1e-5) }, { "2.5e+300", Json (2.5e300) }, { "18446744073709551615", Json (18446744073709551615u) }, { "1844674407370955161600", Json (1844674407370955161600.0) }, { "-9223372036854775808", Json (std::numeric_limits<std::int64_t>::min()) }, { "-9223372036854775809", Json (-9223372036854775809.0) }, { "0.1", Json (0.1) }, { "123456789012345678901234567890.5", Json (123456789012345678901234567890.5) }, { "4.9e-324", Json (4.9e-324) }, { "2.2250738585072011e-308", Json (2.2250738585072011e-308) }, { "9007199254740993", Json (9007199254740993) }
        };
        space();
        if (places.empty() || places.back().first != pointer) places.emplace_back (pointer, here());
        const auto kind = dice (depth > 0 ? 4 : 2);
        Json made;
        if (kind == 0)
        {
            const auto& [written, meaning] = scalars[dice (scalars.size())];
            text += written;
            made = meaning;
        }
        else if (kind == 1)
            made = string();
        else
            made = kind == 2 ? list (depth, pointer) : object (depth, pointer);
        space();
        return made;
    }

    std::string text;
    std::vector<std::pair<std::string, TextPosition>> places;   // JSON pointers
    bool has_twins = false;

private:
    std::size_t size() { return dice (20) == 0 ? 30 : dice (5); }

    Json list (int depth, const std::string& pointer)
    {
        auto made = Json::array();
        text += '[';
        for (std::size_t i = 0, n = size(); i < n; ++i)
        {
            if (i > 0) text += ',';
            made.push_back (value (depth - 1, pointer + '/' + std::to_string (i)));
        }
        if (made.empty()) space();
        text += ']';
        return made;
    }

    Json object (int depth, const std::string& pointer)
    {
        auto made = Json::object();
        text += '{';
        for (std::size_t i = 0, n = size(); i < n; ++i)
        {
            if (i > 0) text += ',';
            space();
            const auto begin = here();
            auto key = string (dice (50) == 0 ? "" : std::to_string (i));
            space();
            text += ':';
            const auto inner = pointer + '/' + pointerPart (key);
            const bool is_twin = made.contains (key);
            has_twins |= is_twin;
            places.emplace_back (is_twin ? "twin" : inner, begin);
            append (made, std::move (key), value (depth - 1, is_twin ? "twin" : inner));
        }
        if (made.empty()) space();
        text += '}';
        return made;
    }

    void space()
    {
        static const std::vector<std::string> spaces { "", "", "", " ", "\n", "\t", "\r\n", " \n  " };
        text += spaces[dice (spaces.size())];
    }

    std::string string (const std::string& end = {})
    {
        static const std::vector<std::pair<std::string, std::string>> parts {
            { "a", "a" }, { "bc", "bc" }, { "~", "~" }, { "/", "/" }, { "'", "'" }, { "\x7f", "\x7f" }, { "ü", "ü" }, { "€", "€" }, { "\U0001F600", "\U0001F600" }, { "\uFFFF", "\uFFFF" }, { "\\\"", "\"" }, { "\\\\", "\\" }, { "\\/", "/" }, { "\\b", "\b" }, { "\\f", "\f" }, { "\\n", "\n" }, { "\\r", "\r" }, { "\\t", "\t" }, { "\\u0000", std::string (1, '\0') }, { "\\u00e4", "ä" }, { "\\u20AC", "€" }, { "\\uD83D\\uDE00", "\U0001F600" }, { "\\ud7ff", "\uD7FF" }, { "\\uE000", "\uE000" }
        };
        std::string meaning;
        text += '"';
        for (auto n = dice (5); n > 0; --n)
        {
            const auto& part = parts[dice (parts.size())];
            text += part.first;
            meaning += part.second;
        }
        text += end + '"';
        return meaning + end;
    }

    /// Counted again from the start of the text, independent of the reader.
    TextPosition here() const
    {
        TextPosition p;
        for (std::size_t i = 0; i < text.size(); ++i)
            if (text[i] == '\n')
                p = { p.line + 1, 1 };
            else if (! continuesCharacter (text[i]))
                ++p.column;
        return p;
    }

    std::mt19937 random;
};

constexpr double most = 1e6;

/// The place of a message is in the text, and there is a remedy.
bool isUseful (const Message& m, std::string_view text)
{
    int line = 1;
    for (const char c : text)
        line += c == '\n';
    return m.line >= 1 && m.line <= line && m.column >= 1 && ! m.text.empty() && ! m.remedy.empty();
}

bool isAccepted (std::string_view text) { return readJson (text, most).messages.empty(); }
}   // namespace

TEST_CASE ("JSON reads as what it means, and each part is where it was written", "[json][property]")
{
    int cases = 0, refused = 0;
    test::property ("any text", [&] {
        OddWriter odd (*rc::gen::arbitrary<unsigned>());
        const auto meaning = odd.value (4, "");
        const auto read = readJson (odd.text, most);
        RC_ASSERT (read.messages.empty() == ! odd.has_twins);
        for (const auto& m : read.messages)
            RC_ASSERT (m.id == "file/duplicate_key" && isUseful (m, odd.text));
        RC_ASSERT (read.root == meaning);
        RC_ASSERT (read.root.dump() == meaning.dump());   // numbers of different types compare as equal, but are written differently
        for (const auto& [pointer, place] : odd.places)
            if (! odd.has_twins) RC_ASSERT (read.positions.find (pointer) == place);
        ++cases;

        static constexpr char all_bytes[] = "\0\x01\n\"\\/{}[],:0129-+.eEutfn \x7f\x80\xBF\xC0\xC2\xE0\xED\xF0\xF4\xF5\xFF";
        static constexpr std::string_view bytes (all_bytes, sizeof all_bytes - 1);
        auto broken = odd.text;
        for (auto n = 1 + odd.dice (3); n > 0 && ! broken.empty(); --n)
        {
            const auto at = odd.dice (broken.size());
            switch (odd.dice (3))
            {
            case 0:
                broken[at] = bytes[odd.dice (bytes.size())];
                break;
            case 1:
                broken.insert (at, 1, bytes[odd.dice (bytes.size())]);
                break;
            default:
                broken.erase (at, 1);
            }
        }
        const auto again = readJson (broken, most);
        for (const auto& m : again.messages)
            RC_ASSERT (isUseful (m, broken));
        if (again.messages.empty()) RC_ASSERT (readJson (again.root.dump(), most).root == again.root);
        refused += again.root.is_null() && ! again.messages.empty();
    });
    CHECK (4 * refused > cases);
}

TEST_CASE ("JSON beyond a limit is refused", "[json]")
{
    CHECK (readJson ("[1, 2]", 3.0).messages.empty());
    CHECK (readJson ("[1, 2]", 2.0).messages.size() == 1);
    const auto nested = [] (int n) { return std::string (static_cast<std::size_t> (n), '[') + std::string (static_cast<std::size_t> (n), ']'); };
    CHECK (isAccepted (nested (deepest_nesting)));
    CHECK_FALSE (isAccepted (nested (deepest_nesting + 1)));
}

TEST_CASE ("JSON: a string is read correctly whatever its length, and wherever a special character is", "[json]")
{
    const std::vector<std::string> specials { "\\\"", "\\\\", "\\n", "\\u00e4", "ü", "€", "\U0001F600", "\x7f", " ", "!", "#", "[", "]" };
    const std::vector<std::string> meanings { "\"", "\\", "\n", "ä", "ü", "€", "\U0001F600", "\x7f", " ", "!", "#", "[", "]" };
    int wrong = 0;
    for (std::size_t size = 0; size < 20; ++size)
        for (std::size_t where = 0; where <= size; ++where)
            for (std::size_t k = 0; k < specials.size(); ++k)
            {
                const std::string before (where, 'a'), after (size - where, 'z');
                const auto read = readJson ('"' + before + specials[k] + after + '"', most);
                wrong += read.root != Json (before + meanings[k] + after);
                for (const auto* bad : { "\n", "\x1f", "\x01", "\xff", "\x80" })
                    wrong += isAccepted ('"' + before + bad + after + '"');
                wrong += isAccepted ('"' + before + '"' + after + "\"");
            }
    CHECK (wrong == 0);
}
