// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// Notices that files have been edited. What counts is their content, so that an editor may write in place or replace the
/// file by renaming another, and a file that is saved unchanged is none that was edited. A file that is not there, or
/// empty, is waited for. [main thread]
class FileWatch
{
public:
    explicit FileWatch (std::vector<std::filesystem::path> files) { watch (std::move (files)); }

    /// Goes on with these files. Those that it watched already are still compared with what they were.
    void watch (std::vector<std::filesystem::path>);

    /// True if files have other contents than when it last said so, and had the same ones at the look before: what is
    /// half written goes on changing. To be called a few times a second.
    bool look();

private:
    struct Watched
    {
        std::filesystem::path file;
        std::filesystem::file_time_type written {};
        std::uintmax_t size = 0;
        std::optional<std::string> latest;           ///< at the last look; nothing if it could not be read
        std::optional<std::string> known, pending;   ///< pending: seen once, and not known
    };

    static bool readAgain (Watched&);

    std::vector<Watched> all;
};

}   // namespace tactus::host
