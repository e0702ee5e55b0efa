// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <sys/wait.h>

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
    const int status = WIFEXITED (result) ? WEXITSTATUS (result) : -WTERMSIG (result);
    return { status, textOf (scratch.path ("out")), textOf (scratch.path ("err")) };
}

std::string testedProgram()
{
    const char* other = std::getenv ("TACTUS_TESTED_PROGRAM");
    return other != nullptr ? other : TACTUS_PROGRAM;
}

bool isOfWindows() { return std::getenv ("TACTUS_TESTED_PROGRAM") != nullptr; }

SerialLine serialLine (const Scratch& scratch)
{
    const char* known = std::getenv ("TACTUS_TESTED_LINE");
    if (isOfWindows() && known != nullptr) return { known, "COM20" };
    const auto link = scratch.path ("line");
    return { link, link };
}

std::vector<std::string> playOn (const std::string& device, const std::string& graph, const std::vector<std::string>& more)
{
    std::vector<std::string> words { "play", graph, "--device", "stylus=" + device, "--session", "off", "--osc", "off" };
    if (isOfWindows()) words.push_back ("--untried");
    words.insert (words.end(), more.begin(), more.end());
    return words;
}

std::string withSlashes (std::string text)
{
    if (isOfWindows()) std::replace (text.begin(), text.end(), '\\', '/');
    return text;
}

Ran runTactus (const std::vector<std::string>& arguments) { return runProgram (testedProgram(), arguments); }

void checkRefused (const std::vector<std::string>& arguments, int status, const std::string& words, const std::string& unwritten)
{
    const auto ran = runTactus (arguments);
    INFO (ran.err);
    CHECK (ran.status == status);
    CHECK (ran.err.find (words) != std::string::npos);
    CHECK_FALSE (fs::exists (unwritten));
}

bool sameRows (const std::string& live, const std::string& again, const std::string& said)
{
    const auto end = said.find (" ticks were not recorded");
    const auto lost = end == std::string::npos ? 0ul : std::stoul (said.substr (said.rfind (' ', end - 1)));
    const auto text = textOf (live), whole = textOf (again);
    if (lost == 0 || live.ends_with (".wav")) return lost > 0 || (! text.empty() && text == whole);
    std::istringstream rows (text), all (whole);
    std::string row, other;
    auto missing = 0ul;
    for (bool has_row = static_cast<bool> (std::getline (rows, row)); std::getline (all, other);)
        if (has_row && row == other)
            has_row = static_cast<bool> (std::getline (rows, row));
        else
            ++missing;
    WARN (lost << " ticks of a live run were lost");
    return ! rows && missing == lost;
}

std::string sharedData (const std::string& name)
{
    const auto path = fs::path (TACTUS_SHARED_DATA) / name;
    if (fs::exists (path)) return path.string();
    WARN ("skipped: " << path.string() << " does not exist");
    return "";
}

}   // namespace tactus::test
