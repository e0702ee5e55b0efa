// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/hid_link/hid_device.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host::hid
{

DeviceLayout layoutOf (const HidModel& model)
{
    auto signals = model.profile().signals.size();
    for (std::size_t i = 0; i < model.outputs(); ++i)
        signals += model.channelNames (i).size();
    return { .axes = model.axisNames(), .efforts = model.effortNames(), .buttons = model.buttonNames(), .signal_outputs = static_cast<int> (signals) };
}

namespace
{
// Half a period of the slowest that such motors are asked for: else the amplitude would be felt to come and go with the signal.
constexpr double least_hold = 12.5e-3;   // s

/// How often the report is sent that has this effort.
double periodOf (const Profile& profile, const std::string& effort)
{
    for (const auto& report : profile.outputs)
        if (std::ranges::count (report.fields, effort, &OutputField::name) > 0) return 1.0 / report.max_rate;
    return 0.0;
}
}   // namespace

HidDevice::HidDevice (std::unique_ptr<HidPort> port)
    : link (std::move (port)), values (link->profile()), only_changes (std::ranges::count (link->profile()->quirks, "only_changes") > 0)
{
    std::size_t channel = 0;
    for (std::size_t i = 0; i < values.outputs(); ++i)
        if (const auto& stream = values.profile().outputs[i].stream)
        {
            streams.push_back ({ i, StreamFeed (*stream, channel) });
            channel += stream->channels.size();
        }
    const auto& names = values.effortNames();
    for (const auto& signal : values.profile().signals)
        shaken.push_back ({ indexOf (names, signal.amplitude), indexOf (names, signal.frequency), static_cast<int> (channel++), std::max (least_hold, periodOf (values.profile(), signal.amplitude)) });
}

void HidDevice::prepare (double dt_s)
{
    dt = dt_s;
    for (auto& s : streams)
        s.feed.prepare (dt);
    for (auto& s : shaken)
        s.shaking.prepare (dt, s.hold);
    ticks_without = 0;
    has_to_rest = true;
}

void HidDevice::take (const ArrivedReport& report) noexcept
{
    if (report.connection != connection)
    {
        values.reset();   // its clocks and counters begin anew
        if (connection != 0) owed = 0;
        connection = report.connection;
        has_one = false;
    }

    const auto before = values.counts();
    const auto refusal = values.decode (report.bytes).refusal;
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
    const std::size_t id = link->hasIds() ? report.bytes.front() : 0;
    if (came_now.test (id)) ++tally.skipped;
    came_now.set (id);
    refused = false;
    has_one = true;
    latest = report.at;
}

Reading HidDevice::read() noexcept
{
    const auto no_room = link->overflown();
    owed += no_room - overflown;
    latest = 0;
    came_now.reset();
    link->drain ([this] (const ArrivedReport& report)
                 { take (report); });

    // Where reports found no room, what there was to take is old, whatever it says.
    const bool fresh = came_now.any() && no_room == overflown;
    overflown = no_room;
    ticks_without = fresh ? 0 : ticks_without + 1;

    if (const auto now = link->episode(); now != episode)
    {
        episode = now;
        has_to_rest = true;
    }

    const bool connected = link->isConnected();
    auto reading = values.reading();
    for (std::size_t i = 0; i < values.axisNames().size(); ++i)
        reading.axes.set (static_cast<int> (i), values.sample().axes[i]);
    reading.age = only_changes && connected && has_one ? 0.0 : static_cast<double> (ticks_without) * dt;
    reading.valid = reading.valid && connected && has_one && ! refused && ! has_to_rest;

    tally.age = reading.age;
    if (has_one) tally.oldest = std::max (tally.oldest, reading.age);
    publish();
    return reading;
}

void HidDevice::shake (const Channels& signals, HidEffort& effort) noexcept
{
    for (auto& [amplitude, frequency, channel, hold, shaking] : shaken)
    {
        shaking.tick (signals[channel]);
        if (amplitude >= 0) effort.efforts[static_cast<std::size_t> (amplitude)] += shaking.amplitude();
        if (frequency >= 0 && shaking.frequency() > 0.0) effort.efforts[static_cast<std::size_t> (frequency)] = shaking.frequency();
    }
}

void HidDevice::write (const Effort& guarded) noexcept
{
    const auto isZero = [] (double v)
    { return v == 0.0; };
    const bool rests = guarded.force.isZero (0.0) && guarded.torque.isZero (0.0) && std::ranges::all_of (guarded.axes, isZero) && std::ranges::all_of (guarded.signals, isZero);
    has_to_rest = has_to_rest && ! rests;

    HidEffort effort { guarded.force, guarded.torque, values.restEfforts() };
    for (std::size_t i = 0; i < values.effortNames().size(); ++i)
        if (const double asked = guarded.axes[static_cast<int> (i)]; asked != 0.0) effort.efforts[i] = asked;
    shake (guarded.signals, effort);

    for (std::size_t i = 0; i < values.outputs(); ++i)
        if (values.channelNames (i).empty()) link->offer (i, has_to_rest ? values.neutral (i) : values.encode (i, effort), episode, latest);
    for (auto& [report, feed] : streams)
        feed.tick (guarded.signals, [&, i = report] (std::span<const float> samples)
                   { link->offer (i, has_to_rest ? values.neutral (i) : values.encode (i, effort, samples), episode, latest); });
}

void HidDevice::publish() noexcept { published.store (tally); }

}   // namespace tactus::host::hid
