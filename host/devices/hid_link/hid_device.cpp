// SPDX-License-Identifier: MIT
#include "hid_device.hpp"

#include <tactus/text/list_text.hpp>

#include <host/devices/hid/physics.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace tactus::host::hid
{

std::string describeStray (const PortCounts& port)
{
    if (port.stray == 0) return {};
    if (port.reports == 0) return std::to_string (port.stray) + " bytes arrived, but no frame: check baud, framing and CRC";
    return std::to_string (port.stray) + (port.stray == 1 ? " stray byte" : " stray bytes");
}

std::string describe (const ReadingCounts& read, const PortCounts& port)
{
    const auto number = [] (auto n) { return std::to_string (n); };
    auto text = number (read.taken) + " taken, " + number (read.lost) + " lost, "
                + number (std::accumulate (read.refused.begin(), read.refused.end(), std::uint64_t { 0 })) + " refused";
    std::string reasons;
    for (std::size_t i = 0; i < read.refused.size(); ++i)
        if (read.refused[i] > 0) addToList (reasons, number (read.refused[i]) + " " + std::string (describe (static_cast<Refusal> (i))));
    if (! reasons.empty()) text += " (" + reasons + ")";
    if (read.restarts > 0) text += ", " + number (read.restarts) + " out of order";
    if (read.skipped > 0) text += ", " + number (read.skipped) + " skipped for newer ones";
    if (port.overflown > 0) text += ", " + number (port.overflown) + " dropped for lack of room";
    if (const auto stray = describeStray (port); ! stray.empty()) text += ", " + stray;
    return text;
}

DeviceLayout layoutOf (const HidModel& model)
{
    auto signals = model.profile().signals.size();
    for (std::size_t i = 0; i < model.outputs(); ++i)
        signals += model.channelNames (i).size();
    const auto numbers = numbersOf (model.profile());
    const auto known = [] (const DeviceNumbers::Number& number) { return number ? number->value : 0.0; };
    return { .axes = model.axisNames(),
             .efforts = model.ownEffortNames(),
             .buttons = model.buttonNames(),
             .signal_outputs = static_cast<int> (signals),
             .mechanics = { known (numbers.mass), known (numbers.damping) } };
}

namespace
{
// Half a period of the lowest frequency that is requested from such motors; with a shorter hold, the amplitude would
// noticeably follow the waveform.
constexpr double least_hold = 12.5e-3;   // s

/// The period of the report that contains this effort, in s.
double periodOf (const Profile& profile, const std::string& effort)
{
    for (const auto& report : profile.outputs)
        if (std::ranges::count (report.fields, effort, &OutputField::name) > 0) return 1.0 / report.max_rate;
    return 0.0;
}
}   // namespace

HidDevice::HidDevice (std::unique_ptr<HidPort> port)
    : link (std::move (port)), values (link->profile()), longest_pause (std::chrono::nanoseconds (link->watchdog()).count()),
      judge (values)
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
        motors.push_back ({ indexOf (names, signal.amplitude), indexOf (names, signal.frequency), static_cast<int> (channel++),
                            std::max (least_hold, periodOf (values.profile(), signal.amplitude)) });
}

void HidDevice::prepare (double dt_s)
{
    dt = dt_s;
    for (auto& s : streams)
        s.feed.prepare (dt);
    for (auto& m : motors)
        m.tracker.prepare (dt, m.hold);
    judge.prepare();
    has_to_rest = true;
    driven_for = 0.0;
    written = 0;
}

void HidDevice::take (const ArrivedReport& report) noexcept
{
    if (report.connection != connection) judge.reconnect();
    connection = report.connection;
    judge.take (report.bytes, report.at);
}

Reading HidDevice::read() noexcept
{
    const auto no_room = link->overflown();
    judge.dropped (no_room - overflown);
    judge.begin();
    link->drain ([this] (const ArrivedReport& report) { take (report); });

    // If some reports did not fit, the ones in the ring are old, whatever they contain.
    const bool usable = no_room == overflown && ! link->mayLackNewest();
    overflown = no_room;
    if (const auto now = link->episode(); now != episode)
    {
        episode = now;
        has_to_rest = true;
    }

    auto reading = judge.reading ({ dt, link->now(), driven_for, link->isConnected(), usable });
    reading.valid = reading.valid && ! has_to_rest;
    reading.unrendered_force = unrendered_force;
    reading.unrendered_torque = unrendered_torque;
    publish();
    return reading;
}

void HidDevice::withhold() noexcept
{
    for (auto& motor : motors)
        motor.tracker.forgetPeaks();
}

void HidDevice::limitSignals (double max, double /*max_slew*/) { asked_max_signal.store (max, std::memory_order_relaxed); }

/// The limit of each amplitude on this tick. If it was tightened, it falls from the largest amplitude of the last tick, as in the guard.
double HidDevice::limitOfVibration() noexcept
{
    const double asked = asked_max_signal.load (std::memory_order_relaxed);
    if (asked >= max_signal.goal() && ! max_signal.isFalling()) return max_signal.now();
    double level = 0.0;
    for (const auto& motor : motors)
        if (motor.amplitude >= 0) level = std::max (level, std::abs (driven[static_cast<std::size_t> (motor.amplitude)]));
    if (asked < max_signal.goal()) max_signal.tighten (asked, level, Guard::fade_s / dt);
    max_signal.advance (level);
    return max_signal.now();
}

/// Adds the vibrations to the efforts of their motors. An effort may drive the same motor, so the sum is limited.
void HidDevice::vibrate (const Channels& signals, HidEffort& effort) noexcept
{
    const auto most = limitOfVibration();
    for (auto& [amplitude, frequency, channel, hold, tracker] : motors)
    {
        tracker.tick (signals[channel]);
        if (amplitude >= 0)
        {
            auto& sum = effort.efforts[static_cast<std::size_t> (amplitude)];
            sum = std::clamp (sum + tracker.amplitude(), -most, most);
        }
        if (frequency >= 0 && tracker.frequency() > 0.0) effort.efforts[static_cast<std::size_t> (frequency)] = tracker.frequency();
    }
}

/// The stop of the guard that only a rearm ends.
BoardStop::Cause HidDevice::latched() const noexcept
{
    const auto* guard = heeded.load (std::memory_order_acquire);
    if (guard == nullptr || ! guard->isLatched()) return BoardStop::Cause::none;
    return guard->stop() == Guard::Stop::emergency ? BoardStop::Cause::emergency : BoardStop::Cause::limit;
}

/// A report without samples, for the efforts of this tick.
std::span<const std::uint8_t> HidDevice::bytesOf (std::size_t report, BoardStop::Says says) noexcept
{
    const auto& how = values.profile().outputs[report];
    if (says == BoardStop::Says::stop && ! how.stop.empty()) return how.stop;
    if (says == BoardStop::Says::rearm && ! how.rearm.empty()) return how.rearm;
    return has_to_rest ? values.neutral (report) : values.encodeValues (report, driven);
}

void HidDevice::write (const Effort& guarded) noexcept
{
    const auto isZero = [] (double v) { return v == 0.0; };
    const bool rests = guarded.force.isZero (0.0) && guarded.torque.isZero (0.0) && std::ranges::all_of (guarded.axes, isZero)
                       && std::ranges::all_of (guarded.signals, isZero);
    has_to_rest = has_to_rest && ! rests;
    driven_for = has_to_rest ? 0.0 : driven_for + dt;

    HidEffort effort { guarded.force, guarded.torque, values.restEfforts() };
    values.take (guarded.axes, effort);
    vibrate (guarded.signals, effort);

    // The last limits hold per second of wall time, whatever drives the run. A pause counts as long as the port waits for efforts.
    const auto now = link->now();
    const double passed = written == 0 ? dt : 1e-9 * static_cast<double> (std::min (now - written, longest_pause));
    if (has_to_rest) values.rest();
    driven = has_to_rest ? EffortValues {} : values.drive (effort, passed);
    written = now;
    unrendered_force = guarded.force - values.renderedForce();
    unrendered_torque = guarded.torque - values.renderedTorque();
    const auto says = board_stop (latched(), rests, values.isStopped(), dt);
    for (std::size_t i = 0; i < values.outputs(); ++i)
        if (values.channelNames (i).empty()) link->offer (i, bytesOf (i, says), episode, judge.latest(), has_to_rest || values.rests (i, driven));
    for (auto& [report, feed] : streams)
        feed.tick (guarded.signals, [&, i = report] (std::span<const float> samples) {
            const auto& bytes = has_to_rest ? values.neutral (i) : values.encodeValues (i, driven, samples);
            const bool is_silent = values.rests (i, driven) && std::ranges::all_of (samples, [] (float s) { return s == 0.0f; });
            link->offer (i, bytes, episode, judge.latest(), has_to_rest || is_silent);
        });
    link->sendNow();
}

void HidDevice::publish() noexcept { published.store (judge.counts()); }

}   // namespace tactus::host::hid
