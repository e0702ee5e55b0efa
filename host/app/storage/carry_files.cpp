// SPDX-License-Identifier: GPL-3.0-or-later
#include "carry_files.hpp"

#include <tactus/file/atomic_file.hpp>

#include <fstream>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
constexpr std::size_t longest_path = 1000;

class Carrier
{
public:
    std::vector<std::string> failed;

    void carry (const graph::Graph& g, const fs::path& to)
    {
        carry (g, g.root, to);
        for (const auto& [name, patch] : g.graphs)
            carry (g, patch, to);
        for (const auto& [role, description] : g.devices)
            carryNamedIn (description, g.folder, to);
    }

private:
    void carry (const graph::Graph& g, const graph::Patch& patch, const fs::path& to)
    {
        for (const auto& node : patch.nodes)
        {
            carryNamedIn (node.settings, g.folder, to);
            if (! node.type.starts_with ("file:")) continue;
            const auto written = node.type.substr (5);
            if (! copy (written, g.folder, to)) continue;
            if (const auto inner = g.files.find (written); inner != g.files.end()) carry (*inner->second, (to / written).parent_path());
        }
    }

    /// A string names a file if such a file exists.
    void carryNamedIn (const Json& value, const fs::path& from, const fs::path& to)
    {
        if (value.is_string())
            copy (value.get<std::string>(), from, to);
        else if (value.is_structured())
            for (const auto& part : value)
                carryNamedIn (part, from, to);
    }

    static bool write (const fs::path& from, const fs::path& to)
    {
        std::error_code error;
        fs::create_directories (to.parent_path(), error);
        std::ifstream in (from, std::ios::binary);
        auto file = AtomicFile::create (to);   // follows no link that leads to nothing, or that belongs to another user
        if (! file) return false;
        if (in.peek() != std::ifstream::traits_type::eof()) file->stream() << in.rdbuf();
        return file->stream() && file->commit();
    }

    /// Returns true if the file was copied.
    bool copy (const std::string& named, const fs::path& from, const fs::path& to)
    {
        const fs::path name = named;
        std::error_code error;
        if (named.empty() || named.size() > longest_path || name.is_absolute() || ! fs::is_regular_file (from / name, error)) return false;
        if (fs::exists (to / name, error)) return false;
        if (*name.lexically_normal().begin() != ".." && write (from / name, to / name)) return true;
        failed.push_back (named);
        return false;
    }
};
}   // namespace

std::vector<std::string> carryFiles (const graph::Graph& g, const fs::path& to)
{
    std::error_code error;
    if (g.folder.empty() || fs::equivalent (g.folder, to, error)) return {};
    Carrier carrier;
    carrier.carry (g, to);
    return carrier.failed;
}

}   // namespace tactus::host
