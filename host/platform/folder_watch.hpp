// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <set>
#include <vector>

namespace tactus::host
{

/// Learns from the system when files are written, so that they need not be looked at again and again. It watches the folders of
/// the files, because an editor may replace a file by renaming another one. Only on Linux (inotify); a change that another
/// computer makes in a shared folder is not noticed. [one thread]
class FolderWatch
{
public:
    FolderWatch() = default;
    ~FolderWatch();
    FolderWatch (FolderWatch&&) noexcept;
    FolderWatch& operator= (FolderWatch&&) noexcept;

    /// From now on, watches these files, and no others.
    void watch (const std::vector<std::filesystem::path>& files);

    /// True if the system tells about all the files. Otherwise, look at the files themselves.
    bool isTold() const noexcept { return is_told; }

    /// True if any of the files may have been written, replaced or removed since the last call. Does not wait.
    bool look();

    /// True if a file has been written to, but not closed yet.
    bool isWriting() const noexcept { return ! open.empty(); }

private:
    void close() noexcept;

    int queue = -1;   // descriptor of the system's queue of events
    bool is_told = false;
    std::set<std::filesystem::path> names;   // of the files, without their folders
    std::set<std::filesystem::path> open;    // names of the files that are being written
};

}   // namespace tactus::host
