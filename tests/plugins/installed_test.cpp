// SPDX-License-Identifier: MIT
#include "load.hpp"
#include "support/other_user.hpp"
#include "support/sketch.hpp"
#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <host/code/plugins/installed_plugins.hpp>
#include <host/code/plugins/live_compiler.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

using namespace tactus;
namespace fs = std::filesystem;

namespace
{
void install (const std::string& plugin, const fs::path& as) { fs::copy_file (test::pluginFile (plugin), as, fs::copy_options::overwrite_existing); }

/// The exit status of a process that loads the plugins of a folder.
int loadElsewhere (const fs::path& folder, const fs::path& marks)
{
    const auto child = ::fork();
    if (child == 0)
    {
        host::loadFolders ({ folder }, marks);
        ::_exit (0);
    }
    int status = -1;
    REQUIRE (::waitpid (child, &status, 0) == child);
    return WIFEXITED (status) ? WEXITSTATUS (status) : -1;
}
}   // namespace

TEST_CASE ("the plugins of a folder are loaded in the order of their names, and other files are ignored", "[plugins]")
{
    TemporaryFolder folder;
    install ("in_c", folder / "b.tactus");
    install ("grown", folder / "a.tactus");
    install ("throwing", folder / "c.tactus");
    std::ofstream (folder / "d.txt") << "no plugin";
    const auto loaded = host::loadFolders ({ folder.path(), folder / ".", folder / "missing" }, folder / "marks");
    REQUIRE (loaded.types.size() == 2);
    CHECK (loaded.types[0].origin == (folder / "a.tactus").string());
    CHECK (loaded.types[1].info.id == "bad.throwing");
    REQUIRE (loaded.messages.size() == 1);   // b has the same node as a
    CHECK (loaded.messages[0].id == "plugin/two_ids");
    CHECK (loaded.messages[0].text.find ("a.tactus") != std::string::npos);
    CHECK (fs::is_empty (folder / "marks"));
}

TEST_CASE ("a plugin that ends the program while it is loaded is not loaded again until it changes", "[plugins]")
{
    TemporaryFolder folder;
    const auto marks = folder / "marks";
    install ("crashing", folder / "a.tactus");
    install ("in_c", folder / "b.tactus");
    CHECK (loadElsewhere (folder.path(), marks) == 77);

    const auto loaded = host::loadFolders ({ folder.path() }, marks);
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].id == "plugin/quarantined");
    CHECK (loaded.messages[0].where == (folder / "a.tactus").string());
    CHECK (loaded.types.size() == 1);   // the other plugin is not affected

    install ("throwing", folder / "a.tactus");
    fs::last_write_time (folder / "a.tactus", fs::file_time_type::clock::now() + std::chrono::seconds (1));
    const auto again = host::loadFolders ({ folder.path() }, marks);
    CHECK (again.messages.empty());
    CHECK (again.types.size() == 2);
    CHECK (fs::is_empty (marks));
}

TEST_CASE ("a plugin that another user could have written is not loaded", "[plugins]")
{
    TemporaryFolder folder;
    install ("in_c", folder / "a.tactus");
    install ("throwing", folder / "b.tactus");
    fs::permissions (folder / "a.tactus", fs::perms::others_write, fs::perm_options::add);
    auto loaded = host::loadFolders ({ folder.path() }, folder / "marks");
    CHECK (loaded.types.size() == 1);   // the other plugin is not affected
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].id == "plugin/foreign");
    CHECK (loaded.messages[0].where == (folder / "a.tactus").string());

    fs::permissions (folder / "a.tactus", fs::perms::others_write, fs::perm_options::remove);
    CHECK (host::loadFolders ({ folder.path() }, folder / "marks").messages.empty());
    if (! test::giveAway (folder / "a.tactus")) return;
    loaded = host::loadFolders ({ folder.path() }, folder / "marks");
    REQUIRE (loaded.messages.size() == 1);
    CHECK (loaded.messages[0].id == "plugin/foreign");
}

TEST_CASE ("plugins in a folder that another user could replace are loaded from the files that were checked", "[plugins]")
{
    TemporaryFolder folder;
    const auto inner = folder / "inner";
    fs::create_directory (inner);
    install ("in_c", inner / "a.tactus");
    install ("throwing", inner / "b.tactus");
    fs::permissions (folder.path(), fs::perms::all);
    for (int i = 0; i < 3; ++i)   // the loader must not take one for the other
    {
        const auto loaded = host::loadFolders ({ inner }, {});
        INFO (host::textOf (loaded.messages));
        REQUIRE (loaded.types.size() == 2);
        CHECK (loaded.types[0].info.id == "c.twice");
        CHECK (loaded.types[1].info.id == "bad.throwing");
        CHECK (loaded.types[0].origin == (inner / "a.tactus").string());
    }
}

TEST_CASE ("code that another user could have written is not compiled while a graph runs", "[plugins]")
{
    TemporaryFolder folder;
    folder.write ("node.hpp", "TACTUS_NODE (mine::Node);");
    const auto source = host::liveHeader (folder / "node.hpp");
    REQUIRE (source);
    CHECK (source->trusted());
    fs::permissions (folder / "node.hpp", fs::perms::others_write, fs::perm_options::add);
    CHECK (source->trusted().error().id == "live/foreign");
    CHECK (host::LiveCompiler().start (*source).error().id == "live/foreign");

    folder.write ("a.tactus.build", "compiler sh\nsource " + (folder / "node.hpp").string() + "\n");
    CHECK (host::liveBuild (folder / "a.tactus"));
    fs::permissions (folder / "a.tactus.build", fs::perms::others_write, fs::perm_options::add);
    CHECK (host::liveBuild (folder / "a.tactus").error().id == "live/foreign");
}

TEST_CASE ("plugins are looked for in the folders of the command line, the environment, the user and the system", "[plugins]")
{
    const char* before = std::getenv ("TACTUS_PLUGINS");
    const std::string kept = before != nullptr ? before : "";
    ::setenv ("TACTUS_PLUGINS", "/one:/two", 1);
    const auto folders = host::pluginFolders ({ "/first" });
    if (before != nullptr)
        ::setenv ("TACTUS_PLUGINS", kept.c_str(), 1);
    else
        ::unsetenv ("TACTUS_PLUGINS");
    REQUIRE (folders.size() >= 4);
    CHECK (folders[0] == "/first");
    CHECK (folders[1] == "/one");
    CHECK (folders[2] == "/two");
    CHECK (folders.back().filename() == "plugins");

    const char* words[] = { "tactus", "play", "--plugins", "a", "graph.json", "--plugins=b", "--pluginsx=c" };
    CHECK (host::pluginFoldersIn (7, words) == std::vector<std::string> { "a", "b" });
}

TEST_CASE ("a program that has extended its catalogue with plugins exits cleanly", "[plugins]")
{
    const auto child = ::fork();
    if (child == 0)
    {
        auto loaded = loadPlugins ({ test::pluginFile ("devices") }, Catalogue {});
        extendCatalogue (std::move (loaded.types));
        std::exit (catalogue().find ("device.axis")->origin.empty() ? 1 : 0);   // runs the destructors of static objects
    }
    int status = -1;
    REQUIRE (::waitpid (child, &status, 0) == child);
    CHECK (status == 0);
}
