// SPDX-License-Identifier: MIT
#include "private_folder.hpp"

#include <tactus/text/ownership.hpp>

#include <system_error>
#include <vector>

#if defined(_WIN32)
#include <random>
#else
#include <stdlib.h>
#include <sys/stat.h>

#include <cerrno>
#endif

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
/// Makes one folder that only this user can enter. If it is there already, that is no error.
std::error_code makeClosed (const fs::path& folder)
{
#if defined(_WIN32)
    std::error_code failed;
    fs::create_directory (folder, failed);
    return failed;
#else
    return ::mkdir (folder.c_str(), S_IRWXU) == 0 || errno == EEXIST ? std::error_code {} : std::error_code (errno, std::generic_category());
#endif
}

fs::path makeNew (const fs::path& in, const std::string& name)
{
#if defined(_WIN32)
    std::error_code failed;
    const auto folder = in / (name + std::to_string (std::random_device {}()));
    return fs::create_directory (folder, failed) ? folder : fs::path();
#else
    auto path = (in / (name + "XXXXXX")).string();
    if (::mkdtemp (path.data()) == nullptr) return {};
    if (whoElseCanChange (path).empty()) return path;
    std::error_code ignored;
    fs::remove (path, ignored);
    return {};
#endif
}
}   // namespace

fs::path temporaryFolder()
{
    std::error_code failed;
    auto folder = fs::temp_directory_path (failed);
#if ! defined(_WIN32)
    if (failed) folder = "/tmp";
#endif
    return folder;
}

fs::path privateFolder (const std::string& name)
{
    auto folder = makeNew (temporaryFolder(), name);
#if ! defined(_WIN32)
    if (folder.empty()) folder = makeNew ("/tmp", name);
#endif
    return folder;
}

Result<> needOwnFolder (const fs::path& folder)
{
    std::error_code failed;
    std::vector<fs::path> missing;
    for (auto at = fs::absolute (folder, failed); at.has_relative_path() && ! fs::exists (at, failed); at = at.parent_path())
        missing.push_back (at);
    const auto foreign = [&folder] (std::string who) { return Message::error ("folder/foreign", folder.string(), std::move (who)); };
    if (auto who = whoElseCanChange (folder); ! who.empty()) return foreign (std::move (who));
    for (auto at = missing.rbegin(); at != missing.rend(); ++at)
        if (const auto why = makeClosed (*at)) return Message::error ("folder/unwritable", at->string(), "the folder cannot be made: " + why.message());
    if (! fs::is_directory (folder, failed)) return Message::error ("folder/unwritable", folder.string(), "it is not a folder");
    if (auto who = whoElseCanChange (folder); ! who.empty()) return foreign (std::move (who));   // another user may have been faster
    return {};
}

}   // namespace tactus::host
