// SPDX-License-Identifier: MIT
#include "file_watch.hpp"

#include <tactus/file/text_file.hpp>

#include <algorithm>

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
/// The content of a file; none if the file is empty, because it may have been opened but not written yet, or cannot be read.
std::optional<std::string> contentOf (const fs::path& file)
{
    auto content = readTextFile (file);
    if (content && content->empty()) content.reset();
    return content;
}
}   // namespace

void FileWatch::watch (std::vector<fs::path> files)
{
    folders.watch (files);   // before they are read, so that no edit is missed
    is_unsettled = true;
    quiet = 0;
    std::vector<WatchedFile> next;
    for (auto& file : files)
    {
        if (std::ranges::find (next, file, &WatchedFile::file) != next.end()) continue;
        const auto old = std::ranges::find (all, file, &WatchedFile::file);
        if (old != all.end())
            next.push_back (std::move (*old));
        else
        {
            next.emplace_back().file = std::move (file);
            next.back().known = contentOf (next.back().file);
        }
    }
    all = std::move (next);
}

/// Two writes within one tick of the file system's clock have the same time, so a file with a recent time is read on every look.
bool FileWatch::readAgain (WatchedFile& w)
{
    constexpr auto young = std::chrono::seconds (2);
    std::error_code failure;
    const auto written = fs::last_write_time (w.file, failure);
    const auto size = failure ? 0 : fs::file_size (w.file, failure);
    if (failure) return false;
    const bool same = w.latest && written == w.written && size == w.size && fs::file_time_type::clock::now() - written > young;
    w.written = written;
    w.size = size;
    if (! same) w.latest = contentOf (w.file);
    return w.latest.has_value();
}

/// Watches the same files again: a folder may have been made again, or a link may lead to another file.
void FileWatch::watchFolders()
{
    std::vector<fs::path> files;
    for (const auto& w : all)
        files.push_back (w.file);
    folders.watch (files);
    is_unsettled = true;   // changes in between are not reported
}

bool FileWatch::poll()
{
    if (folders.poll())
    {
        if (folders.isTold()) quiet = 0;
    }
    else if (! is_unsettled && quiet + 1 < most_quiet)
    {
        ++quiet;
        return false;
    }
    const bool is_long_quiet = ++quiet >= most_quiet;
    if (is_long_quiet) quiet = 0;
    const bool is_changed = compare (folders.isWriting() && ! is_long_quiet);
    if (is_changed || (is_long_quiet && ! folders.isTold())) watchFolders();
    return is_changed;
}

/// True if the files have changed, and no more changes come in.
bool FileWatch::compare (bool is_writing)
{
    bool changed = false, settled = ! is_writing;
    for (auto& w : all)
    {
        if (! readAgain (w)) continue;
        if (w.latest == w.known)
        {
            w.pending.reset();
            continue;
        }
        changed = true;
        if (w.latest == w.pending) continue;
        w.pending = w.latest;
        settled = false;
    }
    is_unsettled = changed && ! settled;
    if (! changed || ! settled) return false;
    for (auto& w : all)
        if (w.latest) w.known = w.latest;
    return true;
}

}   // namespace tactus::host
