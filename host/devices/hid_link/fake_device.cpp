// SPDX-License-Identifier: MIT
#include "fake_device.hpp"

#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <filesystem>
#include <random>
#include <string>
#include <system_error>
#include <utility>

namespace tactus::host::hid
{
namespace
{
using FaultKind = DeviceFault::Kind;

constexpr std::pair<std::string_view, FaultKind> fault_names[] {
    { "stall", FaultKind::stall },
    { "garbage", FaultKind::garbage },
    { "half", FaultKind::half },
    { "lost_byte", FaultKind::lost_byte },
    { "missed_byte", FaultKind::missed },
    { "reset", FaultKind::reset },
    { "late", FaultKind::late },
    { "lie", FaultKind::lie },
    { "away", FaultKind::away },
    { "push", FaultKind::push },
    { "rename", FaultKind::rename },
};

constexpr double usual_rate = 1000.0;                     // Hz
constexpr auto longest_wait = std::chrono::seconds (1);   // that ends an unfinished report on Haply's board

std::vector<Bytes> stepsOf (const Profile& profile)
{
    std::vector<Bytes> steps;
    for (const auto& step : profile.init)
        steps.push_back (step.bytes);
    return steps;
}

/// The shapes of the reports that the device hears: its output reports, and the steps that set it up.
std::vector<FrameReader::Shape> heardShapes (const Profile& profile, const std::vector<Bytes>& steps)
{
    auto shapes = outputShapes (profile);
    for (const auto& bytes : steps)
    {
        auto& shape = shapes.emplace_back (FrameReader::Shape { bytes.front(), bytes.size(), bytes.size(), {} });
        for (std::size_t i = 1; i < bytes.size(); ++i)
            shape.marks.emplace_back (Bits { .at = 8 * i }, bytes[i]);
    }
    return shapes;
}

/// Replaces a link at once, so that it never leads nowhere while it is replaced.
Result<> lead (const std::filesystem::path& link, const std::string& to)
{
    std::error_code failed;
    if (std::filesystem::exists (std::filesystem::symlink_status (link, failed)) && ! std::filesystem::is_symlink (link, failed))
        return Message::error ("fake/link", link.string(), "there is a file with this name", "name another one");
    auto fresh = link;
    fresh += ".new";
    std::filesystem::remove (fresh, failed);
    std::filesystem::create_symlink (to, fresh, failed);
    if (! failed) std::filesystem::rename (fresh, link, failed);
    if (failed) return Message::error ("fake/link", link.string(), "the link cannot be made: " + failed.message(), "name a link in a folder of yours");
    return {};
}
}   // namespace

Result<DeviceFault> readFault (std::string_view text)
{
    const auto wrong = [&] (std::string why) {
        return Message::error ("fake/fault", std::string (text), std::move (why), "write KIND, KIND@FROM or KIND@FROM:DURATION, in s, as in stall@2:0.5");
    };
    const auto at = text.find ('@');
    const auto kind = text.substr (0, at);
    const auto* named = std::ranges::find (fault_names, kind, [] (const auto& f) { return f.first; });
    if (named == std::end (fault_names))
    {
        std::vector<std::string> names;
        for (const auto& f : fault_names)
            names.emplace_back (f.first);
        auto why = wrong (quote (kind) + " is not a fault");
        why.remedy = suggestion (kind, names);
        return why;
    }
    DeviceFault fault { .kind = named->second };
    if (at == text.npos) return fault;
    const auto times = text.substr (at + 1);
    const auto colon = times.find (':');
    const auto from = wholeNumber (times.substr (0, colon));
    const auto lasts = colon == times.npos ? std::optional (fault.to) : wholeNumber (times.substr (colon + 1));
    if (! from || ! lasts || ! (*from >= 0.0) || ! (*lasts > 0.0)) return wrong ("its times are not numbers of at least 0");
    fault.from = *from;
    fault.to = *from + *lasts;
    return fault;
}

FakeDevice::FakeDevice (std::shared_ptr<const Profile> p, std::unique_ptr<Device> h, Options o)
    : profile (std::move (p)), hand (std::move (h)), options (std::move (o)), rate_hz (profile->rate > 0.0 ? profile->rate : usual_rate),
      watchdog (profile->limits.device_watchdog), port (options.port), serial ("fake-" + std::to_string (std::random_device {}())), side (profile),
      framing (options.wire == Wire::serial ? profile->wires.serial->framing : Framing::none),
      answers (framing == Framing::answer),
      init (answers ? stepsOf (*profile) : std::vector<Bytes> {}),
      lines (framing, heardShapes (*profile, init), answers ? longest_wait : profile->wires.serial.value_or (SerialWire {}).pause)
{
    hand->prepare (1.0 / rate_hz);
    if (answers) hand_reading = hand->read();   // it may be asked before the first step
}

FakeDevice::~FakeDevice()
{
    std::error_code failed;
    if (! options.link.empty() && std::filesystem::read_symlink (options.link, failed) == name) std::filesystem::remove (options.link, failed);
}

Result<std::unique_ptr<FakeDevice>> FakeDevice::make (std::shared_ptr<const Profile> profile, std::unique_ptr<Device> hand, Options options)
{
    const auto& wires = profile->wires;
    const bool knows = options.wire == Wire::hid || (options.wire == Wire::udp ? wires.udp : wires.serial.has_value());
    if (! knows)
        return Message::error ("fake/wire", profile->id,
                               "the profile " + quote (profile->id) + " has no wire " + quote (options.wire == Wire::serial ? "serial" : "udp"),
                               "add it to the \"wires\" of the profile, or choose another wire");
    std::error_code failed;
    if (! options.link.empty() && std::filesystem::is_symlink (options.link, failed) && std::filesystem::exists (options.link, failed))
        return Message::error ("fake/link", options.link, "there is a link with this name, which leads to a file", "remove it, or name another one");
    std::unique_ptr<FakeDevice> fake (new FakeDevice (std::move (profile), std::move (hand), std::move (options)));
    if (auto connected = fake->connect(); ! connected) return std::move (connected).error();
    if (fake->hid)
        if (auto found = fake->findFile(); ! found) return std::move (found).error();
    return fake;
}

/// Makes the far end of the wire, of a serial line under another name than the last one.
Result<> FakeDevice::connect()
{
    if (options.wire == Wire::hid) return plug();
    const auto old_name = name;
    auto made = options.wire == Wire::serial ? WireFile::makeTerminal (name) : WireFile::listenUdp (port);
    if (made && options.wire == Wire::serial && name == old_name)
    {
        const auto same = std::move (made);   // keeps the name while another terminal is made
        made = WireFile::makeTerminal (name);
    }
    if (! made) return std::move (made).error();
    wire.emplace (std::move (*made));
    if (options.wire == Wire::udp) name = "127.0.0.1:" + std::to_string (port);
    if (options.wire == Wire::serial && ! options.link.empty())
        if (auto led = lead (options.link, name); ! led) return led;
    return {};
}

Result<> FakeDevice::plug()
{
    const auto identity = identityOf (*profile);
    if (! identity) return identity.error();
    auto plugged = VirtualHid::plug (*identity, serial);
    if (! plugged) return std::move (plugged).error();
    hid = std::move (*plugged);
    hid->on_ask = [this] (std::uint8_t id, bool is_feature) { return answerTo (id, is_feature); };
    return {};
}

/// Waits for the device's file. A driver of the kernel may ask it for reports first.
Result<> FakeDevice::findFile()
{
    constexpr std::chrono::milliseconds longest { 5000 }, pause { 10 };
    Bytes report (longest_report + 1);
    for (const auto end = WireFile::Clock::now() + longest; WireFile::Clock::now() < end;)
    {
        static_cast<void> (hid->read (report, WireFile::Clock::now() + pause));
        if (name = hid->path(); ! name.empty()) return {};
    }
    return Message::error ("fake/hidraw", profile->id, "the kernel has made no file /dev/hidraw* for the device",
                           "load the module hid-generic; if the kernel has its own driver for this device, that driver needs more than a profile describes");
}

/// The answer if the device is asked for a report: the latest one of this id, or a feature report of `init`.
Bytes FakeDevice::answerTo (std::uint8_t id, bool is_feature) const
{
    if (is (FaultKind::stall) || is (FaultKind::reset)) return {};
    if (is_feature) return featureOf (*profile, id);
    const bool has_ids = usesIds (*profile);
    const auto latest = std::ranges::find_if (previous, [&] (const auto& r) { return ! has_ids || r.front() == id; });
    if (latest == previous.end()) return {};
    auto report = *latest;
    if (! has_ids) report.insert (report.begin(), 0);
    return report;
}

bool FakeDevice::is (FaultKind kind) const noexcept
{
    return std::ranges::any_of (options.faults, [&] (const auto& f) { return f.kind == kind && time() >= f.from && time() < f.to; });
}

void FakeDevice::comeAndGo()
{
    if (is (FaultKind::reset)) restart();
    if (is (FaultKind::away))
    {
        wire.reset();
        hid.reset();
        restart();
        return;
    }
    if (! isConnected() && connect()) restart();   // else tried again on the next step
}

void FakeDevice::restart()
{
    applied = {};
    is_driven = false;
    set_up = 0;
    side.restart();
    lines.reset();
    previous.clear();
    if (wire) wire->dropInput();
    for (Bytes bytes (longest_report + 1); hid && hid->read (bytes, {}).what == WireFile::Outcome::Kind::report;)
        ;
}

void FakeDevice::step()
{
    comeAndGo();
    while (hear ({}))
        ;
    ++steps;
    if (is_driven && watchdog > 0.0 && static_cast<double> (steps - last_valid) > watchdog * rate_hz)
    {
        is_driven = false;
        applied = {};
        ++tally.released;
        tell (Line::What::released, {});
    }
    hand->write (applied);
    hand_reading = hand->read();
    side.hold (is (FaultKind::lie));
    if (! isConnected() || answers || is (FaultKind::stall) || is (FaultKind::reset)) return;
    std::vector<Bytes> reports;
    for (std::size_t i = 0; i < side.inputs(); ++i)
        if (side.tellsSomething (i)) reports.push_back (side.input (i, hand_reading, time()));
    for (const auto& report : reports)
        send (report);
    if (is (FaultKind::late))
        for (const auto& report : previous)
            send (report);
    previous = std::move (reports);
}

bool FakeDevice::hear (WireFile::Clock::time_point until)
{
    if (! isConnected() || is (FaultKind::stall) || is (FaultKind::reset)) return false;
    lines.lose (is (FaultKind::missed));
    Bytes bytes (longest_report + 1);
    WireFile::Outcome got;
    if (hid)
        got = hid->read (bytes, until);
    else
        got = options.wire == Wire::udp ? wire->read (bytes, until) : lines.read (*wire, bytes, until);
    if (got.what != WireFile::Outcome::Kind::report) return false;
    auto report = std::span (bytes).first (got.size);
    const auto isAsLong = [&] (const auto& out) { return ! out.id && out.body.size() + 1 == report.size(); };
    if (hid && std::ranges::any_of (profile->outputs, isAsLong)) report = report.subspan (1);   // the 0 of a report without an id
    take (report);
    return true;
}

/// True if the report is a step of `init`. They count in their order.
bool FakeDevice::isStep (std::span<const std::uint8_t> report)
{
    for (std::size_t i = 0; i < init.size(); ++i)
    {
        if (! std::ranges::equal (init[i], report)) continue;
        if (i <= set_up) set_up = i + 1;
        return true;
    }
    return false;
}

void FakeDevice::take (std::span<const std::uint8_t> report)
{
    tell (Line::What::heard, report);
    if (isStep (report)) return;
    const auto heard = side.output (report);
    if (! heard)
    {
        ++tally.refused;
        return;
    }
    ++tally.heard;
    last_valid = steps;
    const bool is_set_up = set_up == init.size();
    is_driven = is_set_up && heard->enabled;
    if (heard->pushes || ! is_set_up) applied = is_set_up ? heard->effort : Effort {};
    if (! answers) return;
    auto answer = side.input (0, hand_reading, time());
    if (! is_set_up) answer.resize (1);
    send (answer);
}

void FakeDevice::send (const Bytes& report)
{
    ++tally.sent;
    tell (Line::What::sent, report);
    Bytes bytes (longestFrame (framing, report.size()));
    bytes.resize (writeFrame (framing, report, bytes));
    if (is (FaultKind::garbage))
        for (auto& byte : bytes)
            byte = static_cast<std::uint8_t> (random());
    if (is (FaultKind::half)) bytes.resize (bytes.size() / 2);
    if (is (FaultKind::lost_byte)) bytes.erase (bytes.begin() + static_cast<std::ptrdiff_t> (bytes.size() / 2));
    if (hid)
        hid->send (bytes);
    else
        static_cast<void> (wire->write (bytes));   // a program that does not read loses reports
}

void FakeDevice::tell (Line::What what, std::span<const std::uint8_t> bytes) const
{
    if (on_line) on_line ({ what, steps, bytes });
}

/// Xorshift (Marsaglia, 2003).
std::uint32_t FakeDevice::random() noexcept
{
    seed ^= seed << 13;
    seed ^= seed >> 17;
    seed ^= seed << 5;
    return seed >> 8;
}

FakeDevice::Counts FakeDevice::counts() const noexcept
{
    auto all = tally;
    all.stray = lines.counts().bytes;
    return all;
}

}   // namespace tactus::host::hid
