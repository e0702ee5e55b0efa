// SPDX-License-Identifier: MIT
#pragma once

#include "packets.hpp"

#include <host/base/platform/wire_file.hpp>
#include <host/devices/hid/usb_adapter.hpp>
#include <host/drivers/helper_program.hpp>
#include <tactus/file/file_lock.hpp>
#include <tactus/file/text_file.hpp>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <system_error>

namespace tactus::host::falcon
{

/// The FTDI adapter between the computer and a Falcon, as a serial port, or by libftdi. Each function that can fail returns the reason if it fails; empty if
/// it succeeds.
class SerialPort
{
    using Latency = WireFile::Latency;
    using Bytes = std::span<const std::uint8_t>;

public:
    using Clock = WireFile::Clock;

    std::string open (const std::string& path)
    {
        name = path;
        lock = FileLock::takeExisting (path);
        if (! lock && ::access (path.c_str(), R_OK | W_OK) == 0) return "another role, another instance of Tactus or another program is using it";
        auto opened = WireFile::openSerial (path, normal_baud, WireFile::Others::admitted);   // the guardian opens it, too
        if (! opened) return opened.error().text + (opened.error().remedy.empty() ? "" : ": " + opened.error().remedy);
        wire = std::move (*opened);
        return {};
    }

    /// Opens the Falcon with this number, counted from 0, by libftdi in a process of its own, which a pseudo-terminal connects with this one.
    std::string openUsb (unsigned number)
    {
        std::string path;
        const auto far_end = WireFile::makeTerminal (path);
        auto why = far_end ? open (path) : far_end.error().text;
        if (! why.empty()) return why;
        goNormal();
        why = bridge.start (hello, "falcon-bridge", { std::to_string (number) }, { far_end->descriptor() }, environ);
        return why.empty() ? bridge.firstLine().value_or ("the program between the driver and libftdi has died") : why;
    }

    /// The serial port of a Falcon that the kernel knows; empty: there is none.
    static std::string ofFalcon (const std::filesystem::path& adapters = "/sys/bus/usb-serial/devices")
    {
        const auto found = hid::usbEntries (adapters, "0403", "cb48", "../..");
        return found.empty() ? std::string() : "/dev/" + found.front().filename().string();
    }

    const std::string& path() const noexcept { return name; }

    /// Sets the speed and the latency for the running firmware.
    void goNormal() { change (normal_baud, Latency::low); }

    /// Loads firmware from a file. May take some seconds.
    std::string load (const std::string& file)
    {
        constexpr std::size_t block_size = 62, most_firmware = 65'536;
        const auto image = readFile (file);
        if (! image || image->empty() || image->size() > most_firmware)
            return file + ": this is not the firmware of a Falcon: it cannot be read, is empty, or is too long";
        change (hello_baud, Latency::usual);   // users report that loading fails otherwise
        wire->signal (false);
        wire->signal (true);
        bool is_there = false;
        for (int tries = 0; tries < 40 && ! is_there && ! is_gone; ++tries, count = used = 0)
            is_there = asks (hello, hello_answer, std::chrono::milliseconds (50));
        if (! is_there) return "neither its firmware nor its loader answers: check its power and its cable";
        wire->signal (false);
        change (loading_baud, Latency::usual);   // without the answers to earlier questions
        if (! asks (ready, ready)) return "it is not ready for its firmware";
        for (Bytes left (reinterpret_cast<const std::uint8_t*> (image->data()), image->size()); ! left.empty();)
        {
            const auto block = left.first (std::min (left.size(), block_size));
            if (! asks (block, block)) return "its echo of the firmware is wrong after " + std::to_string (image->size() - left.size()) + " bytes";
            left = left.subspan (block.size());
        }
        return {};
    }

    /// True if everything that was sent is out, so that a packet can be sent.
    bool isFree() const { return wire->unsent() == 0; }

    std::string send (const Packet& packet)
    {
        const auto sent = wire->write (packet);
        if (sent.size == packet.size()) return {};
        if (sent.error != 0 && sent.error != EAGAIN) is_gone = true;
        return sent.error != 0 ? std::generic_category().message (sent.error) : "only a part of a packet is out";
    }

    /// The next report, as soon as it arrives.
    std::optional<Report> next (Clock::time_point until)
    {
        do
            while (used < count)
                if (const auto report = finder.take (bytes[used++])) return report;
        while (receive (until));
        return std::nullopt;
    }

    bool isGone() const noexcept { return is_gone; }

private:
    static constexpr std::uint8_t hello[] { 0x0a, 0x43, 0x0d }, hello_answer[] { 0x0a, 0x44, 0x2c, 0x0d }, ready[] { 0x41 };

    void change (unsigned baud, Latency latency)
    {
        wire->change (static_cast<int> (baud), latency);
        count = used = 0;
        finder = {};
    }

    bool receive (Clock::time_point until)
    {
        const auto got = wire->read (bytes, until);
        if (got.what == WireFile::Outcome::Kind::failure) is_gone = true;
        count = got.size;
        used = 0;
        return count > 0;
    }

    /// Some systems put a 0 in front of an answer.
    bool asks (Bytes question, Bytes answer, std::chrono::milliseconds patience = std::chrono::seconds (1))
    {
        if (wire->write (question).size != question.size()) return false;
        const auto until = Clock::now() + patience;
        for (bool is_first = true; ! answer.empty() && (used < count || receive (until)); is_first = false)
            if (const auto byte = bytes[used++]; byte == answer.front())
                answer = answer.subspan (1);
            else if (! is_first || byte != 0)
                return false;
        return answer.empty();
    }

    std::string name;
    HelperProcess bridge;   // ends after the wire is closed
    std::optional<FileLock> lock;
    std::optional<WireFile> wire;
    std::atomic<bool> is_gone = false;
    PacketFinder finder;
    std::array<std::uint8_t, 256> bytes {};
    std::size_t count = 0, used = 0;   // of them
};

}   // namespace tactus::host::falcon
