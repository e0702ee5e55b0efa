// SPDX-License-Identifier: GPL-3.0-or-later
#include "preset_list.hpp"

#include <host/app/text/filled.hpp>
#include <host/app/text/find.hpp>
#include <host/base/platform/home_folder.hpp>

#include <tactus/file/graph_file.hpp>

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <string_view>

#include <juce_core/juce_core.h>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
/// Distinguishes a damaged graph from a file of a different kind.
bool claimsToBeAGraph (const fs::path& file)
{
    const auto messages = loadGraph (file).messages;
    return std::ranges::count (messages, "file/not_a_graph", &Message::id) == 0;
}
}   // namespace

Preset presetOf (const fs::path& file, const Catalogue& catalogue)
{
    const auto loaded = loadGraph (file);
    const auto& graph = loaded.graph;
    Preset p { file, graph.name, graph.about, graph.tags, {}, {}, {}, ! graph.graphs.empty() };
    const auto error = std::ranges::find (loaded.messages, Message::Severity::error, &Message::severity);
    if (error != loaded.messages.end()) p.problem = error->text;
    if (p.name.empty()) p.name = file.stem().string();
    const auto note = [&] (const graph::Patch& patch) {
        for (const auto& node : patch.nodes)
            if (! node.type.starts_with ("graph:") && ! node.type.starts_with ("file:")) p.types.insert (node.type);
    };
    note (graph.root);
    for (const auto& [name, patch] : graph.graphs)
        note (patch);
    std::ranges::copy_if (p.types, std::back_inserter (p.placeholders), [&] (const std::string& type) { return catalogue.find (type) == nullptr; });
    return p;
}

std::vector<Preset> presetsIn (const fs::path& folder, const Catalogue& catalogue)
{
    std::vector<Preset> presets;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator (folder, failed))
    {
        if (entry.path().extension() != ".json") continue;
        auto p = presetOf (entry.path(), catalogue);
        if (p.problem.empty() || claimsToBeAGraph (entry.path())) presets.push_back (std::move (p));
    }
    std::ranges::sort (presets, {}, &Preset::name);
    return presets;
}

fs::path ownFolder()
{
    const auto given = juce::SystemStats::getEnvironmentVariable ("TACTUS_GRAPHS", {});
    if (given.isNotEmpty()) return given.toStdString();
    if (const auto documents = documentsFolder(); ! documents.empty()) return documents / "Tactus";
    return juce::File::getSpecialLocation (juce::File::userDocumentsDirectory).getChildFile ("Tactus").getFullPathName().toStdString();
}

std::vector<Preset> matching (const std::vector<Preset>& presets, const std::string& query, const std::set<std::string>& tags)
{
    auto found = presets;
    std::erase_if (found, [&] (const Preset& p) {
        const auto isMissing = [&] (const std::string& t) { return std::ranges::count (p.tags, t) == 0; };
        return std::ranges::any_of (tags, isMissing);
    });
    std::vector<Findable> searched;
    for (const auto& p : found)
    {
        std::string all_tags;
        for (const auto& t : p.tags)
            all_tags += t + ' ';
        searched.push_back ({ p.name, p.file.stem().string(), std::move (all_tags), p.about + (p.has_subgraphs ? " subgraph" : "") });
    }
    std::vector<Preset> sorted;
    for (const auto i : bestMatches (searched, query))
        sorted.push_back (std::move (found[i]));
    return sorted;
}

std::vector<std::pair<std::string, int>> tagsOf (const std::vector<Preset>& presets)
{
    std::map<std::string, int> counts;
    for (const auto& p : presets)
        for (const auto& t : std::set (p.tags.begin(), p.tags.end()))
            ++counts[t];
    std::vector<std::pair<std::string, int>> all (counts.begin(), counts.end());
    std::ranges::stable_sort (all, std::greater {}, &std::pair<std::string, int>::second);
    return all;
}

std::string placeholderText (const Preset& p)
{
    if (p.placeholders.empty()) return {};
    auto text = filled (p.placeholders.size() == 1 ? TRANS ("%1 placeholder") : TRANS ("%1 placeholders"), p.placeholders.size()).toStdString() + ": ";
    for (const auto& type : p.placeholders)
        text += (&type == &p.placeholders.front() ? "" : ", ") + type;
    return text;
}

static constexpr std::string_view dragged_preset = "preset ";   // before its path

std::string asDragged (const Preset& p) { return std::string (dragged_preset) + p.file.string(); }

std::filesystem::path fileOfDragged (const std::string& dragged)
{
    return dragged.starts_with (dragged_preset) ? dragged.substr (dragged_preset.size()) : std::string();
}

}   // namespace tactus::host
