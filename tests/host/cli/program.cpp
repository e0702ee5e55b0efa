// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <catch2/catch.hpp>

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
/// The user's own device bindings must not affect the tests.
[[maybe_unused]] const bool has_no_home = setenv ("TACTUS_HOME", (fs::temp_directory_path() / "tactus_test_no_home").c_str(), 1) == 0;
}   // namespace

std::string Scratch::write (const std::string& name, const std::string& text) const
{
    folder.write (name, text);
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

void checkRefused (const std::vector<std::string>& arguments, int status, const std::string& words, const std::string& unwritten)
{
    const auto ran = runTactus (arguments);
    INFO (ran.err);
    CHECK (ran.status == status);
    CHECK (ran.err.find (words) != std::string::npos);
    CHECK_FALSE (fs::exists (unwritten));
}

std::string sharedData (const std::string& name)
{
    const auto path = fs::path (TACTUS_SHARED_DATA) / name;
    if (fs::exists (path)) return path.string();
    WARN ("skipped: " << path.string() << " does not exist");
    return "";
}

}   // namespace tactus::test
