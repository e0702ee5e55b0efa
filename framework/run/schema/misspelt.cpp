// SPDX-License-Identifier: MIT
#include "schema_parts.hpp"

namespace tactus::schema
{

namespace
{
/// Matches a word with one letter wrong, missing or too many, with two neighbours swapped, or in the wrong case; and the word itself.
std::string nearly (const std::string& word)
{
    std::string all;
    const auto add = [&all] (const std::string& one) { all += (all.empty() ? "" : "|") + one; };
    for (std::size_t i = 0; i <= word.size(); ++i)
    {
        const auto before = word.substr (0, i), after = word.substr (i);
        add (before + '.' + after);
        if (i < word.size()) add (before + ".?" + after.substr (1));
        if (i + 1 < word.size()) add (before + after[1] + after[0] + after.substr (2));
    }
    std::string any_case;
    for (const char c : word)
        any_case += c >= 'a' && c <= 'z' ? std::string { '[', c, static_cast<char> (c - 'a' + 'A'), ']' } : std::string (1, c);
    return all + '|' + any_case;
}
}   // namespace

void refuseMisspelt (Json& object)
{
    std::string known;
    for (const auto& [key, schema] : object["properties"].asObject())
        if (key != "$schema") known += (known.empty() ? "" : "|") + key;
    auto patterns = Json::object();
    for (const auto& [key, schema] : object["properties"].asObject())
        if (key != "$schema" && key.size() > 2) patterns["^(?!(?:" + known + ")$)(?:" + nearly (key) + ")$"] = never ("did you mean '" + key + "'?");
    object["patternProperties"] = std::move (patterns);
}

}   // namespace tactus::schema
