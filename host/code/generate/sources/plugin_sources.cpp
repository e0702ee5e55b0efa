// SPDX-License-Identifier: MIT
#include "plugin_sources.hpp"
#include "code.hpp"

#include <tactus/file/text_file.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/ownership.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <optional>
#include <regex>
#include <sstream>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

Message refusal (const std::string& why, const std::string& remedy)
{
    return Message::error ("export/plugin", "", why, remedy + ", or bypass the node");
}

/// A file that only this user and root can have written, of a bounded size: what it contains will be compiled.
Result<std::string> textOf (const fs::path& path)
{
    std::error_code unseen;
    if (const auto size = fs::file_size (path, unseen); ! unseen && size > PluginSources::most_bytes)
        return Message::error ("file/too_large", path.string(), "it is larger than 1 MB", "");
    const auto file = TrustedFile::open (path);
    if (! file) return file.error();
    return readFile (file->path());
}

bool isHeader (const fs::path& file)
{
    const auto suffix = file.extension();
    return suffix == ".hpp" || suffix == ".h" || suffix == ".hxx" || suffix == ".hh";
}

std::vector<fs::path> headersIn (const fs::path& folder)
{
    std::vector<fs::path> all;
    std::error_code unseen;
    std::size_t seen = 0;
    for (const auto& entry : fs::directory_iterator (folder, unseen))
    {
        if (++seen > 16 * PluginSources::most_files || all.size() == PluginSources::most_files) break;
        if (isHeader (entry.path()) && entry.is_regular_file (unseen)) all.push_back (entry.path());
    }
    std::ranges::sort (all);
    return all;
}

/// "Ice" of "my::Ice".
std::string lastName (const std::string& type)
{
    const auto at = type.rfind ("::");
    return at == type.npos ? type : type.substr (at + 2);
}

/// The place where the struct or class of this name begins last before a given place; empty if nowhere.
std::optional<std::size_t> structBefore (const std::string& text, const std::string& name, std::size_t place)
{
    std::optional<std::size_t> last;
    for (const auto& key : { "struct " + name, "class " + name })
        for (auto at = text.find (key); at != text.npos && at < place; at = text.find (key, at + 1))
        {
            const char next = at + key.size() < text.size() ? text[at + key.size()] : '\0';
            if (next == ' ' || next == '\n' || next == '\r' || next == '{' || next == ':') last = std::max (last.value_or (0), at);
        }
    return last;
}

/// The class of the node with this id, if the text defines it: of the classes that TACTUS_NODE lines name, the last one that begins before
/// the id.
std::string classIn (const std::string& text, const std::string& id)
{
    const auto place = text.find ('"' + id + '"');
    if (place == text.npos) return {};
    static const std::regex line_of_node (R"(\s*TACTUS_NODE\s*\(\s*([A-Za-z0-9_:]{1,200})\s*\)\s*;?\s*)");
    std::string found;
    std::optional<std::size_t> nearest;
    std::istringstream lines (text);
    for (std::string line; std::getline (lines, line);)
    {
        std::smatch parts;
        if (line.size() > 400 || ! std::regex_match (line, parts, line_of_node)) continue;
        const auto begin = structBefore (text, lastName (parts[1].str()), place);
        if (! begin || (nearest && *begin < *nearest)) continue;
        nearest = begin;
        found = parts[1].str();
    }
    return found;
}

struct Found
{
    fs::path header;
    std::string type;
};

/// The first header in this folder that defines the node. `why` gets what kept a header from being read.
std::optional<Found> nodeIn (const fs::path& folder, const std::string& id, std::string& why)
{
    for (const auto& header : headersIn (folder))
    {
        const auto text = textOf (header);
        if (! text)
            why += "; " + text.error().text;
        else if (auto type = classIn (*text, id); ! type.empty())
            return Found { header, std::move (type) };
    }
    return {};
}

/// The files that the lines `#include "…"` and `#include <tactus/…>` of a text name.
std::vector<std::string> includesOf (const std::string& text, char mark)
{
    static const std::regex directive (R"(\s*#\s*include\s*([<"])([^>"]{1,400})[>"].*)");
    std::vector<std::string> all;
    std::istringstream lines (text);
    for (std::string line; std::getline (lines, line);)
        if (std::smatch parts; line.size() < 500 && std::regex_match (line, parts, directive) && parts[1].str()[0] == mark) all.push_back (parts[2].str());
    return all;
}
}   // namespace

std::vector<fs::path> headerFoldersOf (const fs::path& plugin)
{
    std::vector<fs::path> all;
    const auto add = [&] (const fs::path& folder) {
        if (std::ranges::find (all, folder) == all.end()) all.push_back (folder);
    };
    if (const auto build = textOf (plugin.string() + ".build"))
    {
        std::istringstream lines (*build);
        for (std::string line; std::getline (lines, line);)
            if (line.starts_with ("source ")) add (fs::path (line.substr (7)).parent_path().lexically_normal());
    }
    const auto folder = plugin.parent_path();
    add (folder);
    add (folder / "include");
    add ((folder / "../../../include/tactus/plugins").lexically_normal());   // of an installed plugin, which is in PREFIX/lib/tactus/plugins
    return all;
}

Result<> PluginSources::keep (const fs::path& base, const std::string& relative, const std::string& folder)
{
    const auto path = folder + relative;
    if (texts.contains (path)) return {};
    auto text = textOf (base / relative);
    const auto remedy = "put everything that the header of the node includes next to it";
    if (! text) return refusal (quotePath ((base / relative).string()) + " cannot be exported: " + text.error().text, remedy);
    if (texts.size() == most_files) return refusal ("the nodes of plugins include more than " + std::to_string (most_files) + " headers", "include fewer");
    const auto included = includesOf (*text, '"'), ours = includesOf (*text, '<');
    texts.emplace (path, std::move (*text));
    for (const auto& name : ours)
        if (name.starts_with ("tactus/") && findSource (name) == nullptr)
            return refusal (quotePath ((base / relative).string()) + " includes <" + printable (name) + ">, which exported code does not have",
                            "include it where the plugin is made, not in the header of the node");
    for (const auto& name : included)
    {
        const auto next = (fs::path (relative).parent_path() / name).lexically_normal();
        if (next.is_absolute() || *next.begin() == "..")
            return refusal (quotePath ((base / relative).string()) + " includes " + quote (name) + ", which is outside of its folder", remedy);
        if (auto kept = keep (base, next.generic_string(), folder); ! kept) return kept;
    }
    return {};
}

Result<> PluginSources::add (const NodeType& type)
{
    const std::string id (type.info.id);
    if (known.contains (id)) return {};
    std::string looked, why;
    for (const auto& folder : headerFoldersOf (type.origin))
    {
        addToList (looked, quotePath (folder.string()));
        const auto found = nodeIn (folder, id, why);
        if (! found) continue;
        const auto into = "plugins/" + identifier (fs::path (type.origin).stem().string()) + "/", name = found->header.filename().string();
        if (auto kept = keep (folder, name, into); ! kept) return kept;
        known.emplace (id, NodeClass { found->type, into + name });
        return {};
    }
    return refusal ("its code is in the plugin " + quotePath (type.origin) + ", and no header with it was found in " + looked + why,
                    "put the header of the node next to the plugin");
}

}   // namespace tactus::host
