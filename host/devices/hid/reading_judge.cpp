// SPDX-License-Identifier: MIT
#include "reading_judge.hpp"

#include <algorithm>
#include <utility>

namespace tactus::host::hid
{

ReadingJudge::ReadingJudge (HidModel& model)
    : values (model), has_ids (usesIds (model.profile())),
      expected_rate (model.hasSequence() || sendsOnlyChanges (model.profile()) || model.profile().inputs.size() != 1 ? 0.0 : model.profile().rate)
{
    const auto places = placingReports (values.profile());
    if (std::ranges::all_of (places, [] (const auto* report) { return report->id.has_value(); }))
        for (const auto* report : places)
            heard.push_back ({ .id = *report->id });
    if (heard.empty()) heard.emplace_back();
    if (places.size() == 1 && ! sendsOnlyChanges (values.profile())) timed = places.front();
}

void ReadingJudge::prepare() noexcept
{
    for (auto& each : heard)
        each = { .id = each.id };
}

void ReadingJudge::reconnect() noexcept
{
    values.reset();
    if (was_connected) owed = 0;
    was_connected = true;
    has_one = false;
    record = {};
    restarted = false;
    arrived_last = 0;
    restartTime();
}

void ReadingJudge::restartTime() noexcept
{
    lag = clock = passed_on_clock = 0.0;
    timed_at = 0;
    if (timed == nullptr) return;
    const double rate = values.profile().rate;
    measured = MeasuredTime { ! timed->timestamp.empty() || ! timed->sequence.empty(), rate > 0.0 ? 1.0 / rate : 0.0 };
}

void ReadingJudge::begin() noexcept
{
    newest = timed_at = 0;
    came_now.reset();
}

void ReadingJudge::take (std::span<const std::uint8_t> report, Nanoseconds arrival) noexcept
{
    const auto before = values.counts();
    const auto refusal = values.decode (report).refusal;
    const auto& after = values.counts();
    const auto gap = after.lost - before.lost, without_room = std::min (gap, owed);
    owed -= without_room;
    tally.lost += gap - without_room;
    tally.restarts += after.restarts - before.restarts;

    if (refusal != Refusal::none)
    {
        ++tally.refused[static_cast<std::size_t> (refusal)];
        refused = refused || refusal != Refusal::unknown_id;
        return;
    }
    ++tally.taken;
    refused = false;
    const std::size_t id = has_ids ? report.front() : 0;
    has_one = has_one || std::ranges::any_of (heard, [id] (const auto& each) { return ! each.id || *each.id == id; });
    newest = arrival;
    judge (arrival, gap - without_room);
    if (standing != ReadingFault::none) return;
    if (timed != nullptr && (! timed->id || *timed->id == id))
    {
        timed_at = arrival;
        const double rate = values.profile().rate, before = std::exchange (clock, values.sample().time);
        passed_on_clock += ! timed->timestamp.empty() ? clock - before : static_cast<double> (gap + 1) / (rate > 0.0 ? rate : 1.0);
    }
    if (came_now.test (id)) ++tally.skipped;
    came_now.set (id);
}

void ReadingJudge::judge (Nanoseconds arrival, std::uint64_t lost) noexcept
{
    standing = ReadingFault::none;
    switch (values.sample().report_order)
    {
    case ReportOrder::repeated:
        standing = ReadingFault::repeated;
        break;
    case ReportOrder::clock_stopped:
        standing = ReadingFault::clock_stopped;
        break;
    case ReportOrder::back:
        restartTime();
        record.restart();
        restarted = true;
        break;
    case ReportOrder::next:
        if (expected_rate > 0.0 && arrived_last != 0)
            lost = ReportRecord::missingAfter (1e-9 * static_cast<double> (arrival - arrived_last), expected_rate);
        record.arrived (lost);
        restarted = restarted && ! record.isTrusted();
        break;
    }
    arrived_last = arrival;
}

/// Finds the lag of the newest report. Earlier reports of the same tick count only through the time that has passed on the device's clock.
void ReadingJudge::time() noexcept
{
    if (timed_at != 0) lag = measured (std::exchange (passed_on_clock, 0.0), 1e-9 * static_cast<double> (timed_at), values.sample().position);
}

/// The fault that keeps the reading from being valid, other than its content.
ReadingFault ReadingJudge::fault (bool is_connected) const noexcept
{
    if (! is_connected) return ReadingFault::unplugged;
    if (refused) return ReadingFault::malformed;
    if (! has_one) return ReadingFault::no_report;
    if (restarted) return ReadingFault::restarted;
    return record.isTrusted() ? ReadingFault::none : ReadingFault::lost;
}

/// By the clock or in ticks, whichever is longer, so that neither a run that ticks too slowly nor one that ticks too fast makes an old report
/// seem new.
double ReadingJudge::ReportArrival::age (bool comes, Nanoseconds arrival, double lag_s, double period_s, Nanoseconds now) noexcept
{
    ticks_without = comes ? 0 : ticks_without + 1;
    if (comes)
    {
        at = arrival;
        lag = lag_s;
    }
    if (comes) return lag > 0.0 ? lag + std::max (0.0, static_cast<double> (now - at) / 1e9) : 0.0;   // one waits for its tick longer than another
    return lag + std::max (static_cast<double> (ticks_without) * period_s, at == 0 ? 0.0 : static_cast<double> (now - at) / 1e9);
}

Reading ReadingJudge::reading (const Tick& tick) noexcept
{
    time();
    double age = 0.0;
    for (auto& each : heard)
        age = std::max (age, each.age (tick.is_usable && (each.id ? came_now.test (*each.id) : came_now.any()), newest, lag, tick.period_s, tick.now));

    auto reading = values.reading (tick.driven_s);
    if (const auto why = fault (tick.is_connected); why != ReadingFault::none)
    {
        reading.fault = why;
        reading.valid = false;
    }
    for (std::size_t i = 0; i < values.axisNames().size(); ++i)
        reading.axes.set (static_cast<int> (i), values.sample().axes[i]);
    reading.age = age;
    if (reading.fault == ReadingFault::none && reading.age > 0.0) reading.fault = standing;

    tally.age = reading.age;
    if (has_one) tally.oldest = std::max (tally.oldest, reading.age);
    return reading;
}

}   // namespace tactus::host::hid
