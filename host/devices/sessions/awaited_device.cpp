// SPDX-License-Identifier: MIT
#include "awaited_device.hpp"

#include <tactus/text/caught.hpp>

#include <utility>

namespace tactus::host
{

AwaitedDevice::AwaitedDevice (Json d, std::shared_ptr<const hid::Profile> p, hid::HidSystem& s, std::chrono::milliseconds t)
    : description (std::move (d)), wanted (std::move (p)), system (s), pause (t)
{
}

AwaitedDevice::~AwaitedDevice()
{
    {
        const std::lock_guard lock (mutex);
        stopping = true;
    }
    stopped.notify_all();
}

/// The search starts here and not in the constructor, because a caller that only asks for the layout must not open the device.
void AwaitedDevice::prepare (double dt_s)
{
    dt = dt_s;
    if (! looking.joinable())
        looking = std::jthread ([this] {
            while (device() == nullptr && ! isStopping())
                if (const auto looked = caught (wanted->id, [this] { lookOn(); }); ! looked) note (looked.error().text);
        });
}

Reading AwaitedDevice::read() noexcept
{
    if (auto* d = device()) return d->read();
    Reading nothing;
    nothing.valid = false;
    nothing.age = age += dt;
    return nothing;
}

void AwaitedDevice::write (const Effort& guarded) noexcept
{
    if (auto* d = device()) d->write (guarded);
}

void AwaitedDevice::withhold() noexcept
{
    if (auto* d = device()) d->withhold();
}

void AwaitedDevice::limitSignals (double max, double max_slew)
{
    const std::lock_guard lock (mutex);
    max_signal = max;
    max_signal_slew = max_slew;
    if (auto* d = device()) d->limitSignals (max, max_slew);
}

DeviceLayout AwaitedDevice::layout() const { return hid::layoutOf (hid::HidModel (wanted)); }

std::string AwaitedDevice::trouble() const
{
    const std::lock_guard lock (mutex);
    return last_trouble;
}

void AwaitedDevice::lookOn()
{
    while (device() == nullptr)
    {
        poll();
        std::unique_lock lock (mutex);
        if (stopped.wait_for (lock, pause, [this] { return stopping; }))
            return;
    }
}

void AwaitedDevice::poll()
{
    auto made = hid::openDevice (description, {}, system, { .profiles = { wanted }, .messages = {} });
    if (auto* d = dynamic_cast<hid::HidDevice*> (made.device.get()))
    {
        d->limitSlews (slews[0], slews[1], slews[2]);
        d->prepare (dt);
        opened = std::move (made.device);
        const std::lock_guard lock (mutex);
        d->limitSignals (max_signal, max_signal_slew);
        there.store (d, std::memory_order_release);
        return;
    }
    note (made.messages.empty() ? std::string() : made.messages.back().text);
}

void AwaitedDevice::note (const std::string& trouble)
{
    const std::lock_guard lock (mutex);
    last_trouble = trouble;
}

bool AwaitedDevice::isStopping() const
{
    const std::lock_guard lock (mutex);
    return stopping;
}

}   // namespace tactus::host
