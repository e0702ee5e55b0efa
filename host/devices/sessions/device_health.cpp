// SPDX-License-Identifier: MIT
#include "device_health.hpp"

#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
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
struct LatestReport
{
    double at_s = 0.0;
    std::uint64_t reports = 0;
};

std::optional<LatestReport> latestOf (const hid::HidDevice& d)
{
    const auto& port = d.port();
    for (int tries = 0; tries < 8; ++tries)
    {
        const auto before = port.lastArrival();
        const auto reports = port.counts().reports;
        if (before != 0 && before == port.lastArrival()) return LatestReport { 1e-9 * static_cast<double> (before), reports };
    }
    return std::nullopt;
}

/// True if the rate of the profile is that of all reports that come.
bool hasOneRate (const hid::Profile& p) { return hasClock (p) && p.inputs.size() == 1; }

constexpr double most_off = 0.02;   // of the nominal rate; the crystals of boards are off by less than 0.0001

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

std::optional<PluginRole> pluginRole (const std::string& role, Device& device)
{
    const auto* of_plugin = dynamic_cast<const PluginDevice*> (&device);
    return of_plugin != nullptr ? std::optional (PluginRole { role, of_plugin }) : std::nullopt;
}

std::string describe (const DeviceHealth& h)
{
    if (! h.has_come) return "not available yet" + (h.trouble.empty() ? std::string() : ": " + h.trouble);
    if (! h.connected) return "unplugged" + (h.trouble.empty() ? std::string() : ": " + h.trouble);
    auto text = h.rate_hz ? printed ("%.1f reports/s, ", *h.rate_hz) : std::string();
    if (h.reached_hz > 0.0) text += printed ("%.0f efforts/s reach it, ", h.reached_hz);
    text += printed ("latest %.1f ms old", 1e3 * h.age);
    if (h.ticks) text += h.read_by_tick ? ", ticks the run directly" : ", ticks the run through a reading thread";
    if (h.drift_ppm) text += printed (", clock %+.0f ppm", *h.drift_ppm);
    if (h.lost > 0) text += ", " + std::to_string (h.lost) + " lost";
    if (h.warning) text += ", " + h.warning->text;
    return text;
}

HealthWatch::Meter& HealthWatch::meterOf (const std::string& role)
{
    const auto at = std::ranges::find (meters, role, &Meter::role);
    return at != meters.end() ? *at : meters.emplace_back (Meter { .role = role });
}

void HealthWatch::Meter::add (double at_s, std::uint64_t reports, double longest_gap_s) noexcept
{
    if (at_s - latest_s > longest_gap_s)
    {
        rate.reset();
        recent.reset();
    }
    latest_s = at_s;
    rate.add (at_s, reports);
    recent.add (at_s, reports);
}

void HealthWatch::judgeRate (Meter& meter, DeviceHealth& h, double nominal_hz) const
{
    if (meter.recent.span() >= shortest_span)
        if (const auto rate = std::exchange (meter.recent, {}).rate())
        {
            const double off = rate->hz / nominal_hz - 1.0;
            const int way = std::abs (off) <= most_off + 3.0 * rate->error / nominal_hz ? 0 : (off < 0.0 ? -1 : 1);
            meter.wrong = way == 0 || way * meter.wrong < 0 ? way : meter.wrong + way;
            meter.wrong_hz = rate->hz;
        }
    if (std::abs (meter.wrong) < 2) return;
    const auto sent = numberText (std::round (meter.wrong_hz));
    auto text = "the board sends " + sent + " reports/s, its profile says " + numberText (nominal_hz);
    if (h.ticks) text += ": the graph runs at " + numberText (std::round (100.0 * meter.wrong_hz / nominal_hz)) + " % of its speed";
    h.warning = Message::warning ("device/rate", h.role, std::move (text),
                                  "set \"rate\" to " + sent + " in the profile " + h.profile + ", or correct the firmware");
}

void HealthWatch::poll (const PluginRole& plugin)
{
    const auto& device = *plugin.device;
    const auto counts = device.counts();
    auto& h = known.emplace_back();
    h.role = plugin.role;
    h.profile = device.driver();
    h.has_come = true;
    h.connected = device.isConnected();
    h.age = device.age();
    h.oldest = counts.oldest;
    h.reports = counts.readings;
    h.lost = counts.lost;
    h.departures = counts.departures;
    h.trouble = device.trouble();
    h.reached_hz = counts.reached_hz;

    auto& meter = meterOf (plugin.role);
    if (std::exchange (meter.departures, counts.departures) != counts.departures) meter.rate.reset();
    const std::chrono::duration<double> at = device.lastArrival().time_since_epoch();
    if (h.connected && at.count() > 0.0) meter.add (at.count(), counts.readings + counts.lost, longestGap());
    if (const auto rate = meter.rate.rate()) h.rate_hz = rate->hz;
}

void HealthWatch::poll (std::span<const RealDevice> devices, std::span<const PluginRole> plugins)
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
        if (std::exchange (meter.departures, port.departures) != port.departures) meter = { .role = real.role, .departures = port.departures };
        if (const auto latest = latestOf (*device); latest && h.connected)
            meter.add (latest->at_s, latest->reports + read.lost, longestGap());
        if (const auto rate = meter.rate.rate()) h.rate_hz = rate->hz;
        if (hasOneRate (real.profile())) judgeRate (meter, h, real.profile().rate);
        if (port.reports == 0 && port.stray > 0)
            h.warning = Message::warning ("device/no_frame", h.role, hid::describeStray (port),
                                          "compare \"wires\" of the profile " + h.profile + " with the firmware");
    }

    for (const auto& plugin : plugins)
        poll (plugin);

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
