// SPDX-License-Identifier: MIT
#pragma once

#include <dlfcn.h>
#include <signal.h>   // NOLINT: sigset_t
#include <spawn.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
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

/// Starts a helper, in a session of its own, so that no key of the terminal reaches it. It gets copies of `files`, whose numbers follow the arguments. Returns
/// why that failed; empty if it runs, as `process`.
inline std::string startHelper (const std::filesystem::path& file, std::vector<std::string> arguments, const std::vector<int>& files, char* const* environment,
                                pid_t& process)
{
    posix_spawn_file_actions_t copies;
    posix_spawnattr_t how;
    sigset_t none;
    ::sigemptyset (&none);
    ::posix_spawn_file_actions_init (&copies);
    ::posix_spawnattr_init (&how);
    arguments.insert (arguments.begin(), file.filename().string());
    int copy = files.empty() ? 0 : *std::ranges::max_element (files);   // above all files that are copied
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
    ::posix_spawnattr_setsigmask (&how, &none);
    pid_t started = -1;
    const int error = ::posix_spawn (&started, file.c_str(), &copies, &how, texts.data(), environment);
    ::posix_spawnattr_destroy (&how);
    ::posix_spawn_file_actions_destroy (&copies);
    if (error != 0) return file.string() + " cannot be started: " + std::generic_category().message (error);
    process = started;
    return {};
}

}   // namespace tactus::host
