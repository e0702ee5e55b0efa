// SPDX-License-Identifier: MIT
#include "no_system_calls.hpp"

#include <cstdio>

#if ! defined(_WIN32)
#include <sys/wait.h>
#include <unistd.h>
#endif

namespace tactus::test
{

#if defined(_WIN32)
ChildEnd inChild (const std::function<int()>&)
{
    return {};
}   // there is no fork
#else

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
#endif

}   // namespace tactus::test
