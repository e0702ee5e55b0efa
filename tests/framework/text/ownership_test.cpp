// SPDX-License-Identifier: MIT
#include <tactus/text/ownership.hpp>

#include "support/other_user.hpp"
#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <sys/stat.h>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
constexpr auto sticky = fs::perms::all | fs::perms::sticky_bit;

bool contains (const std::string& text, const std::string& words) { return text.find (words) != std::string::npos; }
}   // namespace

TEST_CASE ("what only this user and root can change is told from what others can change, on the whole way to it", "[ownership]")
{
    const TemporaryFolder folder;
    fs::create_directories (folder / "a/b");
    folder.write ("a/b/file", "text");
    const auto file = folder / "a/b/file";
    CHECK (whoElseCanChange (file).empty());
    CHECK (whoElseCanChange (folder / "a/b/").empty());
    CHECK (whoElseCanChange (folder / "a/../a/./b/not_yet").empty());
    CHECK (whoElseCanChange (folder / "none/of/these").empty());

    fs::permissions (file, fs::perms::others_write, fs::perm_options::add);
    CHECK (contains (whoElseCanChange (file), "every user may write to the file"));
    fs::permissions (file, fs::perms::others_write, fs::perm_options::remove);

    fs::permissions (folder / "a", fs::perms::all);
    CHECK (contains (whoElseCanChange (file), "every user may write to the folder '" + (folder / "a").string() + "'"));
    CHECK_FALSE (whoElseCanChange (folder / "a/not_yet").empty());
    fs::permissions (folder / "a", sticky);   // as /tmp
    CHECK (whoElseCanChange (file).empty());
    CHECK (whoElseCanChange (folder / "a/not_yet").empty());
    CHECK_FALSE (whoElseCanChange (folder / "a").empty());   // others could put files there
    CHECK_FALSE (whoElseCanChange (folder / "a/.").empty());
}

TEST_CASE ("links count, and so does everything on the way to where they lead", "[ownership]")
{
    const TemporaryFolder folder;
    fs::create_directories (folder / "open/inner");
    fs::create_directories (folder / "closed");
    fs::create_symlink (folder / "open/inner", folder / "closed/absolute");
    fs::create_symlink ("../open/inner/file", folder / "closed/relative");
    fs::create_symlink ("circle", folder / "closed/circle");
    folder.write ("open/inner/file", "text");
    for (const auto* way : { "closed/absolute", "closed/absolute/file", "closed/relative" })
    {
        INFO (way);
        fs::permissions (folder / "open", fs::perms::owner_all);
        CHECK (whoElseCanChange (folder / way).empty());
        fs::permissions (folder / "open", fs::perms::all);
        CHECK (contains (whoElseCanChange (folder / way), "open"));
    }
    CHECK_FALSE (whoElseCanChange (folder / "closed/circle").empty());
}

TEST_CASE ("what belongs to another user can be changed by that user", "[ownership]")
{
    const TemporaryFolder folder;
    fs::create_directories (folder / "a/b");
    folder.write ("a/b/file", "text");
    fs::create_symlink ("a/b/file", folder / "link");
    CHECK (whoElseOwns (folder / "link").empty());
    if (! test::giveAway (folder / "link")) return;
    CHECK (contains (whoElseOwns (folder / "link"), "the link"));
    CHECK (contains (whoElseCanChange (folder / "link"), "belongs to the user nobody"));

    CHECK (test::giveAway (folder / "a"));
    CHECK (contains (whoElseCanChange (folder / "a/b/file"), "the folder '" + (folder / "a").string() + "' belongs to the user nobody"));
    const auto opened = TrustedFile::open (folder / "a/b/file");   // the file itself is this user's
    REQUIRE (opened);
    CHECK (opened->path().starts_with ("/proc/self/fd/"));

    CHECK (test::giveAway (folder / "a/b/file"));
    const auto refused = TrustedFile::open (folder / "a/b/file");
    REQUIRE_FALSE (refused);
    CHECK (refused.error().id == "file/foreign");
}

TEST_CASE ("a chain of links is this user's only if every link is", "[ownership]")
{
    const TemporaryFolder folder;
    fs::create_directory (folder / "inner");
    folder.write ("inner/file", "text");
    fs::create_symlink ("inner/second", folder / "first");
    fs::create_symlink ("third", folder / "inner/second");
    fs::create_symlink ("file", folder / "inner/third");
    fs::create_symlink ("circle", folder / "circle");
    for (const auto* path : { "first", "inner/file", "none", "circle" })
        CHECK (whoElseLinks (folder / path).empty());
    if (! test::giveAway (folder / "inner/third")) return;
    CHECK (contains (whoElseLinks (folder / "first"), "the link '" + (folder / "inner/third").string() + "'"));
}

TEST_CASE ("only a regular file that nobody else may write to is trusted, and a pipe does not block", "[ownership]")
{
    const TemporaryFolder folder;
    folder.write ("file", "text");
    const auto opened = TrustedFile::open (folder / "file");
    REQUIRE (opened);
    CHECK (opened->path() == (folder / "file").string());

    fs::permissions (folder / "file", fs::perms::others_write, fs::perm_options::add);
    CHECK (TrustedFile::open (folder / "file").error().id == "file/foreign");
    REQUIRE (::mkfifo ((folder / "pipe").c_str(), 0600) == 0);
    for (const auto* name : { "pipe", "none", "." })
        CHECK (TrustedFile::open (folder / name).error().id == "file/unreadable");
}
