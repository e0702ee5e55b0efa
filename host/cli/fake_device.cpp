// SPDX-License-Identifier: GPL-3.0-or-later
#include "bounded_log.hpp"
#include "commands.hpp"
#include "report.hpp"

#include <host/base/platform/preset_folder.hpp>
#include <host/base/platform/private_folder.hpp>
#include <host/base/platform/signals.hpp>
#include <host/devices/hid/hex.hpp>
#include <host/devices/hid_link/fake_device.hpp>
#include <host/devices/hid_link/profile_library.hpp>
#include <host/drivers/offered_fake.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/tick_clock.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <string_view>
#include <system_error>
#include <thread>

namespace tactus::host
{

namespace
{
using namespace hid;
using Clock = std::chrono::steady_clock;

struct FakeOptions
{
    std::string profile, wire, link, hand = "stroke", log;
    std::vector<std::string> faults;
    int port = 0;
    double duration_s = 0.0, log_megabytes = 100.0;
};

std::shared_ptr<const Profile> profileOf (const std::string& id)
{
    auto all = loadProfileLibrary();
    if (auto found = profileNamed (all, id)) return found;
    warnOfFiles (all.messages);   // the profile may be in a file with a mistake
    std::vector<std::string> names;
    for (const auto& p : all.profiles)
        if (! p->inputs.empty()) names.push_back (p->id);
    fail (Message::error ("hid/unknown_profile", "", "there is no device profile " + quote (id), suggestion (id, names)));
}

/// A hand that strokes, and gives way to the force. A gesture does not: on a hard surface, its force would be at the limit all the time.
constexpr auto soft_stroke = R"({ "driver": "sim", "mass": "50 g", "damping": "1 N*s/m",
    "hand": { "stiffness": "600 N/m", "damping": "6 N*s/m", "path": "stroke", "offset": [0, 0, "-1 mm"], "scale": 0.5 } })";

/// The hand is any device that a graph may have, as in --device ROLE=, or the usual one.
std::unique_ptr<Device> handOf (const std::string& text)
{
    if (text == "stroke") return makeDevice (Json::parse (soft_stroke), {}).device;
    const std::vector<std::pair<std::string, Json>> no_graph;
    auto parsed = tactus::parseDeviceOption ("hand=" + text, no_graph, {});
    if (! parsed) fail (Message::error (parsed.error().id, "--hand " + text, parsed.error().text,
                                        "write stroke, gesture:NAME, trace:FILE.csv, sim or FILE.json"));
    auto made = makeDevice (parsed->description, parsed->folder);
    for (const auto& m : made.messages)
        if (m.severity == Message::Severity::error) fail (Message::error (m.id, "--hand " + text + m.where, m.text, m.remedy));
    return std::move (made.device);
}

const char* nameOf (Wire wire)
{
    if (wire == Wire::hid) return "hid";
    return wire == Wire::serial ? "serial" : "udp";
}

Wire wireOf (const FakeOptions& o, const Profile& profile)
{
    for (const auto wire : { Wire::serial, Wire::udp, Wire::hid })
        if (o.wire == nameOf (wire)) return wire;
    if (profile.wires.serial) return Wire::serial;
    return profile.wires.udp ? Wire::udp : Wire::hid;
}

std::string textOf (const FakeDevice::Line& line)
{
    const auto step = std::to_string (line.step);
    if (line.what == FakeDevice::Line::What::released) return step + " ! the watchdog has released the motors\n";
    return step + (line.what == FakeDevice::Line::What::sent ? " > " : " < ") + hexOf (line.bytes) + "\n";
}

void play (FakeDevice& fake, double duration_s, std::ofstream& log)
{
    const auto period = toDuration (1.0 / fake.rate());
    auto due = Clock::now();
    while (! stopRequested() && (duration_s <= 0.0 || fake.time() < duration_s))
    {
        fake.step();
        log.flush();   // a program that reads the file meanwhile sees each line at once
        due += period;
        while (Clock::now() < due && fake.hear (due))
            ;
        std::this_thread::sleep_until (due);
        due = std::max (due, Clock::now() - std::chrono::milliseconds (100));   // after a pause, not everything is caught up
    }
}

/// The words of a list with ", " between them, without what follows each in brackets.
bool isAmong (std::string_view list, std::string_view word)
{
    for (std::size_t at = 0; at < list.size();)
    {
        const auto end = std::min (list.find (", ", at), list.size());
        if (const auto each = list.substr (at, end - at); each.substr (0, each.find (' ')) == word) return true;
        at = end + 2;
    }
    return false;
}

/// Plays a fake without a profile, until it is stopped.
void playOffered (const OfferedFakeKind& kind, const FakeOptions& o)
{
    if (! o.link.empty() || ! o.log.empty() || ! o.wire.empty())
        throw UsageError ("--link, --log, --wire", "only a fake device that is made from a profile has these options");
    std::vector<std::pair<DeviceFault, std::string>> faults;
    for (const auto& text : o.faults)
    {
        faults.emplace_back (orFail (readFault (text)), text.substr (0, text.find ('@')));
        std::string choice = kind.faults;
        choice.replace (choice.rfind (", "), 2, " or ");
        if (! isAmong (kind.faults, faults.back().second))
            fail (Message::error ("fake/fault", text, "this device or service does not have this fault", "choose " + choice));
    }
    const auto folder = privateFolder ("tactus-fake");
    {
        const auto fake = orFail (kind.make ({ .hand = kind.needs_hand ? handOf (o.hand) : nullptr,
                                               .port = o.port,
                                               .libraries = shipped ({ "lib/tactus/fakes", "../lib/tactus/fakes" }),
                                               .private_folder = folder }));
        std::cout << fake->where() << "\n"
                  << std::flush;
        const auto begin = Clock::now();
        std::string fault;
        for (;;)
        {
            const double now = std::chrono::duration<double> (Clock::now() - begin).count();
            if (stopRequested() || (o.duration_s > 0.0 && now >= o.duration_s)) break;
            std::string due;
            for (const auto& [when, what] : faults)
                if (now >= when.from && now < when.to) due = what;
            if (due != fault) fake->fail (due);
            fault = due;
            std::this_thread::sleep_for (std::chrono::milliseconds (1));
        }
        std::cout << fake->heard() << "\n";
    }
    std::error_code failed;
    if (! folder.empty()) std::filesystem::remove_all (folder, failed);
}

void run (const FakeOptions& o)
{
    watchForStop();
    for (const auto* kind : offeredFakes())
        if (o.profile == kind->name) return playOffered (*kind, o);
    const auto profile = profileOf (o.profile);
    FakeDevice::Options options { .wire = wireOf (o, *profile), .link = o.link, .port = o.port, .faults = {} };
    if (options.wire != Wire::serial && ! o.link.empty()) throw UsageError ("--link", "only a serial line has a name to link to");
    for (const auto& text : o.faults)
    {
        options.faults.push_back (orFail (readFault (text)));
        const auto kind = options.faults.back().kind;
        if (isOfService (kind)) fail (Message::error ("fake/fault", text, "only a service has this fault", "choose another fault"));
        if (kind == DeviceFault::Kind::missed && options.wire != Wire::serial)
            fail (Message::error ("fake/fault", text, "only a serial line has this fault", "choose another fault, or \"--wire serial\""));
    }
    auto fake = orFail (FakeDevice::make (profile, handOf (o.hand), options));

    std::ofstream log;
    BoundedLog bounded (log, static_cast<std::uint64_t> (1e6 * o.log_megabytes));
    if (! o.log.empty())
    {
        log.open (o.log, std::ios::binary);   // the line ends of Linux in Windows, too
        if (! log) fail (Message::error ("output/unwritable", o.log, "the log cannot be written", "name a file in a folder that you may write to"));
        fake->on_line = [&o, &bounded] (const FakeDevice::Line& line) {
            if (bounded.add (textOf (line)))
                warn (o.log, Message::warning ("fake/log", "", "the log has reached " + numberText (o.log_megabytes) + " MB and ends here; the device goes on",
                                               "give a larger --log-size, in MB"));
        };
    }
    const auto place = ! o.link.empty() ? o.link : fake->place();
    std::cout << "a fake " << profile->name << " is at " << place << "; play on it: --device ROLE=" << nameOf (options.wire) << ":" << profile->id
              << (options.wire == Wire::hid ? "" : "@" + place) << "\n"
              << std::flush;
    play (*fake, o.duration_s, log);
    const auto n = fake->counts();
    std::cout << fake->place() << ": " << n.sent << " reports sent, " << n.heard << " heard, " << n.refused << " refused, " << n.stray << " stray bytes, "
              << "released by the watchdog " << n.released << (n.released == 1 ? " time\n" : " times\n");
    if (! o.log.empty() && ! log) fail (Message::error ("output/unwritable", o.log, "the log could not be written to its end", "check the disk"));
}
}   // namespace

void addFakeDevice (const Command& app)
{
    const auto options = std::make_shared<FakeOptions>();
    std::string others;
    for (const auto* kind : offeredFakes())
        others += std::string ("; or ") + kind->name + ", " + kind->what;
    const auto command = app.add ("fake-device", "Simulate a device, to test programs without hardware");
    command
        .addOption ("profile", options->profile,
                    "The id of a profile, such as tactus_board" + others)
        .required();
    command
        .addOption ("--wire", options->wire,
                    "The wire: serial, udp, or hid, a virtual device of the kernel, which needs root; default: the first that the profile knows")
        .check (oneOf ({ "serial", "udp", "hid" }));
    command.addOption ("--link", options->link, "A symbolic link to the serial line, so that its name stays the same").type ("PATH");
    command.addOption ("--port", options->port, "The port on this computer, of UDP or of a service; default: a free one").check (within (0, 65535));
    command.addOption ("--hand", options->hand,
                       "The hand: stroke, which gives way to the force; gesture:NAME, trace:FILE.csv, sim, or FILE.json with a simulated device; "
                       "default: stroke");
    command.addOption ("--fault", options->faults,
                       "A fault, KIND, KIND@FROM or KIND@FROM:DURATION, in s from the start of this program; kinds: stall, garbage, half, "
                       "lost_byte, missed_byte, late, lie, "
                       "reset, away, and of a service push and rename; may be given more than once")
        .oneValueEach();
    command.addOption ("--log", options->log, "A file for each report: its step, > if sent or < if received, and its bytes").type ("FILE");
    command.addOption ("--log-size", options->log_megabytes, "The largest size of the log in MB; default: 100").check (finiteWithin (1e-3, 1e6));
    command.addOption ("--duration", options->duration_s, "Length in s; default: until Ctrl-C").check (finiteWithin (0.0, 1e9));
    command.footer ("Examples:\n"
                    "  tactus fake-device tactus_board --link board --log heard.txt\n"
                    "  tactus play graphs/dry_wood.json --device stylus=serial:tactus_board@board\n"
                    "  tactus fake-device tactus_board --wire udp --port 9750 --fault stall@5:0.2 --fault away@8:1\n"
                    "  sudo tactus fake-device tactus_board --wire hid\n"
                    "  tactus fake-device haply_2diy --link arm --fault missed_byte@5:0.001\n"
                    "  tactus fake-device falcon --fault stall@5:0.2\n"
                    "  tactus fake-device forcedimension --hand gesture:press\n"
                    "  tactus fake-device haply_inverse3 --port 10001\n"
                    "  tactus fake-device bhaptics_vest --port 15881");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
