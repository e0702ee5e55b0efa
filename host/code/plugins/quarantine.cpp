// SPDX-License-Identifier: MIT
#include "quarantine.hpp"

#include <host/base/platform/private_folder.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/quote.hpp>

#include <fstream>
#include <functional>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

/// Size and time of a file: another build of a plugin differs in these.
std::string stampOf (const fs::path& file)
{
    std::error_code unseen;
    const auto size = fs::file_size (file, unseen);
    const auto time = fs::last_write_time (file, unseen).time_since_epoch().count();
    return std::to_string (size) + " bytes, " + std::to_string (time);
}
}   // namespace

fs::path Quarantine::markOf (const fs::path& file) const
{
    if (folder.empty()) return {};
    std::error_code unseen;
    const auto whole = fs::weakly_canonical (file, unseen).string();
    return folder / (file.stem().string() + "-" + std::to_string (std::hash<std::string> {}(whole)) + ".loading");
}

bool Quarantine::holds (const fs::path& file) const
{
    const auto mark = markOf (file);
    if (mark.empty() || readTextFile (mark) != stampOf (file)) return false;
    return FileLock::takeExisting (mark).has_value();
}

Message Quarantine::refusal (const fs::path& file) const
{
    return Message::error ("plugin/quarantined", file.string(),
                           "the program crashed or was killed the last time it loaded this plugin, so it is not loaded again",
                           "build or install it again, or remove " + quote (markOf (file).string()));
}

Quarantine::LoadingMark::LoadingMark (const Quarantine& quarantine, const fs::path& file) : mark (quarantine.markOf (file))
{
    if (mark.empty()) return;
    if (needOwnFolder (mark.parent_path())) lock = FileLock::take (mark);
    if (lock) std::ofstream (mark) << stampOf (file);
}

Quarantine::LoadingMark::~LoadingMark()
{
    if (! lock) return;   // another program is loading the same plugin, and will remove the mark
    std::error_code unseen;
    fs::remove (mark, unseen);
}

}   // namespace tactus::host
