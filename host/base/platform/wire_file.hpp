// SPDX-License-Identifier: MIT
#pragma once

#include "report_file.hpp"

#include <tactus/text/result.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// An open serial line or UDP socket, or the far end of one. Nothing blocks except read(), and nothing allocates or throws once it is open. Works
/// only on Linux and Windows, which has no far end of a serial line. Id: device/wire; its text is the reason. [one thread may read while another writes]
class WireFile
{
public:
    using Clock = ReportFile::Clock;
    using Outcome = ReportFile::Outcome;

    /// Permission for other programs, except those of root, to open a line as well. A pseudo-terminal is always open to them.
    enum class Others
    {
        excluded,
        admitted
    };

    /// The time for which the adapter of a line keeps bytes, if it is one that can be told: as short as it can, or as long as it likes.
    enum class Latency
    {
        low,
        usual
    };

    /// A serial line that passes all bytes unchanged: 8 bits, no parity, no flow control. Also works on a pseudo-terminal.
    static Result<WireFile> openSerial (const std::string& path, int baud, Others = Others::excluded);

    /// The names of the serial ports that are not files, as on Windows: "COM3". [any thread]
    static std::vector<std::string> portNames();

    /// True if there is a serial port of this name. [any thread]
    static bool isThere (const std::string& port);

    /// Checks that an address is one for connectUdp(): numbers, with a port from 1 to 65535.
    static Result<> checkUdp (const std::string& address);

    /// A socket that exchanges datagrams with one address, such as "192.168.4.1:9750" or "[fe80::1]:9750", and takes none from other addresses.
    static Result<WireFile> connectUdp (const std::string& address);

    /// The far end of a serial line: a new pseudo-terminal. `path` becomes the name of the end that a program opens.
    static Result<WireFile> makeTerminal (std::string& path);

    /// The far end of a UDP wire, on this computer. Datagrams go to the sender of the last one. A port of 0 becomes a free one.
    static Result<WireFile> listenUdp (int& port);

    WireFile (WireFile&& other) noexcept { swap (other); }
    WireFile& operator= (WireFile&& other) noexcept
    {
        swap (other);
        return *this;
    }
    ~WireFile();

    /// Takes the bytes that have come, or one datagram, or waits for them; does not wait if `until` has passed. Skips empty datagrams.
    Outcome read (std::span<std::uint8_t> into, Clock::time_point until) noexcept;

    struct Sent
    {
        std::size_t size = 0;   ///< the bytes that the system took
        int error = 0;          ///< 0 if it took any; EAGAIN: no room now
    };

    Sent write (std::span<const std::uint8_t> bytes) noexcept;

    /// The number of bytes that the system still has to send. 0 if it is not known.
    std::size_t unsent() const noexcept;

    /// Drops the bytes that have come so far.
    void dropInput() noexcept;

    /// Gives a serial line another speed, and drops the bytes that wait in either direction.
    void change (int baud, Latency) noexcept;

    /// Sets the control lines of a serial line: RTS off, and DTR on or off.
    void signal (bool is_ready) noexcept;

    int descriptor() const noexcept { return file; }

private:
    enum class Kind
    {
        line,
        socket,
        listener
    };

    WireFile (int f, Kind k) noexcept : file (f), kind (k) {}
    void swap (WireFile& other) noexcept
    {
        std::swap (file, other.file);
        std::swap (kept_open, other.kept_open);
        std::swap (kept, other.kept);
        std::swap (kind, other.kind);
        std::swap (peer, other.peer);
        std::swap (peer_size, other.peer_size);
    }

    int file = -1, kept_open = -1;   // kept_open: the near end of a terminal, so that the far end lives while no program has it open
    std::shared_ptr<void> kept;      // what Windows needs for a line: it has other calls for lines than for sockets
    Kind kind = Kind::line;
    alignas (8) std::array<std::uint8_t, 128> peer {};   // a sockaddr: the sender of the last datagram
    std::uint32_t peer_size = 0;
};

}   // namespace tactus::host
