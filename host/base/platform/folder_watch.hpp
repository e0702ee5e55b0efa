// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <filesystem>
#include <map>
#include <vector>

namespace tactus::host
{

/// Asks the system to report when files are written, so that they need not be read again and again. It watches the folders of the
/// files, because an editor may replace a file by renaming another one. Works only on Linux (inotify), and does not notice changes that
/// another computer makes in a shared folder. [one thread]
class FolderWatch
{
public:
    FolderWatch() = default;
    ~FolderWatch();
    FolderWatch (FolderWatch&&) noexcept;
    FolderWatch& operator= (FolderWatch&&) noexcept;

    /// From now on, watches these files, and no others.
    void watch (const std::vector<std::filesystem::path>& files);

    /// True if the system reports changes of all the files. If not, look at the files themselves.
    bool isTold() const noexcept { return is_told; }

    /// True if any of the files may have been written, replaced or removed since the last call. Does not wait.
    bool poll();

    /// True if a file has been written to, but not closed yet.
    bool isWriting() const noexcept
    {
        return std::ranges::any_of (names, [] (const auto& named) { return named.second.is_open && named.second.is_written; });
    }

private:
    /// The use of a file by other programs. A program may set the time of a file, which looks like writing, without opening it.
    struct FileUse
    {
        bool is_open = false, is_written = false;
    };

    void close() noexcept;
    bool take (unsigned event, const char* name);

    int queue = -1;   // descriptor of the system's queue of events
    bool is_told = false;
    std::map<std::filesystem::path, FileUse> names;   // of the files, without their folders
};

}   // namespace tactus::host
