// SPDX-License-Identifier: MIT
#include "sources.hpp"

#include <algorithm>
#include <filesystem>
#include <vector>

namespace tactus::host
{

namespace
{
/// The path of the file that this line includes, if it is one of ours: between <> by its full path, between quotation marks next to the
/// file that includes it.
std::string includedBy (std::string_view line, const std::string& from)
{
    constexpr std::string_view directive = "#include ";
    if (! line.starts_with (directive) || line.size() < directive.size() + 2) return {};
    const char mark = line[directive.size()];
    const auto begin = directive.size() + 1, end = line.find (mark == '<' ? '>' : '"', begin);
    if (end == line.npos) return {};
    const std::string path (line.substr (begin, end - begin));
    if (mark == '"') return (std::filesystem::path (from).parent_path() / path).lexically_normal().generic_string();
    return path.starts_with ("tactus/") ? path : std::string {};
}

/// The text between `key` and `end`.
std::string_view valueAfter (std::string_view text, std::string_view key, std::string_view end)
{
    const auto at = text.find (key);
    if (at == text.npos) return {};
    const auto begin = at + key.size();
    return text.substr (begin, text.find (end, begin) - begin);
}

/// Code for reading and checking a graph, which exported code does not call.
bool isOnlyForChecks (std::string_view path)
{
    return path == "tactus/node/device_parts.cpp" || path == "tactus/node/setting.cpp" || path == "tactus/text/message.cpp";
}

/// True if this file belongs to the header: guard.cpp and guard_event.cpp of guard.hpp.
bool isCodeOf (std::string_view file, std::string_view header)
{
    constexpr std::string_view code = ".cpp", declarations = ".hpp";
    if (! file.ends_with (code) || ! header.ends_with (declarations)) return false;
    const auto stem = header.substr (0, header.size() - declarations.size()), name = file.substr (0, file.size() - code.size());
    if (name == stem) return true;
    return name.starts_with (stem) && name[stem.size()] == '_' && findSource (std::string (name).append (declarations)) == nullptr;
}
}   // namespace

const SourceFile* findSource (std::string_view path) noexcept
{
    const auto all = sourceFiles();
    const auto found = std::ranges::find (all, path, &SourceFile::path);
    return found != all.end() ? &*found : nullptr;
}

std::vector<std::string> includesOf (const SourceFile& file)
{
    std::vector<std::string> all;
    for (std::size_t i = 0; i < file.text.size();)
    {
        const auto end = std::min (file.text.find ('\n', i), file.text.size());
        if (auto path = includedBy (file.text.substr (i, end - i), std::string (file.path)); ! path.empty()) all.push_back (std::move (path));
        i = end + 1;
    }
    return all;
}

NodeClass classOf (std::string_view id)
{
    const std::string title = ".id = \"" + std::string (id) + "\",";
    for (const auto& file : sourceFiles())
        if (file.path.starts_with ("tactus/nodes/") && file.text.find (title) != file.text.npos)
            return { std::string (valueAfter (file.text, "\nTACTUS_NODE (", ")")), std::string (file.path) };
    return {};
}

std::set<std::string> withIncludes (const std::set<std::string>& paths)
{
    std::set<std::string> all;
    std::vector<std::string> next (paths.begin(), paths.end());
    while (! next.empty())
    {
        const auto path = std::move (next.back());
        next.pop_back();
        const auto* file = findSource (path);
        if (file == nullptr || ! all.insert (path).second) continue;
        for (auto& included : includesOf (*file))
            next.push_back (std::move (included));
        for (const auto& other : sourceFiles())
            if (isCodeOf (other.path, path) && ! isOnlyForChecks (other.path)) next.emplace_back (other.path);
    }
    return all;
}

}   // namespace tactus::host
