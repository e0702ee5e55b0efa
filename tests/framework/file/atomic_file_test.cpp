// SPDX-License-Identifier: MIT
#include <tactus/file/atomic_file.hpp>

#include "support/no_system_calls.hpp"
#include "support/other_user.hpp"
#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <cstdlib>

namespace fs = std::filesystem;
using namespace tactus;

namespace
{
/// Begins this file in a child process, which then ends without a destructor, as when it is killed.
void beginAndDie (const fs::path& target, IfKilled if_killed)
{
    const auto end = test::inChild ([&] {
        auto file = AtomicFile::create (target, if_killed);
        if (! file) return 1;
        file->stream() << "half";
        file->stream().flush();
        std::_Exit (3);
    });
    REQUIRE (end.status == 3);
}

std::size_t filesIn (const TemporaryFolder& folder) { return static_cast<std::size_t> (std::distance (fs::directory_iterator (folder.path()), {})); }
}   // namespace

TEST_CASE ("atomic file: the target changes on commit, not before", "[host][io]")
{
    const TemporaryFolder folder;
    folder.write ("out.txt", "old");

    auto file = AtomicFile::create (folder / "out.txt");
    REQUIRE (file.has_value());
    file->stream() << "new";
    file->stream().flush();
    CHECK (folder.textOf ("out.txt") == "old");

    REQUIRE (file->commit());
    CHECK (folder.textOf ("out.txt") == "new");
    CHECK (std::distance (fs::directory_iterator (folder.path()), {}) == 1);
}

TEST_CASE ("atomic file: without a commit the target is unchanged", "[host][io]")
{
    const TemporaryFolder folder;
    {
        auto file = AtomicFile::create (folder / "out.txt");
        REQUIRE (file.has_value());
        auto moved = std::move (*file);
        moved.stream() << "half";
    }
    CHECK (folder.isEmpty());
}

TEST_CASE ("atomic file: assigning to a file discards what it was writing", "[host][io]")
{
    const TemporaryFolder folder;
    auto first = AtomicFile::create (folder / "first.txt");
    auto second = AtomicFile::create (folder / "second.txt");
    REQUIRE ((first.has_value() && second.has_value()));

    *first = std::move (*second);
    first->stream() << "2";
    REQUIRE (first->commit().has_value());

    CHECK_FALSE (fs::exists (folder / "first.txt"));
    CHECK (folder.textOf ("second.txt") == "2");
    CHECK (std::distance (fs::directory_iterator (folder.path()), {}) == 1);
}

TEST_CASE ("atomic file: two writers of one target do not disturb each other", "[host][io]")
{
    const TemporaryFolder folder;
    auto one = AtomicFile::create (folder / "out.txt");
    auto other = AtomicFile::create (folder / "out.txt");
    REQUIRE ((one.has_value() && other.has_value()));
    one->stream() << "one";
    other->stream() << "other";

    REQUIRE (one->commit().has_value());
    CHECK (folder.textOf ("out.txt") == "one");
    REQUIRE (other->commit().has_value());
    CHECK (folder.textOf ("out.txt") == "other");
}

TEST_CASE ("atomic file: a target that cannot be written is refused immediately, with its path and the reason", "[host][io]")
{
    const TemporaryFolder folder;

    for (const auto& target : { folder.path(), folder / "missing/out.txt" })
    {
        const auto file = AtomicFile::create (target);
        REQUIRE_FALSE (file.has_value());
        CHECK (file.error().id == "output/unwritable");
        CHECK (file.error().where == target.string());
        CHECK_THAT (file.error().text, Catch::StartsWith ("cannot be written: "));
    }
}

TEST_CASE ("atomic file: a name that is too long is an error on commit and leaves nothing behind", "[host][io]")
{
    const TemporaryFolder folder;
    {
        auto file = AtomicFile::create (folder / std::string (300, 'x'));
        REQUIRE (file.has_value());
        CHECK (file->commit().error().id == "output/unwritable");
    }
    CHECK (folder.isEmpty());
}

TEST_CASE ("atomic file: the permissions of the old file are kept, and a link stays a link", "[host][io]")
{
    const TemporaryFolder folder;
    folder.write ("real.txt", "old");
    const auto owner_only = fs::perms::owner_read | fs::perms::owner_write;
    fs::permissions (folder / "real.txt", owner_only);
    fs::create_symlink (folder / "real.txt", folder / "link.txt");

    auto file = AtomicFile::create (folder / "link.txt");
    REQUIRE (file.has_value());
    file->stream() << "new";
    REQUIRE (file->commit());

    CHECK (fs::is_symlink (folder / "link.txt"));
    CHECK (folder.textOf ("real.txt") == "new");
    CHECK (fs::status (folder / "real.txt").permissions() == owner_only);
}

TEST_CASE ("atomic file: a link or the permissions of another user do not choose what is written", "[host][io]")
{
    const TemporaryFolder folder;
    folder.write ("precious.txt", "old");
    folder.write ("theirs.txt", "old");
    fs::permissions (folder / "theirs.txt", fs::perms::all);
    fs::create_symlink ("precious.txt", folder / "out.txt");
    fs::create_symlink ("out.txt", folder / "mine.txt");
    if (! test::giveAway (folder / "out.txt") || ! test::giveAway (folder / "theirs.txt")) return;

    for (const auto* name : { "out.txt", "mine.txt" })
    {
        const auto refused = AtomicFile::create (folder / name);
        REQUIRE_FALSE (refused.has_value());
        CHECK (refused.error().id == "output/unwritable");
        CHECK (refused.error().text.find ("the link") != std::string::npos);
    }
    CHECK (folder.textOf ("precious.txt") == "old");

    auto file = AtomicFile::create (folder / "theirs.txt");
    REQUIRE (file.has_value());
    REQUIRE (file->commit());
    CHECK ((fs::status (folder / "theirs.txt").permissions() & (fs::perms::group_write | fs::perms::others_write)) == fs::perms::none);
}

TEST_CASE ("atomic file: a device is written to, not replaced", "[host][io]")
{
    if (! fs::is_character_file ("/dev/null"))
        return;

    auto file = AtomicFile::create ("/dev/null");
    REQUIRE (file.has_value());
    file->stream() << "gone";
    CHECK (file->commit().has_value());
    CHECK (fs::is_character_file ("/dev/null"));
}

TEST_CASE ("atomic file: what a killed process leaves is removed by the next one that writes there, but no file in use and no other file", "[host][io]")
{
    const TemporaryFolder folder;
    folder.write (".tactus-notes", "mine");
    fs::create_symlink (folder / ".tactus-notes", folder / ".tactus-1-0.tmp");
    auto in_use = AtomicFile::create (folder / "in_use.txt");
    REQUIRE (in_use.has_value());
    in_use->stream() << "whole";
    beginAndDie (folder / "killed.txt", IfKilled::removed);
    CHECK (filesIn (folder) == 4);

    auto next = AtomicFile::create (folder / "next.txt");
    REQUIRE (next.has_value());
    CHECK (filesIn (folder) == 4);   // one removed, one begun
    REQUIRE (next->commit());
    REQUIRE (in_use->commit());
    CHECK (folder.textOf ("in_use.txt") == "whole");
    CHECK (folder.textOf (".tactus-notes") == "mine");
    CHECK (fs::is_symlink (folder / ".tactus-1-0.tmp"));
    CHECK (filesIn (folder) == 4);
}

TEST_CASE ("atomic file: what a killed process leaves is kept next to the target on request, and never overwritten", "[host][io]")
{
    const TemporaryFolder folder;
    const auto target = folder / "out.csv";
    beginAndDie (target, IfKilled::kept);
    CHECK (folder.textOf ("out.partial.csv") == "half");

    auto running = AtomicFile::create (target, IfKilled::kept);
    REQUIRE (running.has_value());
    CHECK (fs::exists (folder / "out.partial-2.csv"));
    beginAndDie (target, IfKilled::kept);
    CHECK (leftUnfinished (target) == std::vector<fs::path> { folder / "out.partial.csv", folder / "out.partial-3.csv" });

    running->stream() << "whole";
    REQUIRE (running->commit());
    CHECK (folder.textOf ("out.csv") == "whole");
    CHECK (folder.textOf ("out.partial.csv") == "half");
    CHECK (folder.textOf ("out.partial-3.csv") == "half");
    CHECK (filesIn (folder) == 3);
}

TEST_CASE ("atomic file: a file that would be kept after a kill is removed if it is only abandoned", "[host][io]")
{
    const TemporaryFolder folder;
    {
        auto file = AtomicFile::create (folder / "out.csv", IfKilled::kept);
        REQUIRE (file.has_value());
    }
    CHECK (folder.isEmpty());
}
