// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace tactus
{

/// A file that only one holder may lock, in this process or another. The system releases it when the process ends,
/// for whatever reason, so a process that gets the lock knows that there is no other holder. [main thread]
class FileLock
{
public:
    /// True if the system itself keeps a file that is open from being locked or removed.
#if defined(_WIN32)
    static constexpr bool open_is_locked = true;
#else
    static constexpr bool open_is_locked = false;
#endif

    /// Creates the file if necessary. Empty if it is locked or cannot be created.
    static std::optional<FileLock> take (const std::filesystem::path&);

    /// The same for an existing file, such as a device file; never creates it.
    static std::optional<FileLock> takeExisting (const std::filesystem::path&);

    FileLock (FileLock&&) noexcept;
    FileLock& operator= (FileLock&&) noexcept;
    ~FileLock();

private:
    static std::optional<FileLock> takeOpened (const std::filesystem::path&, bool make);
    explicit FileLock (std::intptr_t h) noexcept : handle (h) {}
    void release() noexcept;

    static constexpr std::intptr_t none = -1;
    std::intptr_t handle = none;
    long owner = 0;   // the process that took it: the lock is not that of a child that it forks
};

}   // namespace tactus
