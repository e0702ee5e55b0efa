// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// A program that runs in the background, and whose output goes to a file. [one thread]
class BackgroundProgram
{
public:
    enum class Priority
    {
        low,
        usual
    };   ///< low: beside a run, or beside other work of a person; usual: somebody waits for the result

    /// The CPU time after which the system ends each process of the program: far more than a plugin takes to compile.
    static constexpr unsigned usual_cpu_seconds = 600;

    /// Starts command[0], which is looked for in PATH; its output goes to the file `says`. Null if it cannot be started; on Windows, always.
    /// The limit on CPU time exists only on Linux. It also ends what a killed program has left behind.
    static std::unique_ptr<BackgroundProgram> start (const std::vector<std::string>& command, const std::filesystem::path& says,
                                                     unsigned cpu_seconds = usual_cpu_seconds, Priority = Priority::low);

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
