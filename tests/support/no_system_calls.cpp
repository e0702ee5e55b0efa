// SPDX-License-Identifier: MIT
#include "no_system_calls.hpp"

#include <cstddef>
#include <cstdio>
#include <iterator>

#include <sys/wait.h>
#include <unistd.h>

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__)) && ! defined(__SANITIZE_ADDRESS__) && ! defined(__SANITIZE_THREAD__)
#define TACTUS_SECCOMP 1
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#endif

namespace tactus::test
{

#if defined(TACTUS_SECCOMP)

bool canForbidSystemCalls() noexcept
{
    return true;
}

void forbidSystemCalls() noexcept
{
#if defined(__x86_64__)
    constexpr unsigned architecture = AUDIT_ARCH_X86_64;
#else
    constexpr unsigned architecture = AUDIT_ARCH_AARCH64;
#endif
    sock_filter rules[] {
        BPF_STMT (BPF_LD | BPF_W | BPF_ABS, offsetof (seccomp_data, arch)),
        BPF_JUMP (BPF_JMP | BPF_JEQ | BPF_K, architecture, 0, 4),
        BPF_STMT (BPF_LD | BPF_W | BPF_ABS, offsetof (seccomp_data, nr)),
        BPF_JUMP (BPF_JMP | BPF_JEQ | BPF_K, SYS_write, 3, 0),
        BPF_JUMP (BPF_JMP | BPF_JEQ | BPF_K, SYS_exit, 2, 0),
        BPF_JUMP (BPF_JMP | BPF_JEQ | BPF_K, SYS_exit_group, 1, 0),
        BPF_STMT (BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
        BPF_STMT (BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    };
    const sock_fprog program { static_cast<unsigned short> (std::size (rules)), rules };
    const bool installed = prctl (PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && prctl (PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
    if (! installed) _exit (125);
}

#else

bool canForbidSystemCalls() noexcept
{
    return false;
}
void forbidSystemCalls() noexcept {}

#endif

ChildEnd inChild (const std::function<int()>& run)
{
    std::fflush (nullptr);   // else it is written twice
    const auto child = fork();
    if (child < 0) return {};
    if (child == 0) _exit (run());
    int status = 0;
    if (waitpid (child, &status, 0) != child) return {};
    return { WIFEXITED (status) ? WEXITSTATUS (status) : -1, WIFSIGNALED (status) ? WTERMSIG (status) : 0 };
}

}   // namespace tactus::test
