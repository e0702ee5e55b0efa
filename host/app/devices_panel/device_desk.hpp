// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/model/device_profiles.hpp>
#include <host/hid_link/open_device.hpp>
#include <host/sessions/session_file.hpp>

#include <condition_variable>
#include <mutex>
#include <thread>

namespace tactus::host
{

/// The session of the window, kept in its file at once as it is edited, and the devices that are plugged in. [main thread]
class DeviceDesk
{
public:
    explicit DeviceDesk (hid::HidSystem& = hid::thisComputer(), const hid::LoadedProfiles& = deviceProfiles());
    ~DeviceDesk();

    /// Reads the user's session. Before that there is an empty one, which is kept nowhere.
    void open (const std::filesystem::path& home);

    const LoadedSession& session() const noexcept { return now; }
    hid::HidSystem& system() const noexcept { return devices; }
    const hid::LoadedProfiles& profiles() const noexcept { return known; }

    /// Changes the session and its file. Returns what is wrong, if it could not; then nothing has changed.
    std::optional<Message> edit (const std::function<void (DeviceSession&)>&);

    std::function<void()> onChange;   ///< of the session

    /// The devices that are plugged in are looked for, once a second and not on this thread, while somebody wants to know.
    void look (bool wanted);
    std::vector<hid::ConnectedDevice> connected() const;   ///< as of the last look

private:
    void lookOn();

    hid::HidSystem& devices;
    const hid::LoadedProfiles& known;
    LoadedSession now;
    bool is_kept = false;

    mutable std::mutex mutex;   // of what is below
    std::condition_variable changed;
    bool looks = false, ends = false;
    std::vector<hid::ConnectedDevice> there;
    std::jthread looking;   // last: it uses the others
};

}   // namespace tactus::host
