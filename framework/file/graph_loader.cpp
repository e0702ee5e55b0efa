// SPDX-License-Identifier: MIT
#include "graph_file.hpp"
#include "text_file.hpp"

#include <tactus/text/closest_match.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

namespace tactus
{
namespace fs = std::filesystem;

namespace
{
constexpr std::string_view file_type = "file:";
constexpr std::size_t longest_chain = 32;

/// The file in the same folder that the user probably meant. Empty if there is none.
std::string similarFile (const fs::path& path)
{
    std::vector<std::string> names;
    std::error_code failed;
    for (fs::directory_iterator entry (path.has_parent_path() ? path.parent_path() : ".", failed), end; ! failed && entry != end; entry.increment (failed))
        if (entry->path().extension().string() == ".json" && names.size() < 1000) names.push_back (entry->path().filename().string());
    return std::string (closestMatch (path.filename().string(), std::vector<std::string_view> (names.begin(), names.end())));
}

Message unreadable (const fs::path& path, const std::string& reason)
{
    std::error_code failed;
    if (fs::is_directory (path, failed))
        return Message::error ("file/unreadable", {}, quotePath (path) + " cannot be read: " + reason,
                               "name a file in it, such as " + quotePath (path / "NAME.json"));
    const auto meant = fs::exists (path, failed) ? "" : similarFile (path);
    return Message::error ("file/unreadable", {}, quotePath (path) + " cannot be read: " + reason,
                           meant.empty() ? "check the path; a path in a file is relative to the folder of that file" : "did you mean " + quote (meant) + "?");
}

/// The text of a file.
Result<std::string> readText (const fs::path& path)
{
    auto text = readFile (path);
    if (text || text.error().id != "file/unreadable") return text;
    return unreadable (path, text.error().text);
}

/// Loads a file and the files it includes. A file that is included twice is loaded once.
class Loader
{
public:
    LoadedGraph load (const fs::path& path)
    {
        auto text = readText (path);
        if (text) return parse (path, *text);
        LoadedGraph loaded;
        loaded.messages.push_back (std::move (text).error());
        loaded.messages.back().file = path.string();
        return loaded;
    }

private:
    /// A path that is the same for a file however it was reached.
    static fs::path identityOf (const fs::path& path)
    {
        std::error_code failure;
        const auto canonical = fs::weakly_canonical (path, failure);
        return failure ? path : canonical;
    }

    LoadedGraph parse (const fs::path& path, std::string_view text)
    {
        auto loaded = readGraph (text, values_left);
        values_left -= loaded.values;
        loaded.graph.folder = path.parent_path().string();
        chain.push_back (identityOf (path));
        include (loaded);
        chain.pop_back();
        for (auto& m : loaded.messages)
            if (m.file.empty()) m.file = path.string();
        return loaded;
    }

    void include (LoadedGraph& loaded)
    {
        const auto patch = [&] (const graph::Patch& p, const std::string& where) {
            for (const auto& node : p.nodes)
                if (node.type.starts_with (file_type))
                    include (loaded, node.type.substr (file_type.size()), where + "/nodes/" + pointerPart (node.name) + "/type");
        };
        patch (loaded.graph.root, "");
        for (const auto& [name, subgraph] : loaded.graph.graphs)
            patch (subgraph, "/graphs/" + pointerPart (name));
    }

    void include (LoadedGraph& loaded, const std::string& written, const std::string& where)
    {
        if (written.empty() || loaded.graph.files.contains (written)) return;
        const auto refuse = [&] (Message m) {
            const auto position = loaded.positionOf (where);
            m.where = where;
            m.line = position.line;
            m.column = position.column;
            loaded.messages.push_back (std::move (m));
        };
        if (++included > budgets().files)
        {
            if (included == budgets().files + 1.0)
                refuse (overBudget ("file/too_many", &Budgets::files, "the graph", included, "move subgraphs into one file"));
            return;
        }
        if (written.find ('\0') != std::string::npos) return refuse (unreadable (written, "its name contains a zero byte"));

        const auto path = fs::path (loaded.graph.folder) / written;
        const auto identity = identityOf (path);
        if (const auto first = std::ranges::find (chain, identity); first != chain.end())
        {
            std::string round;
            for (auto file = first; file != chain.end(); ++file)
                round += file->filename().string() + " -> ";
            return refuse (Message::error ("file/cycle", {}, "the file contains itself: " + round + identity.filename().string(),
                                           "remove one of the nodes through which these files include each other"));
        }
        if (chain.size() >= longest_chain)
            return refuse (Message::error ("file/too_deep", {}, "included files are nested more than " + std::to_string (longest_chain) + " levels deep",
                                           "move subgraphs into one file"));

        auto& graph = loaded_files[identity];
        if (graph == nullptr)
        {
            auto text = readText (path);
            if (! text) return refuse (std::move (text).error());
            auto inner = parse (path, *text);
            std::ranges::move (inner.messages, std::back_inserter (loaded.messages));
            graph = std::make_shared<const graph::Graph> (std::move (inner.graph));
        }
        loaded.graph.files.emplace (written, graph);
    }

    double values_left = budgets().values, included = 0.0;
    std::vector<fs::path> chain;   ///< the files being loaded, outermost first
    std::map<fs::path, std::shared_ptr<const graph::Graph>> loaded_files;
};
}   // namespace

LoadedGraph loadGraph (const fs::path& path)
{
    beginReading();
    return Loader().load (path);
}

}   // namespace tactus
