// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_device.hpp"
#include "event_devices.hpp"
#include "found_devices.hpp"
#include "probe_driver.hpp"
#include "try_device.hpp"

#include <host/base/platform/signals.hpp>
#include <host/base/platform/terminal.hpp>
#include <host/cli/commands.hpp>
#include <host/cli/report.hpp>
#include <host/devices/audio/card.hpp>
#include <host/devices/hid/usb_adapter.hpp>
#include <host/devices/hid_link/driver_ports.hpp>
#include <host/devices/hid_link/force_feedback.hpp>
#include <host/devices/hid_link/hid_device.hpp>
#include <host/devices/hid_link/open_device.hpp>
#include <host/devices/hid_link/profile_library.hpp>
#include <host/devices/hid_link/serial_ports.hpp>
#include <host/devices/hid_link/udev_rule.hpp>
#include <host/tools/reports/connected_devices.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/list_text.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>
#include <sstream>
#include <thread>

namespace tactus::host
{

namespace
{
using namespace std::chrono_literals;
using namespace hid;
using Clock = std::chrono::steady_clock;

struct DevicesOptions
{
    std::string tried, report;
    bool probe = false, json = false;
    double duration_s = 0.0;
    DeviceCapture capture;
};

Listed listedAs (ChosenDevice chosen)
{
    if (! chosen.profile) fail ("hid/no_profile", printableName (chosen.device.path) + ": no profile says what its bytes mean", "name it: serial:PROFILE@PORT");
    return { std::move (chosen.device), { std::move (chosen.profile) }, true, {} };
}

//==============================================================================
std::string textOf (const Listed& l)
{
    const auto& d = l.device;
    std::string text = d.path + "   " + hex4 (d.vid) + ":" + hex4 (d.pid) + "   " + (d.product.empty() ? "unnamed" : printableName (d.product));
    if (! d.serial.empty()) text += ", serial " + printableName (d.serial);
    if (d.bus != Bus::unknown) text += ", " + std::string (nameOf (d.bus));
    text += "\n    ";
    if (l.profiles.empty())
    {
        text += "no profile fits this device\n";
        for (const auto& m : l.unable)
            text += "    " + inOneLine (m.text) + "\n";
        return text;
    }

    text += "profile " + printableName (l.profiles.front()->id) + " (" + printableName (l.profiles.front()->name) + "), "
            + std::string (verifiedOf (*l.profiles.front()));
    for (std::size_t i = 1; i < l.profiles.size(); ++i)
        text += (i == 1 ? "; would also fit: " : ", ") + printableName (l.profiles[i]->id);
    text += "\n    ";
    text += l.may_open ? "may be opened: --device ROLE=hid:" + printableName (l.profiles.front()->id) : "may not be opened by this user: " + howToPermit (d);
    return text + "\n";
}

//==============================================================================
template <typename Numbers>
std::string inARow (const Numbers& numbers)
{
    std::string text;
    for (const auto n : numbers)
        addToList (text, numberText (static_cast<double> (n)));
    return text.empty() ? "unknown" : text;
}

std::string textOf (const audio::ListedCard& c)
{
    const auto name = printableName (c.type + ":" + c.name);
    auto text = "sound card " + name + "\n    ";
    if (! c.trouble.empty()) return text + inOneLine (c.trouble) + "\n";
    text += std::to_string (c.outputs.size()) + " outputs, " + std::to_string (c.inputs.size()) + " inputs; ";
    text += inARow (c.rates) + " Hz; blocks of " + inARow (c.blocks) + "\n    ";
    return text + "--audio \"" + name + "\" --route PORT=CHANNEL, or --device ROLE=audio\n";
}

Json jsonOf (const audio::ListedCard& c)
{
    return { { "driver", "audio" },
             { "type", c.type },
             { "name", c.name },
             { "outputs", c.outputs },
             { "inputs", c.inputs },
             { "rates_hz", c.rates },
             { "blocks", c.blocks },
             { "trouble", c.trouble } };
}

//==============================================================================
std::string textOf (const SerialPort& p, const LoadedProfiles& profiles)
{
    auto text = "serial port " + printableName (p.path);
    if (! p.vid.empty()) text += "   " + p.vid + ":" + p.pid + "   " + (p.product.empty() ? "unnamed" : printableName (p.product));
    text += "\n    ";
    if (! p.may_open) return text + "may not be opened by this user: join the group of the port, such as dialout\n";
    if (const auto* device = driverOf (p))
    {
        const auto slow = hid::slowAdapter (p.path);
        return text + device->what + ": --device ROLE=" + device->driver + ":" + printableName (p.path) + "\n"
               + (slow.empty() ? "" : "    " + printable (slow) + "\n");
    }
    const auto fitting = profilesFor (p, profiles.profiles);
    std::string ids;
    for (const auto& profile : fitting)
        addToList (ids, printableName (profile->id) + " (" + printableName (profile->name) + ")");
    if (fitting.empty()) return text + "no profile names a serial line: docs/devices.md says how to write one\n";
    const auto device = "serial:" + (isOf (p, *fitting.front()) ? printableName (fitting.front()->id) : "PROFILE") + "@" + printableName (p.path);
    return text + "nothing on the line says which device it is. With a serial line: " + ids + "\n    to see and count its reports, without driving it: "
           + "tactus devices --probe --device " + device + "\n    to play: --device ROLE=" + device + "\n";
}

//==============================================================================
/// A device being probed.
class Probed
{
public:
    explicit Probed (std::unique_ptr<HidPort> port) : device (std::move (port)) { device.prepare (1e-3 * static_cast<double> (period.count())); }

    static constexpr auto period = 5ms;   // period of poll(); the port's buffer lasts far longer

    void poll() { latest = device.read(); }

    std::string text (double seconds) const
    {
        const auto& port = device.port();
        const auto& m = device.model();
        const auto counts = port.counts();
        std::ostringstream out;
        out << port.device().path << " (" << port.profile()->id << "): ";
        if (! port.isConnected())
            out << "unplugged; ";
        else if (! latest.valid && counts.reports == 0)
            out << "nothing received yet; ";
        const double rate_hz = static_cast<double> (counts.reports) / seconds;
        out << counts.reports << " reports, " << numberText (std::round (rate_hz)) << " per second, " << describe (device.counts(), counts) << '\n';
        if (m.hasPosition()) out << "    position " << vector (latest.position, 1e3) << " mm\n";
        const bool rotates = ! std::ranges::all_of (port.profile()->rotation, [] (const auto& terms) { return terms.empty(); });
        if (rotates) out << "    rotation " << vector (latest.rotation, 1.0) << " rad\n";
        if (! port.profile()->pressure.empty()) out << "    pressure " << rounded (latest.pressure) << " N\n";
        out << "   ";
        for (std::size_t i = 0; i < m.axisNames().size(); ++i)
            out << ' ' << m.axisNames()[i] << ' ' << rounded (m.sample().axes[i]) << (m.axisUnits()[i] == "1" ? "" : " " + m.axisUnits()[i]);
        out << '\n';
        if (! m.buttonNames().empty())
        {
            out << "    pressed:";
            for (const auto& name : pressed())
                out << ' ' << name;
            out << '\n';
        }
        if (const auto trouble = port.trouble(); ! trouble.empty()) out << "    last problem: " << trouble << '\n';
        return out.str();
    }

    Json json() const
    {
        const auto& port = device.port();
        const auto& m = device.model();
        const auto read = device.counts();
        const auto counts = port.counts();
        Json axes = Json::object(), refused = Json::object();
        for (std::size_t i = 0; i < m.axisNames().size(); ++i)
            axes[m.axisNames()[i]] = m.sample().axes[i];
        for (std::size_t i = 0; i < refusals; ++i)
            if (read.refused[i] > 0) refused[std::string (describe (static_cast<Refusal> (i)))] = read.refused[i];
        const auto list = [] (const Vec3& v) { return Json { v.x(), v.y(), v.z() }; };
        return { { "profile", port.profile()->id },
                 { "connected", port.isConnected() },
                 { "valid", port.isConnected() && latest.fault == ReadingFault::none && m.sample().valid },   // the reading, which drives nothing here
                 { "reports", counts.reports },
                 { "taken", read.taken },
                 { "lost", read.lost },
                 { "restarts", read.restarts },
                 { "refused", std::move (refused) },
                 { "departures", counts.departures },
                 { "position", list (latest.position) },
                 { "rotation", list (latest.rotation) },
                 { "pressure", latest.pressure },
                 { "axes", std::move (axes) },
                 { "pressed", pressed() } };
    }

    const std::string& path() const { return device.port().device().path; }

private:
    static std::string rounded (double v)
    {
        char text[32];
        std::snprintf (text, sizeof text, "%.6g", v);
        return text;
    }

    static std::string vector (const Vec3& v, double scale)
    {
        char text[96];
        std::snprintf (text, sizeof text, "%10.4f %10.4f %10.4f", scale * v.x(), scale * v.y(), scale * v.z());
        return text;
    }

    std::vector<std::string> pressed() const
    {
        std::vector<std::string> names;
        const auto& all = device.model().buttonNames();
        for (std::size_t i = 0; i < all.size(); ++i)
            if ((latest.buttons >> i & 1u) != 0) names.push_back (all[i]);
        return names;
    }

    HidDevice device;
    Reading latest;
};

/// Opens every device that has a profile and may be opened. Prints why the other devices are left out.
std::vector<std::unique_ptr<Probed>> openAll (const std::vector<Listed>& all)
{
    std::vector<std::unique_ptr<Probed>> probed;
    for (const auto& l : all)
    {
        if (l.profiles.empty()) continue;
        auto opened = HidPort::open (thisComputer(), l.device, l.profiles.front());
        if (opened)
            probed.push_back (std::make_unique<Probed> (std::move (*opened)));
        else
            std::cerr << printableName (opened.error().where) << ": error: " << inOneLine (opened.error().text) << "\n    "
                      << printable (opened.error().remedy) << " [" << opened.error().id << "]\n";
    }
    return probed;
}

void probe (const std::vector<Listed>& all, const std::vector<ListedEvents>& event_devices, const DevicesOptions& options, Json& json)
{
    watchForStop();
    auto probed = openAll (all);
    std::vector<std::unique_ptr<ProbedEvents>> events;
    for (const auto& l : event_devices)
        if (auto opened = probeEventDevice (l)) events.push_back (std::move (opened));
    if (probed.empty() && events.empty())
    {
        const bool any_fits = ! event_devices.empty() || std::ranges::any_of (all, [] (const Listed& l) { return ! l.profiles.empty(); });
        if (any_fits) throw Stop {};   // the reason has already been printed
        return;
    }

    const bool live = ! options.json && stderrIsTerminal();
    const auto begin = Clock::now();
    const auto show = [&] {
        const double seconds = std::max (1e-3, std::chrono::duration<double> (Clock::now() - begin).count());
        std::string text;
        for (const auto& p : probed)
            text += printable (p->text (seconds));
        for (const auto& e : events)
            text += printable (e->text (seconds));
        return text;
    };

    auto shown = begin;
    std::ptrdiff_t lines = 0;
    while (! stopRequested() && (options.duration_s <= 0.0 || Clock::now() - begin < std::chrono::duration<double> (options.duration_s)))
    {
        std::this_thread::sleep_for (Probed::period);
        for (const auto& p : probed)
            p->poll();
        for (const auto& e : events)
            e->poll();
        if (options.json || Clock::now() - shown < (live ? 100ms : 1000ms)) continue;
        shown = Clock::now();
        const auto text = show();
        if (live && lines > 0) std::cout << "\033[" << lines << "A\033[J";
        lines = std::ranges::count (text, '\n');
        std::cout << text << std::flush;
        if (! std::cout) return;
    }

    if (! options.json)
    {
        if (live && lines > 0) std::cout << "\033[" << lines << "A\033[J";
        std::cout << show();
        return;
    }
    for (auto& device : json)
    {
        for (const auto& p : probed)
            if (device.value ("path", Json()) == p->path()) device["probe"] = p->json();
        for (const auto& e : events)
            if (device.value ("path", Json()) == e->path()) device["probe"] = e->json();
    }
}

void run (const DevicesOptions& options)
{
    if (! options.tried.empty()) return tryOnDevice (options.tried, options.report);
    if (! options.capture.device.empty() && ! options.probe && options.capture.file.empty())
    {
        if (listFoundDevices (options.capture.device, options.json)) return;
        throw UsageError ("--device requires --probe or --capture, unless it names only a driver in a plugin");
    }
    if (options.duration_s > 0.0 && ! options.probe && options.capture.file.empty()) throw UsageError ("--duration requires --probe or --capture");
    if (! options.capture.file.empty())
    {
        auto capture = options.capture;
        capture.duration_s = options.duration_s;
        return captureDevice (capture);
    }
    if (! options.capture.device.empty() && probeDriver (options.capture.device, options.duration_s, options.json)) return;
    readUnguarded();
    const auto profiles = loadProfileLibrary();
    warnOfFiles (profiles.messages);

    const auto all = options.capture.device.empty() ? listDevices (profiles) : std::vector { listedAs (chooseDevice (options.capture.device, profiles)) };
    Json json = Json::array();
    for (const auto& l : all)
        json.push_back (jsonOf (l));

    const auto ports = options.probe ? std::vector<SerialPort> {} : serialPorts();
    for (const auto& port : ports)
        json.push_back (host::jsonOf (port, profiles));
    const auto event_devices = options.capture.device.empty() ? listEventDevices() : std::vector<ListedEvents> {};
    for (const auto& l : event_devices)
        json.push_back (l.json);
    const auto cards = options.probe ? std::vector<audio::ListedCard> {} : audio::soundCards().list();
    for (const auto& card : cards)
        json.push_back (jsonOf (card));

    if (! options.json && all.empty()) std::cout << "No HID device is connected.\n";
    if (! options.json && (! options.probe || all.empty()))
        for (const auto& l : all)
            std::cout << textOf (l);
    if (! options.json && ! options.probe)
        for (const auto& l : event_devices)
            std::cout << l.text;
    if (! options.json)
    {
        for (const auto& port : ports)
            std::cout << textOf (port, profiles);
        if (! options.probe) std::cout << withoutPort (ports);
        for (const auto& card : cards)
            std::cout << textOf (card);
    }
    const auto known = options.probe ? std::vector<std::shared_ptr<const Profile>> {} : knownByNumbers (profiles);
    for (const auto& profile : known)
        json.push_back (numbersJsonOf (*profile));
    if (! options.json) std::cout << numbersText (known);
    if (! options.json && ! options.probe) std::cout << driversText();
    if (options.probe && (! all.empty() || ! event_devices.empty()))
    {
        if (! options.json && ! all.empty() && std::ranges::all_of (all, [] (const Listed& l) { return l.profiles.empty(); }))
            std::cout << "None of the connected HID devices has a profile; `tactus devices` lists them.\n";
        probe (all, event_devices, options, json);
    }
    if (options.json) std::cout << json.dump (2) << '\n';
}
}   // namespace

void addDevices (const Command& app)
{
    const auto options = std::make_shared<DevicesOptions>();
    const auto command = app.add ("devices", "List connected devices, their profiles and their readings");
    const auto probe = command.addFlag ("--probe", options->probe,
                                        "Open all devices that have a profile, or force feedback, and show their readings until Ctrl-C; "
                                        "they are initialised as their profiles specify, but not driven");
    command.addOption ("--duration", options->duration_s, "How long to probe or capture, in s").check (within (1e-3, 1e9));
    const auto capture = command.addOption ("--capture", options->capture.file,
                                            "Record each report that a device sends or gets, until Ctrl-C, without driving it; see docs/known_devices.md")
                             .type ("FILE")
                             .excludes (probe);
    command.addOption ("--device", options->capture.device,
                       "What to probe or record: hid:PROFILE, serial:PROFILE@PORT, udp:PROFILE@ADDRESS, haply:HOST:PORT or bhaptics:HOST:PORT; to probe, "
                       "also DRIVER:PORT of any other driver; to record, also the path of a device, which need not have a profile; default: the only HID "
                       "device with a profile. Without --probe and --capture: the name of a driver, which lists the devices that it finds");
    command.addOption ("--baud", options->capture.baud, "The speed of a serial port without a profile; default: 115200")
        .check (within (300, 20000000))
        .needs (capture);
    const auto tried = command.addOption ("--try", options->tried,
                                          "Lead you through ten minutes with a device, with forces of 0.3 N and walls of 1 N at most, and write a report: "
                                          "a role of your session, or a device as for play, such as forcedimension:1")
                           .type ("DRIVER|ROLE")
                           .excludes (probe)
                           .excludes (capture);
    command.addOption ("--out", options->report, "The file of the report of --try; default: trial.json").type ("FILE").needs (tried);
    command.addFlag ("--json", options->json, "Print JSON; with --probe, the last readings of the devices");
    command.footer ("Tactus comes with profiles. Put your own into the folder that TACTUS_PROFILES names, or into ~/.config/tactus/profiles.\n\n"
                    "Examples:\n"
                    "  tactus devices\n"
                    "  tactus devices --device forcedimension\n"
                    "  tactus devices --probe\n"
                    "  tactus devices --probe --duration 2 --json\n"
                    "  tactus devices --probe --device serial:tactus_board@/dev/ttyACM0\n"
                    "  tactus devices --probe --device haply:localhost:10001\n"
                    "  tactus devices --try forcedimension:1 --out arm.json\n"
                    "  tactus devices --capture board.jsonl --device serial:tactus_board@/dev/ttyACM0\n"
                    "  tactus devices --capture arm.jsonl --device haply:localhost:10001");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
