// SPDX-License-Identifier: GPL-3.0-or-later
#include "share.hpp"
#include "carry_files.hpp"

#include <host/app/text/filled.hpp>
#include <host/base/files/preset_pack.hpp>
#include <host/base/platform/private_folder.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>

#include <system_error>
#include <utility>

namespace tactus::host
{

namespace
{
CarriedGraph carriedToNewFolder (const graph::Graph& g, const std::vector<std::filesystem::path>& from_elsewhere)
{
    const auto folder = privateFolder ("tactus-share-");   // nothing is there, so no file needs another name
    auto carried = carriedTo (folder, g, {}, from_elsewhere);
    std::error_code ignored;
    std::filesystem::remove_all (folder, ignored);
    return carried;
}
}   // namespace

std::vector<std::filesystem::path> filesElsewhere (const graph::Graph& g) { return carriedToNewFolder (g, {}).elsewhere; }

Result<> sharePreset (const graph::Graph& g, const std::filesystem::path& file, const std::vector<std::filesystem::path>& from_elsewhere)
{
    auto carried = carriedToNewFolder (g, from_elsewhere);
    std::vector<PackedFile> files { { "graph.json", writeGraph (carried.graph) } };
    for (auto& f : carried.files)
    {
        auto bytes = f.text ? Result<std::string> (std::move (*f.text)) : readFile (f.from);
        if (! bytes) return Message::error (bytes.error().id, f.from.string(), bytes.error().text, bytes.error().remedy);
        files.push_back ({ f.name.generic_string(), std::move (*bytes) });
    }
    auto pack = presetPack (files);
    if (! pack && pack.error().id == "pack/outside")
        return Message::error ("share/outside", file.string(), pack.error().text,
                               TRANS ("copy that file into the folder of the graph, under a name that does not begin with a dot, and choose it there")
                                   .toStdString());
    if (! pack && pack.error().id == "pack/name")
        return Message::error ("share/name", file.string(), pack.error().text, TRANS ("rename that file, and choose it again").toStdString());
    if (! pack) return Message::error (pack.error().id, file.string(), pack.error().text, pack.error().remedy);
    return writeTextFile (file, *pack);
}

}   // namespace tactus::host
