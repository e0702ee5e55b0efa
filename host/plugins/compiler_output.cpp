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
    return Message::error ("live/compile", place, std::move (text), "correct the C++ code and save it; the previous version keeps running");
}
}   // namespace

Messages errorsOf (const std::string& output, const std::string& name)
{
    static const std::regex error ("(.+?):([0-9]{1,8}):(?:([0-9]{1,8}):)? (?:fatal )?error: (.*)");
    Messages all;
    std::string last_lines;
    std::istringstream lines (output);
    for (std::string line; std::getline (lines, line);)
    {
        if (line.size() > longest_line) line.resize (longest_line);
        last_lines += last_lines.empty() ? line : "\n" + line;
        std::smatch parts;
        if (all.size() >= most_errors || ! std::regex_match (line, parts, error)) continue;
        const auto column = parts[3].matched ? ":" + parts[3].str() : std::string();
        auto& m = all.emplace_back (errorIn (parts[1].str() + ":" + parts[2].str() + column, parts[4].str()));
        m.file = parts[1].str();
        m.line = std::stoi (parts[2].str());
        m.column = parts[3].matched ? std::stoi (parts[3].str()) : 1;
    }
    if (! all.empty()) return all;
    if (last_lines.size() > longest_line) last_lines.erase (0, last_lines.size() - longest_line);
    return { errorIn (name, last_lines.empty() ? "the compiler failed without a message" : "the compiler failed: " + last_lines) };
}

}   // namespace tactus::host
