// SPDX-License-Identifier: MIT
#include "guardian.hpp"

#if defined(__linux__)
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>

namespace tactus::host::guardian
{

std::uint32_t write (int file, const FinalReports& reports, std::uint32_t which) noexcept
{
    std::uint32_t left = 0;
    const auto* at = reports.bytes.data();
    for (std::size_t i = 0; i < reports.count; at += reports.sizes[i++])
    {
        const auto it = 1u << i;
        if ((which & it) == 0) continue;
        const auto size = reports.sizes[i];
        const auto done = reports.is_feature[i] != 0 ? ::ioctl (file, HIDIOCSFEATURE (size), at) : ::write (file, at, size);
        if (done < 0 || (done < size && ::isatty (file) != 0)) left |= it;   // a tty may take only a part; a hidraw device takes all or nothing
    }
    return left;
}

bool send (int to, const FinalReports& reports, int file) noexcept
{
    FinalReports copy = reports;
    iovec part { &copy, sizeof copy };
    alignas (cmsghdr) std::array<char, CMSG_SPACE (sizeof (int))> room {};
    msghdr message {};
    message.msg_iov = &part;
    message.msg_iovlen = 1;
    if (file >= 0)
    {
        message.msg_control = room.data();
        message.msg_controllen = room.size();
        auto* const header = CMSG_FIRSTHDR (&message);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = SCM_RIGHTS;
        header->cmsg_len = CMSG_LEN (sizeof file);
        std::memcpy (CMSG_DATA (header), &file, sizeof file);
    }
    return ::sendmsg (to, &message, MSG_NOSIGNAL) == sizeof copy;
}

}   // namespace tactus::host::guardian

#endif
