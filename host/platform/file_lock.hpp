// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

namespace tactus::host
{

/// A file that one at a time may hold, here or in another process. The system lets go of it when the process ends, however
/// it ends: whoever gets the lock knows that nobody is left. [main thread]
class FileLock
{
public:
    /// Makes the file if need be; nothing if somebody holds it, or it cannot be made.
    static std::optional<FileLock> take (const std::filesystem::path&);

    /// The same of a file that is there, such as a device; it is never made.
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
};

}   // namespace tactus::host
