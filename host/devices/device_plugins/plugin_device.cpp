// SPDX-License-Identifier: MIT
#include "plugin_device.hpp"
#include "plugin_link.hpp"

#include <tactus/text/caught.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
using Clock = std::chrono::steady_clock;

bool isZero (const Channels& all) noexcept
{
    return std::all_of (all.begin(), all.end(), [] (double v) { return v == 0.0; });
}
}   // namespace

PluginDevice::PluginDevice (std::unique_ptr<OpenedDevice> opened, std::optional<Failsafe> failsafe, const Options& options)
    : described (opened->about()), called (opened->driver().name()), patience (options.patience),
      link (std::make_shared<Link> (std::move (opened), std::move (failsafe), options))
{
    const auto persist = [] (Link& l, auto act) {
        while (! l.isStopping())
            if (const auto done = caught (l.name(), act); ! done) l.note (done.error().text);
    };
    writer = std::thread ([persist, l = link] {
        persist (*l, [&l] { l->writeOn(); });
        if (const auto left = caught (l->name(), [&l] { l->leave(); }); ! left) l->note (left.error().text);
        l->ends (Link::Thread::writing);
    });
    try
    {
        reader = std::thread ([persist, l = link, longest = patience] {
            persist (*l, [&l] { l->readOn(); });
            if (l->waitFor (Link::Thread::writing, Clock::now() + longest)) l->close();
            l->ends (Link::Thread::reading);
        });
    }
    catch (...)
    {
        link->stop();
        writer.join();
        throw;
    }
}

PluginDevice::~PluginDevice()
{
    link->stop();
    const auto end = Clock::now() + patience;
    const auto finish = [&] (std::thread& thread, Link::Thread which) {
        if (link->waitFor (which, end))
            thread.join();
        else
            thread.detach();   // it hangs in the driver, with everything that it needs
    };
    finish (writer, Link::Thread::writing);
    finish (reader, Link::Thread::reading);
}

//==============================================================================
void PluginDevice::prepare (double dt_s)
{
    dt = dt_s;
    has_to_rest = true;
    ticks_without = 0.0;
    restartTime();
}

void PluginDevice::restartTime() noexcept
{
    measured = hid::MeasuredTime { (described.stamps & TACTUS_DEVICE_NUMBERS) != 0, described.rate_hz > 0.0 ? 1.0 / described.rate_hz : dt };
    lag = 0.0;
}

void PluginDevice::limitSlews (double force, double torque, double axis) { link->limitSlews (force, torque, axis); }
void PluginDevice::limitSignals (double max, double /*max_slew*/) { link->limitSignals (max); }

Reading PluginDevice::read() noexcept
{
    const auto now = Clock::now();
    const auto taken = link->taken();
    if (const auto current = link->episode(); current != episode)
    {
        episode = current;
        has_to_rest = true;
        restartTime();
    }

    const bool is_new = taken.number != seen;
    seen = taken.number;
    ticks_without = is_new ? 0.0 : ticks_without + 1.0;
    const double waited = taken.at == 0 ? 0.0 : std::chrono::duration<double> (now.time_since_epoch() - std::chrono::nanoseconds (taken.at)).count();
    const auto& from = taken.reading;
    Reading reading { .position = Vec3 { from.position }, .rotation = Vec3 { from.rotation }, .pressure = from.pressure, .buttons = from.buttons };
    if (is_new && (described.stamps & TACTUS_DEVICE_TIMES) == 0)
    {
        const double passed = (taken.numbered - std::exchange (numbered, taken.numbered)) / (described.rate_hz > 0.0 ? described.rate_hz : 1.0);
        lag = measured (passed, 1e-9 * static_cast<double> (taken.at), reading.position);
    }
    reading.age = from.age_s + taken.lag_s + lag + std::max (ticks_without * dt, waited);
    for (int i = static_cast<int> (from.axis_count) - 1; i >= 0; --i)
        reading.axes.set (i, from.axes[i]);
    for (int i = static_cast<int> (from.signal_count) - 1; i >= 0; --i)
        reading.signals.set (i, from.signals[i]);

    if (! link->isConnected())
        reading.fault = ReadingFault::unplugged;
    else if (link->isStuck (now))
        reading.fault = ReadingFault::stuck;
    else if (taken.number == 0 && taken.fault == 0)
        reading.fault = ReadingFault::no_report;
    else
        reading.fault = static_cast<ReadingFault> (taken.fault);
    reading.valid = reading.fault == ReadingFault::none && from.valid != 0 && ! has_to_rest;
    if (reading.fault == ReadingFault::none && reading.age > 0.0) reading.fault = static_cast<ReadingFault> (taken.standing);

    const auto without = link->unrendered();
    reading.unrendered_force = Vec3 { without.force.data() };
    reading.unrendered_torque = Vec3 { without.torque.data() };
    age_now.store (reading.age, std::memory_order_relaxed);
    if (taken.number != 0) oldest.store (std::max (oldest.load (std::memory_order_relaxed), reading.age), std::memory_order_relaxed);
    return reading;
}

void PluginDevice::write (const Effort& guarded) noexcept
{
    const bool rests = guarded.force.isZero (0.0) && guarded.torque.isZero (0.0) && isZero (guarded.axes) && isZero (guarded.signals);
    has_to_rest = has_to_rest && ! rests;
    const bool stops = std::exchange (is_withheld, false) || has_to_rest;
    link->offer (has_to_rest ? Effort {} : guarded, stops, ++offers, episode);
}

//==============================================================================
bool PluginDevice::isConnected() const noexcept { return link->isConnected(); }
bool PluginDevice::isDriven() const noexcept { return link->isDriven(); }
Clock::time_point PluginDevice::lastArrival() const noexcept { return link->lastArrival(); }
std::string PluginDevice::trouble() const { return link->trouble(); }

PluginCounts PluginDevice::counts() const noexcept
{
    auto all = link->counts();
    all.oldest = oldest.load (std::memory_order_relaxed);
    return all;
}

}   // namespace tactus::host
