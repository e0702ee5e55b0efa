// SPDX-License-Identifier: MIT
#include "code.hpp"

#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>

namespace tactus::host
{

namespace
{
constexpr std::string_view words_of_cpp[] {
    "alignas", "alignof", "and", "and_eq", "asm", "auto", "bitand", "bitor", "bool", "break",
    "case", "catch", "char", "char16_t", "char32_t", "char8_t", "class", "co_await", "co_return", "co_yield",
    "compl", "concept", "const", "const_cast", "consteval", "constexpr", "constinit", "continue", "decltype", "default",
    "delete", "do", "double", "dynamic_cast", "else", "enum", "explicit", "export", "extern", "false",
    "float", "for", "friend", "goto", "if", "inline", "int", "long", "mutable", "namespace",
    "new", "noexcept", "not", "not_eq", "nullptr", "operator", "or", "or_eq", "private", "protected",
    "public", "register", "reinterpret_cast", "requires", "return", "short", "signed", "sizeof", "static", "static_assert",
    "static_cast", "struct", "switch", "template", "this", "thread_local", "throw", "true", "try", "typedef",
    "typeid", "typename", "union", "unsigned", "using", "virtual", "void", "volatile", "wchar_t", "while",
    "xor", "xor_eq", "linux", "unix", "main", "errno", "stdin", "stdout", "stderr", "assert"
};

bool isWord (char c) { return std::isalnum (static_cast<unsigned char> (c)) != 0; }
}   // namespace

std::string literal (double v)
{
    if (v != v) return "tactus::exported::not_a_number";
    if (std::isinf (v)) return v > 0.0 ? "tactus::inf" : "-tactus::inf";
    auto text = numberText (v);
    if (text.find_first_of (".e") == text.npos) text += ".0";
    return text;
}

std::string textLiteral (std::string_view text)
{
    std::string all = "\"";
    for (const char c : text)
    {
        const auto byte = static_cast<unsigned char> (c);
        if (c == '"' || c == '\\' || c == '?')
            all += { '\\', c };
        else if (byte < 0x20 || byte == 0x7f)
        {
            const char digits[] { '\\', static_cast<char> ('0' + byte / 64), static_cast<char> ('0' + byte / 8 % 8), static_cast<char> ('0' + byte % 8) };
            all.append (digits, sizeof digits);   // octal, because it ends after three digits
        }
        else
            all += c;
    }
    return all + "\"";
}

std::string comment (std::string_view text)
{
    std::string all;
    for (const char c : text)
        all += static_cast<unsigned char> (c) < 0x20 || c == 0x7f ? ' ' : c;
    while (! all.empty() && (all.back() == '\\' || all.back() == ' '))   // a backslash would continue the comment
        all.pop_back();
    return all;
}

std::string identifier (std::string_view text)
{
    std::string all;
    for (const char c : text)
        if (isWord (c))
            all += c;
        else if (! all.empty() && all.back() != '_')
            all += '_';
    while (! all.empty() && all.back() == '_')
        all.pop_back();
    if (all.empty() || std::isdigit (static_cast<unsigned char> (all.front())) != 0) all.insert (0, "g");
    return all;
}

std::string className (std::string_view name)
{
    std::string all;
    bool starts = true;
    for (const char c : name)
    {
        if (c != '_') all += starts ? static_cast<char> (std::toupper (static_cast<unsigned char> (c))) : c;
        starts = c == '_';
    }
    return all;
}

std::vector<std::string> inOrder (std::vector<std::pair<std::size_t, std::string>> members)
{
    std::ranges::sort (members);
    std::vector<std::string> all;
    for (auto& [offset, member] : members)
        all.push_back (std::move (member));
    return all;
}

std::string wrapped (std::string_view indent, const std::string& head, const std::vector<std::string>& parts, std::string_view end)
{
    constexpr std::size_t most_columns = 130;
    auto all = std::string (indent) + head;
    if (const auto one = listText (parts); all.size() + one.size() + end.size() + 2 <= most_columns)
        return all.append (parts.empty() ? "" : " " + one + " ").append (end) + "\n";
    for (std::size_t i = 0; i < parts.size(); ++i)
        all.append (i > 0 ? ",\n" : "\n").append (indent).append ("    ").append (parts[i]);
    return all.append ("\n").append (indent).append (end) + "\n";
}

std::string filled (std::string text, const std::vector<std::pair<std::string, std::string>>& marks)
{
    std::string all;
    for (std::size_t at = 0; at < text.size();)
    {
        const auto mark = std::ranges::find_if (marks, [&] (const auto& m) { return text.compare (at, m.first.size(), m.first) == 0; });
        if (mark == marks.end())
            all += text[at++];
        else
        {
            all += mark->second;
            at += mark->first.size();
        }
    }
    return all;
}

std::string Names::make (std::string_view text, const std::vector<std::string>& endings)
{
    auto first = identifier (text);
    if (std::ranges::count (words_of_cpp, first) > 0) first += '_';
    auto name = first;
    const auto isFree = [&] (const std::string& ending) { return ! used.contains (name + ending); };
    for (int n = 2; ! isFree ("") || ! std::ranges::all_of (endings, isFree); ++n)
        name = first + "_" + std::to_string (n);
    used.insert (name);
    for (const auto& ending : endings)
        used.insert (name + ending);
    return name;
}

}   // namespace tactus::host
