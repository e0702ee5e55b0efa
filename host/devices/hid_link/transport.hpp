// SPDX-License-Identifier: MIT
#pragma once

#include <host/base/platform/report_file.hpp>
#include <host/devices/hid/match.hpp>
#include <tactus/file/file_lock.hpp>
#include <tactus/text/result.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host::hid
{

/// A report on its way to a device. Its first byte is the report id, or 0 if the device uses no ids.
struct OutgoingReport
{
    Bytes bytes;
    bool is_feature = false;
};

/// A failed transfer, with the system's own message.
inline Message transferError (std::string why) { return Message::error ("hid/transfer", {}, std::move (why)); }

/// A device that another driver uses: another role, or another program. `who` says which, if that is known.
inline Message inUse (std::string where, std::string who = "another role or another instance of Tactus is using it")
{
    return Message::error ("hid/not_opened", std::move (where), std::move (who),
                           "end the other program, or leave the device to the other role");
}

/// Locks the file of a device, so that only one driver uses it. Empty if this user may not open it, or if it is no file. Id: hid/not_opened if another
/// driver has it.
Result<std::optional<FileLock>> lockDevice (const std::string& path);

/// An open device. One thread may read while another makes all other calls. The destructor closes it. Id: hid/transfer.
class Transport
{
public:
    virtual ~Transport() = default;

    /// Waits for an input report and returns its size, which may be 0. Also returns 0 on timeout. A failure
    /// means that the device is gone. A report longer than the buffer is truncated.
    virtual Result<std::size_t> read (std::span<std::uint8_t> into, std::chrono::milliseconds timeout) = 0;

    /// Asks for the input report whose id is the first byte of `report`, stores it there as read() does, and returns its size. For the
    /// thread that calls read(). Blocks for as long as the device needs, which is for some seconds if it does not answer.
    virtual Result<std::size_t> getInput (std::span<std::uint8_t> /*report*/) { return transferError ("the device cannot be asked for a report"); }

    /// True if readUntil() works.
    virtual bool canReadUntil() const noexcept { return false; }

    /// The number of reports that the system keeps for a reader who is late; it drops newer ones.
    virtual std::size_t keptBySystem() const noexcept { return 63; }   // Linux, of HID: HIDRAW_BUFFER_SIZE is 64

    /// Bytes that have come so far and belong to no report. [any thread]
    virtual std::uint64_t strayBytes() const noexcept { return 0; }

    /// True while the device has not answered the last report: one that pushes waits, and then the newest is sent. [any thread]
    virtual bool awaitsAnswer() const noexcept { return false; }

    /// Like read(), for the thread that ticks a run: neither allocates nor throws, and waits precisely until that time. Does not wait
    /// if it has passed. After a failure, read() says why.
    virtual ReportFile::Outcome readUntil (std::span<std::uint8_t>, ReportFile::Clock::time_point) noexcept
    {
        return { .what = ReportFile::Outcome::Kind::failure };
    }

    /// Blocks for as long as the device needs.
    virtual Result<> write (std::span<const std::uint8_t> report) = 0;
    virtual Result<> sendFeature (std::span<const std::uint8_t> report) = 0;

    /// Requests the feature report whose id is the first byte of `report`, and stores it in `report`.
    virtual Result<> getFeature (std::span<std::uint8_t> report) = 0;

    /// Arranges for these reports to be written, in this order, if the process dies or freezes without closing the device.
    /// Replaces the reports of the previous call.
    virtual Result<> armFailsafe (const std::vector<OutgoingReport>&) { return {}; }

    /// Tells the failsafe that the writing thread is alive, and whether there may be an effort on the device. Returns false if the
    /// failsafe has written to the device, or if the computer has slept. Then open the device again before sending any effort.
    virtual bool beat (bool /*driven*/) noexcept { return true; }
};

/// The kind of connection between a device and this computer.
enum class Wire
{
    hid,
    serial,
    udp
};

/// A connected device, whether open or not.
struct ConnectedDevice : DeviceInfo
{
    Wire wire = Wire::hid;
    std::string path;           ///< the system's name for the device, such as /dev/hidraw3 or /dev/ttyACM0; of UDP: its address
    std::string serial;         ///< empty if the device has none
    std::string manufacturer;   ///< empty if the device has none
};

/// Lists the connected devices and opens them. [any thread]
class HidSystem
{
public:
    virtual ~HidSystem() = default;

    virtual std::vector<ConnectedDevice> connected() = 0;

    /// Ids: hid/not_permitted, hid/not_opened; the text is the reason, and the remedy may be empty.
    virtual Result<std::unique_ptr<Transport>> open (const ConnectedDevice&) = 0;

    /// Opens a device over whatever wire it has. Ids: those of open() and openWire().
    virtual Result<std::unique_ptr<Transport>> reach (const ConnectedDevice&, const Profile&);

    /// The report descriptor, read without opening the device. Empty if the system does not provide it.
    virtual Bytes reportDescriptor (const ConnectedDevice&) { return {}; }

    /// The time by which reports arrive and efforts are limited. Tests have their own. [any thread]
    virtual std::chrono::steady_clock::time_point now() const noexcept { return std::chrono::steady_clock::now(); }

    /// True if this user may open the device; checked without opening it.
    virtual bool mayOpen (const ConnectedDevice&) { return true; }
};

/// The devices of this computer, accessed through hidapi.
HidSystem& thisComputer();

}   // namespace tactus::host::hid
