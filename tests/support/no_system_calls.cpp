// SPDX-License-Identifier: MIT
#include "no_system_calls.hpp"

#include <cstdio>

#include <sys/wait.h>
#include <unistd.h>

namespace tactus::test
{

ChildEnd inChild (const std::function<int()>& run)
{
    std::fflush (nullptr);   // otherwise buffered output would be written twice
    const auto child = fork();
    if (child < 0) return {};
    if (child == 0) _exit (run());
    int status = 0;
    if (waitpid (child, &status, 0) != child) return {};
    return { WIFEXITED (status) ? WEXITSTATUS (status) : -1, WIFSIGNALED (status) ? WTERMSIG (status) : 0 };
}

}   // namespace tactus::test
