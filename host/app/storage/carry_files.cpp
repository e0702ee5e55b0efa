// SPDX-License-Identifier: GPL-3.0-or-later
#include "carry_files.hpp"

#include <host/app/text/file_path.hpp>
#include <tactus/file/atomic_file.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/budget.hpp>

#include <optional>
#include <string>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
constexpr std::size_t longest_path = 1000;
constexpr int most_names = 100;   // that are tried for a copy

/// Writes a file with these bytes, and the folders that lead to it.
bool write (const std::string& bytes, const fs::path& to)
{
    std::error_code error;
    fs::create_directories (to.parent_path(), error);
    auto file = AtomicFile::create (to);   // follows no link that leads to nothing, or that belongs to another user
    return file && file->stream() << bytes && file->commit();
}

class Carrier
{
public:
    Carrier (fs::path f, fs::path t) : from (std::move (f)), to (std::move (t)) {}

    void carry (graph::Graph& g) const
    {
        carry (g, g.root);
        for (auto& [name, patch] : g.graphs)
            carry (g, patch);
        for (auto& [role, description] : g.devices)
            carryNamedIn (description);
    }

private:
    fs::path from, to;

    void carry (const graph::Graph& g, graph::Patch& patch) const
    {
        for (auto& node : patch.nodes)
        {
            carryNamedIn (node.settings);
            if (! node.type.starts_with ("file:")) continue;
            const auto written = node.type.substr (5);
            const auto inner = g.files.find (written);
            node.type = "file:" + carried (written, inner == g.files.end() ? nullptr : inner->second.get());
        }
    }

    /// A string names a file if such a file exists.
    void carryNamedIn (Json& value) const
    {
        if (value.is_string())
            value = carried (value.asString());
        else if (value.is_structured())
            for (auto& part : value)
                carryNamedIn (part);
    }

    /// The bytes of the copy; for a graph, those after its own files have been carried.
    static std::optional<std::string> bytesOf (const fs::path& file, const graph::Graph* loaded, const fs::path& copy)
    {
        if (loaded != nullptr)
        {
            auto inner = *loaded;
            Carrier (file.parent_path(), copy.parent_path()).carry (inner);
            if (auto text = writeGraph (inner); text != writeGraph (*loaded)) return text;
        }
        auto bytes = readFile (file);
        return bytes ? std::optional (*std::move (bytes)) : std::nullopt;
    }

    /// The path of a file as the copy of the graph has to say it.
    std::string carried (const std::string& named, const graph::Graph* loaded = nullptr) const
    {
        const fs::path name = named;
        std::error_code error;
        if (named.empty() || named.size() > longest_path || name.is_absolute() || ! fs::is_regular_file (from / name, error)) return named;
        const auto stays = pathFrom (from / name, to.string());
        if (*name.lexically_normal().begin() == "..") return stays;
        const auto bytes = bytesOf (from / name, loaded, to / name);
        if (! bytes) return stays;
        auto copy = name;
        for (int i = 2; i <= most_names; ++i)
        {
            if (! fs::exists (to / copy, error)) return write (*bytes, to / copy) ? copy.string() : stays;
            if (const auto there = readFile (to / copy); there && *there == *bytes) return copy.string();
            copy = name.parent_path() / (name.stem().string() + "_" + std::to_string (i) + name.extension().string());
        }
        return stays;
    }
};
}   // namespace

graph::Graph carriedTo (const fs::path& folder, const graph::Graph& g)
{
    auto copy = g;
    std::error_code error;
    beginReading();
    if (! g.folder.empty() && ! fs::equivalent (g.folder, folder, error)) Carrier (g.folder, folder).carry (copy);
    return copy;
}

}   // namespace tactus::host
