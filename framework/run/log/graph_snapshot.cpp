// SPDX-License-Identifier: MIT
#include "graph_snapshot.hpp"
#include "content_hash.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/ids.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/quote.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace tactus
{

namespace fs = std::filesystem;

namespace
{
/// Normalises a path; "" means the current folder.
fs::path whole (const fs::path& path) { return (fs::current_path() / path).lexically_normal(); }

std::string relativeTo (const fs::path& folder, const fs::path& path)
{
    const auto relative = whole (path).lexically_relative (whole (folder));
    return (relative.empty() ? whole (path) : relative).generic_string();
}

/// Writes a graph and the files that it includes. The graph comes last.
class Writer
{
public:
    explicit Writer (fs::path f) : folder (std::move (f)) {}

    std::size_t add (const graph::Graph& graph)
    {
        auto includes = Json::object();
        for (const auto& [written, file] : graph.files)
            includes[written] = add (file);
        all.push_back ({ { "text", writeGraph (graph) },
                         { "folder", relativeTo (folder, graph.folder) },
                         { "ids", graph::idsOf (graph) },
                         { "includes", std::move (includes) } });
        return all.size() - 1;
    }

    Json all = Json::array();

private:
    std::size_t add (const std::shared_ptr<const graph::Graph>& file)
    {
        if (const auto known = numbers.find (file.get()); known != numbers.end()) return known->second;
        return numbers.emplace (file.get(), add (*file)).first->second;
    }

    fs::path folder;
    std::map<const graph::Graph*, std::size_t> numbers;
};

Message wrong (std::string where, std::string text)
{
    return Message::error ("log/graph", std::move (where), std::move (text), "use the log unchanged, as `tactus play` wrote it");
}

const Json* member (const Json& object, const char* key)
{
    const auto at = object.find (key);
    return at != object.end() ? &*at : nullptr;
}
}   // namespace

Json snapshotOf (const graph::Graph& graph, const std::set<std::string>& assets, const fs::path& folder)
{
    Writer writer { folder };
    writer.add (graph);
    auto named = Json::object();
    for (const auto& path : assets)
        named[relativeTo (folder, path)] = fileHash (path).value_or ("");
    return { { "files", std::move (writer.all) }, { "assets", std::move (named) } };
}

Result<graph::Graph> readSnapshot (const Json& snapshot, const fs::path& folder)
{
    const auto* files = snapshot.is_object() ? member (snapshot, "files") : nullptr;
    if (files == nullptr || ! files->is_array() || files->empty()) return wrong ("", "the graph in the log has no list of files");

    std::vector<std::shared_ptr<const graph::Graph>> read;
    double values_left = budgets().values;
    for (const auto& entry : *files)
    {
        const auto where = "/files/" + std::to_string (read.size());
        if (! entry.is_object()) return wrong (where, "this is not an entry for a graph file");
        const auto *text = member (entry, "text"), *place = member (entry, "folder"), *ids = member (entry, "ids"), *includes = member (entry, "includes");
        if (text == nullptr || ! text->is_string() || place == nullptr || ! place->is_string() || ids == nullptr
            || includes == nullptr || ! includes->is_object())
            return wrong (where, "an entry for a graph file needs text, folder, ids and includes");

        auto loaded = readGraph (text->asString(), values_left);
        values_left -= loaded.values;
        for (const auto& m : loaded.messages)
            if (m.severity == Message::Severity::error) return wrong (where + "/text", "the graph cannot be read: " + m.text + " [" + m.id + "]");
        if (! graph::giveIds (loaded.graph, *ids)) return wrong (where + "/ids", "the ids do not match the nodes and wires of the graph");
        loaded.graph.folder = (folder / place->asString()).lexically_normal().string();
        for (const auto& [written, number] : includes->items())
        {
            if (! number.is_number_unsigned() || number.get<std::size_t>() >= read.size())
                return wrong (where + "/includes/" + pointerPart (written), "there is no earlier file with this number");
            loaded.graph.files.emplace (written, read[number.get<std::size_t>()]);
        }
        read.push_back (std::make_shared<const graph::Graph> (std::move (loaded.graph)));
    }
    return *read.back();
}

Messages checkAssets (const Json& snapshot, const fs::path& folder)
{
    Messages messages;
    const auto* assets = member (snapshot, "assets");
    if (assets == nullptr || ! assets->is_object()) return messages;
    for (const auto& [path, hash] : assets->items())
    {
        const auto file = (folder / path).lexically_normal();
        const auto now = fileHash (file);
        if (! now)
            messages.push_back (Message::error ("log/asset_missing", "/assets/" + pointerPart (path),
                                                quotePath (file) + ", which the run used, cannot be read",
                                                "restore the file; its path is relative to the folder of the log"));
        else if (Json (*now) != hash)
            messages.push_back (Message::error ("log/asset_changed", "/assets/" + pointerPart (path),
                                                quotePath (file) + " has changed since the run used it",
                                                "restore the old file, or name a graph file on the command line to replay that graph with the new file"));
    }
    return messages;
}

Json movedSnapshot (Json snapshot, const fs::path& from_folder, const fs::path& to_folder)
{
    const auto moved = [&] (const std::string& path) { return relativeTo (to_folder, from_folder / path); };
    if (auto files = snapshot.find ("files"); files != snapshot.end() && files->is_array())
        for (auto& entry : files->asArray())
            if (auto place = entry.find ("folder"); place != entry.end() && place->is_string()) *place = moved (place->asString());
    const auto* assets = member (snapshot, "assets");
    if (assets == nullptr || ! assets->is_object()) return snapshot;
    auto named = Json::object();
    for (const auto& [path, hash] : assets->items())
        named[moved (path)] = hash;
    snapshot["assets"] = std::move (named);
    return snapshot;
}

std::string snapshotHash (const Json& snapshot)
{
    std::string texts;
    if (const auto* files = member (snapshot, "files"); files != nullptr && files->is_array())
        for (const auto& entry : *files)
            if (entry.is_object())
                if (const auto* text = member (entry, "text"); text != nullptr && text->is_string()) texts += text->asString() + '\n';
    return contentHash (texts);
}

}   // namespace tactus
