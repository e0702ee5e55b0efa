// SPDX-License-Identifier: MIT
// What live C++ leaves to the system: a private folder, and a limit on the compiler.
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <host/base/platform/background_program.hpp>
#include <host/base/platform/private_folder.hpp>

#include <sys/stat.h>

#include <chrono>
#include <cstdlib>

using namespace tactus;
namespace fs = std::filesystem;

TEST_CASE ("a private folder is new, and closed to others even if the user's files are open to all", "[platform]")
{
    const auto mask = ::umask (0);
    const auto a = host::privateFolder ("tactus-test-private-"), b = host::privateFolder ("tactus-test-private-");
    ::umask (mask);
    REQUIRE (fs::is_directory (a));
    REQUIRE (fs::is_directory (b));
    CHECK (a != b);
    CHECK (fs::status (a).permissions() == fs::perms::owner_all);
    CHECK (a.filename().string().starts_with ("tactus-test-private-"));
    fs::remove (a);
    fs::remove (b);
}

#if defined(__linux__)
TEST_CASE ("a program in the background that never ends is ended by the system after its CPU time", "[platform]")
{
    const TemporaryFolder folder;
    const auto program = host::BackgroundProgram::start ({ "sh", "-c", "while :; do :; done" }, folder / "says", 1);
    REQUIRE (program);
    REQUIRE (tactus::test::eventually (std::chrono::milliseconds (20), [&] { return program->status().has_value(); }));
    CHECK (program->status() == -1);
}
#endif
