// SPDX-License-Identifier: MIT
#include "background_program.hpp"

#if ! defined(_WIN32)
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstring>

extern char** environ;
#endif

namespace tactus::host
{

#if defined(_WIN32)

std::unique_ptr<BackgroundProgram> BackgroundProgram::start (const std::vector<std::string>&, const std::filesystem::path&, unsigned, Priority)
{
    return nullptr;
}
BackgroundProgram::~BackgroundProgram() = default;
std::optional<int> BackgroundProgram::status() { return -1; }

#else

namespace
{
/// The environment of this program, but with messages in English: the code that reads them knows no other language.
std::vector<char*> inEnglish()
{
    static char english[] = "LC_ALL=C";
    std::vector<char*> all;
    for (char** entry = environ; *entry != nullptr; ++entry)
        if (std::strncmp (*entry, "LC_ALL=", 7) != 0) all.push_back (*entry);
    all.push_back (english);
    all.push_back (nullptr);
    return all;
}
}   // namespace

std::unique_ptr<BackgroundProgram> BackgroundProgram::start (const std::vector<std::string>& command, const std::filesystem::path& says,
                                                             [[maybe_unused]] unsigned cpu_seconds, Priority priority)
{
    auto copies = command;
    std::vector<char*> words;
    for (auto& word : copies)
        words.push_back (word.data());
    words.push_back (nullptr);

    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init (&files);
    posix_spawn_file_actions_addopen (&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen (&files, 1, says.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_adddup2 (&files, 1, 2);

    // The child gets its own process group: Ctrl-C in the terminal then ends only the run, and the group can be ended as a whole. Signals
    // that this program blocks are not blocked in the child.
    posix_spawnattr_t how;
    posix_spawnattr_init (&how);
    sigset_t none;
    sigemptyset (&none);
    posix_spawnattr_setsigmask (&how, &none);
    posix_spawnattr_setpgroup (&how, 0);
    posix_spawnattr_setflags (&how, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK);

    pid_t child = 0;
    const int refused = posix_spawnp (&child, words[0], &files, &how, words.data(), inEnglish().data());
    posix_spawnattr_destroy (&how);
    posix_spawn_file_actions_destroy (&files);
    if (refused != 0) return nullptr;
#if defined(__linux__)
    // Applies to each process that the program starts, even if this program is killed first.
    const rlimit most { cpu_seconds, cpu_seconds };
    ::prlimit (child, RLIMIT_CPU, &most, nullptr);
#endif
    constexpr int low_priority = 10;
    if (priority == Priority::low) ::setpriority (PRIO_PGRP, static_cast<id_t> (child), low_priority);
    return std::unique_ptr<BackgroundProgram> (new BackgroundProgram (child));
}

BackgroundProgram::~BackgroundProgram()
{
    if (ended) return;
    const auto child = static_cast<pid_t> (id);
    ::kill (-child, SIGKILL);
    while (::waitpid (child, nullptr, 0) < 0 && errno == EINTR)
        continue;
}

std::optional<int> BackgroundProgram::status()
{
    if (ended) return ended;
    int how = 0;
    const auto found = ::waitpid (static_cast<pid_t> (id), &how, WNOHANG);
    if (found == 0 || (found < 0 && errno == EINTR)) return std::nullopt;
    return ended = found > 0 && WIFEXITED (how) ? WEXITSTATUS (how) : -1;
}

#endif

}   // namespace tactus::host
