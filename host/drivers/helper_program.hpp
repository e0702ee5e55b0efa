// SPDX-License-Identifier: MIT
#pragma once

#if defined(_WIN32)
#include "windows_helper.hpp"
#else
#include "helper_side.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>   // NOLINT: sigset_t
#include <spawn.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The program of this name, which is next to a driver, or where the driver's programs keep their plugins. Empty, with the reason, if it cannot be used.
/// `in_driver`: anything that belongs to the driver.
inline std::filesystem::path findHelper (const void* in_driver, const std::string& name, std::string& why)
{
    Dl_info self {};
    if (::dladdr (in_driver, &self) == 0 || self.dli_fname == nullptr) return why = "the driver does not know where it is", std::filesystem::path();
    std::error_code failed;
    const auto folder = std::filesystem::weakly_canonical (self.dli_fname, failed).parent_path();
    why = "the program " + name + " is not in " + folder.string() + ", next to the driver";
    for (const auto& file : { folder / name, folder / "../lib/tactus/plugins" / name })
    {
        struct stat is
        {
        };
        if (::stat (file.c_str(), &is) != 0) continue;
        if ((is.st_uid == 0 || is.st_uid == ::geteuid()) && (is.st_mode & (S_IWGRP | S_IWOTH)) == 0) return file;
        why = file.string() + " belongs to another user, or other users may write to it";
    }
    return {};
}

/// A program of a driver's own, for a library that might not end well. Each of the two learns from a pipe that the other is gone. [one thread; hasEnded()
/// and kill(): any thread, while the object lives]
class HelperProcess
{
public:
    HelperProcess() = default;
    HelperProcess (const HelperProcess&) = delete;
    HelperProcess& operator= (const HelperProcess&) = delete;

    /// The helper sees that it shall end, or else is killed.
    ~HelperProcess()
    {
        constexpr int patience = 150, nap_ms = 20;
        if (to_helper >= 0) ::close (to_helper);
        for (int naps = 0; process > 0 && ! hasEnded (nap_ms) && naps < patience; ++naps)
        {
        }
        if (process > 0 && ! hasEnded (0)) kill();
        if (process > 0) ::waitpid (process, nullptr, 0);
        if (from_helper >= 0) ::close (from_helper);
    }

    /// Starts it, in a session of its own, so that no key of the terminal reaches it. SIGTERM and SIGHUP, which a computer that shuts down sends to every
    /// program, wait until it ends: it ends with this program, after it has taken the force off. After its arguments come the numbers of its copies of
    /// `files`, of a pipe that ends with this object, and of one for its first line. Returns why that failed; empty if it runs. `in_driver`: as for
    /// findHelper().
    std::string start (const void* in_driver, const std::string& name, std::vector<std::string> arguments, std::vector<int> files, char* const* environment)
    {
        std::string why;
        const auto program = findHelper (in_driver, name, why);
        if (program.empty()) return why;
        std::array<int, 2> towards { -1, -1 }, from { -1, -1 };
        const bool has_pipes = ::pipe2 (towards.data(), O_CLOEXEC) == 0 && ::pipe2 (from.data(), O_CLOEXEC) == 0;
        const int failed = errno;
        to_helper = towards[1];
        from_helper = from[0];
        if (! has_pipes)
        {
            if (towards[0] >= 0) ::close (towards[0]);
            return "no pipes for " + name + ": " + std::generic_category().message (failed);
        }
        files.insert (files.end(), { towards[0], from[1] });
        posix_spawn_file_actions_t copies;
        posix_spawnattr_t how;
        sigset_t waiting;
        ::sigemptyset (&waiting);
        ::sigaddset (&waiting, SIGTERM);
        ::sigaddset (&waiting, SIGHUP);
        ::posix_spawn_file_actions_init (&copies);
        ::posix_spawnattr_init (&how);
        arguments.insert (arguments.begin(), name);
        int copy = *std::ranges::max_element (files);   // above all files that are copied
        for (const int each : files)
        {
            ::posix_spawn_file_actions_adddup2 (&copies, each, ++copy);
            arguments.push_back (std::to_string (copy));
        }
        std::vector<char*> texts;
        for (auto& argument : arguments)
            texts.push_back (argument.data());
        texts.push_back (nullptr);
        ::posix_spawnattr_setflags (&how, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
        ::posix_spawnattr_setsigmask (&how, &waiting);
        const int error = ::posix_spawn (&process, program.c_str(), &copies, &how, texts.data(), environment);
        if (error != 0) process = -1;
        ::posix_spawnattr_destroy (&how);
        ::posix_spawn_file_actions_destroy (&copies);
        for (const int its : { towards[0], from[1] })
            ::close (its);
        return error != 0 ? program.string() + " cannot be started: " + std::generic_category().message (error) : std::string();
    }

    /// The first line that the helper writes; empty if it dies before.
    std::optional<std::string> firstLine() const
    {
        std::string said;
        for (char byte = 0; ::read (from_helper, &byte, 1) == 1; said += byte)
            if (byte == '\n') return said;
        return std::nullopt;
    }

    bool hasEnded (int wait_ms) const { return pipeEnds (from_helper, wait_ms); }

    void kill() const
    {
        if (process > 0) ::kill (process, SIGKILL);
    }

private:
    int to_helper = -1, from_helper = -1;
    pid_t process = -1;
};

}   // namespace tactus::host
#endif
