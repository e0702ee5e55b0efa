// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/runtime/file_watch.hpp>

#include "host/cli/program.hpp"

#include <catch2/catch.hpp>

#include <filesystem>

namespace fs = std::filesystem;
using tactus::host::FileWatch;
using tactus::test::Scratch;

namespace
{
/// Looks until nothing is new any more, and counts how often something was.
int changes (FileWatch& watch)
{
    int n = 0;
    for (int i = 0; i < 4; ++i)
        n += watch.look();
    return n;
}
}   // namespace

TEST_CASE ("an edited file is noticed once, also one of the same length written at once after the last", "[watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", "a");
    FileWatch watch { { file } };
    CHECK (changes (watch) == 0);
    for (const auto* text : { "b", "c", "d", "longer" })
    {
        scratch.write ("g.json", text);
        CHECK (changes (watch) == 1);
        CHECK (changes (watch) == 0);
    }
}

TEST_CASE ("an edit within a tick of the file system's clock is noticed, though it leaves the same time and size", "[watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", "a");
    const auto written = fs::file_time_type::clock::now() + std::chrono::minutes (1);   // however slow the machine is
    fs::last_write_time (file, written);
    FileWatch watch { { file } };
    CHECK (changes (watch) == 0);
    scratch.write ("g.json", "b");
    fs::last_write_time (file, written);
    CHECK (changes (watch) == 1);
}

TEST_CASE ("a file that goes on changing is not taken yet", "[watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", "old");
    FileWatch watch { { file } };
    for (const auto* half : { "{", "{ \"a\"", "{ \"a\": 1" })
    {
        scratch.write ("g.json", half);
        CHECK_FALSE (watch.look());
    }
    scratch.write ("g.json", "{ \"a\": 1 }");
    CHECK (changes (watch) == 1);
}

TEST_CASE ("saved unchanged, or changed and changed back, is not edited", "[watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", "a");
    FileWatch watch { { file } };
    scratch.write ("g.json", "a");
    fs::last_write_time (file, fs::file_time_type::clock::now() + std::chrono::hours (1));
    CHECK (changes (watch) == 0);
    scratch.write ("g.json", "b");
    CHECK_FALSE (watch.look());
    scratch.write ("g.json", "a");
    CHECK (changes (watch) == 0);
    scratch.write ("g.json", "b");
    CHECK_FALSE (watch.look());
}

TEST_CASE ("a file may be replaced by renaming, and be away for a while", "[watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", "a");
    FileWatch watch { { file } };
    fs::rename (scratch.write ("new", "b"), file);
    CHECK (changes (watch) == 1);
    fs::remove (file);
    CHECK (changes (watch) == 0);
    scratch.write ("g.json", "b");
    CHECK (changes (watch) == 0);
    fs::remove (file);
    fs::create_directory (file);
    CHECK (changes (watch) == 0);
    fs::remove (file);
    scratch.write ("g.json", "");
    CHECK (changes (watch) == 0);
    scratch.write ("g.json", "c");
    CHECK (changes (watch) == 1);
}

TEST_CASE ("of several files any may be edited, and one that is gone does not hold up the others", "[watch]")
{
    const Scratch scratch;
    const auto a = scratch.write ("a.json", "a"), b = scratch.write ("b.json", "b");
    FileWatch watch { { a } };
    scratch.write ("a.json", "edited");
    watch.watch ({ a, b });
    CHECK (changes (watch) == 1);
    scratch.write ("b.json", "edited");
    CHECK (changes (watch) == 1);
    fs::remove (b);
    scratch.write ("a.json", "again");
    CHECK (changes (watch) == 1);
}

TEST_CASE ("an old file is not read for nothing, and still noticed when it is written", "[watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", "a");
    fs::last_write_time (file, fs::file_time_type::clock::now() - std::chrono::hours (1));
    FileWatch watch { { file } };
    CHECK (changes (watch) == 0);
    scratch.write ("g.json", "b");
    CHECK (changes (watch) == 1);
}
