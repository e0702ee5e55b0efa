// SPDX-License-Identifier: MIT
#include "hid_port.hpp"
#include "udev_rule.hpp"

#include <host/devices/hid/answer.hpp>
#include <host/devices/hid/bits.hpp>
#include <tactus/run/realtime.hpp>
#include <tactus/run/tick_clock.hpp>
#include <tactus/text/caught.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace tactus::host::hid
{
namespace
{
using namespace std::chrono_literals;
using Clock = HidPort::Clock;

constexpr std::size_t reports_waiting = 1024;   // one second of reports from a fast device: a run starts a while after its devices are opened
constexpr auto longest_between_beats = 20ms;    // several times within Failsafe::patience
constexpr auto longest_leave = 200ms;           // for how long the neutral reports are tried again when a port is closed
constexpr auto between_tries = 5ms;
constexpr int least_tries = 3;
constexpr const char* check_device = "check that the connected device is the one that the profile describes, and plug it in again";

double secondsOf (Clock::duration d) { return std::chrono::duration<double> (d).count(); }

/// The reports that a device is asked for while they do not come, because it pushes, but sends only when something changes.
std::vector<const InputReport*> askedFor (const Profile& p)
{
    if (! sendsOnlyChanges (p) || p.outputs.empty() || p.inputs.empty()) return {};
    auto all = placingReports (p);
    if (all.empty()) all.push_back (&p.inputs.front());
    return all;
}

Clock::duration watchdogOf (const Profile& p)
{
    const double s = p.limits.guard.watchdog;
    return toDuration (isFinite (s) && s > 0.0 ? s : GuardLimits::default_watchdog);
}

Result<> transfer (Transport& t, Step::Kind kind, std::span<std::uint8_t> bytes)
{
    switch (kind)
    {
    case Step::Kind::output:
        return t.write (bytes);
    case Step::Kind::feature:
        return t.sendFeature (bytes);
    case Step::Kind::get_feature:
        return t.getFeature (bytes);
    }
    return {};
}
}   // namespace

HidPort::HidPort (HidSystem& s, ConnectedDevice d, std::shared_ptr<const Profile> p, Options o)
    : system (s), wanted (std::move (d)), description (std::move (p)), options (o), longest_silence (watchdogOf (*description)),
      has_ids (usesIds (*description)), states (askedFor (*description)), ring (reports_waiting, 1, { .bytes = Bytes (longestInput (*description) + 1) }),
      buffer (longest_report + 1), quiet (description)
{
    for (std::size_t i = 0; i < description->outputs.size(); ++i)
        outputs.push_back (std::make_unique<Output>());
}

Result<std::unique_ptr<HidPort>> HidPort::open (HidSystem& system, const ConnectedDevice& device, std::shared_ptr<const Profile> profile, Options options)
{
    auto opened = system.reach (device, *profile);
    if (! opened)
    {
        const auto& why = opened.error();
        const auto named = device.path + " (" + device.product + ")";
        if (! why.remedy.empty()) return Message::error (why.id, device.path, "cannot open " + named + ": " + why.text, why.remedy);
        if (device.wire == Wire::udp)
            return Message::error (why.id, device.path, named + " is not there: " + why.text, "check its address, its power and its network, and start it");
        if (why.id == "hid/not_permitted") return Message::error (why.id, device.path, "this user may not open " + named, howToPermit (device));
        return Message::error (why.id, device.path, "cannot open " + named + ": " + why.text, "check that no other program is using it, and plug it in again");
    }

    std::unique_ptr<HidPort> port (new HidPort (system, device, std::move (profile), options));
    if (const auto woken = port->wake (**opened); ! woken && woken.error().id == "device/failsafe")
        return Message::error (woken.error().id, device.path, device.path + " (" + device.product + "): " + woken.error().text,
                               ! woken.error().remedy.empty()
                                   ? woken.error().remedy
                                   : "install Tactus with the program force-guardian, and open devices only in a process that was not forked from one with "
                                     "open devices");
    else if (! woken)
        return Message::error (woken.error().id, device.path,
                               device.path + " (" + device.product + ") fails the init steps of its profile " + port->profile()->id + ": " + woken.error().text,
                               woken.error().remedy);
    port->become (std::move (*opened));
    const auto persist = [p = port.get()] (auto act) {
        while (! p->isStopping())
            if (const auto done = caught (p->wanted.path, act); ! done) p->note (done.error().text);
    };
    port->reader = std::jthread ([persist, p = port.get()] { persist ([p] { p->readOn(); }); });
    port->writer = std::jthread ([persist, p = port.get()] {
        persist ([p] { p->writeOn(); });
        if (const auto left = caught (p->wanted.path, [p] { p->leave(); }); ! left) p->note (left.error().text);
    });
    return port;
}

HidPort::~HidPort()
{
    {
        const std::lock_guard lock (opening);
        stopping = true;
    }
    stopped.notify_all();
    something.ring();
    if (writer.joinable()) writer.join();   // sends the neutral reports and the exit steps
    if (reader.joinable()) reader.join();
}

//==============================================================================
// Both threads

/// The bytes as they are sent, including a number that the device returned.
Bytes HidPort::addressed (std::span<const std::uint8_t> wire, const std::optional<Bits>& place, std::size_t block) const
{
    Bytes bytes (wire.begin(), wire.end());
    const auto body = std::span (bytes).subspan (has_ids ? 0 : 1);
    if (place && assigned[block] != 0 && place->end() <= 8 * body.size()) putBits (*place, assigned[block], body);
    return bytes;
}

Bytes HidPort::wireOf (const Step& step) const
{
    auto bytes = step.bytes;
    if (! has_ids) bytes.insert (bytes.begin(), 0);
    return addressed (bytes, step.given, step.block);
}

/// An error if nothing would bring a device with motors to rest if this program died. Where the system has no failsafe at all, it is only noted.
Result<> HidPort::armFailsafe (Transport& t)
{
    const auto last = neutralReports();
    auto armed = t.armFailsafe (last);
    if (armed || last.empty()) return {};
    auto why = std::move (armed).error();
    why.text = "if this program dies, nothing brings the device to rest: " + why.text;
    if (why.id != "device/no_failsafe") return why;
    note (why.text);
    return {};
}

/// Performs the init steps.
Result<> HidPort::wake (Transport& t)
{
    const std::lock_guard lock (writing);
    quiet.reset();
    assigned = {};
    if (auto armed = armFailsafe (t); ! armed) return armed;
    for (const auto& step : description->init)
        if (auto done = perform (t, step); ! done) return done;
    return assigned[0] != 0 ? armFailsafe (t) : Result<> {};
}

Result<> HidPort::perform (Transport& t, const Step& step)
{
    if (step.answer) return ask (t, step);
    auto bytes = wireOf (step);
    if (const auto done = transfer (t, step.kind, bytes); ! done)
        return Message::error ("hid/init", "", step.about.empty() ? done.error().text : step.about + " was refused: " + done.error().text, check_device);
    if (step.delay > 0.0) std::this_thread::sleep_for (toDuration (step.delay));
    return {};
}

/// Repeats the request until the device answers, and keeps the number in the answer.
Result<> HidPort::ask (Transport& t, const Step& step)
{
    const auto refused = [&] (std::string text) { return Message::error ("hid/init", "", step.about + " " + std::move (text), check_device); };

    const auto end = Clock::now() + toDuration (step.answer->patience);
    for (;;)
    {
        auto bytes = wireOf (step);
        if (const auto done = t.getFeature (bytes); ! done) return refused ("was refused: " + done.error().text);
        const auto number = numberIn (*step.answer, std::span<const std::uint8_t> (bytes).subspan (has_ids ? 0 : 1));
        if (! number) return number.error();
        if (*number)
        {
            assigned[step.block] = **number;
            return {};
        }
        if (Clock::now() >= end || isStopping()) return refused ("contained no answer");
        std::this_thread::sleep_for (toDuration (step.answer->pause));
    }
}

void HidPort::become (Opened opened)
{
    ++connections;
    const std::lock_guard lock (opening);
    link = std::move (opened);
    connected.store (link != nullptr, std::memory_order_release);
}

HidPort::Opened HidPort::transport() const
{
    const std::lock_guard lock (opening);
    return link;
}

void HidPort::note (const std::string& what)
{
    const std::lock_guard lock (opening);
    last_trouble = what;
}

std::string HidPort::trouble() const
{
    const std::lock_guard lock (opening);
    return last_trouble;
}

PortCounts HidPort::counts() const noexcept
{
    const auto n = answers_sent.load (std::memory_order_relaxed);
    const std::lock_guard lock (opening);
    return { .reports = reports.load (std::memory_order_relaxed),
             .read_by_tick = read_by_tick.load (std::memory_order_relaxed),
             .asked_for = asked_for.load (std::memory_order_relaxed),
             .stray = stray_before + (link ? link->strayBytes() : 0),
             .overflown = ring.lost(),
             .writes = writes.load (std::memory_order_relaxed),
             .write_errors = write_errors.load (std::memory_order_relaxed),
             .dropped = dropped.load (std::memory_order_relaxed),
             .silences = silences.load (std::memory_order_relaxed),
             .departures = departures.load (std::memory_order_relaxed),
             .latency_min = latency_min.load (std::memory_order_relaxed),
             .latency_mean = n > 0 ? latency_sum.load (std::memory_order_relaxed) / static_cast<double> (n) : 0.0,
             .latency_max = latency_max.load (std::memory_order_relaxed) };
}

//==============================================================================
// The tick thread

void HidPort::offer (std::size_t report, std::span<const std::uint8_t> bytes, std::uint64_t of_episode, Nanoseconds answers,
                     bool rests) noexcept
{
    if (report >= outputs.size()) return;
    auto& o = outputs[report]->draft;
    if (bytes.size() > o.bytes.size()) return;
    ++o.number;
    o.episode = of_episode;
    o.size = bytes.size();
    o.answers = answers;
    o.rests = rests ? 1 : 0;
    std::ranges::copy (bytes, o.bytes.begin());
    constexpr std::size_t word = sizeof (std::uint64_t);
    outputs[report]->offered.store (o, offsetof (PendingReport, bytes) + (bytes.size() + word - 1) / word * word);
}

//==============================================================================
// The writing thread

Clock::time_point HidPort::nextLook (Clock::time_point now) const
{
    double wait = std::min (secondsOf (longest_silence) / 4.0, secondsOf (longest_between_beats));
    for (const auto& o : description->outputs)
        wait = std::min (wait, 0.5 / o.max_rate);
    return now + toDuration (std::max (wait, 250e-6));
}

void HidPort::writeOn()
{
    if (options.real_time) becomeRealTime (std::nullopt);
    while (! isStopping())
    {
        something.wait (nextLook (Clock::now()));
        const auto t = transport();
        if (! t)
        {
            const std::lock_guard lock (writing);
            for (const auto& o : outputs)
                o->seen = o->offered.load().number;   // the device is disconnected, so these offers do not count as dropped
        }
        else if (! serve (*t))
            lose (*t, "the program or the computer was suspended, so the device is opened again");
    }
}

/// Brings the device to rest at the end.
void HidPort::leave()
{
    const std::lock_guard lock (writing);
    if (const auto t = transport()) leave (*t);
}

/// Sends what is due. False if the device must be opened again (Transport::beat).
bool HidPort::serve (Transport& t)
{
    const std::lock_guard lock (writing);
    const auto now = Clock::now();
    for (std::size_t i = 0; i < outputs.size(); ++i)
        poll (t, *outputs[i], i, now);
    if (driven && now - given > longest_silence)
    {
        if (! std::exchange (is_silent, true))
        {
            silences.fetch_add (1, std::memory_order_relaxed);
            current_episode.fetch_add (1, std::memory_order_acq_rel);
        }
        quieten (t);
    }
    return t.beat (driven);
}

void HidPort::poll (Transport& t, Output& o, std::size_t report, Clock::time_point now)
{
    const auto& how = description->outputs[report];
    const double rate = how.max_rate * more_than_the_rate;
    o.credit = std::min (burst, o.credit + rate * secondsOf (now - o.earned));
    o.earned = now;

    const auto latest = o.offered.load();
    const bool is_new = latest.number != o.seen;
    if (is_new)
    {
        given = now;
        is_silent = false;
    }
    if (latest.number == 0 || latest.episode != episode())
    {
        o.seen = latest.number;
        return;
    }

    const auto bytes = std::span (latest.bytes).first (latest.size);
    const bool changed = how.keepalive == 0.0 ? is_new : ! std::ranges::equal (bytes, o.latest);
    const bool kept_alive = how.keepalive > 0.0 && now - o.sent >= toDuration (how.keepalive);
    const bool stops = latest.rests != 0 && o.pushes;
    if (! changed && ! kept_alive && ! stops)
    {
        o.seen = latest.number;
        return;
    }
    if (((o.credit < 1.0 || t.awaitsAnswer()) && ! stops) || ! t.beat (true)) return;

    // Offers in between were never sent, so they count as dropped. With a keepalive, an unchanged offer is neither sent nor counted.
    if (is_new && how.keepalive == 0.0) dropped.fetch_add (latest.number - o.seen - 1, std::memory_order_relaxed);
    o.seen = latest.number;
    o.credit = std::max (0.0, o.credit - 1.0);
    o.sent = now;
    o.latest.assign (bytes.begin(), bytes.end());
    driven = true;
    const auto is_sent = static_cast<bool> (send (t, report, bytes));
    if (is_sent || latest.rests == 0) o.pushes = latest.rests == 0;   // a report that could not be sent may have arrived
    if (is_sent && is_new) count (latest.answers, Clock::now());
}

void HidPort::count (Nanoseconds answers, Clock::time_point sent_at) noexcept
{
    if (answers == 0) return;
    const double s = 1e-9 * static_cast<double> (nanosecondsOf (sent_at) - answers);
    const auto n = answers_sent.load (std::memory_order_relaxed);
    latency_sum.store (latency_sum.load (std::memory_order_relaxed) + s, std::memory_order_relaxed);
    latency_min.store (n == 0 ? s : std::min (s, latency_min.load (std::memory_order_relaxed)), std::memory_order_relaxed);
    latency_max.store (std::max (s, latency_max.load (std::memory_order_relaxed)), std::memory_order_relaxed);
    answers_sent.store (n + 1, std::memory_order_relaxed);
}

Result<> HidPort::send (Transport& t, std::size_t report, std::span<const std::uint8_t> bytes)
{
    const auto& how = description->outputs[report];
    const auto put = [&] (std::span<const std::uint8_t> b) { return how.is_feature ? t.sendFeature (b) : t.write (b); };
    auto sent = how.given ? put (addressed (bytes, how.given, how.block)) : put (bytes);
    writes.fetch_add (1, std::memory_order_relaxed);
    if (! sent)
    {
        write_errors.fetch_add (1, std::memory_order_relaxed);
        note (sent.error().text);
    }
    return sent;
}

/// Sends the neutral reports, regardless of what was offered. False if the system did not take one of them: the device may still be
/// driven, and they must be sent again. [with `writing` held]
bool HidPort::quieten (Transport& t)
{
    driven = false;
    for (std::size_t i = 0; i < outputs.size(); ++i)
    {
        const auto bytes = quiet.neutral (i);
        outputs[i]->latest.assign (bytes.begin(), bytes.end());
        if (send (t, i, bytes))   // counts and records its own failures
            outputs[i]->pushes = false;
        else
            driven = true;
    }
    t.beat (driven);
    return ! driven;
}

/// [with `writing` held]
void HidPort::leave (Transport& t)
{
    const auto end = Clock::now() + longest_leave;
    for (int tries = 1; ! quieten (t) && (tries < least_tries || Clock::now() < end); ++tries)
        std::this_thread::sleep_for (between_tries);
    for (const auto& step : description->exit)
        if (const auto done = perform (t, step); ! done) note (done.error().text);
}

/// The neutral reports and exit steps, for the failsafe, without reports that are always the same. Before the device has returned its numbers,
/// only those that do not need them. [with `writing` held]
std::vector<OutgoingReport> HidPort::neutralReports()
{
    std::vector<OutgoingReport> last;
    for (std::size_t i = 0; i < outputs.size(); ++i)
    {
        const auto& how = description->outputs[i];
        const bool only_asks = how.fields.empty() && ! how.stream && how.body == how.neutral;
        if (only_asks || (how.given && assigned[how.block] == 0)) continue;
        const auto bytes = quiet.neutral (i);
        last.push_back ({ addressed (bytes, how.given, how.block), how.is_feature });
    }
    for (const auto& step : description->exit)
        if (step.kind != Step::Kind::get_feature && (! step.given || assigned[step.block] != 0))
            last.push_back ({ wireOf (step), step.kind == Step::Kind::feature });
    return last;
}

}   // namespace tactus::host::hid
