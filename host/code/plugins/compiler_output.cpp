// SPDX-License-Identifier: MIT
#include "compiler_output.hpp"

#include <regex>
#include <sstream>
#include <vector>

namespace tactus::host
{

namespace
{
constexpr std::size_t longest_line = 1000;   // matching a longer line with std::regex may use up the stack
constexpr std::size_t most_errors = 20;      // later errors usually follow from the first

Message errorIn (const std::string& place, std::string text)
{
    return Message::error ("live/compile", place, std::move (text), correct_and_save);
}

/// An error at the file, line and column that a line of the compiler names.
Message at (std::string text, const std::smatch& place)
{
    const auto column = place[3].matched ? ":" + place[3].str() : std::string();
    auto m = errorIn (place[1].str() + ":" + place[2].str() + column, std::move (text));
    m.file = place[1].str();
    m.line = std::stoi (place[2].str());
    m.column = place[3].matched ? std::stoi (place[3].str()) : 1;
    return m;
}
}   // namespace

Messages errorsOf (const std::string& output, const std::string& name)
{
    static const std::regex error ("(.+?):([0-9]{1,8}):(?:([0-9]{1,8}):)? (?:fatal )?error: (.*)");
    // GCC places an error in a macro at the macro. What the author can edit is where the macro is used.
    static const std::regex use ("(.+?):([0-9]{1,8}):([0-9]{1,8}): note: in expansion of macro .TACTUS_NODE.");
    Messages all;
    std::string last_lines;
    std::istringstream lines (output);
    for (std::string line; std::getline (lines, line);)
    {
        if (line.size() > longest_line) line.resize (longest_line);
        last_lines += last_lines.empty() ? line : "\n" + line;
        std::smatch parts;
        if (! all.empty() && line.find ("TACTUS_NODE") != std::string::npos && std::regex_search (line, parts, use))
        {
            auto& m = all.back();
            m = at (m.text, parts);
            continue;
        }
        if (all.size() >= most_errors || ! std::regex_match (line, parts, error)) continue;
        all.push_back (at (parts[4].str(), parts));
    }
    if (! all.empty()) return all;
    if (last_lines.size() > longest_line) last_lines.erase (0, last_lines.size() - longest_line);
    return { errorIn (name, last_lines.empty() ? "the compiler failed without a message" : "the compiler failed: " + last_lines) };
}

}   // namespace tactus::host
