// SPDX-License-Identifier: MIT
#pragma once

#include "support/waiting.hpp"

#include <host/devices/hid_link/transport.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#if defined(__linux__)

#include <poll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace tactus::test
{

/// A device at the other end of a pair of sockets, which the tick thread can read as it reads a real one. It can be opened once.
class SocketBoard final : public host::hid::HidSystem
{
public:
    ~SocketBoard() override
    {
        if (end >= 0) ::close (end);
    }

    /// False if there is no room for the report, or if the device is not open. [any thread]
    bool send (std::span<const std::uint8_t> report) const
    {
        return ::send (end, report.data(), report.size(), MSG_DONTWAIT | MSG_NOSIGNAL) == static_cast<ssize_t> (report.size());
    }

    /// The next report that the device gets. Empty: none within this time.
    std::vector<std::uint8_t> hear (std::chrono::milliseconds longest) const
    {
        pollfd polled { .fd = end, .events = POLLIN, .revents = 0 };
        std::vector<std::uint8_t> bytes (65);
        if (::poll (&polled, 1, static_cast<int> (longest.count())) <= 0) return {};
        bytes.resize (static_cast<std::size_t> (std::max<ssize_t> (0, ::read (end, bytes.data(), bytes.size()))));
        return bytes;
    }

    std::vector<host::hid::ConnectedDevice> connected() override { return {}; }

    Result<std::unique_ptr<host::hid::Transport>> open (const host::hid::ConnectedDevice&) override
    {
        int both[2] {};
        if (end >= 0 || ::socketpair (AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, both) != 0) return Message::error ("hid/not_opened", {}, "no sockets");
        end = both[0];
        return std::make_unique<Wire> (*this, both[1]);
    }

    int end = -1;                          ///< the device's end; it sends and gets whole reports
    std::atomic<int> reading_thread = 0;   ///< the system's number of the thread that read() was last called on

private:
    class Wire final : public host::hid::Transport
    {
    public:
        Wire (SocketBoard& b, int s) : board (b), socket (s), file (s) {}

        Result<std::size_t> read (std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override
        {
            board.reading_thread = static_cast<int> (::syscall (SYS_gettid));
            const auto got = file.read (into, fromNow (timeout));
            if (got.what == host::ReportFile::Outcome::Kind::failure) return host::hid::transferError ("unplugged");
            return got.size;
        }

        bool canReadUntil() const noexcept override { return true; }

        host::ReportFile::Outcome readUntil (std::span<std::uint8_t> into, host::ReportFile::Clock::time_point until) noexcept override
        {
            return file.read (into, until);
        }

        Result<> write (std::span<const std::uint8_t> report) override
        {
            // A test need not take what the device gets.
            static_cast<void> (::send (socket, report.data(), report.size(), MSG_DONTWAIT | MSG_NOSIGNAL));
            return {};
        }
        Result<> sendFeature (std::span<const std::uint8_t>) override { return {}; }
        Result<> getFeature (std::span<std::uint8_t>) override { return {}; }

    private:
        SocketBoard& board;
        const int socket;
        host::ReportFile file;   // closes it
    };
};

}   // namespace tactus::test

#endif
