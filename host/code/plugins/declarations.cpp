// SPDX-License-Identifier: MIT
#include "declarations.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace tactus::host
{

namespace
{
using Words = std::vector<std::string_view>;

bool isLetterOrDigit (char c) { return std::isalnum (static_cast<unsigned char> (c)) != 0 || c == '_'; }

/// The end of a literal in quotation marks, which begins at `i`.
std::size_t endOfLiteral (std::string_view s, std::size_t i)
{
    const char mark = s[i];
    for (++i; i < s.size() && s[i] != mark && s[i] != '\n'; ++i)
        if (s[i] == '\\') ++i;
    return std::min (i + 1, s.size());
}

/// The end of a preprocessor directive, which a backslash continues on the next line.
std::size_t endOfDirective (std::string_view s, std::size_t i)
{
    do
        i = std::min (s.find ('\n', i + 1), s.size());
    while (i < s.size() && s[i - 1] == '\\');
    return i;
}

std::size_t endOfWord (std::string_view s, std::size_t begin)
{
    auto i = begin;
    if (s[i] == '#') return endOfDirective (s, i);
    if (s[i] == '"' || s[i] == '\'') return endOfLiteral (s, i);
    const bool is_number = std::isdigit (static_cast<unsigned char> (s[i])) != 0;
    while (i < s.size() && (isLetterOrDigit (s[i]) || (s[i] == '\'' && is_number)))
        ++i;
    return std::max (i, begin + 1);
}

/// The words of the text: names, numbers, literals, single signs and whole directives. A raw literal is cut into words like code.
Words wordsOf (std::string_view s)
{
    Words all;
    for (std::size_t i = 0; i < s.size();)
    {
        auto next = i + 1;
        if (s.substr (i, 2) == "//")
            next = std::min (s.find ('\n', i), s.size());
        else if (s.substr (i, 2) == "/*")
            next = std::min (s.find ("*/", i + 2), s.size() - 2) + 2;
        else if (std::isspace (static_cast<unsigned char> (s[i])) == 0)
            all.push_back (s.substr (i, (next = endOfWord (s, i)) - i));
        i = next;
    }
    return all;
}

template <std::size_t n>
bool hasOneOf (const Words& statement, const std::array<std::string_view, n>& words)
{
    return std::ranges::any_of (statement, [&] (auto word) { return std::ranges::count (words, word) > 0; });
}

enum class Braces
{
    scope,      ///< contains declarations
    function,   ///< the body of a function that cannot affect the members of a class
    other       ///< anything else
};

/// The kind of block that a brace opens, judged by the words between the previous statement and the brace.
Braces bracesAfter (const Words& statement)
{
    constexpr std::array<std::string_view, 9> may_decide { "constexpr", "consteval", "auto", "concept", "requires", "decltype", "=", "[", "alignas" };
    constexpr std::array<std::string_view, 5> scopes { "namespace", "struct", "class", "union", "enum" };
    constexpr std::array<std::string_view, 4> after_parameters { "const", "noexcept", "override", "final" };
    if (hasOneOf (statement, may_decide)) return Braces::other;
    if (hasOneOf (statement, scopes)) return Braces::scope;
    auto last = statement.rbegin();
    while (last != statement.rend() && std::ranges::count (after_parameters, *last) > 0)
        ++last;
    return last != statement.rend() && *last == ")" ? Braces::function : Braces::other;
}

/// The index after the brace that closes the one at `i`.
std::size_t endOfBraces (const Words& words, std::size_t i)
{
    for (int depth = 0; i < words.size(); ++i)
    {
        if (words[i] == "{") ++depth;
        if (words[i] == "}" && --depth == 0) return i + 1;
    }
    return i;
}
}   // namespace

std::string declarationsOf (std::string_view source)
{
    const auto words = wordsOf (source);
    std::string text;
    Words statement;
    const auto keep = [&text] (std::string_view word) { text.append (word) += ' '; };
    for (std::size_t i = 0; i < words.size();)
    {
        const auto word = words[i];
        const auto braces = word == "{" ? bracesAfter (statement) : Braces::scope;
        const auto end = braces == Braces::scope ? i + 1 : endOfBraces (words, i);
        const Words inside (words.begin() + static_cast<std::ptrdiff_t> (i), words.begin() + static_cast<std::ptrdiff_t> (end));
        const bool has_directive = std::ranges::any_of (inside, [] (auto w) { return w.front() == '#'; });   // it may affect later code
        if (braces == Braces::function && ! has_directive)
            keep ("{}");
        else
            std::ranges::for_each (inside, keep);
        if (word == ";" || word == "{" || word == "}" || word.front() == '#')
            statement.clear();
        else
            statement.push_back (word);
        i = end;
    }
    return text;
}

}   // namespace tactus::host
