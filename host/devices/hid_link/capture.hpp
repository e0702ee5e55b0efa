// SPDX-License-Identifier: MIT
#pragma once

#include "transport.hpp"

#include <host/devices/hid/profile.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/result.hpp>

#include <cstdint>
#include <fstream>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host::hid
{

/// Reports that passed between this computer and a device, as `tactus devices --capture` records them. One JSON object a line:
///
///     {"format":"tactus-capture","version":1,"wire":"serial","profile":"tactus_board"}
///     {"t":0.0012,"in":"54 01 01 00"}
///
/// The first line may also have the ids of a HID device and its report descriptor. `t` is in s. Serial numbers and paths are not in the file.
///
/// Messages between a driver and a service are recorded as text: {"format":…,"version":1,"wire":"websocket","driver":"haply"} and {"t":0.002,"in":"{}"}.
/// They are as they were, so they have whatever the service says about its devices.
struct Capture
{
    /// One line after the first. `bytes` are as HidPort gets and sends them: a report id comes first if the device uses ids; if not, `in` has
    /// none and what is sent has a 0. A line without a profile has no reports: `in` then has the bytes that came together.
    struct Line
    {
        enum class What
        {
            in,
            out,
            feature_in,   ///< the answer to a request
            feature_out,
            gone   ///< the device was unplugged, or a transfer failed; no bytes
        };

        What what = What::in;
        double t = 0.0;
        Bytes bytes {};

        bool operator== (const Line&) const = default;
    };

    std::string profile;        ///< the id; empty if none fitted
    std::string driver;         ///< the one that talks with a service; empty: the lines are reports
    std::optional<Wire> wire;   ///< none for a service
    std::vector<Line> lines;
};

/// Reads a capture. A last line without an end is left out, because the program may have been killed. Ids: capture/format, capture/version,
/// capture/line, and file/… of readJson; each message has its line. [main thread]
Result<Capture> readCapture (std::string_view text);

/// Writes a capture while it is made, each line at once. [any thread]
class CaptureFile
{
public:
    /// Replaces the file. Id: output/unwritable.
    static Result<std::unique_ptr<CaptureFile>> create (const std::string& path, const ConnectedDevice&, std::string_view profile, const Bytes& descriptor);

    /// The same for messages between a driver and a service.
    static Result<std::unique_ptr<CaptureFile>> createForMessages (const std::string& path, std::string_view driver);

    void add (Capture::Line::What, std::span<const std::uint8_t>) noexcept;   ///< now

    std::uint64_t lines() const noexcept;   ///< written so far, without the first
    bool isGood() const noexcept;           ///< false after a write has failed

private:
    CaptureFile (std::ofstream f, bool text) : file (std::move (f)), is_text (text) {}
    static Result<std::unique_ptr<CaptureFile>> begin (const std::string& path, const Json& head, bool is_text);

    mutable std::mutex mutex;
    std::ofstream file;
    const bool is_text;   // messages, not reports
    std::uint64_t count = 0;
    const std::chrono::steady_clock::time_point began = std::chrono::steady_clock::now();
};

/// A system that records the reports to and from the devices that are opened with it. The other system and the file must outlive it and all that it
/// opens. [any thread]
class CapturingSystem final : public HidSystem
{
public:
    CapturingSystem (HidSystem& s, CaptureFile& f) : system (s), file (f) {}

    std::vector<ConnectedDevice> connected() override { return system.connected(); }
    Result<std::unique_ptr<Transport>> open (const ConnectedDevice&) override;
    Result<std::unique_ptr<Transport>> reach (const ConnectedDevice&, const Profile&) override;
    Bytes reportDescriptor (const ConnectedDevice& device) override { return system.reportDescriptor (device); }
    std::chrono::steady_clock::time_point now() const noexcept override { return system.now(); }
    bool mayOpen (const ConnectedDevice& device) override { return system.mayOpen (device); }

private:
    HidSystem& system;
    CaptureFile& file;
};

}   // namespace tactus::host::hid
