// SPDX-License-Identifier: MIT
#include "migrate.hpp"

#include <algorithm>

namespace tactus
{
namespace
{
Message problem (std::string id, std::string text, std::string remedy)
{
    return Message::error (std::move (id), "/version", std::move (text), std::move (remedy));
}
}   // namespace

Result<> migrate (Json& file, int version, const FileFormat& format)
{
    const auto newest = std::to_string (format.version);
    if (version > format.version)
        return problem ("file/newer_version", "the file is version " + std::to_string (version) + ", but this Tactus reads only versions up to " + newest,
                        "open the file with a newer Tactus");

    for (; version < format.version; ++version)
    {
        const auto step = std::ranges::find (format.steps, version, &Migration::from);
        if (step == format.steps.end())
            return problem ("file/unknown_version", "version " + std::to_string (version) + " of the graph file does not exist",
                            "write \"version\": " + newest);
        try
        {
            step->step (file);
            file["version"] = version + 1;
        }
        catch (const JsonError& reason)
        {
            return problem ("file/migration", "the file could not be migrated from version " + std::to_string (version) + " to the next: " + reason.what(),
                            "make sure that all parts of the file conform to version " + std::to_string (version));
        }
    }
    return {};
}

}   // namespace tactus
