// SPDX-License-Identifier: MIT
#pragma once

#include "line_reader.hpp"
#include "transport.hpp"
#include "virtual_hid.hpp"

#include <host/devices/hid/device_side.hpp>

#include <tactus/node/device.hpp>
#include <tactus/text/result.hpp>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host::hid
{

/// A fault of a fake device, with its start and end in s of the device's own time.
struct DeviceFault
{
    enum class Kind
    {
        stall,       ///< sends nothing and takes nothing
        garbage,     ///< sends random bytes instead of reports
        half,        ///< sends only the first half of a report's bytes
        lost_byte,   ///< leaves out a byte in the middle of a report
        missed,      ///< serial lines only: misses the last byte of the bytes that come together
        reset,       ///< is being reset; comes back on the same line as if switched on again, and has forgotten what `init` has set up
        late,        ///< after each report, sends the previous one again
        lie,         ///< an encoder stops counting, or, without encoders, the first coordinate is frozen
        away,        ///< is unplugged; comes back as if switched on again, and a serial line then has another name
        push,        ///< services only: sends without a request, and does not answer
        rename       ///< services only: its device has another name
    };

    Kind kind = Kind::stall;
    double from = 0.0, to = std::numeric_limits<double>::infinity();
};

/// True for a fault of services, which the device of a profile cannot have.
constexpr bool isOfService (DeviceFault::Kind kind) noexcept { return kind == DeviceFault::Kind::push || kind == DeviceFault::Kind::rename; }

/// Reads "stall", "stall@2" (from 2 s on) or "stall@2:0.5" (for half a second). Id: fake/fault.
Result<DeviceFault> readFault (std::string_view);

/// Simulates the device of a profile at the far end of a serial line (a pseudo-terminal) or of UDP, or as a HID device of the kernel. A simulated hand moves
/// its tool and feels the force. Its time is the number of steps, so nothing depends on when they are made. Like the Tactus board, it releases its motors
/// if no valid report comes for its watchdog (`device_watchdog` of the profile; without one it keeps them on), and if an enable bit is 0.
///
/// It sends only reports with values or buttons: no signs of life and the like, which some devices send, too.
///
/// With the framing `answer`, it is like Haply's board: it answers each report at once, waits for the rest of an unfinished one, and until it has heard
/// all steps of `init`, answers with its first byte alone and drives nothing. [one thread]
class FakeDevice
{
public:
    struct Options
    {
        Wire wire = Wire::serial;
        std::string link;   ///< a symbolic link that always leads to the serial line; replaced if it leads nowhere. Empty: none
        int port = 0;       ///< of UDP; 0: any
        std::vector<DeviceFault> faults;
    };

    /// An event on the wire. `bytes` is one report, or bytes that are no report.
    struct Line
    {
        enum class What
        {
            sent,
            heard,
            released   ///< the watchdog has released the motors; no bytes
        };

        What what;
        std::uint64_t step;   ///< counted from 1
        std::span<const std::uint8_t> bytes;
    };

    struct Counts
    {
        std::uint64_t sent = 0;       ///< reports
        std::uint64_t heard = 0;      ///< valid reports
        std::uint64_t refused = 0;    ///< reports with a wrong CRC, length or id
        std::uint64_t stray = 0;      ///< bytes that belong to no report
        std::uint64_t released = 0;   ///< times that the watchdog has released the motors
    };

    /// The hand may be any simulated device. Its layout is not used. Ids: device/wire, fake/wire if the profile does not know the wire, fake/link; for HID,
    /// also those of VirtualHid, and fake/hidraw if the kernel makes no file for the device.
    static Result<std::unique_ptr<FakeDevice>> make (std::shared_ptr<const Profile>, std::unique_ptr<Device> hand, Options);

    ~FakeDevice();
    FakeDevice (const FakeDevice&) = delete;
    FakeDevice& operator= (const FakeDevice&) = delete;

    /// Called for each event on the wire.
    std::function<void (const Line&)> on_line;

    /// Has a fault from now on, for a duration in s of its own time.
    void fail (DeviceFault::Kind kind, double duration_s) { options.faults.push_back ({ kind, time(), time() + duration_s }); }

    /// One tick: takes the reports that have come, moves the hand, and sends its input reports.
    void step();

    /// Takes a report that has come, or waits for one. False if none comes. step() calls it without waiting, until there is none.
    bool hear (WireFile::Clock::time_point until);

    std::string place() const { return name; }   ///< what a program opens: "/dev/pts/3", "127.0.0.1:9750", "/dev/hidraw3"
    double rate() const noexcept { return rate_hz; }
    double time() const noexcept { return static_cast<double> (steps) / rate_hz; }   ///< s
    const Effort& effort() const noexcept { return applied; }                        ///< what the motors do now
    const Reading& reading() const noexcept { return hand_reading; }
    Counts counts() const noexcept;

private:
    FakeDevice (std::shared_ptr<const Profile>, std::unique_ptr<Device> hand, Options);

    Result<> connect();
    Result<> plug();
    Result<> findFile();
    bool isConnected() const noexcept { return wire || hid; }
    Bytes answerTo (std::uint8_t id, bool is_feature) const;
    bool is (DeviceFault::Kind) const noexcept;
    void comeAndGo();
    void restart();
    bool isStep (std::span<const std::uint8_t> report);
    void take (std::span<const std::uint8_t> report);
    void send (const Bytes& report);
    void tell (Line::What, std::span<const std::uint8_t>) const;
    std::uint32_t random() noexcept;

    const std::shared_ptr<const Profile> profile;
    const std::unique_ptr<Device> hand;
    Options options;
    const double rate_hz, watchdog;
    int port = 0;
    const std::string serial;   // of a HID device: no other one has it
    std::string name;
    std::optional<WireFile> wire;   // this or the other, or none while it is away
    std::unique_ptr<VirtualHid> hid;
    DeviceSide side;
    Framing framing = Framing::none;
    const bool answers;
    std::vector<Bytes> init;   // of a device that answers
    LineReader lines;
    Reading hand_reading;
    Effort applied;
    Counts tally;
    std::vector<Bytes> previous;   // the input reports of the step before
    std::uint64_t steps = 0, last_valid = 0;
    std::size_t set_up = 0;   // steps of `init` heard
    bool is_driven = false;
    std::uint32_t seed = 0x12345678;
};

}   // namespace tactus::host::hid
