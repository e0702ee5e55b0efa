// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_setup.hpp"

#include <host/devices/hid_link/force_feedback.hpp>
#include <host/devices/sessions/audio_settings.hpp>
#include <tactus/text/caught.hpp>

#include <algorithm>
#include <chrono>
#include <tuple>
#include <utility>

namespace tactus::host
{

DeviceSetup::DeviceSetup (hid::HidSystem& s, const hid::LoadedProfiles& p, ListEvents events, ListOffered offered, AskDrivers asked)
    : devices (s), known (p), list_events (events), list_offered (offered), ask_drivers (asked)
{
}

DeviceSetup::~DeviceSetup()
{
    {
        const std::lock_guard lock (mutex);
        ends = true;
    }
    changed.notify_all();
}

void DeviceSetup::open (const std::filesystem::path& home)
{
    now = loadDefaultSession (home);
    is_saved = ! home.empty();
    seen = stampOfFile();
    if (onChange) onChange();
}

bool DeviceSetup::movesTool (const std::string& role) const
{
    const auto* bound = now.session.binding (role);
    return bound != nullptr && ! audio::isAudio (*bound);
}

Result<> DeviceSetup::edit (const std::function<void (DeviceSession&)>& change)
{
    if (is_saved)
    {
        readAgain();
        auto edited = editSession (now, change);
        if (! edited.isGood()) return *std::ranges::find (edited.messages, Message::Severity::error, &Message::severity);
        now = std::move (edited);
        seen = stampOfFile();
    }
    else
        change (now.session);
    if (onChange) onChange();
    return {};
}

DeviceSetup::Stamp DeviceSetup::stampOfFile() const
{
    std::error_code failed;
    const auto written = std::filesystem::last_write_time (now.file, failed);
    const auto size = failed ? 0 : std::filesystem::file_size (now.file, failed);
    return failed ? Stamp() : Stamp ({ written, size });
}

void DeviceSetup::follow()
{
    if (is_saved && stampOfFile() != seen) readAgain();
}

/// A file that cannot be read, such as one that is still being written, changes nothing.
void DeviceSetup::readAgain()
{
    seen = stampOfFile();
    auto read = rereadSession (now.file);
    if (std::ranges::count (read.messages, "session/foreign", &Message::id) > 0) now.messages = read.messages;   // edit() refuses from now on
    if (! read.isGood() || read.session == now.session) return;
    const auto before = std::exchange (now, std::move (read));
    if (onChangedElsewhere) onChangedElsewhere (before.session);
}

void DeviceSetup::scan (bool on)
{
    {
        const std::lock_guard lock (mutex);
        if (scans == on) return;
        scans = on;
    }
    changed.notify_all();
    if (on && ! scanner.joinable())
        scanner = std::jthread ([this] { static_cast<void> (caught ({}, [this] { scanLoop(); })); });
}

std::vector<hid::ConnectedDevice> DeviceSetup::connected() const
{
    const std::lock_guard lock (mutex);
    return found;
}

std::vector<hid::ConnectedDevice> DeviceSetup::withoutProfile() const
{
    const std::lock_guard lock (mutex);
    return found_without_profile;
}

std::vector<ConnectedEvents> DeviceSetup::events() const
{
    const std::lock_guard lock (mutex);
    return found_events;
}

std::vector<OfferedDevice> DeviceSetup::offered() const
{
    std::vector<OfferedDevice> all;
    {
        const std::lock_guard lock (mutex);
        all = found_offered;
    }
    const std::lock_guard lock (answer->mutex);
    all.insert (all.end(), answer->found.begin(), answer->found.end());
    return all;
}

void DeviceSetup::askDrivers()
{
    const std::lock_guard lock (answer->mutex);
    if (std::exchange (answer->is_asking, true)) return;
    std::thread ([to = answer, ask = ask_drivers] {
        static_cast<void> (caught ({}, [&] {
            Messages messages;
            auto found = caught ({}, [&] { return ask (messages); });
            if (! found) messages.push_back (found.error());
            const std::lock_guard done (to->mutex);
            to->found = found ? std::move (*found) : std::vector<OfferedDevice> {};
            to->messages = std::move (messages);
            to->is_asking = false;
            to->is_new = true;
        }));
    }).detach();
}

std::optional<std::pair<std::size_t, Messages>> DeviceSetup::takeAnswer()
{
    const std::lock_guard lock (answer->mutex);
    if (! std::exchange (answer->is_new, false)) return std::nullopt;
    return std::pair { answer->found.size(), answer->messages };
}

void DeviceSetup::scanLoop()
{
    using namespace std::chrono_literals;
    std::unique_lock lock (mutex);
    while (! ends)
    {
        changed.wait (lock, [this] { return ends || scans; });
        if (ends) return;
        lock.unlock();
        auto look = caught ({}, [this] {
            auto connected_now = hid::eachOnce (devices.connected(), known);
            auto without_profile = connected_now;
            std::erase_if (without_profile,
                           [&] (const auto& d) { return ! hid::matching (known.profiles, d).empty() || ! hid::hasForceFeedback (devices, d); });
            return std::tuple { std::move (connected_now), std::move (without_profile), list_events(), list_offered (known) };
        });
        lock.lock();
        if (look) std::tie (found, found_without_profile, found_events, found_offered) = std::move (*look);   // else it looks again a second later
        changed.wait_for (lock, 1s, [this] { return ends; });
    }
}

}   // namespace tactus::host
