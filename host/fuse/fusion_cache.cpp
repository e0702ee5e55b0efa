// SPDX-License-Identifier: GPL-3.0-or-later
#include "fusion_cache.hpp"

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

/// True if the folder exists, and only this user can write to it.
bool isPrivate (const fs::path& folder)
{
    std::error_code failed;
    const auto status = fs::status (folder, failed);
    return ! failed && fs::is_directory (status) && (status.permissions() & (fs::perms::group_write | fs::perms::others_write)) == fs::perms::none;
}

bool makePrivate (const fs::path& folder)
{
    std::error_code failed;
    if (fs::create_directories (folder, failed)) fs::permissions (folder, fs::perms::owner_all, failed);
    return isPrivate (folder);
}

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

std::optional<fs::path> FusionCache::find (const std::string& key) const
{
    std::error_code unseen;
    auto kept = folder / (key + ".so");
    if (folder.empty() || ! isPrivate (folder) || ! fs::exists (kept, unseen)) return std::nullopt;
    fs::last_write_time (kept, fs::file_time_type::clock::now(), unseen);   // the oldest are removed first
    return kept;
}

fs::path FusionCache::keep (const fs::path& object, const std::string& key, const std::string& unique) const
{
    if (folder.empty() || ! makePrivate (folder)) return object;
    std::error_code failed;
    const auto kept = folder / (key + ".so"), part = folder / (key + "." + unique);
    fs::copy_file (object, part, fs::copy_options::overwrite_existing, failed);
    if (! failed) fs::rename (part, kept, failed);   // atomic, so that no other program sees half a file
    std::error_code ignored;
    if (failed) fs::remove (part, ignored);
    removeOldest (folder);
    return failed ? object : kept;
}

}   // namespace tactus::host
