// SPDX-License-Identifier: MIT
#include "support/other_user.hpp"
#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <host/base/platform/home_folder.hpp>
#include <host/base/platform/preset_folder.hpp>
#include <host/base/platform/private_folder.hpp>

#include <sys/stat.h>

#include <cstdlib>
#include <string>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
/// Sets a variable of the environment until the test ends.
class Variable
{
public:
    Variable (const char* n, const std::string& value) : name (n)
    {
        if (const char* old = std::getenv (n)) before = old;
        ::setenv (n, value.c_str(), 1);
    }
    ~Variable() { before.empty() ? ::unsetenv (name) : ::setenv (name, before.c_str(), 1); }
    Variable (const Variable&) = delete;
    Variable& operator= (const Variable&) = delete;

private:
    const char* const name;
    std::string before;
};
}   // namespace

TEST_CASE ("a home folder that another user can change is not used, and that is said", "[platform]")
{
    const TemporaryFolder folder;
    const auto home = folder / "home";
    const Variable told { "TACTUS_HOME", home.string() };
    CHECK (host::homeFolder() == home);   // it need not exist
    fs::create_directory (home);
    CHECK (host::homeFolder() == home);
    CHECK_FALSE (host::homeTrouble());

    fs::permissions (home, fs::perms::all);
    CHECK (host::homeFolder().empty());
    REQUIRE (host::homeTrouble());
    CHECK (host::homeTrouble()->id == "home/foreign");
    CHECK (host::homeTrouble()->where == home.string());
    fs::permissions (home, fs::perms::owner_all);
    if (! test::giveAway (home)) return;
    CHECK (host::homeFolder().empty());
}

TEST_CASE ("what another user puts next to a program is not taken for a part of it", "[platform]")
{
    const TemporaryFolder folder;   // as /tmp, with a build in it
    fs::permissions (folder.path(), fs::perms::all | fs::perms::sticky_bit);
    const auto program = folder / "tactus/out/bin";
    for (const auto* name : { "tactus/out/bin", "tactus/out/share", "host/devices/profiles" })
        fs::create_directories (folder / name);
    const auto place = folder / "host/devices/profiles";
    CHECK (host::shippedWith (program, { "profiles", "../../../host/devices/profiles" }) == place);
    CHECK (host::shippedWith (program, { "../share", "../../../host/devices/profiles" }) == folder / "tactus/out/share");
    const auto no_program = folder / "tactus/out/none";   // as a library that was installed without programs has it
    CHECK (host::shippedWith (no_program, { "../share" }) == folder / "tactus/out/share");

    fs::permissions (folder / "host", fs::perms::all);
    for (const auto& from : { program, no_program })
        CHECK (host::shippedWith (from, { "../../../host/devices/profiles" }).empty());
    fs::permissions (program, fs::perms::all);   // all can replace the program itself: as on file systems without permissions
    CHECK (host::shippedWith (program, { "../../../host/devices/profiles" }) == place);
    fs::permissions (program, fs::perms::owner_all);
    fs::permissions (folder / "host", fs::perms::owner_all);

    if (! test::giveAway (folder / "host")) return;
    CHECK (host::shippedWith (program, { "../../../host/devices/profiles" }).empty());
    CHECK (test::giveAway (folder.path()));   // a checkout of another user, with everything in it
    CHECK (host::shippedWith (program, { "../../../host/devices/profiles" }) == place);
}

TEST_CASE ("a folder of one's own is made so that nobody else can enter it, and is not made where another user could replace it", "[platform]")
{
    const TemporaryFolder folder;
    const auto mask = ::umask (0);
    const auto made = host::needOwnFolder (folder / "a/b");
    ::umask (mask);
    CHECK (made);
    for (const auto* name : { "a", "a/b" })
        CHECK (fs::status (folder / name).permissions() == fs::perms::owner_all);
    CHECK (host::needOwnFolder (folder / "a/b"));

    fs::create_directory (folder / "open");
    fs::permissions (folder / "open", fs::perms::all);
    const auto refused = host::needOwnFolder (folder / "open/a/b");
    REQUIRE_FALSE (refused);
    CHECK (refused.error().id == "folder/foreign");
    CHECK (fs::is_empty (folder / "open"));
    folder.write ("file", "text");
    CHECK (host::needOwnFolder (folder / "file").error().id == "folder/unwritable");
}

TEST_CASE ("temporary folders are not made where another user could replace them", "[platform]")
{
    const TemporaryFolder folder;
    const Variable told { "TMPDIR", folder.path().string() };
    const auto in = host::privateFolder ("tactus-test-private-");
    CHECK (in.parent_path() == folder.path());
    fs::remove (in);
    fs::permissions (folder.path(), fs::perms::all);
    const auto elsewhere = host::privateFolder ("tactus-test-private-");
    CHECK (elsewhere.parent_path() == "/tmp");
    fs::remove (elsewhere);
    CHECK (folder.isEmpty());
}
