// SPDX-License-Identifier: MIT
#include "wire_file.hpp"
#include "wire_address.hpp"

#include <filesystem>
#include <system_error>

#if defined(__linux__)
#include <asm/termbits.h>   // termios2, which takes any baud rate; <termios.h> must not be included with it
#include <fcntl.h>
#include <linux/serial.h>
#include <netdb.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <memory>
#endif

namespace tactus::host
{

#if defined(__linux__)

namespace
{
Message failure (const std::string& where, std::string why) { return Message::error ("device/wire", where, std::move (why)); }
Message failure (const std::string& where, int error) { return failure (where, std::generic_category().message (error)); }

/// Sets a line to raw bytes. False if it is none. `kept`: the flags of its control that stay as they are.
bool makeRaw (int file, int baud, tcflag_t kept = HUPCL) noexcept
{
    termios2 how {};
    if (::ioctl (file, TCGETS2, &how) != 0) return false;
    how.c_iflag = how.c_oflag = how.c_lflag = 0;
    how.c_cflag = CS8 | CREAD | CLOCAL | BOTHER | (how.c_cflag & kept);
    how.c_ispeed = how.c_ospeed = static_cast<speed_t> (baud);
    how.c_cc[VMIN] = 1;
    how.c_cc[VTIME] = 0;
    return ::ioctl (file, TCSETS2, &how) == 0;
}

/// From now on, only root can open the line: another program would take a part of its bytes. Not for a pseudo-terminal, which would stay closed to others
/// after a crash, for as long as its far end lives.
void excludeOthers (int file) noexcept
{
    constexpr unsigned first_pty = 136, last_pty = 143;   // Documentation/admin-guide/devices.txt of Linux
    struct stat which
    {
    };
    if (::fstat (file, &which) == 0 && (major (which.st_rdev) < first_pty || major (which.st_rdev) > last_pty)) static_cast<void> (::ioctl (file, TIOCEXCL));
}

/// Some adapters collect bytes for up to 16 ms, unless they are asked not to.
void setLatency (int file, WireFile::Latency latency) noexcept
{
    serial_struct how {};
    if (::ioctl (file, TIOCGSERIAL, &how) != 0) return;
    how.flags = latency == WireFile::Latency::low ? how.flags | int { ASYNC_LOW_LATENCY } : how.flags & ~int { ASYNC_LOW_LATENCY };
    static_cast<void> (::ioctl (file, TIOCSSERIAL, &how));   // not every adapter can
}
}   // namespace

Result<WireFile> WireFile::openSerial (const std::string& path, int baud, Others others)
{
    const int file = ::open (path.c_str(), O_RDWR | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (const int error = errno; file < 0)
        return Message::error ("device/wire", path, std::generic_category().message (error),
                               error == EACCES ? "join the group of " + path + " (on Debian: sudo adduser $USER dialout)" : std::string());
    WireFile line (file, Kind::line);
    if (! makeRaw (file, baud))
        return Message::error ("device/wire", path, "it is not a serial line: " + std::generic_category().message (errno),
                               "name a serial port, such as /dev/ttyACM0");
    if (others == Others::excluded) excludeOthers (file);
    setLatency (file, Latency::low);
    line.dropInput();
    return line;
}

namespace
{
using Addresses = std::unique_ptr<addrinfo, decltype (&::freeaddrinfo)>;

Result<Addresses> readAddress (const std::string& address)
{
    auto read = WireAddress::read (address);
    if (! read) return std::move (read).error();
    addrinfo wanted {};
    wanted.ai_socktype = SOCK_DGRAM;
    wanted.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;   // no name is looked up, because that can take long
    addrinfo* found = nullptr;
    if (const int error = ::getaddrinfo (read->host.c_str(), read->port.c_str(), &wanted, &found); error != 0)
        return WireAddress::refusal (address, ::gai_strerror (error));
    return Addresses (found, ::freeaddrinfo);
}
}   // namespace

Result<> WireFile::checkUdp (const std::string& address)
{
    auto read = readAddress (address);
    return read ? Result<> {} : std::move (read).error();
}

Result<WireFile> WireFile::connectUdp (const std::string& address)
{
    auto read = readAddress (address);
    if (! read) return std::move (read).error();
    const auto& found = *read;
    const int file = ::socket (found->ai_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (file < 0) return failure (address, errno);
    WireFile socket (file, Kind::socket);
    if (::connect (file, found->ai_addr, found->ai_addrlen) != 0) return failure (address, errno);
    return socket;
}

Result<WireFile> WireFile::makeTerminal (std::string& path)
{
    const int file = ::posix_openpt (O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return failure ("a pseudo-terminal", errno);
    WireFile line (file, Kind::line);
    std::array<char, 64> name {};
    if (::grantpt (file) != 0 || ::unlockpt (file) != 0 || ::ptsname_r (file, name.data(), name.size()) != 0 || ! makeRaw (file, 115200))
        return failure ("a pseudo-terminal", errno);
    path = name.data();
    line.kept_open = ::open (name.data(), O_RDWR | O_NONBLOCK | O_NOCTTY | O_CLOEXEC);
    if (line.kept_open < 0) return failure (path, errno);
    return line;
}

Result<WireFile> WireFile::listenUdp (int& port)
{
    const int file = ::socket (AF_INET, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
    if (file < 0) return failure ("UDP", errno);
    WireFile listener (file, Kind::listener);
    sockaddr_in here {};
    here.sin_family = AF_INET;
    here.sin_port = htons (static_cast<std::uint16_t> (port));
    here.sin_addr.s_addr = htonl (INADDR_LOOPBACK);
    socklen_t size = sizeof here;
    auto* const address = reinterpret_cast<sockaddr*> (&here);
    if (::bind (file, address, size) != 0 || ::getsockname (file, address, &size) != 0)
        return Message::error ("device/wire", "UDP port " + std::to_string (port), std::generic_category().message (errno), "choose another port");
    port = ntohs (here.sin_port);
    return listener;
}

WireFile::~WireFile()
{
    if (file >= 0) ::close (file);
    if (kept_open >= 0) ::close (kept_open);
}

WireFile::Outcome WireFile::read (std::span<std::uint8_t> into, Clock::time_point until) noexcept
{
    for (;;)
    {
        ssize_t got = 0;
        if (kind == Kind::line)
            got = ::read (file, into.data(), into.size());
        else if (kind == Kind::socket)
            got = ::recv (file, into.data(), into.size(), 0);
        else
        {
            auto size = static_cast<socklen_t> (peer.size());
            got = ::recvfrom (file, into.data(), into.size(), 0, reinterpret_cast<sockaddr*> (peer.data()), &size);
            if (got >= 0) peer_size = size;
        }
        if (got > 0) return { .what = Outcome::Kind::report, .size = static_cast<std::size_t> (got) };
        if (got == 0 && kind == Kind::line) return { .what = Outcome::Kind::failure, .error = EIO };   // the end of the line
        if (got == 0 || errno == EINTR) continue;
        if (errno != EAGAIN) return { .what = Outcome::Kind::failure, .error = errno };
        const int waited = waitForInput (file, until);
        if (waited == ETIMEDOUT) return {};
        if (waited == EIO && kind != Kind::line) continue;   // the next call returns the error of the socket
        if (waited != 0) return { .what = Outcome::Kind::failure, .error = waited };
    }
}

WireFile::Sent WireFile::write (std::span<const std::uint8_t> bytes) noexcept
{
    for (;;)
    {
        ssize_t put = 0;
        if (kind == Kind::line)
            put = ::write (file, bytes.data(), bytes.size());
        else if (kind == Kind::socket)
            put = ::send (file, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        else if (peer_size == 0)
            return { .size = bytes.size() };   // no datagram has come yet, so there is no address
        else
            put = ::sendto (file, bytes.data(), bytes.size(), MSG_NOSIGNAL, reinterpret_cast<const sockaddr*> (peer.data()), peer_size);
        if (put >= 0) return { .size = static_cast<std::size_t> (put) };
        if (errno != EINTR) return { .error = errno };
    }
}

std::size_t WireFile::unsent() const noexcept
{
    int bytes = 0;
    return kind == Kind::line && ::ioctl (file, TIOCOUTQ, &bytes) == 0 && bytes > 0 ? static_cast<std::size_t> (bytes) : 0;
}

void WireFile::dropInput() noexcept
{
    if (kind == Kind::line) static_cast<void> (::ioctl (file, TCFLSH, TCIFLUSH));   // what it keeps does no harm
}

void WireFile::change (int baud, Latency latency) noexcept
{
    setLatency (file, latency);
    makeRaw (file, baud, 0);   // without HUPCL: when the line closes, its control lines stay, else a Falcon would want its firmware again
    static_cast<void> (::ioctl (file, TCFLSH, TCIOFLUSH));
}

void WireFile::signal (bool is_ready) noexcept
{
    const int off = TIOCM_RTS | (is_ready ? 0 : TIOCM_DTR), on = is_ready ? TIOCM_DTR : 0;
    static_cast<void> (::ioctl (file, TIOCMBIC, &off));   // a pseudo-terminal has no such lines
    static_cast<void> (::ioctl (file, TIOCMBIS, &on));
}

#elif ! defined(_WIN32)   // there, windows/wires.cpp

namespace
{
Message none() { return Message::error ("device/wire", {}, "there are no such wires on this system"); }
}   // namespace

Result<WireFile> WireFile::openSerial (const std::string&, int, Others) { return none(); }
Result<> WireFile::checkUdp (const std::string&) { return {}; }
Result<WireFile> WireFile::connectUdp (const std::string&) { return none(); }
Result<WireFile> WireFile::makeTerminal (std::string&) { return none(); }
Result<WireFile> WireFile::listenUdp (int&) { return none(); }
WireFile::~WireFile() = default;
WireFile::Outcome WireFile::read (std::span<std::uint8_t>, Clock::time_point) noexcept { return { .what = Outcome::Kind::failure }; }
WireFile::Sent WireFile::write (std::span<const std::uint8_t>) noexcept { return {}; }
std::size_t WireFile::unsent() const noexcept { return 0; }
void WireFile::dropInput() noexcept {}
void WireFile::change (int, Latency) noexcept {}
void WireFile::signal (bool) noexcept {}

#endif

#if ! defined(_WIN32)
std::vector<std::string> WireFile::portNames()
{
    return {};
}
bool WireFile::isThere (const std::string& port)
{
    std::error_code unseen;
    return std::filesystem::exists (port, unseen);
}
#endif

}   // namespace tactus::host
