// SPDX-License-Identifier: GPL-3.0-or-later
#include "folder_watch.hpp"

#include <utility>

#if defined(__linux__)
#include <cstring>
#include <sys/inotify.h>
#include <unistd.h>
#endif

namespace tactus::host
{

namespace fs = std::filesystem;

FolderWatch::~FolderWatch() { close(); }

FolderWatch::FolderWatch (FolderWatch&& other) noexcept
    : queue (std::exchange (other.queue, -1)), is_told (std::exchange (other.is_told, false)), names (std::move (other.names)), open (std::move (other.open))
{
}

FolderWatch& FolderWatch::operator= (FolderWatch&& other) noexcept
{
    std::swap (queue, other.queue);
    std::swap (is_told, other.is_told);
    std::swap (names, other.names);
    std::swap (open, other.open);
    return *this;
}

#if defined(__linux__)

void FolderWatch::close() noexcept
{
    if (queue >= 0) ::close (queue);
    queue = -1;
}

void FolderWatch::watch (const std::vector<fs::path>& files)
{
    constexpr auto events = IN_MODIFY | IN_CLOSE_WRITE | IN_ATTRIB | IN_CREATE | IN_DELETE | IN_MOVED_FROM | IN_MOVED_TO | IN_DELETE_SELF | IN_MOVE_SELF;
    close();
    names.clear();
    open.clear();
    queue = ::inotify_init1 (IN_NONBLOCK | IN_CLOEXEC);
    is_told = queue >= 0;
    std::set<fs::path> folders;
    for (const auto& file : files)
    {
        std::error_code failure;
        const auto target = fs::weakly_canonical (file, failure);   // a link leads to another folder, where the file is written
        for (const auto& path : { fs::absolute (file), failure ? fs::absolute (file) : target })
        {
            names.insert (path.filename());
            folders.insert (path.parent_path());
        }
    }
    for (const auto& folder : folders)
        is_told = is_told && ::inotify_add_watch (queue, folder.c_str(), events | IN_ONLYDIR) >= 0;
}

bool FolderWatch::look()
{
    bool is_news = ! is_told;
    alignas (inotify_event) char bytes[4096];
    for (ssize_t got = 0; queue >= 0 && (got = ::read (queue, bytes, sizeof bytes)) > 0;)
        for (ssize_t at = 0; at < got;)
        {
            inotify_event event {};
            std::memcpy (&event, bytes + at, sizeof event);
            const fs::path name = event.len > 0 ? bytes + at + sizeof event : "";
            at += static_cast<ssize_t> (sizeof event + event.len);
            if ((event.mask & (IN_DELETE_SELF | IN_MOVE_SELF | IN_IGNORED | IN_Q_OVERFLOW | IN_UNMOUNT)) != 0)
            {
                is_told = (event.mask & IN_Q_OVERFLOW) != 0 && is_told;   // the folder itself is gone
                is_news = true;
            }
            if (! names.contains (name)) continue;
            is_news = true;
            if ((event.mask & IN_MODIFY) != 0)
                open.insert (name);
            else
                open.erase (name);
        }
    return is_news;
}

#else

void FolderWatch::close() noexcept
{
}
void FolderWatch::watch (const std::vector<fs::path>&) {}
bool FolderWatch::look() { return true; }

#endif

}   // namespace tactus::host
