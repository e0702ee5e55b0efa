// SPDX-License-Identifier: MIT
#include "peer_lock.hpp"
#include "home_folder.hpp"
#include "private_folder.hpp"

#if defined(__linux__)
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <pthread.h>
#include <pwd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>
#endif

namespace tactus::host
{

#if defined(__linux__)

namespace
{
constexpr std::size_t most_devices = 64;
std::array<std::atomic<int>, 2 * most_devices> locks {};   // a file + 1; 0: free

/// Enters an open file in the table. If it is full, closes the file and returns null.
std::atomic<int>* keep (int file) noexcept
{
    for (auto& slot : locks)
        if (int none = 0; slot.compare_exchange_strong (none, file + 1)) return &slot;
    ::close (file);
    return nullptr;
}

void release (std::atomic<int>& slot) noexcept
{
    if (const int file = slot.exchange (0) - 1; file >= 0) ::close (file);
}

/// An address without its port, such as "192.168.4.1". An IPv4 address that is written as IPv6 becomes one of IPv4.
std::string addressIn (const sockaddr_storage& where, bool with_scope)
{
    std::array<char, INET6_ADDRSTRLEN> text {};
    if (where.ss_family == AF_INET)
        return ::inet_ntop (AF_INET, &reinterpret_cast<const sockaddr_in&> (where).sin_addr, text.data(), text.size());
    const auto& six = reinterpret_cast<const sockaddr_in6&> (where);
    if (IN6_IS_ADDR_V4MAPPED (&six.sin6_addr)) return ::inet_ntop (AF_INET, &six.sin6_addr.s6_addr[12], text.data(), text.size());
    const std::string address = ::inet_ntop (AF_INET6, &six.sin6_addr, text.data(), text.size());
    return with_scope ? address + "%" + std::to_string (six.sin6_scope_id) : address;
}

/// Such as "192.168.4.1 9750": where a socket leads.
std::string nameOf (const sockaddr_storage& here, const sockaddr_storage& there, bool with_scope)
{
    auto address = addressIn (there, with_scope);
    if (address == addressIn (here, with_scope) || address.starts_with ("127.")) address = "here";   // what goes to this computer comes from the same address
    const auto port = reinterpret_cast<const sockaddr_in&> (there).sin_port;                         // it is at the same place for IPv6
    return address + " " + std::to_string (ntohs (port));
}

/// The device at the far end of a socket.
struct Peer
{
    std::string name;       // such as "2 192.168.4.1 9750", with the type of the socket; empty if it is not connected to an address of the internet
    std::string unscoped;   // as the tables of the kernel have it: without the type, and without the interface of a local address
    int type = 0;
    std::string inode;   // of the socket itself

    explicit Peer (int socket)
    {
        sockaddr_storage here {}, there {};
        socklen_t here_size = sizeof here, there_size = sizeof there, type_size = sizeof type;
        struct stat file
        {
        };
        if (::getsockname (socket, reinterpret_cast<sockaddr*> (&here), &here_size) != 0
            || ::getpeername (socket, reinterpret_cast<sockaddr*> (&there), &there_size) != 0
            || ::getsockopt (socket, SOL_SOCKET, SO_TYPE, &type, &type_size) != 0 || (there.ss_family != AF_INET && there.ss_family != AF_INET6))
            return;
        if (::fstat (socket, &file) == 0) inode = std::to_string (file.st_ino);
        unscoped = nameOf (here, there, false);
        name = std::to_string (type) + " " + nameOf (here, there, true);
    }
};

/// Reads an address and a port as /proc/net/udp has them, such as 0104A8C0:2616. Words are in the order of this computer.
bool read (const std::string& text, sockaddr_storage& to)
{
    const auto colon = text.find (':');
    if (colon != 8 && colon != 32) return false;
    std::array<std::uint32_t, 4> words {};
    for (std::size_t i = 0; i < colon / 8; ++i)
        if (std::from_chars (&text[8 * i], &text[8 * i] + 8, words[i], 16).ec != std::errc()) return false;
    std::uint16_t port = 0;
    if (std::from_chars (&text[colon] + 1, text.data() + text.size(), port, 16).ec != std::errc()) return false;
    if (colon == 8)
    {
        auto& four = reinterpret_cast<sockaddr_in&> (to);
        four.sin_family = AF_INET;
        four.sin_addr.s_addr = words[0];
        four.sin_port = htons (port);
        return true;
    }
    auto& six = reinterpret_cast<sockaddr_in6&> (to);
    six.sin6_family = AF_INET6;
    std::copy_n (reinterpret_cast<const std::uint8_t*> (words.data()), 16, six.sin6_addr.s6_addr);
    six.sin6_port = htons (port);
    return true;
}

/// The users of all other sockets that are connected to the device.
std::vector<uid_t> usersOf (const Peer& peer)
{
    std::vector<uid_t> all;
    const bool streams = peer.type == SOCK_STREAM;
    for (const auto* table : { streams ? "/proc/net/tcp" : "/proc/net/udp", streams ? "/proc/net/tcp6" : "/proc/net/udp6" })
    {
        std::ifstream in (table);
        std::string line;
        std::getline (in, line);   // the names of the columns
        while (std::getline (in, line))
        {
            std::istringstream row (line);
            std::string number, local, remote, state, queues, timer, retransmitted, waited, inode;
            uid_t user = 0;
            sockaddr_storage here {}, there {};
            constexpr auto connected = "01";
            if (! (row >> number >> local >> remote >> state >> queues >> timer >> retransmitted >> user >> waited >> inode) || state != connected
                || inode == "0" || inode == peer.inode || ! read (local, here) || ! read (remote, there))
                continue;
            if (nameOf (here, there, false) == peer.unscoped) all.push_back (user);
        }
    }
    return all;
}

/// An abstract name: there is no file that could stay behind, or that another user could not open.
struct LockName
{
    sockaddr_un address { .sun_family = AF_UNIX, .sun_path = {} };
    socklen_t size = 0;

    explicit LockName (const std::string& text)
    {
        const auto bytes = std::min (text.size() + 1, sizeof address.sun_path);   // the first one is 0
        std::copy_n (text.begin(), bytes - 1, address.sun_path + 1);
        size = static_cast<socklen_t> (offsetof (sockaddr_un, sun_path) + bytes);
    }
    const sockaddr* get() const noexcept { return reinterpret_cast<const sockaddr*> (&address); }
};

/// The process that holds a lock.
struct Holder
{
    bool is_known = false;
    uid_t user = 0;
    pid_t process = 0;   // 0: unknown

    explicit Holder (const LockName& name)
    {
        const int file = ::socket (AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
        if (file < 0) return;
        ucred whose {};
        socklen_t size = sizeof whose;
        is_known = ::connect (file, name.get(), name.size) == 0 && ::getsockopt (file, SOL_SOCKET, SO_PEERCRED, &whose, &size) == 0;
        ::close (file);
        if (! is_known) return;
        user = whose.uid;
        struct stat folder
        {
        };
        if (whose.pid > 0 && ::stat (("/proc/" + std::to_string (whose.pid)).c_str(), &folder) == 0 && folder.st_uid == user) process = whose.pid;
    }

    bool isMine() const noexcept { return is_known && user == ::geteuid(); }
};

std::string nameOfUser (uid_t user)
{
    std::array<char, 1024> room {};
    passwd entry {}, *found = nullptr;
    if (::getpwuid_r (user, &entry, room.data(), room.size(), &found) == 0 && found != nullptr) return entry.pw_name;
    return std::to_string (user);
}

/// Such as " (process 1234, tactus)"; empty for this process. A process chooses its own name, so no byte of it may reach a terminal as a command.
std::string wordsFor (pid_t process)
{
    if (process == 0 || process == ::getpid()) return {};
    std::ifstream in ("/proc/" + std::to_string (process) + "/comm");
    std::string name;
    std::getline (in, name);
    std::ranges::replace_if (
        name, [] (char c) { return c < ' ' || c > '~'; }, '?');
    return " (process " + std::to_string (process) + (name.empty() ? ")" : ", " + name + ")");
}

/// One byte of the file of all locks stands for each device. The networks and the computers that share the file are part of the name. FNV-1a.
off_t byteFor (const std::string& device)
{
    std::array<char, 256> computer {}, network {};
    ::gethostname (computer.data(), computer.size() - 1);
    static_cast<void> (::readlink ("/proc/self/ns/net", network.data(), network.size() - 1) < 0);   // then all programs have the same one
    std::uint64_t hash = 14695981039346656037ull;
    for (const char c : std::string (computer.data()) + ' ' + network.data() + ' ' + device)
        hash = (hash ^ static_cast<unsigned char> (c)) * 1099511628211ull;
    return static_cast<off_t> (hash >> 1);
}

/// The lock of one device in the file of all locks of this user.
struct OwnLock
{
    int file = -1;   // -1: not locked
    bool is_taken = false;

    explicit OwnLock (const std::string& device)
    {
        const auto folder = runFolder();
        if (folder.empty() || ! needOwnFolder (folder)) return;
        file = ::open ((folder / "devices").c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, S_IRUSR | S_IWUSR);
        struct flock lock
        {
        };   // of this open file: two roles of one process exclude each other, too
        lock.l_type = F_WRLCK;
        lock.l_whence = SEEK_SET;
        lock.l_start = byteFor (device);
        lock.l_len = 1;
        if (file < 0 || ::fcntl (file, F_OFD_SETLK, &lock) == 0) return;
        is_taken = errno == EAGAIN || errno == EACCES;
        ::close (std::exchange (file, -1));
    }
};

constexpr auto own_user = "another role or another instance of Tactus is using it";

/// The reason why a lock counts; empty if it does not.
std::string whyCounts (const Holder& holder, const Peer& peer)
{
    if (holder.isMine()) return own_user + wordsFor (holder.process);
    const auto users = usersOf (peer);
    const auto user = holder.is_known ? std::ranges::find (users, holder.user) : users.begin();
    if (user == users.end()) return {};
    return "the user " + nameOfUser (*user) + " is using it" + wordsFor (holder.process);
}
}   // namespace

PeerLock::Attempt PeerLock::take (int connected_socket, std::string_view part)
{
    // The child of a fork must not hold the locks of its parent.
    static const int forks = ::pthread_atfork (nullptr, nullptr, [] { std::ranges::for_each (locks, release); });
    const Peer peer (connected_socket);
    if (forks != 0 || peer.name.empty()) return { .why = "it cannot be locked" };

    const OwnLock own (peer.name + " " + std::string (part));
    PeerLock lock;
    const auto full = [] { return Attempt { .why = "it cannot be locked: this program uses " + std::to_string (most_devices) + " devices" }; };
    if (own.file >= 0 && (lock.slots[0] = keep (own.file)) == nullptr) return full();

    std::string strangers;
    for (int number = 0; number < most_names; ++number)
    {
        const LockName name ("tactus " + (number > 0 ? std::to_string (number) + " " : "") + peer.name + " " + std::string (part));
        const int file = ::socket (AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
        if (file < 0) return { .why = "it cannot be locked" };
        // It listens, because the kernel tells a process that connects which process listens.
        if (! own.is_taken && ::bind (file, name.get(), name.size) == 0 && ::listen (file, SOMAXCONN) == 0)
        {
            lock.slots[1] = keep (file);
            if (lock.slots[1] == nullptr) return full();
            return { std::move (lock) };
        }
        ::close (file);
        const Holder holder (name);
        if (auto why = whyCounts (holder, peer); ! why.empty()) return { .why = std::move (why) };
        if (number == 0 && holder.is_known) strangers = " by the user " + nameOfUser (holder.user) + wordsFor (holder.process);
    }
    if (own.is_taken) return { .why = own_user };
    if (lock.slots[0] != nullptr) return { std::move (lock) };   // no process with a connection to the device holds a lock
    return { .why = "all names of its lock are held" + strangers + ", and there is no folder of this user for a lock in a file (set XDG_RUNTIME_DIR)" };
}

PeerLock::~PeerLock()
{
    for (auto* const slot : slots)
        if (slot != nullptr) release (*slot);
}

#else

PeerLock::Attempt PeerLock::take (int, std::string_view)
{
    return { PeerLock() };
}
PeerLock::~PeerLock() = default;

#endif

}   // namespace tactus::host
