// SPDX-License-Identifier: GPL-3.0-or-later
#include "event_devices.hpp"

#if TACTUS_EVDEV
#include <host/cli/report.hpp>
#include <host/devices/device_plugins/open_plugin_device.hpp>
#include <host/devices/device_plugins/plugin_device.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <sstream>
#endif

namespace tactus::host
{

#if TACTUS_EVDEV
namespace
{
class Probed final : public ProbedEvents
{
public:
    Probed (std::string p, std::unique_ptr<Device> d) : at (std::move (p)), device (std::move (d)), plugin (dynamic_cast<const PluginDevice&> (*device))
    {
        device->prepare (5e-3);
    }

    void poll() override
    {
        latest = device->read();
        device->write ({});   // no effort; the first one makes readings count
    }

    std::string text (double seconds) const override
    {
        const auto& layout = plugin.about().layout;
        const auto counts = plugin.counts();
        std::ostringstream out;
        out << at << " (evdev): ";
        if (! plugin.isConnected())
            out << "unplugged; ";
        else if (! latest.valid)
            out << "nothing received yet, move it; ";
        out << counts.readings << " readings, " << numberText (std::round (static_cast<double> (counts.readings) / seconds)) << " per second\n   ";
        for (std::size_t i = 0; i < layout.axes.size(); ++i)
        {
            char number[32];
            std::snprintf (number, sizeof number, "%.6g", latest.axes[static_cast<int> (i)]);
            out << ' ' << layout.axes[i] << ' ' << number;
        }
        out << "\n    pressed:";
        for (const auto& name : pressed())
            out << ' ' << name;
        out << '\n';
        if (const auto trouble = plugin.trouble(); ! trouble.empty()) out << "    last problem: " << trouble << '\n';
        return out.str();
    }

    Json json() const override
    {
        const auto& layout = plugin.about().layout;
        const auto counts = plugin.counts();
        Json axes = Json::object();
        for (std::size_t i = 0; i < layout.axes.size(); ++i)
            axes[layout.axes[i]] = latest.axes[static_cast<int> (i)];
        return { { "connected", plugin.isConnected() },
                 { "valid", latest.valid },
                 { "readings", counts.readings },
                 { "departures", counts.departures },
                 { "axes", std::move (axes) },
                 { "pressed", pressed() } };
    }

    const std::string& path() const override { return at; }

private:
    std::vector<std::string> pressed() const
    {
        std::vector<std::string> names;
        const auto& all = plugin.about().layout.buttons;
        for (std::size_t i = 0; i < all.size(); ++i)
            if ((latest.buttons >> i & 1u) != 0) names.push_back (all[i]);
        return names;
    }

    const std::string at;
    const std::unique_ptr<Device> device;
    const PluginDevice& plugin;
    Reading latest;
};
}   // namespace

std::unique_ptr<ProbedEvents> probeEventDevice (const ListedEvents& listed)
{
    auto made = openPluginDevice ({ { "driver", "evdev" }, { "port", listed.path } });
    if (made.device) return std::make_unique<Probed> (listed.path, std::move (made.device));
    for (const auto& m : made.messages)
        if (m.severity == Message::Severity::error)
            std::cerr << printableName (listed.path) << ": error: " << inOneLine (m.text) << "\n    " << inOneLine (m.remedy) << " [" << m.id << "]\n";
    return nullptr;
}
#else
std::unique_ptr<ProbedEvents> probeEventDevice (const ListedEvents&)
{
    return nullptr;
}
#endif

}   // namespace tactus::host
