// SPDX-License-Identifier: MIT
#include "migrate.hpp"

#include <algorithm>

namespace tactus
{
namespace
{
Message problem (std::string id, std::string text, std::string remedy)
{
    Message m;
    m.id = std::move (id);
    m.where = "/version";
    m.text = std::move (text);
    m.remedy = std::move (remedy);
    return m;
}
}   // namespace

Messages migrate (Json& file, int version, const FileFormat& format)
{
    const auto newest = std::to_string (format.version);
    if (version > format.version)
        return { problem ("file/newer_version", "the file is of version " + std::to_string (version) + ", and this Tactus reads versions up to " + newest, "open it with a newer Tactus") };

    for (; version < format.version; ++version)
    {
        const auto step = std::ranges::find (format.steps, version, &Migration::from);
        if (step == format.steps.end())
            return { problem ("file/unknown_version", "there never was a version " + std::to_string (version) + " of the graph file", "write \"version\": " + newest) };
        try
        {
            step->step (file);
            file["version"] = version + 1;
        }
        catch (const Json::exception& reason)
        {
            return { problem ("file/migration", "the file could not be brought from version " + std::to_string (version) + " to the next: " + reason.what(), "its parts should be as version " + std::to_string (version) + " has them") };
        }
    }
    return {};
}

}   // namespace tactus
