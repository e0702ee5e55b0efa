// SPDX-License-Identifier: MIT
// Folders that are written completely or not at all, and never outside of them.
#include "support/no_system_calls.hpp"
#include "support/other_user.hpp"
#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <host/base/platform/atomic_folder.hpp>

#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <vector>

using namespace tactus;
using host::AtomicFolder;
namespace fs = std::filesystem;

namespace
{
constexpr auto list = "list.txt";

/// Writes a folder with these files and their list, as an export does.
Result<> write (const fs::path& target, const std::map<std::string, std::string>& files)
{
    auto made = AtomicFolder::create (target, list);
    if (! made) return std::move (made).error();
    std::string names;
    for (const auto& [name, text] : files)
    {
        if (auto written = made->write (name, text); ! written) return written;
        names += name + "\n";
    }
    if (auto written = made->write (list, names); ! written) return written;
    if (auto kept = made->keepOthers(); ! kept) return kept;
    return made->commit();
}

/// All files below a folder, with their texts. A link counts as the text "-> where it leads".
std::map<std::string, std::string> filesIn (const TemporaryFolder& folder, const std::string& name)
{
    std::map<std::string, std::string> all;
    std::error_code none;
    for (const auto& entry : fs::recursive_directory_iterator (folder / name, none))
    {
        const auto path = entry.path().lexically_relative (folder / name).string();
        if (entry.is_symlink())
            all[path] = "-> " + fs::read_symlink (entry.path()).string();
        else if (entry.is_regular_file())
            all[path] = folder.textOf (name + "/" + path);
    }
    return all;
}

std::vector<std::string> namesIn (const fs::path& folder)
{
    std::vector<std::string> all;
    for (const auto& entry : fs::directory_iterator (folder))
        all.push_back (entry.path().filename().string());
    std::ranges::sort (all);
    return all;
}

std::string idOf (const Result<>& result) { return result ? std::string() : result.error().id; }

/// Runs this in a child process, and kills it before its system call of this number. False if the child ended before; empty if the system
/// does not let it be watched.
std::optional<bool> killedBefore (int call, const std::function<void()>& run)
{
    const auto child = ::fork();
    if (child == 0)
    {
        if (::ptrace (PTRACE_TRACEME, 0, nullptr, nullptr) != 0) ::_exit (2);
        ::raise (SIGSTOP);
        run();
        ::_exit (0);
    }
    int status = 0;
    ::waitpid (child, &status, 0);
    if (! WIFSTOPPED (status)) return std::nullopt;
    for (int stops = 0; stops < 2 * call + 1; ++stops)   // each call stops twice: when it begins and when it ends
    {
        ::ptrace (PTRACE_SYSCALL, child, nullptr, nullptr);
        if (::waitpid (child, &status, 0) != child || ! WIFSTOPPED (status)) return false;
    }
    ::kill (child, SIGKILL);
    ::waitpid (child, &status, 0);
    return true;
}
}   // namespace

TEST_CASE ("a folder is written whole, and what is next to it stays", "[platform][folder]")
{
    const TemporaryFolder folder;
    fs::create_directories (folder / "a.new/mine");
    folder.write ("a.new/mine/text", "precious");
    REQUIRE (write (folder / "a", { { "one", "1" }, { "in/two", "2" } }));
    CHECK (filesIn (folder, "a") == std::map<std::string, std::string> { { "one", "1" }, { "in/two", "2" }, { list, "in/two\none\n" } });
    CHECK (folder.textOf ("a.new/mine/text") == "precious");
    CHECK (namesIn (folder.path()) == std::vector<std::string> { "a", "a.new" });

    fs::create_directory (folder / "empty");
    CHECK (write (folder / "empty", { { "one", "1" } }));
    CHECK (write (folder / "above/it/new/", { { "one", "1" } }));
    CHECK (folder.textOf ("above/it/new/one") == "1");
}

TEST_CASE ("replacing a folder keeps what the user has put there, as it is, and removes what is no longer written", "[platform][folder]")
{
    const TemporaryFolder folder;
    REQUIRE (write (folder / "a", { { "same", "old" }, { "gone", "old" }, { "old/deep/file", "old" }, { "both/one", "old" } }));
    fs::permissions (folder / "a", fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec);
    folder.write ("a/mine", "mine");
    fs::permissions (folder / "a/mine", fs::perms::owner_all);
    folder.write ("a/both/mine", "mine");
    fs::create_directories (folder / "a/build/empty");
    folder.write ("a/build/program", "mine");
    fs::create_symlink ("/no/such/place", folder / "a/link");

    REQUIRE (write (folder / "a", { { "same", "new" }, { "both/one", "new" } }));
    CHECK (filesIn (folder, "a")
           == std::map<std::string, std::string> { { "same", "new" },
                                                   { "both/one", "new" },
                                                   { "mine", "mine" },
                                                   { "both/mine", "mine" },
                                                   { "build/program", "mine" },
                                                   { "link", "-> /no/such/place" },
                                                   { list, "both/one\nsame\n" } });
    CHECK (fs::is_directory (folder / "a/build/empty"));
    CHECK_FALSE (fs::exists (folder / "a/old"));
    CHECK (fs::status (folder / "a/mine").permissions() == fs::perms::owner_all);
    CHECK (fs::status (folder / "a").permissions() == (fs::perms::owner_all | fs::perms::group_read | fs::perms::group_exec));
    CHECK (namesIn (folder.path()) == std::vector<std::string> { "a" });
}

TEST_CASE ("no link in an earlier folder is followed, whatever its list says", "[platform][folder]")
{
    const TemporaryFolder folder;
    fs::create_directories (folder / "outside");
    folder.write ("outside/file", "precious");
    folder.write ("outside/listed", "precious");
    fs::create_directory (folder / "a");
    folder.write (std::string ("a/") + list, "file\nsub/listed\nsub/file\n../outside/file\n" + (folder / "outside/file").string() + "\n");
    fs::create_symlink ("../outside/file", folder / "a/file");
    fs::create_symlink ("../outside", folder / "a/sub");
    const auto before = filesIn (folder, "outside");

    CHECK (idOf (write (folder / "a", { { "file", "new" }, { "sub/file", "new" } })) == "output/exists");   // sub is a link, not a folder of an export
    CHECK (filesIn (folder, "outside") == before);
    CHECK (fs::is_symlink (folder / "a/sub"));

    REQUIRE (write (folder / "a", { { "file", "new" } }));
    CHECK (filesIn (folder, "outside") == before);
    CHECK (folder.textOf ("a/file") == "new");
    CHECK_FALSE (fs::is_symlink (folder / "a/file"));
    CHECK (fs::is_symlink (folder / "a/sub"));
}

TEST_CASE ("only a folder of this user is replaced, and only one that this program wrote", "[platform][folder]")
{
    const TemporaryFolder folder;
    fs::create_directory (folder / "mine");
    folder.write ("mine/text", "precious");
    folder.write ("file", "precious");
    REQUIRE (write (folder / "a", { { "one", "1" } }));
    fs::create_directory_symlink ("a", folder / "link");
    fs::create_directory (folder / "linked_list");
    fs::create_symlink ("../a/" + std::string (list), folder / "linked_list" / list);
    for (const auto* target : { "mine", "file", "link", "link/", "linked_list" })
    {
        INFO (target);
        CHECK (idOf (write (folder / target, { { "one", "new" } })) == "output/exists");
        CHECK (idOf (AtomicFolder::check (folder / target, list)) == "output/exists");
    }
    CHECK (idOf (AtomicFolder::check (folder / "a")) == "output/exists");   // nothing may be in it
    CHECK (AtomicFolder::check (folder / "a", list));
    CHECK (idOf (write ("/", {})) == "output/exists");

    folder.write ("a/two", "mine");
    CHECK (idOf (write (folder / "a", { { "one", "new" }, { "two", "new" } })) == "output/exists");
    CHECK (folder.textOf ("a/one") == "1");
    CHECK (folder.textOf ("a/two") == "mine");
    CHECK (namesIn (folder.path()) == std::vector<std::string> { "a", "file", "link", "linked_list", "mine" });

    const auto current = fs::current_path();
    fs::create_directory (folder / "a/inner");
    fs::current_path (folder / "a/inner");
    const auto refused = write (folder / "a", { { "one", "new" } });
    fs::current_path (current);
    CHECK (idOf (refused) == "output/exists");
}

TEST_CASE ("a folder that belongs to another user is not replaced", "[platform][folder]")
{
    const TemporaryFolder folder;
    fs::create_directory (folder / "empty");
    REQUIRE (write (folder / "a", { { "one", "1" } }));
    if (! test::giveAway (folder / "a") || ! test::giveAway (folder / "empty")) return;
    for (const auto* target : { "a", "empty" })
        CHECK (idOf (write (folder / target, { { "one", "2" } })) == "output/exists");
    CHECK (folder.textOf ("a/one") == "1");
}

TEST_CASE ("a full disk leaves the folder as it was, and nothing next to it", "[platform][folder]")
{
    const TemporaryFolder folder;
    REQUIRE (write (folder / "a", { { "one", "1" }, { "two", "2" } }));
    const auto before = filesIn (folder, "a");
    const auto end = test::inChild ([&] {
        std::signal (SIGXFSZ, SIG_IGN);
        const rlimit small { 100, 100 };
        ::setrlimit (RLIMIT_FSIZE, &small);
        return idOf (write (folder / "a", { { "one", "new" }, { "two", std::string (1000, 'x') } })) == "output/unwritable" ? 0 : 1;
    });
    CHECK (end.status == 0);
    CHECK (filesIn (folder, "a") == before);
    CHECK (namesIn (folder.path()) == std::vector<std::string> { "a" });
}

TEST_CASE ("a program that is killed at any moment leaves the old folder or the new one, and all files of the user", "[platform][folder]")
{
    const std::map<std::string, std::string> old_files { { "one", "old" }, { "in/two", "old" }, { "old", "old" } },
        new_files { { "one", "new" }, { "in/two", "new" } };
    const auto with = [] (std::map<std::string, std::string> files) {
        std::string names;
        for (const auto& [name, text] : files)
            names += name + "\n";
        files[list] = names;
        files["mine"] = "mine";
        files["in/mine"] = "mine";
        return files;
    };
    bool had_old = false, had_new = false;
    for (int call = 0;; ++call)
    {
        const TemporaryFolder folder;
        REQUIRE (write (folder / "a", old_files));
        folder.write ("a/mine", "mine");
        folder.write ("a/in/mine", "mine");
        const auto killed = killedBefore (call, [&] { static_cast<void> (write (folder / "a", new_files)); });
        if (! killed)
        {
            WARN ("skipped: the system does not let a process be watched");
            return;
        }
        const auto left = filesIn (folder, "a");
        INFO ("killed before system call " << call);
        REQUIRE ((left == with (old_files) || left == with (new_files)));
        (left == with (old_files) ? had_old : had_new) = true;
        if (! *killed) break;
    }
    CHECK (had_old);
    CHECK (had_new);
}
