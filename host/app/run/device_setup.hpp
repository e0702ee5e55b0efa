// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "connected_events.hpp"
#include "device_profiles.hpp"

#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/sessions/offered_devices.hpp>
#include <host/devices/sessions/session_file.hpp>
#include <tactus/text/result.hpp>

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace tactus::host
{

/// The session of the window, which is saved at each edit, and the devices that are plugged in. [main thread]
class DeviceSetup
{
public:
    using ListEvents = std::vector<ConnectedEvents> (*)();
    using AskDrivers = std::vector<OfferedDevice> (*) (Messages&);
    using ListOffered = std::vector<OfferedDevice> (*) (const hid::LoadedProfiles&);

    explicit DeviceSetup (hid::HidSystem& = hid::thisComputer(), const hid::LoadedProfiles& = deviceProfiles(), ListEvents = connectedEvents,
                          ListOffered = offeredDevices, AskDrivers = foundDevices);
    ~DeviceSetup();

    /// Reads the user's session. Before that, the session is empty and is not saved.
    void open (const std::filesystem::path& home);

    const LoadedSession& session() const noexcept { return now; }
    bool movesTool (const std::string& role) const;   ///< true if the session binds the role to a device, and not only to a sound card
    hid::HidSystem& system() const noexcept { return devices; }
    const hid::LoadedProfiles& profiles() const noexcept { return known; }

    /// Changes the session and its file, or neither. Changes of the file by another program are read first.
    Result<> edit (const std::function<void (DeviceSession&)>&);

    /// Notices that another program, such as `tactus session`, has changed the file of the session. Call a few times a second: for an unchanged
    /// file, it costs two system calls.
    void follow();

    std::function<void()> onChange;   ///< called when edit() or open() has changed the session

    /// Called when another program has changed the session, with the previous one. The new one must not drive a device until a person presses START.
    std::function<void (const DeviceSession& before)> onChangedElsewhere;

    /// Turns the scan for connected devices on or off. It runs once a second, on its own thread.
    void scan (bool on);
    std::vector<hid::ConnectedDevice> connected() const;        ///< as of the last scan
    std::vector<hid::ConnectedDevice> withoutProfile() const;   ///< of these, the devices with force feedback that no profile fits
    std::vector<ConnectedEvents> events() const;                ///< event devices, as of the last scan
    std::vector<OfferedDevice> offered() const;                 ///< devices at serial ports, as of the last scan, and those that drivers have found

    /// Asks the drivers in plugins for their devices, as a person wants. Loads all of them, on a thread of its own, because a driver may take seconds. If one
    /// never returns, the thread is left behind.
    void askDrivers();

    /// The number of devices that the drivers have found, and the messages of those that cannot look: once for each time they were asked.
    std::optional<std::pair<std::size_t, Messages>> takeAnswer();

private:
    using Stamp = std::optional<std::pair<std::filesystem::file_time_type, std::uintmax_t>>;   // empty: there is no file

    void scanLoop();
    Stamp stampOfFile() const;
    void readAgain();

    hid::HidSystem& devices;
    const hid::LoadedProfiles& known;
    const ListEvents list_events;
    const ListOffered list_offered;
    const AskDrivers ask_drivers;

    /// The answers of drivers. The thread that asks them shares it.
    struct Answer
    {
        std::mutex mutex;
        bool is_asking = false, is_new = false;
        std::vector<OfferedDevice> found;
        Messages messages;
    };
    const std::shared_ptr<Answer> answer = std::make_shared<Answer>();

    LoadedSession now;
    bool is_saved = false;
    Stamp seen;   // of the file, when it was last read or written

    mutable std::mutex mutex;   // guards the members below
    std::condition_variable changed;
    bool scans = false, ends = false;
    std::vector<hid::ConnectedDevice> found, found_without_profile;
    std::vector<ConnectedEvents> found_events;
    std::vector<OfferedDevice> found_offered;
    std::jthread scanner;   // declared last: it uses the members above
};

}   // namespace tactus::host
