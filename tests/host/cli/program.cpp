// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>

#if ! defined(_WIN32)
#include <sys/wait.h>
#endif

namespace tactus::test
{

namespace fs = std::filesystem;

namespace
{
/// What somebody has bound their devices to is not to change what tests see.
[[maybe_unused]] const bool has_no_home = setenv ("TACTUS_HOME", (fs::temp_directory_path() / "tactus_test_nobody").c_str(), 1) == 0;
}   // namespace

Scratch::Scratch()
{
    static std::atomic<int> count { 0 };
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    folder = fs::temp_directory_path() / ("tactus_test_" + std::to_string (now) + "_" + std::to_string (++count));
    fs::create_directories (folder);
}

Scratch::~Scratch()
{
    std::error_code ignored;
    fs::remove_all (folder, ignored);
}

std::string Scratch::write (const std::string& name, const std::string& text) const
{
    std::ofstream (folder / name, std::ios::binary) << text;
    return path (name);
}

std::string textOf (const std::string& path)
{
    std::ostringstream text;
    text << std::ifstream (path, std::ios::binary).rdbuf();
    return text.str();
}

Ran runProgram (const std::string& program, const std::vector<std::string>& arguments)
{
    const Scratch scratch;
    std::string command = "\"" + program + "\"";
    for (const auto& a : arguments)
        command += " '" + a + "'";
    command += " > '" + scratch.path ("out") + "' 2> '" + scratch.path ("err") + "' < /dev/null";
    const int result = std::system (command.c_str());
#if defined(_WIN32)
    const int status = result;
#else
    const int status = WIFEXITED (result) ? WEXITSTATUS (result) : -WTERMSIG (result);
#endif
    return { status, textOf (scratch.path ("out")), textOf (scratch.path ("err")) };
}

Ran runTactus (const std::vector<std::string>& arguments) { return runProgram (TACTUS_PROGRAM, arguments); }

std::string sharedData (const std::string& name)
{
    const auto path = fs::path (TACTUS_SHARED_DATA) / name;
    if (fs::exists (path)) return path.string();
    WARN ("skipped: " << path.string() << " is not there");
    return "";
}

}   // namespace tactus::test
