// SPDX-License-Identifier: MIT
#pragma once

#include "packets.hpp"

#include <tactus/file/file_lock.hpp>

#include <sys/types.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace tactus::host::falcon
{

/// The FTDI adapter between the computer and a Falcon, as a serial port, or by libftdi. Each function that can fail returns the reason if it fails; empty if
/// it succeeds.
class SerialPort
{
public:
    ~SerialPort();

    std::string open (const std::string& path);

    /// Opens the Falcon with this number, counted from 0, by libftdi in a process of its own, which a pseudo-terminal connects with this one.
    std::string openUsb (unsigned number);

    /// The serial port of a Falcon that the kernel knows; empty: there is none.
    static std::string ofFalcon (const std::filesystem::path& adapters = "/sys/bus/usb-serial/devices");

    const std::string& path() const noexcept { return name; }
    void goNormal();   ///< sets the speed and the latency for the running firmware

    /// Loads firmware from a file. May take some seconds.
    std::string load (const std::string& file);

    bool isFree() const;                ///< true if everything that was sent is out
    std::string send (const Packet&);   ///< as soon as it is free

    std::optional<Report> next();                       ///< the next report that has arrived
    void await (std::chrono::steady_clock::duration);   ///< waits until bytes arrive, at most this long
    bool isGone() const noexcept { return is_gone; }

private:
    void setSpeed (unsigned baud);
    void setLowLatency (bool);
    void setLines (int rts_and_dtr);   // the lines that are on
    void purge();
    bool receive();
    bool put (std::span<const std::uint8_t>);
    bool expects (std::span<const std::uint8_t>, std::chrono::milliseconds);

    std::string name;
    int file = -1;
    pid_t bridge = -1;
    std::optional<FileLock> lock;
    std::atomic<bool> is_gone = false;
    PacketFinder finder;
    std::array<std::uint8_t, 256> bytes {};
    std::size_t count = 0, used = 0;   // of them
};

}   // namespace tactus::host::falcon
