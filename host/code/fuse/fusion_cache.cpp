// SPDX-License-Identifier: MIT
#include "fusion_cache.hpp"

#include <host/base/platform/private_folder.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/ownership.hpp>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <utility>
#include <vector>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
constexpr std::size_t most_kept = 64;   // objects in the cache, of about 100 kB each

void removeOldest (const fs::path& folder)
{
    std::error_code ignored;
    std::vector<std::pair<fs::file_time_type, fs::path>> all;
    for (const auto& entry : fs::directory_iterator (folder, ignored))
        if (entry.path().extension() == ".so") all.emplace_back (entry.last_write_time (ignored), entry.path());
    if (all.size() <= most_kept) return;
    std::ranges::sort (all);
    for (std::size_t i = 0; i + most_kept < all.size(); ++i)
        fs::remove (all[i].second, ignored);
}
}   // namespace

std::string environment (const char* name)
{
    const char* value = std::getenv (name);
    return value != nullptr ? value : "";
}

void Digest::add (std::string_view text)
{
    for (const char c : text)
        for (auto& n : numbers)
            n = (n ^ static_cast<unsigned char> (c)) * 0x100000001b3u;
    for (auto& n : numbers)
        n = (n ^ 0x1ffu) * 0x100000001b3u;   // a value that is not a byte, so that the end of each text changes the result
}

std::string Digest::text() const
{
    std::array<char, 40> all {};
    std::snprintf (all.data(), all.size(), "%016llx%016llx", static_cast<unsigned long long> (numbers[0]), static_cast<unsigned long long> (numbers[1]));
    return all.data();
}

fs::path FusionCache::usualFolder()
{
    if (const auto own = environment ("TACTUS_HOME"); ! own.empty()) return fs::path (own) / "fused";
    if (const auto cache = environment ("XDG_CACHE_HOME"); ! cache.empty()) return fs::path (cache) / "tactus" / "fused";
    if (const auto home = environment ("HOME"); ! home.empty()) return fs::path (home) / ".cache" / "tactus" / "fused";
    return {};
}

FusionCache::FusionCache (fs::path f) : folder (std::move (f))
{
    if (folder.empty()) return;
    const auto is_own = needOwnFolder (folder);
    if (is_own) return;
    wrong = Message::warning ("fuse/cache", folder.string(), is_own.error().text + ", so no compiled code is kept in the cache or taken from it",
                              "remove the folder, change its owner or its permissions (chown, chmod go-w), or set XDG_CACHE_HOME (or TACTUS_HOME, if it is set) "
                              "to a folder of your own");
    folder.clear();
}

std::optional<fs::path> FusionCache::find (const std::string& key) const
{
    std::error_code unseen;
    auto kept = folder / (key + ".so");
    if (folder.empty() || ! fs::is_regular_file (fs::symlink_status (kept, unseen)) || ! whoElseCanChange (kept).empty()) return std::nullopt;
    fs::last_write_time (kept, fs::file_time_type::clock::now(), unseen);   // the oldest are removed first
    return kept;
}

fs::path FusionCache::keep (const fs::path& object, const std::string& key) const
{
    if (folder.empty()) return object;
    const auto kept = folder / (key + ".so");
    const auto bytes = readTextFile (object);
    if (! bytes || ! writeTextFile (kept, *bytes)) return object;
    std::error_code failed;
    fs::permissions (kept, fs::perms::owner_read | fs::perms::owner_write, failed);
    removeOldest (folder);
    return failed ? object : kept;
}

}   // namespace tactus::host
