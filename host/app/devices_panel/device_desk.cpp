// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_desk.hpp"

#include <algorithm>
#include <chrono>

namespace tactus::host
{

DeviceDesk::DeviceDesk (hid::HidSystem& s, const hid::LoadedProfiles& p) : devices (s), known (p) {}

DeviceDesk::~DeviceDesk()
{
    {
        const std::lock_guard lock (mutex);
        ends = true;
    }
    changed.notify_all();
}

void DeviceDesk::open (const std::filesystem::path& home)
{
    now = loadUsualSession (home);
    is_kept = ! home.empty();
    if (onChange) onChange();
}

std::optional<Message> DeviceDesk::edit (const std::function<void (DeviceSession&)>& change)
{
    if (is_kept)
    {
        auto edited = editSession (now, change);
        if (! edited.isGood()) return *std::ranges::find (edited.messages, Message::Severity::error, &Message::severity);
        now = std::move (edited);
    }
    else
        change (now.session);
    if (onChange) onChange();
    return std::nullopt;
}

void DeviceDesk::look (bool wanted)
{
    {
        const std::lock_guard lock (mutex);
        if (looks == wanted) return;
        looks = wanted;
    }
    changed.notify_all();
    if (wanted && ! looking.joinable())
        looking = std::jthread ([this]
                                { lookOn(); });
}

std::vector<hid::ConnectedDevice> DeviceDesk::connected() const
{
    const std::lock_guard lock (mutex);
    return there;
}

void DeviceDesk::lookOn()
{
    using namespace std::chrono_literals;
    std::unique_lock lock (mutex);
    while (! ends)
    {
        changed.wait (lock, [this]
                      { return ends || looks; });
        if (ends) return;
        lock.unlock();
        auto found = hid::eachOnce (devices.connected(), known);
        lock.lock();
        there = std::move (found);
        changed.wait_for (lock, 1s, [this]
                          { return ends; });
    }
}

}   // namespace tactus::host
