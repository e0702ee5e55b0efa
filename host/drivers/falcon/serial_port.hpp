// SPDX-License-Identifier: MIT
#pragma once

#include "packets.hpp"

#include <tactus/file/file_lock.hpp>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace tactus::host::falcon
{

/// The chip of FTDI between the computer and a Falcon, as a serial port. Each function that can fail returns why it has failed; empty: it has not.
class SerialPort
{
public:
    ~SerialPort();

    std::string open (const std::string& path);
    std::string remark() const;   ///< what makes the port slow, and what to do about it; may be empty
    void goNormal();              ///< to talk to the firmware

    /// Loads firmware from a file. May take some seconds.
    std::string load (const std::string& file);

    bool isFree() const;                ///< all that was sent is out
    std::string send (const Packet&);   ///< as soon as it is free

    std::optional<Report> next();                       ///< that has arrived
    void await (std::chrono::steady_clock::duration);   ///< until bytes arrive
    bool isGone() const noexcept { return is_gone; }

private:
    void setSpeed (unsigned baud);
    void setLowLatency (bool);
    void setLines (int rts_and_dtr);   // those that are on
    void purge();
    bool receive();
    bool put (std::span<const std::uint8_t>);
    bool expects (std::span<const std::uint8_t>, std::chrono::milliseconds);

    std::string name;
    int file = -1;
    std::optional<FileLock> lock;
    std::atomic<bool> is_gone = false;
    PacketFinder finder;
    std::array<std::uint8_t, 256> bytes {};
    std::size_t count = 0, used = 0;   // of them
};

}   // namespace tactus::host::falcon
