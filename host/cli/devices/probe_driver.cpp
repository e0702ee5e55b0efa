// SPDX-License-Identifier: GPL-3.0-or-later
#include "probe_driver.hpp"

#include <host/base/platform/signals.hpp>
#include <host/base/platform/terminal.hpp>
#include <host/cli/report.hpp>
#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/device_plugins/plugin_device.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <thread>
#include <vector>

namespace tactus::host
{

namespace
{
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;
constexpr auto between_looks = 5ms;

std::vector<std::string> pressedOn (const PluginDevice& device, const Reading& latest)
{
    std::vector<std::string> names;
    const auto& all = device.about().layout.buttons;
    for (std::size_t i = 0; i < all.size(); ++i)
        if ((latest.buttons >> i & 1u) != 0) names.push_back (all[i]);
    return names;
}

std::string threeNumbers (const Vec3& v, double scale)
{
    char text[96];
    std::snprintf (text, sizeof text, "%10.4f %10.4f %10.4f", scale * v.x(), scale * v.y(), scale * v.z());
    return text;
}

/// The reason why the readings cannot be used; empty if they can.
std::string faultIn (const Reading& latest) { return latest.fault == ReadingFault::none ? std::string() : std::string (describe (latest.fault)); }

std::string probeText (const std::string& name, const PluginDevice& device, const Reading& latest, double seconds)
{
    const auto& about = device.about();
    const auto readings = device.counts().readings;
    auto text = name + ": " + std::to_string (readings) + " readings, " + numberText (std::round (static_cast<double> (readings) / seconds)) + " per second";
    const auto fault = faultIn (latest);
    text += (fault.empty() ? "" : "; " + fault) + "\n";
    if (about.position) text += "    position " + threeNumbers (latest.position, 1e3) + " mm\n";
    if (about.rotation) text += "    rotation " + threeNumbers (latest.rotation, 1.0) + " rad\n";
    if (about.pressure) text += "    pressure " + numberText (latest.pressure) + " N\n";
    for (std::size_t i = 0; i < about.layout.axes.size(); ++i)
        text += "    " + about.layout.axes[i] + " " + numberText (latest.axes[static_cast<int> (i)]) + "\n";
    if (! about.layout.buttons.empty())
    {
        text += "    pressed:";
        for (const auto& button : pressedOn (device, latest))
            text += " " + button;
        text += "\n";
    }
    if (const auto trouble = device.trouble(); ! trouble.empty()) text += "    last problem: " + trouble + "\n";
    return text;
}

Json probeJson (const std::string& name, const PluginDevice& device, const Reading& latest)
{
    const auto list = [] (const Vec3& v) { return Json { v.x(), v.y(), v.z() }; };
    Json axes = Json::object();
    for (std::size_t i = 0; i < device.about().layout.axes.size(); ++i)
        axes[device.about().layout.axes[i]] = latest.axes[static_cast<int> (i)];
    return { { "device", name },
             { "connected", device.isConnected() },
             { "valid", latest.fault == ReadingFault::none && device.counts().readings > 0 },
             { "fault", faultIn (latest) },
             { "readings", device.counts().readings },
             { "position", list (latest.position) },
             { "rotation", list (latest.rotation) },
             { "pressure", latest.pressure },
             { "axes", std::move (axes) },
             { "pressed", pressedOn (device, latest) },
             { "trouble", device.trouble() } };
}
}   // namespace

bool probeDriver (const std::string& name, double duration_s, bool as_json)
{
    const auto description = parsePluginDevice (name);
    if (description.is_null()) return false;
    watchForStop();
    auto made = openPluginDevice (description);
    for (const auto& m : made.messages)
        if (m.severity == Message::Severity::error)
            fail (m);
        else
            warn (name, m);
    auto& device = dynamic_cast<PluginDevice&> (*made.device);
    device.prepare (std::chrono::duration<double> (between_looks).count());
    Reading latest;
    const auto begin = Clock::now();
    auto shown = begin;
    const auto show = [&] {
        const double seconds = std::max (1e-3, std::chrono::duration<double> (Clock::now() - begin).count());
        std::cout << printable (probeText (name, device, latest, seconds)) << std::flush;
    };
    while (std::cout && ! stopRequested() && (duration_s <= 0.0 || Clock::now() - begin < std::chrono::duration<double> (duration_s)))
    {
        std::this_thread::sleep_for (between_looks);
        latest = device.read();
        if (as_json || Clock::now() - shown < 1s) continue;
        shown = Clock::now();
        show();
    }
    latest = device.read();
    if (as_json)
        std::cout << Json::array ({ probeJson (name, device, latest) }).dump (2) << '\n';
    else
        show();
    return true;
}

}   // namespace tactus::host
