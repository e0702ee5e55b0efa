// SPDX-License-Identifier: GPL-3.0-or-later
#include "carry_files.hpp"

#include <host/app/text/file_path.hpp>
#include <host/base/assets/file_assets.hpp>
#include <host/base/platform/home_folder.hpp>
#include <host/code/plugins/installed_plugins.hpp>
#include <host/devices/hid_link/profile_library.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/text/budget.hpp>

#include <algorithm>

#include <juce_core/juce_core.h>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
using Kind = SettingSheet::Kind;

constexpr int most_names = 100;   // that are tried for a copy
constexpr const char* traces = "*.csv;*.tsv;*.txt";

bool hasExtensionOf (const fs::path& name, const juce::String& patterns)
{
    const auto file = juce::String (name.filename().string());
    return std::ranges::any_of (juce::StringArray::fromTokens (patterns, ";", {}), [&] (const auto& p) { return file.matchesWildcard (p, true); });
}

bool isHidden (const fs::path& part) { return part.string().starts_with ('.'); }

/// True if a path below a folder leads only through folders, or through nothing yet, and not through a link.
bool hasOnlyFolders (const fs::path& folder, const fs::path& name)
{
    auto at = folder;
    std::error_code ignored;
    return std::ranges::all_of (name, [&] (const fs::path& part) {
        at /= part;
        const auto type = fs::symlink_status (at, ignored).type();
        return type == fs::file_type::directory || type == fs::file_type::not_found;
    });
}

/// True for a file that is no link.
bool isFile (const fs::path& file)
{
    std::error_code ignored;
    return fs::is_regular_file (fs::symlink_status (file, ignored));
}

bool isThere (const fs::path& file)
{
    std::error_code ignored;
    return fs::exists (fs::symlink_status (file, ignored));
}

bool isWithin (const fs::path& file, const fs::path& folder)
{
    std::error_code ignored;
    const auto inner = fs::weakly_canonical (file, ignored);
    auto outer = fs::weakly_canonical (fs::absolute (folder, ignored), ignored);
    if (! outer.has_filename()) outer = outer.parent_path();   // "lab/"
    return ! outer.empty() && std::ranges::mismatch (outer, inner).in1 == outer.end();
}

/// True for a place where a file would become a plugin, a profile, the session or a setting.
bool isReadByTactus (const fs::path& file)
{
    auto folders = usedPluginFolders();
    for (const auto& more : { homeFolder(), hid::ownProfileFolder(), hid::profileFolder() })
        if (! more.empty()) folders.push_back (more);
    return std::ranges::any_of (folders, [&] (const auto& folder) { return isWithin (file, folder); });
}

class Carrier
{
public:
    Carrier (fs::path f, fs::path t, const std::optional<std::vector<fs::path>>& o, const std::vector<fs::path>& a)
        : from (std::move (f)), to (std::move (t)), only (o), agreed (a)
    {
    }

    void carry (graph::Graph& g)
    {
        carry (g, g.root);
        for (auto& [name, patch] : g.graphs)
            carry (g, patch);
        for (auto& [role, description] : g.devices)
            carryTraces (description);
    }

    std::vector<CarriedFile> files;
    std::vector<fs::path> elsewhere;

private:
    const fs::path from, to;   // folders
    fs::path below;            // both: the folder of an included graph
    const std::optional<std::vector<fs::path>>& only;
    const std::vector<fs::path>& agreed;   // files elsewhere

    void carry (const graph::Graph& g, graph::Patch& patch)
    {
        for (auto& node : patch.nodes)
        {
            if (node.type.starts_with ("file:"))
            {
                const auto written = node.type.substr (5);
                const auto inner = g.files.find (written);
                node.type = "file:" + carriedGraph (written, inner == g.files.end() ? nullptr : inner->second.get());
            }
            else if (const auto* type = catalogue().find (node.type))
            {
                for (const auto& sheet : type->settings)
                    if (const auto value = node.settings.find (sheet.id); value != node.settings.end()) carry (*value, sheet);
            }
            else
                leave (node.settings);
        }
    }

    void carry (Json& value, const SettingSheet& sheet)
    {
        const auto inRecord = [&] (Json& record) {
            for (const auto& f : sheet.fields)
                if (const auto field = record.find (f.id); field != record.end()) carry (*field, f);
        };
        switch (sheet.kind)
        {
        case Kind::signal:
        case Kind::image:
        case Kind::table:
            return carryFile (value, sheet.kind);
        case Kind::surface:
            if (const auto mesh = value.find ("mesh"); mesh != value.end()) carryFile (*mesh, sheet.kind);
            return;
        case Kind::record:
            return inRecord (value);
        case Kind::records:
            if (value.is_array()) std::ranges::for_each (value, inRecord);
            return;
        default:
            return;
        }
    }

    void carryFile (Json& value, Kind kind)
    {
        if (! value.is_string()) return;
        const auto fits = [&] (const fs::path& file) {
            if (! hasExtensionOf (file, patternsOf (kind))) return false;
            return ! hasExtensionOf (file, "*.json") || FileAssets().table (file.string()).has_value();   // many programs read such files
        };
        value = carried (value.asString(), fits);
    }

    /// The name of a gesture has no point and no slash.
    void carryTraces (Json& description)
    {
        if (! description.is_object()) return;
        const auto carryPath = [&] (Json& in) {
            const auto path = in.find ("path");
            if (path == in.end() || ! path->is_string() || path->asString().find_first_of ("./\\") == std::string::npos) return;
            *path = carried (path->asString(), [] (const fs::path& file) { return hasExtensionOf (file, traces); });
        };
        if (description.value ("driver", std::string()) == "trace") carryPath (description);
        if (const auto hand = description.find ("hand"); hand != description.end()) carryPath (*hand);
    }

    /// The settings of a plugin that is not here, whose kinds are unknown: a text may be the path of a file.
    void leave (Json& value)
    {
        std::error_code ignored;
        if (value.is_string())
        {
            if (fs::is_regular_file (from / below / value.asString(), ignored)) value = placeOf (value.asString());
        }
        else if (value.is_structured())
            for (auto& part : value)
                leave (part);
    }

    /// The path with which the copy of the graph finds a file where it is.
    std::string placeOf (const fs::path& name) const
    {
        if (name.empty() || from.empty() || name.has_root_path() || name.native().find ('\0') != name.native().npos) return name.string();
        std::error_code failed;
        const auto file = from / below / name;
        const auto folder = fs::weakly_canonical (file.parent_path(), failed);   // behind a link, ".." leads to the folder that it leads into
        return failed ? name.string() : pathFrom (folder / file.filename(), (to / below).string());
    }

    bool mayGoAlong (const fs::path& name) const
    {
        const auto whole = below / name, folder = whole.parent_path();
        return ! from.empty() && std::ranges::none_of (whole, isHidden) && hasOnlyFolders (from, folder) && isFile (from / whole) && hasOnlyFolders (to, folder)
               && ! isReadByTactus (to / whole);
    }

    /// The path of a file as the copy of the graph has to say it.
    template <typename Fits>
    std::string carried (const std::string& named, const Fits& fits)
    {
        const auto stays = placeOf (named);
        const auto name = fs::path (named).lexically_normal();
        if (! isPlain (named) || ! mayGoAlong (name)) return carriedFromElsewhere (named, fits).value_or (stays);
        return fits (from / below / name) ? copied (name, from / below / name, {}).value_or (stays) : stays;
    }

    /// The name of the copy of a file in another folder; empty if it is not agreed that the file goes along.
    template <typename Fits>
    std::optional<std::string> carriedFromElsewhere (const fs::path& named, const Fits& fits)
    {
        const bool has_place = named.is_absolute() || ! from.empty();
        if (named.empty() || ! has_place || named.native().find ('\0') != named.native().npos) return {};
        std::error_code failed;
        const auto file = fs::canonical (from / below / named, failed);
        if (failed || std::ranges::any_of (file, isHidden) || ! isFile (file) || ! fits (file)) return {};
        if (std::ranges::count (elsewhere, file) == 0) elsewhere.push_back (file);
        if (std::ranges::count (agreed, file) == 0) return {};
        return copied ("assets" / file.filename(), file, {});
    }

    std::string carriedGraph (const std::string& named, const graph::Graph* loaded)
    {
        const auto stays = placeOf (named);
        const auto name = fs::path (named).lexically_normal();
        if (loaded == nullptr || ! isPlain (named) || ! hasExtensionOf (name, "*.json") || ! mayGoAlong (name)) return stays;
        const auto before = files;
        auto inner = *loaded;
        const auto outside = std::exchange (below, below / name.parent_path());
        carry (inner);
        below = outside;
        auto text = writeGraph (inner);
        const auto now = readFile (from / below / name);
        const bool is_same = now && text == writeGraph (readGraph (*now).graph);   // also says that the file still is this graph
        if (auto copy = copied (name, from / below / name, is_same ? std::nullopt : std::optional (std::move (text)))) return *copy;
        files = before;
        return stays;
    }

    /// True if no part of the path leads up, so that it stays below the folder.
    static bool isPlain (const fs::path& name)
    {
        return ! name.empty() && ! name.has_root_path() && name.native().find ('\0') == name.native().npos && name.has_filename()
               && std::ranges::none_of (name, [] (const fs::path& part) { return part == ".."; });
    }

    /// The name of the copy, beside what is there; empty if there is none, or if it is not wanted.
    std::optional<std::string> copied (const fs::path& name, const fs::path& source, const std::optional<std::string>& text)
    {
        const auto bytes = text ? Result<std::string> (*text) : readFile (source);
        if (! bytes) return std::nullopt;
        auto copy = name;
        for (int i = 2; i <= most_names; ++i)
        {
            const auto whole = below / copy, target = to / whole;
            const auto planned = std::ranges::find (files, whole, &CarriedFile::name);
            if (planned != files.end())
            {
                if (planned->from == source && planned->text == text) return copy.string();
            }
            else if (! isThere (target))
            {
                if (only && std::ranges::count (*only, whole) == 0) return std::nullopt;
                files.push_back ({ whole, source, text });
                return copy.string();
            }
            else if (const auto there = readFile (target); isFile (target) && there && *there == *bytes)
                return copy.string();
            copy = name.parent_path() / (name.stem().string() + "_" + std::to_string (i) + name.extension().string());
        }
        return std::nullopt;
    }
};
}   // namespace

CarriedGraph carriedTo (const fs::path& folder, const graph::Graph& g, const std::optional<std::vector<fs::path>>& only,
                        const std::vector<fs::path>& from_elsewhere)
{
    CarriedGraph made { g, {}, {} };
    std::error_code error;
    beginReading();
    if (! g.folder.empty() && fs::equivalent (g.folder, folder, error)) return made;
    Carrier carrier (g.folder, folder, only, from_elsewhere);
    carrier.carry (made.graph);
    made.files = std::move (carrier.files);
    made.elsewhere = std::move (carrier.elsewhere);
    return made;
}

Result<> copyInto (const fs::path& folder, const std::vector<CarriedFile>& files)
{
    beginReading();
    for (const auto& [name, from, text] : files)
    {
        const auto bytes = text ? Result<std::string> (*text) : readFile (from);
        if (! bytes) return Message::error ("save/unreadable", from.string(), "it cannot be copied: " + bytes.error().text, "leave the file where it is");
        if (! hasOnlyFolders (folder, name.parent_path()) || isThere (folder / name))
            return Message::error ("save/in_the_way", (folder / name).string(), "something else has appeared here", "save again");
        if (auto written = writeTextFile (folder / name, *bytes); ! written) return written;
    }
    return {};
}

}   // namespace tactus::host
