// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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
    /// An empty path: nothing is kept.
    explicit FusionCache (std::filesystem::path f) : folder (std::move (f)) {}

    /// The user's cache: in TACTUS_HOME, XDG_CACHE_HOME or ~/.cache. Empty if the user's home is unknown.
    static std::filesystem::path usualFolder();

    /// The object with this key, if there is one.
    std::optional<std::filesystem::path> find (const std::string& key) const;

    /// Copies an object into the cache, and returns its new path. If that fails, the object stays where it is. `unique` is a name that no
    /// other running program uses.
    std::filesystem::path keep (const std::filesystem::path& object, const std::string& key, const std::string& unique) const;

private:
    const std::filesystem::path folder;
};

/// A variable of the environment; empty if it is not set.
std::string environment (const char* name);

}   // namespace tactus::host
