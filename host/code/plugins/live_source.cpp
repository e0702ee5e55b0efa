// SPDX-License-Identifier: MIT
#include "live_source.hpp"

#include <tactus/file/text_file.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/ownership.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <regex>
#include <set>
#include <sstream>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

bool isHeader (const fs::path& file)
{
    const auto suffix = file.extension();
    return suffix == ".hpp" || suffix == ".h" || suffix == ".hxx" || suffix == ".hh";
}

Message foreign (const fs::path& where, const Message& why)
{
    return Message::error ("live/foreign", where.string(), why.text + ", so it is not compiled: its code could do all that you may do",
                           "if you trust it, make a copy of your own, or change its owner or its permissions (chown, chmod go-w)");
}
}   // namespace

std::vector<fs::path> LiveSource::watched() const
{
    auto all = sources.empty() ? std::vector { file } : sources;
    std::set<fs::path> folders;
    for (const auto& source : all)
        folders.insert (source.parent_path());
    std::error_code unseen;
    for (const auto& folder : folders)
        for (const auto& entry : fs::directory_iterator (folder, unseen))
            if (! sources.empty() && isHeader (entry.path()) && entry.is_regular_file (unseen)) all.push_back (entry.path());
    return all;
}

Result<> LiveSource::trusted() const
{
    for (const auto& code : sources.empty() ? std::vector { file } : sources)
        if (const auto opened = TrustedFile::open (code); ! opened && opened.error().id == "file/foreign") return foreign (code, opened.error());
    return {};
}

bool LiveSource::isC() const
{
    return ! sources.empty() && std::ranges::all_of (sources, [] (const fs::path& s) { return s.extension() == ".c"; });
}

Result<LiveSource> liveHeader (const fs::path& header)
{
    std::error_code unseen;
    const auto whole = fs::absolute (header, unseen);
    if (! fs::is_regular_file (whole, unseen))
        return Message::error ("live/no_header", header.string(), "there is no such file to watch", "give the header of a node, such as rough_wood.hpp");
    return LiveSource { .file = whole.lexically_normal() };
}

Result<LiveSource> liveBuild (const fs::path& plugin)
{
    const auto build_file = TrustedFile::open (plugin.string() + ".build");   // it names a compiler, which is started
    if (! build_file && build_file.error().id == "file/foreign") return foreign (plugin, build_file.error());
    const auto text = build_file ? readTextFile (build_file->path()) : std::nullopt;
    if (! text)
        return Message::error ("live/no_build_file", plugin.string(), "no file next to the plugin says how to build it",
                               "build it with tactus_add_plugin of this version, or give its header with --live");
    LiveSource source { .file = plugin };
    std::istringstream lines (*text);
    for (std::string line; std::getline (lines, line);)
    {
        const auto space = line.find (' ');
        if (space == std::string::npos || space + 1 == line.size()) continue;
        const auto key = line.substr (0, space), value = line.substr (space + 1);
        if (key == "source") source.sources.emplace_back (value);
        if (key == "include") source.includes.emplace_back (value);
        if (key == "define") source.definitions.push_back (value);
        if (key == "compiler") source.compiler = value;
    }
    std::error_code unseen;
    if (source.sources.empty() || ! std::ranges::all_of (source.sources, [&] (const fs::path& s) { return fs::is_regular_file (s, unseen); }))
        return Message::error ("live/no_build_file", plugin.string() + ".build", "it names no source files, or one that is missing", "build the plugin again");
    return source;
}

std::vector<LiveSource> liveBuilds (const Catalogue& catalogue)
{
    std::set<std::string> origins;
    for (const auto& type : catalogue)
        if (! type.origin.empty()) origins.insert (type.origin);
    std::vector<LiveSource> all;
    for (const auto& origin : origins)
        if (auto source = liveBuild (origin)) all.push_back (std::move (*source));
    return all;
}

Result<std::string> sourceFor (const fs::path& header)
{
    static const std::regex node (R"(\s*TACTUS_NODE\s*\(\s*([A-Za-z0-9_:]{1,200})\s*\)\s*;?\s*)");
    const auto text = readTextFile (header);
    std::istringstream lines (text.value_or (""));
    std::string types;
    for (std::string line; std::getline (lines, line);)
        if (std::smatch parts; line.size() < 400 && std::regex_match (line, parts, node)) addToList (types, parts[1].str());
    if (types.empty())
        return Message::error ("live/no_node", header.string(), "the header has no line TACTUS_NODE (my::Node);", "end the header with the line");
    return "#include <tactus/plugin/node_plugin.hpp>\n#include \"" + header.string() + "\"\nTACTUS_PLUGIN (" + types + ")\n";
}

}   // namespace tactus::host
