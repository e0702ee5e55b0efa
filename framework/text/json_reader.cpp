// SPDX-License-Identifier: MIT
#include "json_scanner.hpp"
#include "json_text.hpp"
#include "quote.hpp"
#include "seen_keys.hpp"
#include "units.hpp"

#include <tuple>
#include <utility>

namespace tactus
{
namespace
{
constexpr std::size_t longest_path = 1000;

constexpr bool isWord (char c) noexcept
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || isDigit (c);
}

/// Makes a long list grow faster than it would by itself, because moving its values takes longer than anything else.
template <typename List>
void makeRoom (List& list)
{
    constexpr std::size_t is_long = 64, growth = 4;
    if (list.size() == list.capacity() && list.size() >= is_long) list.reserve (growth * list.size());
}

/// Reads a file of JSON in one pass. Each function reads one thing where the scanner is. If it is not there, the function says so in a
/// message, unless the caller knows better what was expected, and returns false.
class JsonReader
{
public:
    JsonReader (std::string_view text, JsonText& r, double most) : scan (text), result (r), most_values (most) {}

    bool file();

private:
    /// An object or a list that is being read. Its last entry is being read, too.
    struct Level
    {
        const Level* around = nullptr;
        const Json::Object* members = nullptr;   // null for a list
        const Json::Array* elements = nullptr;
    };

    /// The part of JSON that was expected where reading has failed.
    enum class Wanted
    {
        value,
        key,
        colon,
        separator,
        end_of_file
    };

    bool value (Json& into, std::uint32_t place, int depth);
    bool object (Json::Object&, std::uint32_t place, int depth);
    bool member (Json::Object&, SeenKeys&, std::uint32_t place, int depth);
    bool list (Json::Array&, std::uint32_t place, int depth);
    bool number (Json& into);
    bool string (std::string& into);
    bool key (std::string_view& text);

    std::string pathOf (const Level*) const;
    bool refuse (std::string id, const std::string& where, TextPosition, std::string text, std::string remedy);
    bool syntax (TextPosition, std::string text, std::string remedy);
    bool expected (const std::string& what, Wanted, bool after_comma = false);
    std::string found() const;
    std::string remedyFor (Wanted, bool after_comma) const;
    std::string textWithUnit() const;
    void complainOfTwins (std::string_view key, TextPosition);
    bool tooMany();
    bool tooDeep();

    JsonScanner scan;
    JsonText& result;
    const double most_values;
    const Level* innermost = nullptr;
    bool has_failed = false;   // with a message
    std::string rare_key;      // the last one that was not a plain string
};

bool JsonReader::file()
{
    scan.skipSpace();
    if (! value (result.root, result.positions.addRoot (scan.position()), 0)) return expected ("the file should begin with {", Wanted::value);
    scan.skipSpace();
    return scan.atEnd() || expected ("the file should end after its closing bracket", Wanted::end_of_file);
}

/// Says nothing if no value begins here.
bool JsonReader::value (Json& into, std::uint32_t place, int depth)
{
    if (++result.values > most_values) return tooMany();
    switch (scan.peek())
    {
    case '{':
        return depth < deepest_nesting ? object (JsonScanner::put (into, Json::Object()).asObject(), place, depth + 1) : tooDeep();
    case '[':
        return depth < deepest_nesting ? list (JsonScanner::put (into, Json::Array()).asArray(), place, depth + 1) : tooDeep();
    case '"':
        if (const auto text = scan.plainString()) return JsonScanner::put (into, std::string (*text)), true;
        return string (JsonScanner::put (into, std::string()).asString());
    case 't':
        return scan.takeWord ("true") && (JsonScanner::put (into, true), true);
    case 'f':
        return scan.takeWord ("false") && (JsonScanner::put (into, false), true);
    case 'n':
        return scan.takeWord ("null");
    default:
        return number (into);
    }
}

bool JsonReader::object (Json::Object& members, std::uint32_t place, int depth)
{
    scan.take ('{');
    scan.skipSpace();
    if (scan.take ('}')) return true;
    constexpr std::size_t usual = 2;   // so that most objects are allocated once
    members.reserve (usual);
    SeenKeys seen;
    const Level level { innermost, &members, nullptr };
    innermost = &level;
    do
    {
        scan.skipSpace();
        if (! member (members, seen, place, depth)) return false;
        scan.skipSpace();
    } while (scan.take (','));
    if (! scan.take ('}')) return expected ("a comma or a } should follow the value of " + quote (members.back().first), Wanted::separator);
    innermost = level.around;
    return true;
}

bool JsonReader::member (Json::Object& members, SeenKeys& seen, std::uint32_t place, int depth)
{
    const auto begin = scan.position();
    std::string_view name;
    if (! key (name))
        return expected (members.empty() ? "expected a key in double quotes or a }" : "a key in double quotes should follow the comma", Wanted::key,
                         ! members.empty());
    if (! seen.add (members, name)) complainOfTwins (name, begin);
    const auto inside = result.positions.addMember (place, name, begin);
    makeRoom (members);
    auto& added = members.emplace_back (std::piecewise_construct, std::forward_as_tuple (name), std::tuple()).second;
    scan.skipSpace();
    if (! scan.take (':')) return expected ("a : should follow the key " + quote (members.back().first), Wanted::colon);
    scan.skipSpace();
    return value (added, inside, depth) || expected ("a value should follow the key " + quote (members.back().first), Wanted::value);
}

bool JsonReader::list (Json::Array& elements, std::uint32_t place, int depth)
{
    constexpr std::size_t first_entries = 1000;
    scan.take ('[');
    scan.skipSpace();
    if (scan.take (']')) return true;
    const Level level { innermost, nullptr, &elements };
    innermost = &level;
    do
    {
        scan.skipSpace();
        const auto index = elements.size();
        const bool is_bulk = scan.peek() == '[' || scan.peek() == '-' || isDigit (scan.peek());
        const auto inside = ! is_bulk || index < first_entries ? result.positions.addElement (place, index, scan.position()) : TextPositions::none;
        makeRoom (elements);
        if (! value (elements.emplace_back(), inside, depth))
            return expected (index == 0 ? "expected a value or a ]" : "a value should follow the comma", Wanted::value, index > 0);
        scan.skipSpace();
    } while (scan.take (','));
    if (! scan.take (']')) return expected ("a comma or a ] should follow the list's last value", Wanted::separator);
    innermost = level.around;
    return true;
}

/// Says nothing if no number begins here.
bool JsonReader::number (Json& into)
{
    const char c = scan.peek();
    switch (scan.number (into))
    {
    case JsonScanner::NumberFault::none:
        return true;
    case JsonScanner::NumberFault::too_large:
        return syntax (scan.position(), "the number " + found() + " is too large", "the largest possible number is about 1.8e308");
    case JsonScanner::NumberFault::not_a_number:
        break;
    }
    return (c == '-' || isDigit (c))
           && syntax (scan.position(), found() + " is not a number", "write, for example, 1, -1.5 or 2e-3, with digits on both sides of the point");
}

bool JsonReader::string (std::string& into)
{
    const auto begin = scan.position();
    switch (scan.string (into))
    {
    case JsonScanner::StringFault::none:
        return true;
    case JsonScanner::StringFault::open_at_end:
        return syntax (begin, "the string that begins here is not closed", "end it with a double quote; was the file cut off?");
    case JsonScanner::StringFault::open_at_line_end:
        return syntax (begin, "the string that begins here is not closed on its line", "end it with a double quote, or write \\n for a new line inside it");
    case JsonScanner::StringFault::control_character:
        return syntax (scan.position(), "a string contains a control character", "write it escaped, as \\t or \\u0001");
    case JsonScanner::StringFault::not_utf8:
        return syntax (scan.position(), "a string contains a byte that is not UTF-8", "save the file as UTF-8");
    case JsonScanner::StringFault::bad_escape:
        break;
    }
    return syntax (scan.position(), "a string contains a bad escape",
                   R"(\ may be followed by one of " \ / b f n r t, or by u and four hexadecimal digits (a rare character takes two such escapes))");
}

/// The text is valid until the next key is read. Says nothing if no string begins here.
bool JsonReader::key (std::string_view& text)
{
    if (scan.peek() != '"') return false;
    if (const auto plain = scan.plainString()) return text = *plain, true;
    if (! string (rare_key)) return false;
    text = rare_key;
    return true;
}

//==============================================================================
/// The JSON pointer of an object or a list that is being read; of the file for null.
std::string JsonReader::pathOf (const Level* level) const
{
    std::vector<const Level*> outer;
    for (; level != nullptr && level->around != nullptr; level = level->around)
        outer.push_back (level->around);
    std::string path;
    for (auto l = outer.rbegin(); l != outer.rend() && path.size() < longest_path; ++l)
        path += '/' + ((*l)->members != nullptr ? pointerPart ((*l)->members->back().first) : std::to_string ((*l)->elements->size() - 1));
    return path;
}

/// Returns false, which is what the caller returns.
bool JsonReader::refuse (std::string id, const std::string& where, TextPosition p, std::string text, std::string remedy)
{
    auto m = Message::error (std::move (id), where.substr (0, longest_path), std::move (text), std::move (remedy));
    m.line = p.line;
    m.column = p.column;
    result.messages.push_back (std::move (m));
    has_failed = true;
    return false;
}

bool JsonReader::syntax (TextPosition p, std::string text, std::string remedy)
{
    return refuse ("file/syntax", pathOf (innermost), p, std::move (text), std::move (remedy));
}

/// Says nothing if there is a message already.
bool JsonReader::expected (const std::string& what, Wanted wanted, bool after_comma)
{
    return ! has_failed && syntax (scan.position(), what + ", found " + found(), remedyFor (wanted, after_comma));
}

/// The words for what is at the place of the scanner.
std::string JsonReader::found() const
{
    const auto rest = scan.rest();
    if (rest.empty()) return "the end of the file";
    if (rest.front() == '"') return "a string";
    constexpr std::size_t longest = 40;
    std::size_t size = 0;
    while (size < rest.size() && size < longest && (isWord (rest[size]) || rest[size] == '.' || rest[size] == '-' || rest[size] == '+'))
        ++size;
    if (size == 0)
        do
            ++size;
        while (size < rest.size() && continuesCharacter (rest[size]));
    return quote (rest.substr (0, size));
}

/// The remedy that the character suggests where the scanner is.
std::string JsonReader::remedyFor (Wanted wanted, bool after_comma) const
{
    const char c = scan.peek();
    if (scan.atEnd()) return "the file ends too early, as if it was cut off";
    if (const auto [line, column] = scan.position(); line == 1 && column == 1 && c != '/') return "this is a file of another kind: choose a JSON file";
    if (c == '/' || c == '#') return "JSON has no comments; put notes under a key of your own (unknown keys are kept)";
    if (c == '\'') return "put strings and keys in double quotes";
    if (c == '}' || c == ']') return after_comma ? "remove the comma before the bracket" : "check which bracket is open here";
    if (wanted == Wanted::value && isWord (c))
        return "values are numbers, strings in double quotes, true, false, null, lists and objects; there is no NaN and no Infinity";
    if (wanted == Wanted::key && isDigit (c) && after_comma) return "write numbers with a decimal point, as in 0.4, and keys in double quotes";
    if (wanted == Wanted::key && isWord (c)) return "put the key in double quotes";
    if (const auto text = wanted == Wanted::separator ? textWithUnit() : std::string(); ! text.empty()) return "put a value with a unit in double quotes: \"" + text + '"';
    if (wanted == Wanted::end_of_file) return "remove what follows";
    if (innermost == nullptr) return "a graph file is a JSON object";
    if (wanted == Wanted::separator) return "add the comma";
    return "the order is \"key\": value, \"key\": value";
}

/// The text "0.4 mm" if the file has 0.4 mm without quotes, and the scanner is at the unit; else empty.
std::string JsonReader::textWithUnit() const
{
    if (innermost == nullptr) return {};
    const auto& number = innermost->members != nullptr ? innermost->members->back().second : innermost->elements->back();
    constexpr std::size_t longest = 40;
    auto unit = scan.rest().substr (0, longest);
    unit = unit.substr (0, unit.find_first_of (",:]}\"\r\n"));
    unit = unit.substr (0, unit.find_last_not_of (" \t") + 1);
    auto text = number.is_number() ? number.dump() + ' ' + std::string (unit) : std::string();
    const bool has_unit = unit.find_first_not_of ("0123456789.+-eE \t") != unit.npos;
    return has_unit && parseMeasure (text) ? text : std::string();
}

/// Reading continues after a duplicate key.
void JsonReader::complainOfTwins (std::string_view key, TextPosition at)
{
    constexpr std::size_t most = 1000;   // a hostile file may have millions of them
    if (result.messages.size() >= most) return;
    const auto where = pathOf (innermost) + '/' + pointerPart (key);
    const auto first = result.positions.find (where).value_or (TextPosition {});
    refuse ("file/duplicate_key", where, at,
            "the key " + quote (key) + " occurs twice in one object; first at line " + std::to_string (first.line) + ", column "
                + std::to_string (first.column),
            "remove or rename one of them");
    has_failed = false;
}

bool JsonReader::tooMany()
{
    auto m = overBudget ("file/too_large", &Budgets::values, "the text", budgets().values + 1.0, "put meshes and samples into separate files");
    return refuse (std::move (m.id), pathOf (innermost), scan.position(), std::move (m.text), std::move (m.remedy));
}

bool JsonReader::tooDeep()
{
    const Level inside { innermost, nullptr, nullptr };
    return refuse ("file/too_deep", pathOf (&inside), scan.position(),
                   "objects and lists are nested more than " + std::to_string (deepest_nesting) + " levels deep", "a graph needs fewer than ten levels");
}
}   // namespace

JsonText readJson (std::string_view text, double most_values)
{
    if (const auto size = static_cast<double> (text.size()); size > budgets().file)
    {
        JsonText result;
        result.messages.push_back (overBudget ("file/too_large", &Budgets::file, "the text", size, "put meshes and samples into separate files"));
        return result;
    }
    JsonText result;
    if (! JsonReader (text, result, most_values).file()) result.root = nullptr;
    return result;
}

}   // namespace tactus
