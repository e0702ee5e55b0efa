// SPDX-License-Identifier: MIT
// The wires of wire_file.hpp on Windows.
#if defined(_WIN32)
#include <winsock2.h>
#include <ws2tcpip.h>

#include <windows.h>

#include <host/base/platform/wire_address.hpp>
#include <host/base/platform/wire_file.hpp>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <memory>
#include <string_view>
#include <system_error>

namespace tactus::host
{
namespace
{
using Outcome = WireFile::Outcome;

constexpr std::size_t line_keeps = 4096;   // bytes in each direction
constexpr std::string_view before_name = R"(\\.\)";

Outcome failure (int error) noexcept { return { .what = Outcome::Kind::failure, .error = error }; }

Message failed (const std::string& where, DWORD error)
{
    return Message::error ("device/wire", where, std::system_category().message (static_cast<int> (error)));
}

/// The milliseconds until then, at least one.
DWORD untilThen (WireFile::Clock::time_point until) noexcept
{
    const auto left = std::chrono::ceil<std::chrono::milliseconds> (until - WireFile::Clock::now()).count();
    return static_cast<DWORD> (std::clamp<std::int64_t> (left, 1, 3'600'000));
}

/// An operation on a line that goes on while its thread does something else. A line needs one for each direction, because the system makes calls on
/// other handles wait for each other.
class Operation
{
public:
    Operation() noexcept { state.hEvent = ::CreateEventW (nullptr, TRUE, FALSE, nullptr); }
    ~Operation() { ::CloseHandle (state.hEvent); }
    Operation (const Operation&) = delete;
    Operation& operator= (const Operation&) = delete;

    /// Begins with ReadFile or WriteFile. 0, or an error of the system.
    template <typename Call, typename Bytes>
    DWORD begin (Call call, HANDLE file, Bytes* bytes, std::size_t size) noexcept
    {
        ::ResetEvent (state.hEvent);
        const DWORD error = call (file, bytes, static_cast<DWORD> (size), nullptr, &state) != 0 ? ERROR_SUCCESS : ::GetLastError();
        is_going = error == ERROR_SUCCESS || error == ERROR_IO_PENDING;
        return is_going ? ERROR_SUCCESS : error;
    }

    bool isGoing() const noexcept { return is_going; }
    bool hasEnded (DWORD wait_ms) const noexcept { return ::WaitForSingleObject (state.hEvent, wait_ms) == WAIT_OBJECT_0; }

    /// Waits for its end, which is near: it has ended, or is cancelled.
    DWORD end (HANDLE file, DWORD& size) noexcept
    {
        is_going = false;
        return ::GetOverlappedResult (file, &state, &size, TRUE) != 0 ? ERROR_SUCCESS : ::GetLastError();
    }

    void cancel (HANDLE file) noexcept
    {
        DWORD size = 0;
        if (! is_going) return;
        ::CancelIoEx (file, &state);
        end (file, size);
    }

private:
    OVERLAPPED state {};
    bool is_going = false;
};

/// A serial line. What is being sent must stay where it is until the system has sent it.
struct Line
{
    HANDLE file;
    Operation reading, writing;
    std::array<std::uint8_t, line_keeps> sent {};
    DWORD being_sent = 0;

    explicit Line (HANDLE f) noexcept : file (f) {}
    ~Line()
    {
        reading.cancel (file);
        writing.cancel (file);
        ::CloseHandle (file);
    }
    Line (const Line&) = delete;
    Line& operator= (const Line&) = delete;

    bool makeRaw (int baud) noexcept
    {
        DCB how {};   // afresh: wine cannot tell the state of a line of any speed
        how.DCBlength = sizeof how;
        how.BaudRate = static_cast<DWORD> (baud);
        how.fBinary = TRUE;
        how.fDtrControl = DTR_CONTROL_ENABLE;
        how.fRtsControl = RTS_CONTROL_ENABLE;
        how.ByteSize = 8;
        how.Parity = NOPARITY;
        how.StopBits = ONESTOPBIT;
        how.XonChar = 0x11;   // they are not used, but must differ
        how.XoffChar = 0x13;
        COMMTIMEOUTS none {};   // a read ends when it has all its bytes
        return ::SetCommState (file, &how) != 0 && ::SetCommTimeouts (file, &none) != 0;
    }

    COMSTAT waiting() const noexcept
    {
        DWORD errors = 0;
        COMSTAT now {};
        ::ClearCommError (file, &errors, &now);
        return now;
    }

    /// Reads so many bytes, all of which have come unless `until` is given. Returns how many; none if there is an error, or it is too late.
    DWORD take (std::uint8_t* to, std::size_t size, WireFile::Clock::time_point until, DWORD& error) noexcept
    {
        error = reading.begin (::ReadFile, file, to, size);
        if (error != ERROR_SUCCESS) return 0;
        if (! reading.hasEnded (untilThen (until))) ::CancelIoEx (file, nullptr);
        DWORD got = 0;
        error = reading.end (file, got);
        if (error == ERROR_OPERATION_ABORTED) error = ERROR_SUCCESS;
        return got;
    }
};

struct Sockets
{
    WSADATA about {};
    const bool are_there = ::WSAStartup (MAKEWORD (2, 2), &about) == 0;
};

bool needSockets()
{
    static const Sockets sockets;   // for as long as the program runs
    return sockets.are_there;
}

/// A socket whose calls do not wait.
int openSocket (int family)
{
    const auto opened = needSockets() ? ::socket (family, SOCK_DGRAM, IPPROTO_UDP) : INVALID_SOCKET;
    u_long on = 1;
    if (opened == INVALID_SOCKET) return -1;
    ::ioctlsocket (opened, static_cast<long> (FIONBIO), &on);
    BOOL off = FALSE;
    DWORD size = 0;   // a datagram that did not arrive is no failure of the next read
    ::WSAIoctl (opened, _WSAIOW (IOC_VENDOR, 12), &off, sizeof off, nullptr, 0, &size, nullptr, nullptr);
    return static_cast<int> (opened);   // handles have 32 bits, on 64-bit Windows, too
}

SOCKET socketOf (int file) noexcept { return static_cast<SOCKET> (file); }

int errorOfSocket() noexcept { return ::WSAGetLastError() == WSAEWOULDBLOCK ? EAGAIN : EIO; }

using Addresses = std::unique_ptr<addrinfo, decltype (&::freeaddrinfo)>;

Result<Addresses> readAddress (const std::string& address)
{
    auto read = WireAddress::read (address);
    if (! read) return std::move (read).error();
    addrinfo wanted {};
    wanted.ai_socktype = SOCK_DGRAM;
    wanted.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    if (! needSockets() || ::getaddrinfo (read->host.c_str(), read->port.c_str(), &wanted, &found) != 0)
        return WireAddress::refusal (address, "its host must be written in numbers");
    return Addresses (found, ::freeaddrinfo);
}
}   // namespace

Result<WireFile> WireFile::openSerial (const std::string& path, int baud, Others)   // Windows lets only one program open a port
{
    const auto whole = path.starts_with (before_name) ? path : std::string (before_name) + path;   // COM10 and above have no other name
    const auto file = ::CreateFileA (whole.c_str(), GENERIC_READ | GENERIC_WRITE, 0, nullptr, OPEN_EXISTING, FILE_FLAG_OVERLAPPED, nullptr);
    if (const auto error = ::GetLastError(); file == INVALID_HANDLE_VALUE)
        return error == ERROR_ACCESS_DENIED ? Message::error ("device/wire", path, "another program uses it", "close the other program") : failed (path, error);
    auto line = std::make_shared<Line> (file);
    if (! line->makeRaw (baud))
        return Message::error ("device/wire", path, "it is not a serial line: " + failed (path, ::GetLastError()).text, "name a serial port, such as COM3");
    ::SetupComm (file, line_keeps, line_keeps);
    WireFile opened (0, Kind::line);
    opened.kept = std::move (line);
    opened.dropInput();
    return opened;
}

bool WireFile::isThere (const std::string& port)
{
    std::array<char, 512> target {};
    return ::QueryDosDeviceA (port.c_str() + (port.starts_with (before_name) ? before_name.size() : 0), target.data(), static_cast<DWORD> (target.size())) != 0;
}

std::vector<std::string> WireFile::portNames()
{
    constexpr int most = 256;
    std::vector<std::string> all;
    for (int number = 1; number <= most; ++number)
        if (auto name = "COM" + std::to_string (number); isThere (name)) all.push_back (std::move (name));
    return all;
}

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
    const int file = openSocket (found->ai_family);
    if (file < 0) return failed (address, static_cast<DWORD> (::WSAGetLastError()));
    WireFile socket (file, Kind::socket);
    if (::connect (socketOf (file), found->ai_addr, static_cast<int> (found->ai_addrlen)) != 0)
        return failed (address, static_cast<DWORD> (::WSAGetLastError()));
    return socket;
}

Result<WireFile> WireFile::makeTerminal (std::string&)
{
    return Message::error ("device/wire", {}, "Windows has no far end of a serial port", "choose another wire, such as UDP");
}

Result<WireFile> WireFile::listenUdp (int& port)
{
    const int file = openSocket (AF_INET);
    if (file < 0) return failed ("UDP", static_cast<DWORD> (::WSAGetLastError()));
    WireFile listener (file, Kind::listener);
    sockaddr_in here {};
    here.sin_family = AF_INET;
    here.sin_port = ::htons (static_cast<std::uint16_t> (port));
    here.sin_addr.s_addr = ::htonl (INADDR_LOOPBACK);
    int size = sizeof here;
    auto* const address = reinterpret_cast<sockaddr*> (&here);
    if (::bind (socketOf (file), address, size) != 0 || ::getsockname (socketOf (file), address, &size) != 0)
        return Message::error ("device/wire", "UDP port " + std::to_string (port), failed ({}, static_cast<DWORD> (::WSAGetLastError())).text,
                               "choose another port");
    port = ::ntohs (here.sin_port);
    return listener;
}

WireFile::~WireFile()
{
    if (file >= 0 && kind != Kind::line) ::closesocket (socketOf (file));
}

Outcome WireFile::read (std::span<std::uint8_t> into, Clock::time_point until) noexcept
{
    if (kind == Kind::line)
    {
        auto& line = *static_cast<Line*> (kept.get());
        DWORD error = ERROR_SUCCESS, got = 0;
        std::size_t there = line.waiting().cbInQue;
        if (there == 0 && Clock::now() < until && ! into.empty())
        {
            got = line.take (into.data(), 1, until, error);
            if (got > 0) there = line.waiting().cbInQue;
        }
        there = std::min (there, into.size() - got);
        if (there > 0 && error == ERROR_SUCCESS) got += line.take (into.data() + got, there, Clock::now() + std::chrono::seconds (1), error);
        if (got > 0) return { .what = Outcome::Kind::report, .size = got };
        return error == ERROR_SUCCESS ? Outcome {} : failure (EIO);
    }
    for (;;)
    {
        auto size = static_cast<int> (peer.size());
        const bool listens = kind == Kind::listener;
        const int got = ::recvfrom (socketOf (file), reinterpret_cast<char*> (into.data()), static_cast<int> (into.size()), 0,
                                    listens ? reinterpret_cast<sockaddr*> (peer.data()) : nullptr, listens ? &size : nullptr);
        const int error = got < 0 ? ::WSAGetLastError() : 0;
        if (got >= 0 && listens) peer_size = static_cast<std::uint32_t> (size);
        if (got > 0 || error == WSAEMSGSIZE) return { .what = Outcome::Kind::report, .size = got > 0 ? static_cast<std::size_t> (got) : into.size() };
        if (got == 0 || error == WSAECONNRESET) continue;
        if (error != WSAEWOULDBLOCK) return failure (EIO);
        if (Clock::now() >= until) return {};
        WSAPOLLFD polled { .fd = socketOf (file), .events = POLLRDNORM, .revents = 0 };
        if (::WSAPoll (&polled, 1, static_cast<int> (untilThen (until))) < 0) return failure (EIO);
    }
}

WireFile::Sent WireFile::write (std::span<const std::uint8_t> bytes) noexcept
{
    const auto* text = reinterpret_cast<const char*> (bytes.data());
    if (kind == Kind::line)
    {
        auto& line = *static_cast<Line*> (kept.get());
        if (unsent() > 0) return { .error = EAGAIN };
        const auto size = std::min (bytes.size(), line.sent.size());
        std::copy_n (bytes.begin(), size, line.sent.begin());
        line.being_sent = static_cast<DWORD> (size);
        if (line.writing.begin (::WriteFile, line.file, line.sent.data(), size) != ERROR_SUCCESS) return { .error = EIO };
        return { .size = size };
    }
    if (kind == Kind::listener && peer_size == 0) return { .size = bytes.size() };
    const bool listens = kind == Kind::listener;   // a connected socket knows the address
    const int put = ::sendto (socketOf (file), text, static_cast<int> (bytes.size()), 0,
                              listens ? reinterpret_cast<const sockaddr*> (peer.data()) : nullptr, listens ? static_cast<int> (peer_size) : 0);
    return put >= 0 ? Sent { .size = static_cast<std::size_t> (put) } : Sent { .error = errorOfSocket() };
}

std::size_t WireFile::unsent() const noexcept
{
    if (kind != Kind::line) return 0;
    auto& line = *static_cast<Line*> (kept.get());
    DWORD sent = 0;
    if (line.writing.isGoing() && line.writing.hasEnded (0)) line.writing.end (line.file, sent);
    return line.writing.isGoing() ? line.being_sent : 0;
}

void WireFile::dropInput() noexcept
{
    if (kind == Kind::line) ::PurgeComm (static_cast<Line*> (kept.get())->file, PURGE_RXCLEAR);
}

void WireFile::change (int baud, Latency) noexcept
{
    auto& line = *static_cast<Line*> (kept.get());
    line.makeRaw (baud);
    ::PurgeComm (line.file, PURGE_RXCLEAR | PURGE_TXCLEAR);
}

void WireFile::signal (bool is_ready) noexcept
{
    auto* const port = static_cast<Line*> (kept.get())->file;
    ::EscapeCommFunction (port, CLRRTS);
    ::EscapeCommFunction (port, is_ready ? SETDTR : CLRDTR);
}

}   // namespace tactus::host
#endif
