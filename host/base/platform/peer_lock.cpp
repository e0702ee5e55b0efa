// SPDX-License-Identifier: MIT
#include "peer_lock.hpp"

#if defined(__linux__)
#include <arpa/inet.h>
#include <netinet/in.h>
#include <pthread.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#endif

namespace tactus::host
{

#if defined(__linux__)

namespace
{
std::array<std::atomic<int>, 64> locks {};   // a file + 1; 0: free

void release (std::atomic<int>& slot) noexcept
{
    if (const int file = slot.exchange (0) - 1; file >= 0) ::close (file);
}

/// An address without its port, such as "192.168.4.1". An IPv4 address that is written as IPv6 becomes one of IPv4.
std::string addressIn (const sockaddr_storage& where)
{
    std::array<char, INET6_ADDRSTRLEN> text {};
    if (where.ss_family == AF_INET)
        return ::inet_ntop (AF_INET, &reinterpret_cast<const sockaddr_in&> (where).sin_addr, text.data(), text.size());
    const auto& six = reinterpret_cast<const sockaddr_in6&> (where);
    if (IN6_IS_ADDR_V4MAPPED (&six.sin6_addr)) return ::inet_ntop (AF_INET, &six.sin6_addr.s6_addr[12], text.data(), text.size());
    return std::string (::inet_ntop (AF_INET6, &six.sin6_addr, text.data(), text.size())) + "%" + std::to_string (six.sin6_scope_id);
}

/// Such as "2 192.168.4.1 9750": the type of the socket, where it leads, and the port. Empty if it is not connected to an address of the internet.
std::string nameOf (int socket)
{
    sockaddr_storage here {}, there {};
    socklen_t here_size = sizeof here, there_size = sizeof there;
    int type = 0;
    socklen_t type_size = sizeof type;
    if (::getsockname (socket, reinterpret_cast<sockaddr*> (&here), &here_size) != 0
        || ::getpeername (socket, reinterpret_cast<sockaddr*> (&there), &there_size) != 0
        || ::getsockopt (socket, SOL_SOCKET, SO_TYPE, &type, &type_size) != 0 || (there.ss_family != AF_INET && there.ss_family != AF_INET6))
        return {};
    auto address = addressIn (there);
    if (address == addressIn (here) || address.starts_with ("127.")) address = "here";   // what goes to this computer comes from the same address
    const auto port = reinterpret_cast<const sockaddr_in&> (there).sin_port;             // it is at the same place for IPv6
    return std::to_string (type) + " " + address + " " + std::to_string (ntohs (port));
}
}   // namespace

std::optional<PeerLock> PeerLock::take (int connected_socket, std::string_view part)
{
    // The child of a fork must not hold the locks of its parent.
    static const int forks = ::pthread_atfork (nullptr, nullptr, [] { std::ranges::for_each (locks, release); });
    const auto peer = nameOf (connected_socket);
    if (forks != 0 || peer.empty()) return std::nullopt;

    // An abstract name: there is no file that could stay behind, or that another user could not open.
    sockaddr_un name { .sun_family = AF_UNIX, .sun_path = {} };
    const auto text = std::string (1, '\0') + "tactus " + peer + " " + std::string (part);
    const auto size = std::min (text.size(), sizeof name.sun_path);
    std::copy_n (text.begin(), size, name.sun_path);
    int file = ::socket (AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    if (file < 0) return std::nullopt;
    if (::bind (file, reinterpret_cast<const sockaddr*> (&name), static_cast<socklen_t> (offsetof (sockaddr_un, sun_path) + size)) == 0)
        for (auto& slot : locks)
            if (int none = 0; slot.compare_exchange_strong (none, file + 1)) return PeerLock (&slot);
    ::close (file);
    return std::nullopt;
}

PeerLock::~PeerLock()
{
    if (slot != nullptr) release (*slot);
}

#else

std::optional<PeerLock> PeerLock::take (int, std::string_view)
{
    return PeerLock (nullptr);
}
PeerLock::~PeerLock() = default;

#endif

}   // namespace tactus::host
