// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>

namespace tactus::host
{

/// A file from which each read takes one whole report, such as /dev/hidraw3. Waiting has no coarser unit than the system's own
/// timer, and nothing here allocates, locks or throws, so the thread that ticks a run may wait here for its clock. Works only on
/// Linux. [one thread at a time]
class ReportFile
{
public:
    using Clock = std::chrono::steady_clock;

    struct Outcome
    {
        enum class Kind
        {
            report,
            nothing,   ///< none arrived in time
            failure    ///< the device is gone
        };

        Kind what = Kind::nothing;
        std::size_t size = 0;   ///< of the report, in bytes
        int error = 0;          ///< the system's number of the failure
    };

    /// Opens a file for reading. Empty if the system refuses, or has no such files.
    static std::optional<ReportFile> open (const std::string& path) noexcept;

    /// Takes over an open descriptor that keeps reports apart, such as a socket of packets.
    explicit ReportFile (int descriptor) noexcept;

    ~ReportFile();
    ReportFile (ReportFile&& other) noexcept : file (std::exchange (other.file, -1)) {}
    ReportFile& operator= (ReportFile&& other) noexcept
    {
        std::swap (file, other.file);
        return *this;
    }

    /// Takes the oldest report that waits, or waits for one; does not wait if `until` has passed. A report longer than `into` is
    /// truncated.
    Outcome read (std::span<std::uint8_t> into, Clock::time_point until) noexcept;

    /// Asks a HID device for the input report whose id is the first byte, and stores it there, after its id or a 0. Waits for the answer,
    /// for up to some seconds.
    Outcome ask (std::span<std::uint8_t> report) noexcept;

private:
    int file = -1;
};

/// Waits until a file has something to read; does not wait if `until` has passed. 0: it has; ETIMEDOUT: it has not; any other number: the
/// failure, EIO for a file whose other end is gone. Only on Linux.
int waitForInput (int file, ReportFile::Clock::time_point until) noexcept;

}   // namespace tactus::host
