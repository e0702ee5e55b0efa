// SPDX-License-Identifier: MIT
// How a port reads: on its reading thread, or on the tick thread that the device ticks.
#include "hid_port.hpp"

#include <tactus/run/realtime.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host::hid
{
namespace
{
using namespace std::chrono_literals;
using Clock = HidPort::Clock;
using Kind = ReportFile::Outcome::Kind;

constexpr auto longest_farewell = 200ms, between_farewells = 5ms;   // for how long the neutral reports are tried when a device is lost
constexpr auto longest_read = 20ms;                                 // short, so that a stop request is noticed promptly
constexpr std::size_t most_at_once = 256;                           // a device that sends faster than it can be read must not keep the run from ticking
constexpr Clock::time_point without_waiting;                        // has passed

bool isOf (const InputReport& described, std::span<const std::uint8_t> report)
{
    return ! described.id || (! report.empty() && report.front() == *described.id);
}
}   // namespace

//==============================================================================
// Either thread

/// Puts a report into the ring.
void HidPort::arrive (std::span<const std::uint8_t> report) noexcept
{
    const auto arrival = now();
    if (const auto slot = ring.claim(); ! slot.empty())
    {
        auto& [bytes, arrived_at, connection] = slot.front();
        const auto kept = report.first (std::min (report.size(), bytes.capacity()));
        bytes.assign (kept.begin(), kept.end());   // within its capacity
        arrived_at = arrival;
        connection = connections;
    }
    ring.commit();
    last_arrival.store (arrival, std::memory_order_release);
    reports.fetch_add (1, std::memory_order_release);
}

//==============================================================================
// The tick thread

void HidPort::readHere() noexcept
{
    auto not_yet = Reader::reading_thread;
    reads.compare_exchange_strong (not_yet, Reader::reading_thread_but_asked, std::memory_order_acq_rel);
}

void HidPort::readElsewhere() noexcept
{
    if (reads.exchange (Reader::reading_thread, std::memory_order_acq_rel) == Reader::tick) given_back.ring();
}

bool HidPort::waitForReport (Clock::time_point until) noexcept
{
    was_late = may_lack_newest = false;
    for (;;)
    {
        if (isReadByTick())
        {
            if (readUntil (until)) return isNews();
            reads.store (Reader::reading_thread_but_asked, std::memory_order_release);
            given_back.ring();
            if (isNews()) return true;
        }
        if (! arrived.wait (until)) return false;
        if (isNews()) return true;
    }
}

/// True if reports have arrived since the last call.
bool HidPort::isNews() noexcept
{
    const auto all = reports.load (std::memory_order_acquire);
    return std::exchange (known, all) != all;
}

/// Reads the reports that have arrived, or waits if there are none. False if the device cannot be read any more.
bool HidPort::readUntil (Clock::time_point until) noexcept
{
    if (! isConnected()) return false;   // the writing thread has given it up
    const auto before = reports.load (std::memory_order_relaxed);
    const auto taken = [&] { return reports.load (std::memory_order_relaxed) - before; };

    bool works = takeWaiting();
    was_late = taken() > 0;
    if (works && ! was_late && known == before)
    {
        const auto got = lent->readUntil (buffer, until);
        if (got.what == Kind::report) take (got.size);
        works = got.what == Kind::report ? takeWaiting() : got.what == Kind::nothing;   // the newest counts
    }
    was_late = was_late || taken() > 1;   // woken too late
    may_lack_newest = taken() >= lent->keptBySystem();
    return works;
}

/// Reads the reports that have arrived, without waiting. False if the device cannot be read any more.
bool HidPort::takeWaiting() noexcept
{
    for (std::size_t n = 0; n < most_at_once; ++n)
    {
        const auto got = lent->readUntil (buffer, without_waiting);
        if (got.what != Kind::report) return got.what == Kind::nothing;
        take (got.size);
    }
    return true;
}

/// Takes over a report of this size from the buffer.
void HidPort::take (std::size_t size) noexcept
{
    arrive (std::span (buffer).first (size));
    read_by_tick.fetch_add (1, std::memory_order_relaxed);
}

//==============================================================================
// The reading thread

void HidPort::readOn()
{
    if (options.real_time) becomeRealTime (std::nullopt);   // if real-time priority is refused, the run reports that
    std::vector<std::uint8_t> own_buffer (longest_report + 1);
    const auto quarter = std::clamp<std::chrono::milliseconds> (std::chrono::duration_cast<std::chrono::milliseconds> (longest_silence / 4), 1ms, longest_read);
    const auto patience = states.empty() ? longest_read : quarter;
    while (! isStopping())
    {
        const auto t = transport();
        if (! t)
        {
            lookAgain();
            heard.clear();
            may_ask = true;
            continue;
        }
        lend (*t);
        const auto got = t->read (own_buffer, patience);   // if the tick thread has failed to read, this finds out why
        if (! got)
        {
            lose (*t, got.error().text);
            continue;
        }
        if (*got > 0) hear (std::span (own_buffer).first (*got));
        const auto now = Clock::now();
        for (std::size_t i = 0; i < heard.size() && may_ask; ++i)
            if (now - heard[i] >= patience) may_ask = ask (*t, *states[i]);
    }
}

/// Takes over a report that the reading thread has read.
void HidPort::hear (std::span<const std::uint8_t> report)
{
    arrive (report);
    arrived.ring();
    const auto now = Clock::now();
    if (heard.empty()) heard.assign (states.size(), now);
    for (std::size_t i = 0; i < states.size(); ++i)
        if (isOf (*states[i], report)) heard[i] = now;
}

/// Asks the device for a report that does not come. False if it should not be asked again.
bool HidPort::ask (Transport& t, const InputReport& wanted_report)
{
    std::vector<std::uint8_t> answer (longest_report + 1), waiting (longest_report + 1);
    answer.front() = wanted_report.id.value_or (0);
    const auto begin = Clock::now();
    const auto got = t.getInput (std::span (answer).first (wanted_report.length + (has_ids ? 0 : 1)));
    const auto took = Clock::now() - begin;
    const auto report = std::span<const std::uint8_t> (answer).first (got ? *got : 0);
    if (report.empty() || ! isOf (wanted_report, report) || took > longest_silence)
    {
        note ("the device sends no report while nothing changes, so its readings get old. Asked for one, "
              + (got ? std::string ("it answers late, or with another report") : "it does not answer: " + got.error().text));
        return false;
    }

    // A report that has come meanwhile is newer than the answer, or at least not older.
    bool has_come = false;
    for (std::size_t n = 0; n < most_at_once; ++n)
    {
        const auto more = t.read (waiting, 0ms);
        if (! more || *more == 0) break;   // if the device is gone, the next read says so again
        const auto newer = std::span<const std::uint8_t> (waiting).first (*more);
        has_come = has_come || isOf (wanted_report, newer);
        hear (newer);
    }
    if (has_come) return true;
    asked_for.fetch_add (1, std::memory_order_relaxed);
    hear (report);
    return true;
}

/// Lets the tick thread read the device if it has asked to, for as long as it can and wants to.
void HidPort::lend (Transport& t)
{
    if (! options.lend || ! t.canReadUntil()) return;
    if (reads.load (std::memory_order_acquire) != Reader::reading_thread_but_asked) return;
    lent = &t;
    auto asked = Reader::reading_thread_but_asked;
    if (! reads.compare_exchange_strong (asked, Reader::tick, std::memory_order_acq_rel)) return;
    arrived.ring();
    while (isReadByTick())
        given_back.wait (Clock::now() + 1s);
}

/// Handles a lost device; both threads may find out that it is. The device may still be able to receive the neutral reports.
void HidPort::lose (Transport& t, const std::string& why)
{
    {
        const std::lock_guard lock (opening);
        if (link.get() != &t) return;
        departures.fetch_add (1, std::memory_order_relaxed);
        stray_before += link->strayBytes();
        link.reset();
        connected.store (false, std::memory_order_release);
        last_trouble = why;
    }
    const std::lock_guard lock (writing);
    current_episode.fetch_add (1, std::memory_order_acq_rel);
    const auto end = Clock::now() + longest_farewell;
    while (! quieten (t) && Clock::now() < end)   // the bus may be busy, as after the computer has slept
        std::this_thread::sleep_for (between_farewells);
    driven = false;   // regardless of the reports that it took: the force starts again from zero
}

const ConnectedDevice* HidPort::sameAmong (const std::vector<ConnectedDevice>& devices) const
{
    std::vector<const ConnectedDevice*> alike;
    for (const auto& d : devices)
        if (d.vid == wanted.vid && d.pid == wanted.pid && d.serial == wanted.serial && fit (*description, d) > 0) alike.push_back (&d);
    const auto same_path = std::ranges::find (alike, wanted.path, [] (const auto* d) { return d->path; });
    if (same_path != alike.end()) return *same_path;
    return alike.size() == 1 || (! alike.empty() && ! wanted.serial.empty()) ? alike.front() : nullptr;
}

void HidPort::lookAgain()
{
    {
        std::unique_lock lock (opening);
        stopped.wait_for (lock, options.look_again, [this] { return isStopping(); });
    }
    if (isStopping()) return;

    const auto devices = wanted.wire == Wire::hid ? system.connected() : std::vector { wanted };   // the person has named the port or address of a wire
    const auto* same = wanted.wire == Wire::hid ? sameAmong (devices) : &devices.front();
    if (same == nullptr) return;
    auto opened = system.reach (*same, *description);
    if (! opened) return note (opened.error().text);
    if (const auto woken = wake (**opened); ! woken) return note (woken.error().text + "; " + woken.error().remedy);
    become (std::move (*opened));
}

}   // namespace tactus::host::hid
