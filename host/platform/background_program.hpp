// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// A program that runs in the background with low priority, and whose output goes to a file. [main thread]
class BackgroundProgram
{
public:
    /// Starts command[0], which is looked for in PATH; its output goes to the file `says`. Null if it cannot be started; on Windows, always.
    static std::unique_ptr<BackgroundProgram> start (const std::vector<std::string>& command, const std::filesystem::path& says);

    ~BackgroundProgram();   ///< ends the program, and all that it has started
    BackgroundProgram (const BackgroundProgram&) = delete;
    BackgroundProgram& operator= (const BackgroundProgram&) = delete;

    /// Its exit status, or -1 if it did not exit by itself; empty while it runs. Does not wait.
    std::optional<int> status();

private:
    explicit BackgroundProgram (long i) noexcept : id (i) {}

    const long id;
    std::optional<int> ended;
};

}   // namespace tactus::host
