// SPDX-License-Identifier: GPL-3.0-or-later
#include "preset_pack.hpp"

#include <host/base/platform/private_folder.hpp>

#include <tactus/file/text_file.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/json_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <fstream>
#include <memory>
#include <mutex>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include <juce_core/juce_core.h>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
constexpr const char* graph_name = "graph.json";
constexpr std::size_t longest_name = 200, deepest_folder = 8;

/// True for names that Windows takes for devices, with any ending: "nul", "COM1".
bool isDeviceOfWindows (std::string_view name)
{
    std::string lower (name);
    std::ranges::transform (lower, lower.begin(), [] (char c) { return c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c; });
    if (lower == "con" || lower == "prn" || lower == "aux" || lower == "nul") return true;
    return lower.size() == 4 && (lower.starts_with ("com") || lower.starts_with ("lpt")) && lower[3] >= '1' && lower[3] <= '9';
}

/// True if the path of a file stays below the top, and has no characters that are special on some systems.
bool isPlainName (std::string_view name)
{
    if (name.empty() || name.size() > longest_name) return false;
    std::size_t parts = 0;
    while (true)
    {
        const auto part = name.substr (0, name.find ('/'));
        static constexpr std::string_view special = "\\:*?\"<>|";   // on some systems
        const auto isBad = [] (char c) { return static_cast<unsigned char> (c) < 0x20 || c == 0x7f || special.find (c) != special.npos; };
        if (part.empty() || part.front() == '.' || part.back() == '.' || part.back() == ' ' || std::ranges::any_of (part, isBad)) return false;
        if (isDeviceOfWindows (part.substr (0, part.find ('.')))) return false;
        if (++parts > deepest_folder) return false;
        if (part.size() == name.size()) return true;
        name.remove_prefix (part.size() + 1);
    }
}

Message damaged (const std::string& where, const std::string& why)
{
    return Message::error ("pack/damaged", where, why, "get the file again, or unpack it with another program to look at it");
}

Result<> checkNames (const std::vector<PackedFile>& files, const std::string& where)
{
    std::set<std::string> seen;
    for (const auto& f : files)
    {
        if (! isPlainName (f.name))
            return Message::error ("pack/name", where, "it has a file with the name " + quote (f.name) + ", which is not a plain path below its top",
                                   "do not use it: a preset has no such file");
        auto lower = f.name;
        std::ranges::transform (lower, lower.begin(), [] (char c) { return c >= 'A' && c <= 'Z' ? static_cast<char> (c - 'A' + 'a') : c; });
        if (! seen.insert (lower).second) return Message::error ("pack/twice", where, "it has the file " + quote (f.name) + " twice", "pack it again");
    }
    return {};
}

/// The first text in a part of a graph that is a path out of its folder; "" if there is none.
std::string pathOutside (const Json& value)
{
    if (value.is_string())
    {
        const auto& text = value.asString();
        const bool has_drive = text.size() > 2 && text[1] == ':' && (text[2] == '/' || text[2] == '\\');
        const bool is_absolute = text.starts_with ('/') || text.starts_with ('\\') || has_drive;
        auto rest = std::string_view (text).substr (text.starts_with ("file:") ? 5 : 0);
        bool leaves = is_absolute || (text.starts_with ("file:") && rest.starts_with ('/'));
        while (! rest.empty() && ! leaves)
        {
            const auto part = rest.substr (0, rest.find_first_of ("/\\"));
            leaves = part == "..";
            rest.remove_prefix (std::min (rest.size(), part.size() + 1));
        }
        return leaves ? text : std::string();
    }
    if (value.is_structured())
        for (const auto& inner : value)
            if (auto found = pathOutside (inner); ! found.empty()) return found;
    return {};
}

/// Looks for paths in nodes and devices only: `about`, names and notes are texts for people.
Result<> checkPaths (const std::vector<PackedFile>& files, const std::string& where)
{
    for (const auto& f : files)
    {
        if (! f.name.ends_with (".json")) continue;
        const auto json = readJson (f.bytes).root;
        if (! json.is_object()) continue;   // reading the graph will report what is wrong
        const auto look = [&] (const Json& in) -> std::string {
            if (! in.is_object()) return {};
            for (const char* key : { "nodes", "devices" })
                if (const auto part = in.find (key); part != in.end())
                    if (auto found = pathOutside (*part); ! found.empty()) return found;
            return {};
        };
        auto found = look (json);
        if (const auto graphs = json.find ("graphs"); found.empty() && graphs != json.end() && graphs->is_object())
            for (const auto& [name, patch] : graphs->items())
                if (found.empty()) found = look (patch);
        if (! found.empty())
            return Message::error ("pack/outside", where, quote (f.name) + " names " + quote (found) + ", which is outside of the preset",
                                   "do not use it, or unpack it with another program and look at it");
    }
    return {};
}

/// Checks an archive of so many files with so many bytes in all.
Result<> checkBudgets (const std::string& where, double count, double total)
{
    const auto over = count > budgets().files     ? overBudget ("pack/too_many", &Budgets::files, "it", count, "pack fewer files")
                      : total > budgets().reading ? overBudget ("pack/too_large", &Budgets::reading, "it", total, "pack smaller files")
                                                  : Message {};
    if (over.id.empty()) return {};
    return Message::error (over.id, where, over.text, over.remedy);
}

/// The folders that were made. They are removed when the program exits normally.
class Folders
{
public:
    ~Folders()
    {
        for (const auto& f : all)
        {
            std::error_code ignored;
            fs::remove_all (f, ignored);
        }
    }

    void add (fs::path folder)
    {
        const std::scoped_lock lock (access);
        all.push_back (std::move (folder));
    }

private:
    std::mutex access;
    std::vector<fs::path> all;
};

Result<> writeInto (const fs::path& folder, const PackedFile& f)
{
    const auto to = folder / f.name;
    std::error_code failed;
    fs::create_directories (to.parent_path(), failed);
    std::ofstream out (to, std::ios::binary);
    out.write (f.bytes.data(), static_cast<std::streamsize> (f.bytes.size()));
    out.close();
    if (! out) return Message::error ("output/unwritable", to.string(), "the file cannot be unpacked here", "check that the disk has room");
    return {};
}
}   // namespace

bool isPresetPack (const fs::path& file) { return file.extension() == ".tactus"; }

Result<std::string> presetPack (const std::vector<PackedFile>& files)
{
    if (auto fine = checkNames (files, {}); ! fine) return fine.error();
    if (auto fine = checkPaths (files, {}); ! fine) return fine.error();
    double total = 0.0;
    for (const auto& f : files)
        total += static_cast<double> (f.bytes.size());
    if (auto fits = checkBudgets ({}, static_cast<double> (files.size()), total); ! fits) return fits.error();
    juce::ZipFile::Builder builder;
    const juce::Time when (2000, 0, 1, 0, 0);
    for (const auto& f : files)
        builder.addEntry (new juce::MemoryInputStream (f.bytes.data(), f.bytes.size(), true), 9, juce::String::fromUTF8 (f.name.c_str()), when);
    juce::MemoryOutputStream out;
    if (! builder.writeToStream (out, nullptr)) return damaged ({}, "the archive cannot be made");
    if (const auto size = static_cast<double> (out.getDataSize()); size > budgets().file)
        return overBudget ("pack/too_large", &Budgets::file, "it", size, "pack smaller files");
    return std::string (static_cast<const char*> (out.getData()), out.getDataSize());
}

Result<std::vector<PackedFile>> readPresetPack (const fs::path& path)
{
    const auto where = path.string();
    const auto read = readFile (path);
    if (! read) return Message::error (read.error().id, where, read.error().text, read.error().remedy.empty() ? "check the path" : read.error().remedy);
    const auto notAPack = [&] (const std::string& why) {
        return Message::error ("pack/not_a_pack", where, why, "choose a file that Tactus has written with Share");
    };
    if (! read->starts_with ("PK")) return notAPack ("it is not a ZIP archive");
    juce::ZipFile zip (new juce::MemoryInputStream (read->data(), read->size(), false), true);
    const int count = zip.getNumEntries();
    if (count == 0) return notAPack ("it is an empty or damaged ZIP archive");
    if (auto fits = checkBudgets (where, count, 0.0); ! fits) return fits.error();
    std::vector<PackedFile> files;
    double total = 0.0;
    for (int i = 0; i < count; ++i)
    {
        const auto* entry = zip.getEntry (i);
        if (entry == nullptr) return damaged (where, "its list of files is damaged");
        const auto name = entry->filename.toStdString();
        if (name.ends_with ('/') && isPlainName (std::string_view (name).substr (0, name.size() - 1))) continue;   // a folder
        if (entry->isSymbolicLink)
            return Message::error ("pack/name", where, "it has a link: " + quote (name), "do not use it: a preset has no such file");
        if (entry->uncompressedSize < 0) return damaged (where, "it has a file of a negative size");
        total += static_cast<double> (entry->uncompressedSize);
        if (auto fits = checkBudgets (where, count, total); ! fits) return fits.error();
        const std::unique_ptr<juce::InputStream> stream (zip.createStreamForEntry (i));
        const auto size = static_cast<std::size_t> (entry->uncompressedSize);
        juce::MemoryBlock bytes;
        // As many bytes as the archive says, and one more, to notice if there are others.
        const auto got = stream == nullptr ? std::size_t { 0 } : stream->readIntoMemoryBlock (bytes, static_cast<juce::pointer_sized_int> (size + 1));
        if (stream == nullptr || got != size) return damaged (where, "the file " + quote (name) + " is not as long as the archive says");
        files.push_back ({ name, std::string (static_cast<const char*> (bytes.getData()), size) });
    }
    if (auto fine = checkNames (files, where); ! fine) return fine.error();
    if (std::ranges::count (files, graph_name, &PackedFile::name) == 0)
        return Message::error ("pack/no_graph", where, "it has no graph.json at its top", "choose a file that Tactus has written with Share");
    if (auto fine = checkPaths (files, where); ! fine) return fine.error();
    return files;
}

Result<fs::path> unpackPreset (const fs::path& pack)
{
    const auto files = readPresetPack (pack);
    if (! files) return files.error();
    static Folders folders;
    const auto folder = privateFolder ("tactus-preset-");
    if (folder.empty())
        return Message::error ("output/unwritable", temporaryFolder().string(), "no folder can be made there to unpack the preset", "check TMPDIR");
    folders.add (folder);
    for (const auto& f : *files)
        if (auto written = writeInto (folder, f); ! written) return written.error();
    return folder / graph_name;
}

}   // namespace tactus::host
