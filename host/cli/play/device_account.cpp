// SPDX-License-Identifier: GPL-3.0-or-later
#include "device_account.hpp"

#include <host/devices/hid_link/hid_device.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace tactus::host
{
namespace
{
std::string times (std::uint64_t n) { return n == 1 ? "once" : std::to_string (n) + " times"; }

std::string milliseconds (double s)
{
    char text[32];
    std::snprintf (text, sizeof text, "%.2f", 1e3 * s);
    return text;
}

/// As in "    1000.31 reports/s; its clock runs 12.3 +- 0.4 ppm faster than the run's; readings up to 3.00 ms old".
std::string clockOf (const DeviceHealth& h)
{
    char text[160];
    std::string line;
    if (h.rate_hz)
    {
        std::snprintf (text, sizeof text, "%.2f reports/s", *h.rate_hz);
        line = text;
    }
    if (h.ticks) addToList (line, std::string ("which tick the run ") + (h.read_by_tick ? "directly" : "through a reading thread"));
    if (h.drift_ppm)
    {
        const auto* way = *h.drift_ppm < 0.0 ? "slower" : "faster";
        std::snprintf (text, sizeof text, "; its clock runs %.1f +- %.1f ppm %s than the run's", std::abs (*h.drift_ppm), h.drift_error_ppm, way);
        line += text;
    }
    return "    " + line + (line.empty() ? "" : "; ") + "readings up to " + milliseconds (h.oldest) + " ms old\n";
}

/// As in "stylus (serial_arm): 5000 readings, 3 lost, 1 malformed".
std::string accountOf (const PluginRole& plugin, std::span<const DeviceHealth> health)
{
    const auto& device = *plugin.device;
    const auto counts = device.counts();
    auto text = printableName (plugin.role) + " (" + printableName (device.driver()) + "): " + std::to_string (counts.readings) + " readings";
    const auto tell = [&] (std::uint64_t count, const char* what) {
        if (count > 0) text += ", " + std::to_string (count) + " " + what;
    };
    tell (counts.lost, "lost");
    tell (counts.repeated, "repeated");
    tell (counts.refused, "malformed");
    tell (counts.restarts, "out of order");
    tell (counts.read_errors, "failures of the driver to read");
    text += "\n";
    if (const auto h = std::ranges::find (health, plugin.role, &DeviceHealth::role); h != health.end()) text += clockOf (*h);
    if (counts.writes > 0)
    {
        text += "    " + std::to_string (counts.writes) + " efforts written, " + std::to_string (counts.write_errors) + " failed";
        if (counts.reached_hz > 0.0) text += "; " + numberText (std::round (counts.reached_hz)) + " new ones per second reached the device";
        text += "\n";
    }
    if (counts.silences > 0)
        text += "    the run paused " + times (counts.silences) + " for longer than the watchdog allows, so the force was released\n";
    if (counts.departures > 0)
        text += "    the device was gone " + times (counts.departures) + (device.isConnected() ? "\n" : ", and is still gone\n");
    if (const auto trouble = device.trouble(); ! trouble.empty()) text += "    last problem: " + printableName (trouble) + "\n";
    return text;
}
}   // namespace

std::string statusOf (std::span<const DeviceHealth> devices, const RunClock* clock)
{
    std::string text;
    for (const auto& h : devices)
        text += "   " + printableName (h.role) + " " + printableName (describe (h));
    if (clock == nullptr || ! clock->isByTimer()) return text;
    text += "   the timer ticks the run because no reports arrive";
    if (clock->isReplaced()) text += "; forces are held at zero";
    return text;
}

std::string accountOf (std::span<const RealDevice> devices, std::span<const PluginRole> plugins, std::span<const DeviceHealth> health,
                       const RunClock* clock)
{
    std::string text;
    for (const auto& real : devices)
    {
        const auto called = printableName (real.role) + " (" + printableName (real.profile().id) + ")";
        const auto* device = real.device();
        if (device == nullptr)
        {
            const auto trouble = real.awaited->trouble();
            text += called + ": the device was never available" + (trouble.empty() ? std::string() : "; " + printableName (trouble)) + "\n";
            continue;
        }
        const auto read = device->counts();
        const auto port = device->port().counts();
        text += called + ": " + std::to_string (port.reports) + " reports, "
                + (port.asked_for > 0 ? std::to_string (port.asked_for) + " asked for, " : std::string()) + hid::describe (read, port) + "\n";
        if (const auto h = std::ranges::find (health, real.role, &DeviceHealth::role); h != health.end()) text += clockOf (*h);
        if (port.writes > 0)
        {
            text += "    " + std::to_string (port.writes) + " reports sent, " + std::to_string (port.write_errors) + " failed, ";
            text += std::to_string (port.dropped) + " replaced by newer ones; time from a received report to the answer: " + milliseconds (port.latency_min);
            text += " to " + milliseconds (port.latency_max) + " ms, mean " + milliseconds (port.latency_mean) + " ms\n";
        }
        if (port.silences > 0)
            text += "    the run paused " + times (port.silences) + " for longer than the device's watchdog allows, so the force was released\n";
        if (port.departures > 0)
        {
            text += "    the device was unplugged " + times (port.departures);
            text += device->port().isConnected() ? "\n" : ", and is still unplugged\n";
        }
        if (const auto h = std::ranges::find (health, real.role, &DeviceHealth::role); h != health.end() && h->warning)
            text += "    " + printableName (h->warning->text) + "; " + printableName (h->warning->remedy) + "\n";
        if (const auto trouble = device->port().trouble(); ! trouble.empty()) text += "    last problem: " + printableName (trouble) + "\n";
    }
    for (const auto& plugin : plugins)
        text += accountOf (plugin, health);
    if (clock != nullptr && clock->ticksByTimer() > 0)
        text += "    " + std::to_string (clock->ticksByTimer()) + (clock->ticksByTimer() == 1 ? " tick" : " ticks")
                + " came from the timer because no reports arrived\n";
    return text;
}

}   // namespace tactus::host
