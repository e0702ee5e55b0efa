// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_nodes.hpp"

#include <host/app/text/filled.hpp>

#include <cstdio>

namespace tactus::host
{

namespace
{
/// Puts file and line into the text of each message, because the list of problems shows only locations in the graph.
Messages withPlaces (Messages messages)
{
    for (auto& m : messages)
    {
        const auto line = m.line > 0 ? ":" + std::to_string (m.line) : std::string();
        const std::filesystem::path file (m.file.empty() ? m.where : m.file);
        m.text = file.filename().string() + line + ": " + m.text;
    }
    return messages;
}
}   // namespace

LiveNodes::LiveNodes (std::vector<LiveSource> sources) : plugins (std::move (sources))
{
    if (const auto prepared = plugins.prepare(); ! prepared) said = withPlaces ({ prepared.error() });
}

bool LiveNodes::poll()
{
    const auto now = std::chrono::steady_clock::now();
    if (now - looked < std::chrono::milliseconds (25)) return false;   // code is compiled once two looks in a row find it unchanged
    looked = now;
    auto news = plugins.poll();
    if (! news) return false;
    said = withPlaces (std::move (news->messages));
    if (news->types.empty()) return false;
    earlier = catalogue();
    extendCatalogue (std::move (news->types));
    file = news->file;
    took_s = news->secondsSinceSaved();
    return true;
}

std::string LiveNodes::latest() const
{
    char took[32];
    std::snprintf (took, sizeof took, "%.1f", took_s);
    return filled (TRANS ("%1: in use %2 s after it was saved"), file.filename().string(), took).toStdString();
}

}   // namespace tactus::host
