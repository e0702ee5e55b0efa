// SPDX-License-Identifier: MIT
#include "device_health.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace tactus::host
{

namespace
{
/// True if the device reports at a fixed rate, which can be compared with other clocks. A device that sends only when something
/// moves has no such rate.
bool hasClock (const hid::Profile& p) { return p.rate > 0.0 && ! hid::sendsOnlyChanges (p); }

/// The time of the latest report, and the number of reports. The two are stored one after the other, so about one look in a
/// thousand sees an inconsistent pair, which is off by one report.
struct Latest
{
    double at_s = 0.0;
    std::uint64_t reports = 0;
};

std::optional<Latest> latestOf (const hid::HidDevice& d)
{
    const auto& port = d.port();
    for (int tries = 0; tries < 8; ++tries)
    {
        const auto before = port.lastArrival();
        const auto reports = port.counts().reports;
        if (before != 0 && before == port.lastArrival()) return Latest { 1e-9 * static_cast<double> (before), reports };
    }
    return std::nullopt;
}

template <typename... T>
std::string printed (const char* format, T... values)
{
    char text[64];
    std::snprintf (text, sizeof text, format, values...);
    return text;
}
}   // namespace

std::optional<RealDevice> realDevice (const std::string& role, Device& device)
{
    if (auto* present = dynamic_cast<hid::HidDevice*> (&device)) return RealDevice { role, present, nullptr };
    if (const auto* awaited = dynamic_cast<const AwaitedDevice*> (&device)) return RealDevice { role, nullptr, awaited };
    return std::nullopt;
}

std::string describe (const DeviceHealth& h)
{
    if (! h.has_come) return "not available yet" + (h.trouble.empty() ? std::string() : ": " + h.trouble);
    if (! h.connected) return "unplugged";
    auto text = h.rate_hz ? printed ("%.1f reports/s, ", *h.rate_hz) : std::string();
    text += printed ("latest %.1f ms old", 1e3 * h.age);
    if (h.ticks) text += h.read_by_tick ? ", ticks the run directly" : ", ticks the run through a reading thread";
    if (h.drift_ppm) text += printed (", clock %+.0f ppm", *h.drift_ppm);
    if (h.lost > 0) text += ", " + std::to_string (h.lost) + " lost";
    return text;
}

HealthWatch::Meter& HealthWatch::meterOf (const std::string& role)
{
    const auto at = std::ranges::find (meters, role, &Meter::role);
    return at != meters.end() ? *at : meters.emplace_back (Meter { role, {} });
}

void HealthWatch::look (std::span<const RealDevice> devices)
{
    known.clear();
    for (const auto& real : devices)
    {
        auto& h = known.emplace_back();
        h.role = real.role;
        h.profile = real.profile().id;
        h.ticks = real.role == clock;
        const auto* device = real.device();
        h.has_come = device != nullptr;
        if (! h.has_come)
        {
            h.trouble = real.awaited->trouble();
            continue;
        }
        const auto read = device->counts();
        const auto port = device->port().counts();
        h.connected = device->port().isConnected();
        h.age = read.age;
        h.oldest = read.oldest;
        h.reports = port.reports;
        h.read_by_tick = port.read_by_tick > 0;
        h.lost = read.lost;
        h.departures = port.departures;
        h.trouble = device->port().trouble();

        auto& meter = meterOf (real.role);
        if (std::exchange (meter.departures, port.departures) != port.departures) meter.rate.reset();
        if (const auto latest = latestOf (*device); latest && h.connected) meter.rate.look (latest->at_s, latest->reports + read.lost);
        if (const auto rate = meter.rate.rate()) h.rate_hz = rate->hz;
    }

    // The speed of a device's clock relative to its nominal rate.
    const auto speed = [&] (const std::string& role) -> std::optional<RateMeter::Rate> {
        const auto real = std::ranges::find (devices, role, &RealDevice::role);
        if (real == devices.end() || ! hasClock (real->profile())) return std::nullopt;
        const auto& meter = meterOf (role).rate;
        const auto rate = meter.rate();
        if (! rate || meter.span() < shortest_span) return std::nullopt;
        return RateMeter::Rate { rate->hz / real->profile().rate, rate->error / real->profile().rate };
    };
    const bool by_device = std::ranges::count (devices, clock, &RealDevice::role) > 0;
    const auto reference = by_device ? speed (clock) : RateMeter::Rate { 1.0, 0.0 };
    for (auto& h : known)
    {
        if (h.ticks) continue;
        const auto own = speed (h.role);
        if (! own || ! reference || reference->hz <= 0.0) continue;
        h.drift_ppm = 1e6 * (own->hz / reference->hz - 1.0);
        h.drift_error_ppm = 1e6 * (own->error + reference->error);
    }
}

}   // namespace tactus::host
