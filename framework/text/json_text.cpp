// SPDX-License-Identifier: MIT
#include "json_text.hpp"

#include "is_digit.hpp"
#include "quote.hpp"
#include "seen_keys.hpp"
#include "valid_json.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace tactus
{
namespace
{
using Parser = nlohmann::ordered_json;

constexpr bool isSpace (char c) noexcept { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
constexpr bool isWord (char c) noexcept { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || isDigit (c); }

/// Follows the parser through the text, one token per event, and tracks line and column. The parser itself reports its position
/// only after an error.
class Cursor
{
public:
    explicit Cursor (std::string_view t) : text (t)
    {
        if (text.starts_with ("\xEF\xBB\xBF")) at = 3;   // the parser skips a byte order mark too
    }

    char peek (std::size_t ahead = 0) const { return at + ahead < text.size() ? text[at + ahead] : '\0'; }
    bool atEnd() const { return at >= text.size(); }
    std::string_view rest() const { return text.substr (std::min (at, text.size())); }
    TextPosition position() const { return { line, column }; }

    void advance (std::size_t bytes)
    {
        for (; bytes > 0 && at < text.size(); --bytes, ++at)
            if (text[at] == '\n')
            {
                ++line;
                column = 1;
            }
            else if ((static_cast<unsigned char> (text[at]) & 0xC0u) != 0x80u)
                ++column;
    }

    void advanceTo (std::size_t byte)
    {
        if (byte > at) advance (byte - at);
    }

    void skipSpace()
    {
        while (isSpace (peek()))
            advance (1);
    }

    /// Skips separators, to the start of the next token.
    TextPosition next()
    {
        while (isSpace (peek()) || peek() == ',' || peek() == ':')
            advance (1);
        return position();
    }

    /// Skips one token that the parser has accepted.
    void skipToken()
    {
        switch (peek())
        {
        case '"':
            advance (1);
            while (! atEnd() && peek() != '"')
                advance (peek() == '\\' ? 2 : 1);
            advance (1);
            break;
        case 't':
        case 'n':
            advance (4);
            break;
        case 'f':
            advance (5);
            break;
        case '-':
        case '0':
        case '1':
        case '2':
        case '3':
        case '4':
        case '5':
        case '6':
        case '7':
        case '8':
        case '9':
            skipNumber();
            break;
        default:
            advance (1);
        }
    }

private:
    void skipDigits()
    {
        while (isDigit (peek()))
            advance (1);
    }

    void skipNumber()
    {
        if (peek() == '-') advance (1);
        if (peek() == '0')
            advance (1);
        else
            skipDigits();
        if (peek() == '.')
        {
            advance (1);
            skipDigits();
        }
        if (peek() == 'e' || peek() == 'E')
        {
            advance (1);
            if (peek() == '+' || peek() == '-') advance (1);
            skipDigits();
        }
    }

    std::string_view text;
    std::size_t at = 0;
    int line = 1, column = 1;
};

/// Builds the document and the positions from the parser's events.
class Builder : public nlohmann::json_sax<Parser>
{
public:
    Builder (std::string_view text, JsonText& r, double most) : cursor (text), result (r), most_values (most) {}

    bool null() override { return scalar (nullptr); }
    bool boolean (bool v) override { return scalar (v); }
    bool number_integer (Parser::number_integer_t v) override { return scalar (v); }
    bool number_unsigned (Parser::number_unsigned_t v) override { return scalar (v); }
    bool number_float (Parser::number_float_t v, const std::string&) override { return scalar (v); }
    bool string (std::string& v) override { return scalar (std::move (v)); }
    bool binary (Parser::binary_t&) override { return false; }

    bool start_object (std::size_t) override { return open (true); }
    bool start_array (std::size_t) override { return open (false); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key (std::string& name) override
    {
        const auto position = cursor.next();
        cursor.skipToken();
        auto& object = frames.back();
        object.key = std::move (name);
        object.has_key = true;
        object.inside = result.positions.addMember (object.place, object.key, position);
        if (! object.seen.add (object.members, object.key)) complainOfTwins (object.key, position);
        return true;
    }

    bool parse_error (std::size_t byte, const std::string&, const nlohmann::detail::exception& problem) override
    {
        explain (byte, problem.what());
        return false;
    }

private:
    /// An object or list that is being read.
    struct Frame
    {
        bool is_object = false;
        Json::Object members;
        Json::Array elements;
        SeenKeys seen;
        std::string key;   // of the member that is being read
        bool has_key = false;
        std::uint32_t place = TextPositions::none, inside = TextPositions::none;   // numbers of the positions of this value, and of the one that is being read

        bool empty() const { return members.empty() && elements.empty(); }
    };

    void complainOfTwins (const std::string& name, TextPosition position)
    {
        const auto where = pathOf (innermost()) + '/' + pointerPart (name);
        const auto first = result.positions.find (where).value_or (TextPosition {});
        complain ("file/duplicate_key", where, position,
                  "the key " + quote (name) + " occurs twice in one object; first at line " + std::to_string (first.line) + ", column "
                      + std::to_string (first.column),
                  "remove or rename one of them");
    }

    std::size_t innermost() const { return frames.empty() ? 0 : frames.size() - 1; }

    /// The JSON pointer of the value that a frame holds.
    std::string pathOf (std::size_t frame) const
    {
        std::string path;
        for (std::size_t f = 0; f < frame; ++f)
            path += '/' + (frames[f].is_object ? pointerPart (frames[f].key) : std::to_string (frames[f].elements.size()));
        return path;
    }

    void complain (std::string id, std::string where, TextPosition p, std::string text, std::string remedy)
    {
        constexpr std::size_t most = 1000;   // reading continues after a duplicate key, and a hostile file may have millions of them
        if (result.messages.size() >= most) return;
        auto m = Message::error (std::move (id), where.substr (0, 1000), std::move (text), std::move (remedy));
        m.line = p.line;
        m.column = p.column;
        result.messages.push_back (std::move (m));
    }

    /// The number of the position of a value. For a member of an object, that of its key was recorded before.
    std::uint32_t placeOf (TextPosition position, bool bulk)
    {
        constexpr std::size_t first_entries = 1000;
        if (frames.empty()) return result.positions.addRoot (position);
        auto& around = frames.back();
        if (around.is_object) return around.inside;
        const auto index = around.elements.size();
        return ! bulk || index < first_entries ? result.positions.addElement (around.place, index, position) : TextPositions::none;
    }

    void put (Json value)
    {
        if (frames.empty())
        {
            result.root = std::move (value);
            done = true;
        }
        else if (auto& frame = frames.back(); frame.is_object)
        {
            frame.members.emplace_back (std::move (frame.key), std::move (value));
            frame.has_key = false;
        }
        else
            frame.elements.push_back (std::move (value));
    }

    /// Counts a value. False, with a message, if there are too many.
    bool count (TextPosition position)
    {
        if (++result.values <= most_values) return true;
        auto m = overBudget ("file/too_large", &Budgets::values, "the text", budgets().values + 1.0, "put meshes and samples into separate files");
        complain (std::move (m.id), pathOf (innermost()), position, std::move (m.text), std::move (m.remedy));
        return false;
    }

    bool scalar (Json value)
    {
        const auto position = cursor.next();
        if (! count (position)) return false;
        cursor.skipToken();
        placeOf (position, value.is_number());
        put (std::move (value));
        return true;
    }

    bool open (bool object)
    {
        const auto position = cursor.next();
        if (! count (position)) return false;
        cursor.skipToken();
        const auto place = placeOf (position, ! object);
        if (frames.size() >= deepest_nesting)
        {
            complain ("file/too_deep", pathOf (frames.size()), position,
                      "objects and lists are nested more than " + std::to_string (deepest_nesting) + " levels deep",
                      "a graph needs fewer than ten levels");
            return false;
        }
        auto& frame = frames.emplace_back();
        frame.is_object = object;
        frame.place = place;
        return true;
    }

    bool close()
    {
        cursor.next();
        cursor.skipToken();
        auto frame = std::move (frames.back());
        frames.pop_back();
        if (frame.is_object)
            put (std::move (frame.members));
        else
            put (std::move (frame.elements));
        return true;
    }

    /// Turns the parser's error into a message that a person can understand.
    void explain (std::size_t byte, std::string_view complaint)
    {
        bool value = false, key = false;   // true if a value or a key is allowed here
        std::string expected;
        cursor.skipSpace();
        const auto comma = [&] {
            if (cursor.peek() != ',') return false;
            cursor.advance (1);
            cursor.skipSpace();
            return true;
        };
        if (frames.empty())
        {
            value = ! done;
            expected = done ? "the file should end after its closing bracket" : "the file should begin with {";
        }
        else if (const auto& frame = frames.back(); frame.is_object)
        {
            if (frame.has_key)
            {
                value = cursor.peek() == ':';
                if (value)
                {
                    cursor.advance (1);
                    cursor.skipSpace();
                }
                expected = value ? "a value should follow the key " + quote (frame.key) : "a : should follow the key " + quote (frame.key);
            }
            else if (key = frame.empty() || comma(); key)
                expected = frame.empty() ? "expected a key in double quotes or a }" : "a key in double quotes should follow the comma";
            else
                expected = "a comma or a } should follow the value of " + quote (frame.members.back().first);
        }
        else if (value = frame.empty() || comma(); value)
            expected = frame.empty() ? "expected a value or a ]" : "a value should follow the comma";
        else
            expected = "a comma or a ] should follow the list's last value";

        const char c = cursor.peek();
        if (c == '"' && (value || key)) return explainText (byte, complaint);
        if ((c == '-' || isDigit (c)) && value) return explainNumber (complaint);

        syntax (expected + ", found " + (c == '"' ? "a string" : found()), remedy (c, value, key));
    }

    /// The remedy that the character at the cursor suggests.
    std::string remedy (char c, bool value, bool key) const
    {
        const bool among_others = ! frames.empty() && ! frames.back().empty();
        if (cursor.atEnd()) return "the file ends too early; was it cut off?";
        if (c == '/' || c == '#') return "JSON has no comments; put notes under a key of your own (unknown keys are kept)";
        if (c == '\'') return "put strings and keys in double quotes";
        if (c == '}' || c == ']') return (value || key) && among_others ? "remove the comma before the bracket" : "check which bracket is open here";
        if (value && isWord (c)) return "values are numbers, strings in double quotes, true, false, null, lists and objects; there is no NaN and no Infinity";
        if (key && isWord (c)) return "put the key in double quotes";
        if (frames.empty()) return done ? "remove what follows" : "a graph file is a JSON object";
        if (! value && ! key && ! frames.back().has_key) return "add the comma";
        return "the order is \"key\": value, \"key\": value";
    }

    void explainText (std::size_t byte, std::string_view complaint)
    {
        const auto has = [&] (std::string_view words) { return complaint.find (words) != std::string_view::npos; };

        if (has ("missing closing quote"))
            return syntax ("the string that begins here is not closed", "end it with a double quote; was the file cut off?");
        if (has ("U+000A") || has ("U+000D"))
            return syntax ("the string that begins here is not closed on its line", "end it with a double quote, or write \\n for a new line inside it");
        cursor.advanceTo (byte > 0 ? byte - 1 : 0);
        if (has ("UTF-8"))
            return syntax ("a string contains a byte that is not UTF-8", "save the file as UTF-8");
        if (has ("control character"))
            return syntax ("a string contains a control character", "write it escaped, as \\t or \\u0001");
        syntax ("a string contains a bad escape",
                R"(\ may be followed by one of " \ / b f n r t, or by u and four hexadecimal digits (a rare character takes two such escapes))");
    }

    void explainNumber (std::string_view complaint)
    {
        if (complaint.find ("overflow") != std::string_view::npos)
            return syntax ("the number " + found() + " is too large", "the largest possible number is about 1.8e308");
        syntax (found() + " is not a number", "write, for example, 1, -1.5 or 2e-3, with digits on both sides of the point");
    }

    /// The word at the cursor.
    std::string found() const
    {
        const auto rest = cursor.rest();
        if (rest.empty()) return "the end of the file";
        std::size_t size = 0;
        while (size < rest.size() && size < 40 && (isWord (rest[size]) || rest[size] == '.' || rest[size] == '-' || rest[size] == '+'))
            ++size;
        if (size == 0)
            do
                ++size;
            while (size < rest.size() && (static_cast<unsigned char> (rest[size]) & 0xC0u) == 0x80u);
        return quote (rest.substr (0, size));
    }

    void syntax (std::string text, std::string remedy)
    {
        complain ("file/syntax", pathOf (innermost()), cursor.position(), std::move (text), std::move (remedy));
    }

    Cursor cursor;
    JsonText& result;
    double most_values;
    std::vector<Frame> frames;
    bool done = false;
};

}   // namespace

void appendPointerPart (std::string& pointer, std::string_view key)
{
    const auto is_special = [] (char c) { return c == '~' || c == '/'; };
    if (std::ranges::none_of (key, is_special))
    {
        pointer += key;
        return;
    }
    std::size_t done = 0;
    for (std::size_t i = 0; i < key.size(); ++i)
        if (is_special (key[i]))
        {
            pointer.append (key.substr (done, i - done)).append (key[i] == '~' ? "~0" : "~1");
            done = i + 1;
        }
    pointer.append (key.substr (done));
}

JsonText readJson (std::string_view text, double most_values)
{
    if (const auto size = static_cast<double> (text.size()); size > budgets().file)
    {
        JsonText result;
        result.messages.push_back (overBudget ("file/too_large", &Budgets::file, "the text", size, "put meshes and samples into separate files"));
        return result;
    }
    if (auto valid = readValidJson (text, most_values)) return *std::move (valid);
    return readAnyJson (text, most_values);
}

JsonText readAnyJson (std::string_view text, double most_values)
{
    JsonText result;
    Builder builder (text, result, most_values);
    if (! Parser::sax_parse (text.begin(), text.end(), &builder)) result.root = nullptr;
    return result;
}

std::string pointerPart (std::string_view key)
{
    std::string part;
    appendPointerPart (part, key);
    return part;
}

TextPosition positionOf (const TextPositions& positions, std::string_view pointer)
{
    while (true)
    {
        if (const auto known = positions.find (pointer)) return *known;
        const auto slash = pointer.rfind ('/');
        if (slash == std::string_view::npos) return {};
        pointer = pointer.substr (0, slash);
    }
}

void append (Json& object, std::string key, Json value)
{
    object.asObject().emplace_back (std::move (key), std::move (value));
}

}   // namespace tactus
