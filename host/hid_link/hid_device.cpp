// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/hid_link/hid_device.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host::hid
{

DeviceLayout layoutOf (const HidModel& model)
{
    return { .axes = model.axisNames(), .efforts = model.effortNames(), .buttons = model.buttonNames() };
}

HidDevice::HidDevice (std::unique_ptr<HidPort> port)
    : link (std::move (port)), values (link->profile()), only_changes (std::ranges::count (link->profile()->quirks, "only_changes") > 0)
{
}

void HidDevice::prepare (double dt_s)
{
    dt = dt_s;
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

void HidDevice::write (const Effort& guarded) noexcept
{
    const auto isZero = [] (double v)
    { return v == 0.0; };
    const bool rests = guarded.force.isZero (0.0) && guarded.torque.isZero (0.0) && std::ranges::all_of (guarded.axes, isZero);
    has_to_rest = has_to_rest && ! rests;

    HidEffort effort { guarded.force, guarded.torque, values.restEfforts() };
    for (std::size_t i = 0; i < values.effortNames().size(); ++i)
        if (const double asked = guarded.axes[static_cast<int> (i)]; asked != 0.0) effort.efforts[i] = asked;
    for (std::size_t i = 0; i < values.outputs(); ++i)
        link->offer (i, has_to_rest ? values.neutral (i) : values.encode (i, effort), episode, latest);
}

void HidDevice::publish() noexcept { published.store (tally); }

}   // namespace tactus::host::hid
