// SPDX-License-Identifier: GPL-3.0-or-later
#include "preset_list.hpp"

#include <framework/file/graph_file.hpp>

#include <algorithm>
#include <sstream>

#include <juce_core/juce_core.h>

namespace tactus::host
{

namespace fs = std::filesystem;

std::vector<Preset> presetsIn (const fs::path& folder)
{
    std::vector<Preset> presets;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator (folder, failed))
    {
        if (entry.path().extension() != ".json") continue;
        auto loaded = loadGraph (entry.path());
        Preset p { entry.path(), loaded.graph.name, loaded.graph.about, loaded.graph.tags, {} };
        const auto error = std::ranges::find (loaded.messages, Message::Severity::error, &Message::severity);
        if (error != loaded.messages.end())
        {
            if (error->id == "file/not_a_graph") continue;
            p.problem = error->text;
        }
        if (p.name.empty()) p.name = entry.path().stem().string();
        presets.push_back (std::move (p));
    }
    std::ranges::sort (presets, {}, &Preset::name);
    return presets;
}

fs::path presetFolder()
{
    const auto told = juce::SystemStats::getEnvironmentVariable ("TACTUS_PRESETS", {});
    if (told.isNotEmpty()) return told.toStdString();
    const fs::path program = juce::File::getSpecialLocation (juce::File::currentExecutableFile).getFullPathName().toStdString();
    for (const auto* place : { "../share/tactus/graphs", "../../../graphs", "../graphs" })
        if (const auto folder = (program.parent_path() / place).lexically_normal(); fs::is_directory (folder)) return folder;
    return {};
}

std::vector<Preset> matching (const std::vector<Preset>& presets, const std::string& query)
{
    std::istringstream words { juce::String (query).toLowerCase().toStdString() };
    auto found = presets;
    for (std::string word; words >> word;)
        std::erase_if (found, [&] (const Preset& p)
                       {
            std::string all = p.name + ' ' + p.about;
            for (const auto& t : p.tags)
                all += ' ' + t;
            return ! juce::String (all).toLowerCase().contains (word); });
    return found;
}

}   // namespace tactus::host
