// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/message.hpp>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tactus::host
{

/// Two 64-bit hashes of some texts: FNV-1a, with two starting values.
class Digest
{
public:
    void add (std::string_view text);
    std::string text() const;

private:
    std::array<std::uint64_t, 2> numbers { 0xcbf29ce484222325u, 0x9ae16a3b2f90404fu };
};

/// Shared objects of fused code, by content, in a folder that only this user may write to. [main thread]
class FusionCache
{
public:
    /// Makes the folder if it does not exist. An empty path: nothing is kept.
    explicit FusionCache (std::filesystem::path);

    /// The user's cache: in TACTUS_HOME, XDG_CACHE_HOME or ~/.cache. Empty if the user's home is unknown.
    static std::filesystem::path usualFolder();

    /// The reason why nothing is kept or found: another user could have put code into the folder, or it cannot be made. Id: fuse/cache.
    const std::optional<Message>& trouble() const noexcept { return wrong; }

    /// The object with this key, if there is one that this user has made.
    std::optional<std::filesystem::path> find (const std::string& key) const;

    /// Copies an object into the cache, and returns its new path. If that fails, the object stays where it is.
    std::filesystem::path keep (const std::filesystem::path& object, const std::string& key) const;

private:
    std::filesystem::path folder;
    std::optional<Message> wrong;
};

/// A variable of the environment; empty if it is not set.
std::string environment (const char* name);

}   // namespace tactus::host
