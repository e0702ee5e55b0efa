// SPDX-License-Identifier: MIT
#include "folder_watch.hpp"

#include <utility>

#if defined(__linux__)
#include <cstring>
#include <set>
#include <sys/inotify.h>
#include <system_error>
#include <unistd.h>
#endif

namespace tactus::host
{

namespace fs = std::filesystem;

#if defined(__linux__)
namespace
{
constexpr int most_links = 40;   // followed to reach a file; Linux has the same limit
}
#endif

FolderWatch::~FolderWatch()
{
    close();
}

FolderWatch::FolderWatch (FolderWatch&& other) noexcept
    : queue (std::exchange (other.queue, -1)), is_told (std::exchange (other.is_told, false)), names (std::move (other.names))
{
}

FolderWatch& FolderWatch::operator= (FolderWatch&& other) noexcept
{
    std::swap (queue, other.queue);
    std::swap (is_told, other.is_told);
    std::swap (names, other.names);
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
    constexpr auto events = IN_OPEN | IN_MODIFY | IN_CLOSE | IN_ATTRIB | IN_CREATE | IN_DELETE | IN_MOVE | IN_DELETE_SELF | IN_MOVE_SELF;
    close();
    names.clear();
    queue = ::inotify_init1 (IN_NONBLOCK | IN_CLOEXEC);
    is_told = queue >= 0;
    std::set<fs::path> folders;
    for (const auto& file : files)
    {
        std::error_code failure;
        auto path = fs::absolute (file, failure);
        for (int links = 0; links < most_links; ++links)   // a link may lead to another folder, where the file is written
        {
            names[path.filename()];
            folders.insert (path.parent_path());
            const auto target = fs::read_symlink (path, failure);
            if (failure) break;
            path = path.parent_path() / target;
        }
    }
    for (const auto& folder : folders)
        is_told = is_told && ::inotify_add_watch (queue, folder.c_str(), events | IN_ONLYDIR) >= 0;
}

bool FolderWatch::poll()
{
    bool is_news = ! is_told;
    alignas (inotify_event) char bytes[4096];
    for (ssize_t got = 0; queue >= 0 && (got = ::read (queue, bytes, sizeof bytes)) > 0;)
        for (ssize_t at = 0; at < got;)
        {
            inotify_event event {};
            std::memcpy (&event, bytes + at, sizeof event);
            const char* name = event.len > 0 ? bytes + at + sizeof event : "";
            at += static_cast<ssize_t> (sizeof event + event.len);
            if (take (event.mask, name)) is_news = true;
        }
    return is_news;
}

/// Reading a file does not count as a change. The caller reads the files after each change, so it would never stop.
bool FolderWatch::take (unsigned event, const char* name)
{
    if ((event & IN_Q_OVERFLOW) != 0)
        for (auto& [file, use] : names)
            use = {};
    if ((event & (IN_DELETE_SELF | IN_MOVE_SELF | IN_IGNORED | IN_UNMOUNT)) != 0) is_told = false;   // the folder itself is gone
    if ((event & IN_Q_OVERFLOW) != 0 || ! is_told) return true;

    const auto named = names.find (name);
    if (named == names.end()) return false;
    auto& use = named->second;
    if ((event & IN_OPEN) != 0) use.is_open = true;
    if ((event & IN_MODIFY) != 0) use.is_written = use.is_open;
    if ((event & IN_CLOSE_NOWRITE) != 0 && ! use.is_written) use.is_open = false;
    if ((event & (IN_CLOSE_WRITE | IN_CREATE | IN_DELETE | IN_MOVE)) != 0) use = {};
    return (event & (IN_OPEN | IN_CLOSE_NOWRITE)) == 0;
}

#else

void FolderWatch::close() noexcept
{
}
void FolderWatch::watch (const std::vector<fs::path>&) {}
bool FolderWatch::poll() { return true; }

#endif

}   // namespace tactus::host
