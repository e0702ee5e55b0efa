// SPDX-License-Identifier: MIT
#include "forbid_system_calls.hpp"

#include <tactus/kit/sanitizers.hpp>

#include <cstddef>
#include <iterator>

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__)) && ! TACTUS_SANITIZED
#define TACTUS_SECCOMP 1
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/futex.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>
#endif

namespace tactus::examine
{

#if defined(TACTUS_SECCOMP)

bool canForbidSystemCalls() noexcept
{
    return true;
}

void forbidSystemCalls (Allow allowed) noexcept
{
#if defined(__x86_64__)
    constexpr unsigned architecture = AUDIT_ARCH_X86_64;
#else
    constexpr unsigned architecture = AUDIT_ARCH_AARCH64;
#endif
    const unsigned writing = allowed == Allow::nothing ? SYS_exit : SYS_write;
    const unsigned waking = allowed == Allow::waking_threads ? SYS_futex : writing;
    sock_filter rules[] {
        BPF_STMT (BPF_LD | BPF_W | BPF_ABS, offsetof (seccomp_data, arch)),
        BPF_JUMP (BPF_JMP | BPF_JEQ | BPF_K, architecture, 0, 8),
        BPF_STMT (BPF_LD | BPF_W | BPF_ABS, offsetof (seccomp_data, nr)),
        BPF_JUMP (BPF_JMP | BPF_JEQ | BPF_K, writing, 7, 0),
        BPF_JUMP (BPF_JMP | BPF_JEQ | BPF_K, SYS_exit, 6, 0),
        BPF_JUMP (BPF_JMP | BPF_JEQ | BPF_K, SYS_exit_group, 5, 0),
        BPF_JUMP (BPF_JMP | BPF_JEQ | BPF_K, waking, 0, 3),
        BPF_STMT (BPF_LD | BPF_W | BPF_ABS, offsetof (seccomp_data, args[1])),   // the lower half, on a little-endian machine
        BPF_STMT (BPF_ALU | BPF_AND | BPF_K, static_cast<unsigned> (FUTEX_CMD_MASK)),
        BPF_JUMP (BPF_JMP | BPF_JEQ | BPF_K, FUTEX_WAKE, 1, 0),
        BPF_STMT (BPF_RET | BPF_K, SECCOMP_RET_TRAP),
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
void forbidSystemCalls (Allow) noexcept {}

#endif

}   // namespace tactus::examine
