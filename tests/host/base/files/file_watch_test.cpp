// SPDX-License-Identifier: MIT
#include <host/base/files/file_watch.hpp>

#include "host/cli/program.hpp"

#include <catch2/catch.hpp>

#include <filesystem>
#include <fstream>
#include <string>

namespace fs = std::filesystem;
using tactus::host::FileWatch;
using tactus::test::Scratch;

namespace
{
/// Looks until nothing changes any longer, and counts the reported changes.
int changes (FileWatch& watch)
{
    int n = 0;
    for (int i = 0; i < 4; ++i)
        n += watch.poll();
    return n;
}
}   // namespace

TEST_CASE ("an edit is noticed once, even if it keeps the length and follows the previous edit immediately", "[watch]")
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

TEST_CASE ("an edit within one tick of the file system's clock is noticed, despite equal time and size", "[watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", "a");
    const auto written = fs::file_time_type::clock::now() + std::chrono::minutes (1);   // independent of the machine's speed
    fs::last_write_time (file, written);
    FileWatch watch { { file } };
    CHECK (changes (watch) == 0);
    scratch.write ("g.json", "b");
    fs::last_write_time (file, written);
    CHECK (changes (watch) == 1);
}

TEST_CASE ("a file that keeps changing is not reported yet", "[watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", "old");
    FileWatch watch { { file } };
    for (const auto* half : { "{", "{ \"a\"", "{ \"a\": 1" })
    {
        scratch.write ("g.json", half);
        CHECK_FALSE (watch.poll());
    }
    scratch.write ("g.json", "{ \"a\": 1 }");
    CHECK (changes (watch) == 1);
}

TEST_CASE ("saving unchanged, or changing and reverting, is not an edit", "[watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", "a");
    FileWatch watch { { file } };
    scratch.write ("g.json", "a");
    fs::last_write_time (file, fs::file_time_type::clock::now() + std::chrono::hours (1));
    CHECK (changes (watch) == 0);
    scratch.write ("g.json", "b");
    CHECK_FALSE (watch.poll());
    scratch.write ("g.json", "a");
    CHECK (changes (watch) == 0);
    scratch.write ("g.json", "b");
    CHECK_FALSE (watch.poll());
}

TEST_CASE ("a file may be replaced by renaming, and be missing for a while", "[watch]")
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

TEST_CASE ("any of several files may be edited, and a missing file does not affect the others", "[watch]")
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

#if defined(__linux__)
TEST_CASE ("the system tells which files are written, wherever they are and however they are replaced", "[watch]")
{
    const Scratch scratch;
    const auto a = scratch.write ("a.json", "a");
    fs::create_directories (fs::path (a).parent_path() / "other");
    const auto b = scratch.write ("other/b.json", "b");
    FileWatch watch { { a, b } };
    CHECK (watch.isTold());
    CHECK (changes (watch) == 0);
    scratch.write ("other/b.json", "edited");
    CHECK (changes (watch) == 1);
    fs::rename (scratch.write ("new", "renamed"), a);
    CHECK (changes (watch) == 1);
    scratch.write ("beside.json", "of no interest");
    CHECK (changes (watch) == 0);

    const auto link = fs::path (a).parent_path() / "link.json";
    fs::create_symlink (b, link);
    watch.watch ({ link });
    CHECK (changes (watch) == 0);
    scratch.write ("other/b.json", "edited through another name");
    CHECK (changes (watch) == 1);

    watch.watch ({ fs::path (a).parent_path() / "nowhere" / "c.json" });
    CHECK_FALSE (watch.isTold());   // then the files are compared at each look
}

TEST_CASE ("editors replace a file in many ways, and each is noticed without waiting", "[watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", "0");
    const auto folder = fs::path (file).parent_path();
    FileWatch watch { { file } };
    CHECK (changes (watch) == 0);
    for (int k = 1; k <= 3; ++k)
    {
        const auto text = std::to_string (k);
        scratch.write ("g.json", text);   // write it
        CHECK (changes (watch) == 1);
        fs::rename (scratch.write (".g.json.swp", text + "a"), file);   // write another one, and rename it
        CHECK (changes (watch) == 1);
        fs::rename (file, folder / "g.json~");   // keep the old one
        scratch.write ("g.json", text + "b");
        CHECK (changes (watch) == 1);
        fs::remove (file);
        CHECK (changes (watch) == 0);
        scratch.write ("g.json", text + "c");
        CHECK (changes (watch) == 1);
        std::ofstream (file, std::ios::app) << "d";
        CHECK (changes (watch) == 1);
    }
    CHECK (watch.isTold());
}

TEST_CASE ("links are followed, also when they lead to another file or through another link", "[watch]")
{
    const Scratch scratch;
    const auto folder = fs::path (scratch.write ("a.json", "a")).parent_path();
    fs::create_directories (folder / "far");
    fs::create_directories (folder / "here");
    scratch.write ("far/b.json", "b");
    fs::create_symlink (folder / "a.json", folder / "middle.json");
    fs::create_symlink ("../middle.json", folder / "here" / "link.json");
    FileWatch watch { { folder / "here" / "link.json" } };
    CHECK (watch.isTold());
    CHECK (changes (watch) == 0);
    scratch.write ("a.json", "edited");
    CHECK (changes (watch) == 1);
    fs::create_symlink ("far/b.json", folder / "new");
    fs::rename (folder / "new", folder / "middle.json");
    CHECK (changes (watch) == 1);
    CHECK (changes (watch) == 0);
    scratch.write ("far/b.json", "edited at its new place");
    CHECK (changes (watch) == 1);
}

TEST_CASE ("a folder that is deleted and made again, or renamed, is watched again", "[watch]")
{
    const Scratch scratch;
    const auto folder = fs::path (scratch.write ("beside", "")).parent_path() / "work";
    fs::create_directories (folder);
    const auto file = scratch.write ("work/g.json", "a");
    FileWatch watch { { file } };
    CHECK (changes (watch) == 0);
    fs::remove_all (folder);
    CHECK (changes (watch) == 0);
    CHECK_FALSE (watch.isTold());
    fs::create_directories (folder);
    scratch.write ("work/g.json", "b");
    CHECK (changes (watch) == 1);   // it is compared at each look
    CHECK (watch.isTold());         // and watched again

    fs::rename (folder, folder.parent_path() / "old");
    CHECK (changes (watch) == 0);
    CHECK_FALSE (watch.isTold());
    fs::create_directories (folder);
    for (int i = 0; i < FileWatch::most_quiet; ++i)
        CHECK_FALSE (watch.poll());
    CHECK (watch.isTold());
    scratch.write ("work/g.json", "c");
    CHECK (changes (watch) == 1);
}

TEST_CASE ("what the system does not tell is noticed after a while", "[watch]")
{
    const Scratch scratch;
    const auto folder = fs::path (scratch.write ("beside", "")).parent_path();
    fs::create_directories (folder / "one");
    fs::create_directories (folder / "two");
    scratch.write ("one/g.json", "a");
    scratch.write ("two/g.json", "another one");
    fs::create_directory_symlink ("one", folder / "now");
    FileWatch watch { { folder / "now" / "g.json" } };
    CHECK (changes (watch) == 0);
    fs::remove (folder / "now");
    fs::create_directory_symlink ("two", folder / "now");   // one folder above those that are watched
    int n = 0;
    for (int i = 0; i < 2 * FileWatch::most_quiet; ++i)
        n += watch.poll();
    CHECK (n == 1);
    scratch.write ("two/g.json", "edited");
    CHECK (changes (watch) == 1);
}

TEST_CASE ("a file that is still open is not reported", "[watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", "old");
    FileWatch watch { { file } };
    CHECK (changes (watch) == 0);
    {
        std::ofstream out (file);
        out << "half" << std::flush;
        CHECK (changes (watch) == 0);
        out << " whole";
    }
    CHECK (changes (watch) == 1);

    std::ofstream out (file);
    out << "by a program that never closes it" << std::flush;
    CHECK (changes (watch) == 0);
    int n = 0;
    for (int i = 0; i < 2 * FileWatch::most_quiet; ++i)
        n += watch.poll();
    CHECK (n == 1);
}
#endif

TEST_CASE ("an old file is not read repeatedly, and an edit is still noticed", "[watch]")
{
    const Scratch scratch;
    const auto file = scratch.write ("g.json", "a");
    fs::last_write_time (file, fs::file_time_type::clock::now() - std::chrono::hours (1));
    FileWatch watch { { file } };
    CHECK (changes (watch) == 0);
    scratch.write ("g.json", "b");
    CHECK (changes (watch) == 1);
}
