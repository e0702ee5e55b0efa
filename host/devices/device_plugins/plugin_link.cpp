// SPDX-License-Identifier: MIT
#include "plugin_link.hpp"

#include <tactus/run/realtime.hpp>
#include <tactus/run/tick_clock.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <span>
#include <utility>

namespace tactus::host
{

namespace
{
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto read_timeout = 50ms;
constexpr auto longest_read = 2 * read_timeout + 50ms;
constexpr auto longest_between_beats = 20ms;   // several times within Failsafe::patience
constexpr auto between_slew_steps = 500us;
constexpr auto longest_write = 20ms;    // as tactus_device.h says
constexpr int most_slow_writes = 8;     // in a row; a busy computer makes some calls longer
constexpr auto longest_leave = 200ms;   // for how long a device that does not come to rest is asked again, before it is closed
constexpr auto between_tries = 5ms;
constexpr int least_tries = 3;
constexpr auto after_failure = 10ms, between_throttled = 1ms;
constexpr double most_calls = 20e3, most_in_a_row = 64.0;   // per s

double secondsOf (Clock::duration d) noexcept { return std::chrono::duration<double> (d).count(); }

bool areFinite (std::span<const double> all) noexcept
{
    return std::ranges::all_of (all, [] (double v) { return isFinite (v); });
}

/// A limit to how often a driver may be called. It is far above the rate at which any device reports: readings must not queue up because of it.
class Throttle
{
public:
    bool mayCall (Clock::time_point now) noexcept
    {
        credit = std::min (most_in_a_row, credit + most_calls * secondsOf (now - earned));
        earned = now;
        if (credit < 1.0) return false;
        credit -= 1.0;
        return true;
    }

private:
    double credit = most_in_a_row;
    Clock::time_point earned = Clock::now();
};

ReadingFault faultOf (std::uint32_t told) noexcept
{
    static_assert (static_cast<int> (ReadingFault::too_hot) == TACTUS_DEVICE_TOO_HOT && static_cast<int> (ReadingFault::timed_out) == TACTUS_DEVICE_TIMED_OUT
                   && static_cast<int> (ReadingFault::not_driven) == TACTUS_DEVICE_NOT_DRIVEN
                   && static_cast<int> (ReadingFault::not_homed) == TACTUS_DEVICE_NOT_HOMED && static_cast<int> (ReadingFault::stopped) == TACTUS_DEVICE_STOPPED
                   && static_cast<int> (ReadingFault::failed) == TACTUS_DEVICE_BROKEN);
    const auto fault = static_cast<ReadingFault> (told);
    return told == 0 || isAlarm (fault) ? fault : ReadingFault::failed;
}
}   // namespace

PluginDevice::Link::Link (std::unique_ptr<OpenedDevice> d, std::optional<Failsafe> armed, const Options& o)
    : options (o), longest_silence (toDuration (isFinite (o.silence_s) && o.silence_s > 0.0 ? o.silence_s : GuardLimits::default_watchdog)),
      called (d->driver().name()), driver (d->driver().shared_from_this()), description (d->description()), about (d->about()),
      watch (about.rate_hz, about.stamps), device (std::move (d)), failsafe (std::move (armed)), limiter (about.limits)
{
    for (auto& slew : slews)
        slew = GuardLimits::none;
}

//==============================================================================
// Any thread

void PluginDevice::Link::note (const std::string& what)
{
    const std::lock_guard lock (telling);
    said = what;
}

void PluginDevice::Link::noteFailure (const std::string& what)
{
    const std::lock_guard lock (telling);
    if (! is_lost.load (std::memory_order_acquire)) said = what;
}

std::string PluginDevice::Link::trouble() const
{
    const auto now = nanoseconds (Clock::now());
    const auto hangs = [&] (const std::atomic<std::int64_t>& since, Clock::duration longest, const char* what) {
        const auto began = since.load (std::memory_order_acquire);
        if (began == 0 || now - began <= std::chrono::nanoseconds (longest).count()) return std::string();
        const auto tenths = static_cast<double> ((now - began) / 100'000'000);   // NOLINT(bugprone-integer-division): whole tenths
        return "the driver has not returned from `" + std::string (what) + "` for " + numberText (tenths / 10.0) + " s";
    };
    if (auto why = hangs (read_since, longest_read, "read"); ! why.empty()) return why;
    if (auto why = hangs (write_since, longest_silence, "write"); ! why.empty()) return why;
    const std::lock_guard lock (telling);
    return said;
}

bool PluginDevice::Link::isStuck (Clock::time_point now) const noexcept
{
    const auto hangs = [at = nanoseconds (now)] (const std::atomic<std::int64_t>& since, Clock::duration longest) {
        const auto began = since.load (std::memory_order_acquire);
        return began != 0 && at - began > std::chrono::nanoseconds (longest).count();
    };
    return hangs (read_since, longest_read) || hangs (write_since, longest_silence);
}

void PluginDevice::Link::limitSlews (double force, double torque, double axis) noexcept
{
    slews[0] = force;
    slews[1] = torque;
    slews[2] = axis;
}

PluginCounts PluginDevice::Link::counts() const noexcept
{
    return { .readings = readings.load (std::memory_order_relaxed),
             .refused = refused.load (std::memory_order_relaxed),
             .repeated = repeated.load (std::memory_order_relaxed),
             .lost = lost.load (std::memory_order_relaxed),
             .restarts = restarts.load (std::memory_order_relaxed),
             .read_errors = read_errors.load (std::memory_order_relaxed),
             .held_up = held_up.load (std::memory_order_relaxed),
             .writes = writes.load (std::memory_order_relaxed),
             .write_errors = write_errors.load (std::memory_order_relaxed),
             .silences = silences.load (std::memory_order_relaxed),
             .departures = departures.load (std::memory_order_relaxed),
             .reached_hz = reached_hz.load (std::memory_order_relaxed) };
}

void PluginDevice::Link::stop() noexcept
{
    {
        const std::lock_guard lock (telling);
        stopping = true;
    }
    changed.notify_all();
    something.ring();
}

void PluginDevice::Link::ends (Thread thread)
{
    {
        const std::lock_guard lock (telling);
        ended[static_cast<std::size_t> (thread)] = true;
    }
    changed.notify_all();
}

bool PluginDevice::Link::waitFor (Thread thread, Clock::time_point until)
{
    std::unique_lock lock (telling);
    return changed.wait_until (lock, until, [&] { return ended[static_cast<std::size_t> (thread)]; });
}

void PluginDevice::Link::pause (std::chrono::milliseconds time)
{
    std::unique_lock lock (telling);
    changed.wait_for (lock, time, [this] { return isStopping(); });
}

/// The device is gone, or must be opened again for another reason.
void PluginDevice::Link::lose (const std::string& why)
{
    if (is_lost.exchange (true, std::memory_order_acq_rel)) return;   // for another reason, which is the one to tell
    note (why);
    departures.fetch_add (1, std::memory_order_relaxed);
    current_episode.fetch_add (1, std::memory_order_acq_rel);
}

//==============================================================================
// The reading thread

void PluginDevice::Link::readOn()
{
    if (options.real_time) raisePriority (priority::devices);
    Throttle throttle;
    DriverReport why;
    tactus_reading reading;
    tactus_device_stamp stamp;
    while (! isStopping())
    {
        if (! isConnected())
        {
            lookAgain();
            continue;
        }
        if (! throttle.mayCall (Clock::now()))
        {
            held_up.fetch_add (1, std::memory_order_relaxed);
            std::this_thread::sleep_for (between_throttled);
            continue;
        }
        why.clear();
        int answer = TACTUS_DEVICE_FAILED;
        {
            const Call call (read_since);
            answer = device->read (read_timeout, reading, stamp, why);
        }
        switch (answer)
        {
        case TACTUS_DEVICE_OK:
            take (reading, stamp, Clock::now());
            break;
        case TACTUS_DEVICE_NONE:
            break;
        case TACTUS_DEVICE_GONE:
            lose ("the device is gone: " + why.text ("it was unplugged, or does not answer"));
            break;
        default:
            read_errors.fetch_add (1, std::memory_order_relaxed);
            noteFailure ("the driver cannot read: " + why.text());
            pause (after_failure);
        }
    }
}

/// True if the reading has all values that the driver has named, and all are numbers.
bool PluginDevice::Link::isWhole (const tactus_reading& r) const noexcept
{
    const auto axes = about.layout.axes.size();
    const auto signals = static_cast<std::size_t> (about.layout.signal_inputs);
    if (r.axis_count < axes || r.signal_count < signals) return false;
    return areFinite (r.position) && areFinite (r.rotation) && isFinite (r.pressure) && isFinite (r.age_s) && r.age_s >= 0.0
           && areFinite (std::span (r.axes).first (axes)) && areFinite (std::span (r.signals).first (signals));
}

void PluginDevice::Link::take (tactus_reading& r, const tactus_device_stamp& stamp, Clock::time_point now) noexcept
{
    // The device has no part that its driver has not named.
    if (! about.position) std::ranges::fill (r.position, 0.0);
    if (! about.rotation) std::ranges::fill (r.rotation, 0.0);
    if (! about.pressure) r.pressure = 0.0;
    if (about.layout.buttons.size() < Reading::most_buttons) r.buttons &= (1u << about.layout.buttons.size()) - 1u;

    reached_hz.store (isFinite (stamp.reached_hz) ? std::max (0.0, stamp.reached_hz) : 0.0, std::memory_order_relaxed);
    const auto verdict = watch (stamp, secondsOf (now.time_since_epoch()));
    auto* count = &readings;
    if (! verdict.is_new)
    {
        count = &repeated;
        draft.standing = static_cast<std::uint64_t> (verdict.fault);
    }
    else if (! isWhole (r))
    {
        count = &refused;
        draft.fault = static_cast<std::uint64_t> (ReadingFault::malformed);
    }
    else
    {
        const auto told = faultOf (stamp.fault);
        r.axis_count = static_cast<std::uint32_t> (about.layout.axes.size());
        r.signal_count = static_cast<std::uint32_t> (about.layout.signal_inputs);
        draft = { .reading = r,
                  .number = draft.number + 1,
                  .at = nanoseconds (now),
                  .lag_s = verdict.lag_s,
                  .numbered = static_cast<double> (stamp.number),
                  .fault = static_cast<std::uint64_t> (told != ReadingFault::none ? told : verdict.fault) };
        last_arrival.store (draft.at, std::memory_order_release);
    }
    newest.store (draft);
    count->fetch_add (1, std::memory_order_relaxed);
    lost.fetch_add (verdict.lost, std::memory_order_relaxed);
    if (verdict.has_gone_back) restarts.fetch_add (1, std::memory_order_relaxed);
}

/// Closes the device, and opens it again.
void PluginDevice::Link::lookAgain()
{
    {
        const std::lock_guard lock (calling);
        if (device)
        {
            leaveDevice();
            failsafe.reset();
            device.reset();
        }
    }
    Messages messages;
    auto again = driver->open (description, messages);
    if (again && again->about().isLike (about))
    {
        auto armed = armFailsafe (again->about());
        const std::lock_guard lock (calling);
        if (armed && ! isStopping())
        {
            device = std::move (again);
            failsafe = std::move (*armed);
            limiter.forget();
            driven = rest_fails = false;   // it was brought to rest when it was opened
            failing_since.reset();
            watch = StampWatch { about.rate_hz, about.stamps };
            draft.fault = draft.standing = 0;
            note ({});
            current_episode.fetch_add (1, std::memory_order_acq_rel);
            is_lost.store (false, std::memory_order_release);
            return;
        }
        if (! armed) note (armed.error().text);
    }
    else if (again)
        note ("the device that is there now has other parts or limits than the one that the run began with");
    else if (! messages.empty())
        note (messages.back().text);
    again.reset();
    pause (options.look_again);
}

//==============================================================================
// The writing thread

void PluginDevice::Link::offer (const Effort& e, bool withheld, std::uint64_t number, std::uint64_t of_episode) noexcept
{
    PendingEffort to { .effort = {}, .number = number, .episode = of_episode };
    std::copy_n (e.force.data(), 3, to.effort.force);
    std::copy_n (e.torque.data(), 3, to.effort.torque);
    to.effort.axis_count = static_cast<std::uint32_t> (e.axes.size());
    to.effort.signal_count = static_cast<std::uint32_t> (e.signals.size());
    std::copy (e.axes.begin(), e.axes.end(), to.effort.axes);
    std::copy (e.signals.begin(), e.signals.end(), to.effort.signals);
    to.effort.is_withheld = withheld ? 1 : 0;
    offered.store (to);
    something.ring();
}

void PluginDevice::Link::writeOn()
{
    if (options.real_time) raisePriority (priority::devices);
    const auto usual_wait = std::min<Clock::duration> (longest_silence / 4, longest_between_beats);
    auto wait = usual_wait;
    while (! isStopping())
    {
        something.wait (Clock::now() + wait);
        wait = serve() ? std::min<Clock::duration> (usual_wait, between_slew_steps) : usual_wait;
    }
}

/// Does what is due. True if a slew limit keeps back a part of the last effort.
bool PluginDevice::Link::serve()
{
    const std::lock_guard lock (calling);
    if (! device) return false;
    const auto now = Clock::now();
    const bool fails = failing_since && now - *failing_since > longest_silence;
    if (isConnected() && ! fails) poll (now);
    if (driven && isConnected() && (fails || rest_fails || now - given > longest_silence))
    {
        if (! std::exchange (is_silent, true))
        {
            silences.fetch_add (1, std::memory_order_relaxed);
            current_episode.fetch_add (1, std::memory_order_acq_rel);
        }
        const bool failed_before = rest_fails;
        quieten();
        if (failed_before && ! rest_fails) current_episode.fetch_add (1, std::memory_order_acq_rel);   // the force starts again from zero
    }
    else if (driven && ! isConnected())
        quieten();   // until the reading thread closes it
    if (failsafe && ! rest_fails && ! failsafe->beat (driven)) loseSuspended();
    return limiter.isBehind();
}

/// [with `calling` held]
void PluginDevice::Link::loseSuspended()
{
    lose ("the program or the computer was suspended, so the device is opened again");
    if (driven) quieten();   // a write that had begun before may have put its effort back
}

/// Writes what is offered. [with `calling` held]
void PluginDevice::Link::poll (Clock::time_point now)
{
    const auto latest = offered.load();
    const bool is_new = latest.number != handled;
    handled = latest.number;
    if (is_new)
    {
        given = now;
        is_silent = is_silent && rest_fails;   // a device that did not come to rest gets no effort before it has
    }
    if (latest.number == 0 || latest.episode != episode() || is_silent || (! is_new && ! limiter.isBehind())) return;
    if (! about.takesEfforts() || rest_fails) return;
    if (failsafe && ! failsafe->beat (true)) return loseSuspended();

    Effort wanted {};   // with what the driver has named: nothing else has a limit
    wanted.force = about.renderedForce (Vec3 { latest.effort.force });
    wanted.torque = about.renderedTorque (Vec3 { latest.effort.torque });
    for (int i = static_cast<int> (latest.effort.axis_count) - 1; i >= 0; --i)
        wanted.axes.set (i, latest.effort.axes[i]);
    for (int i = static_cast<int> (latest.effort.signal_count) - 1; i >= 0; --i)
        wanted.signals.set (i, latest.effort.signals[i]);

    limiter.tighten (slews[0], slews[1], slews[2]);
    const auto passed = driven ? std::min (now - written, longest_silence) : Clock::duration {};
    const auto& effort = limiter (wanted, secondsOf (passed));
    RemovedEffort without;
    Vec3::Map (without.force.data()) = Vec3 { latest.effort.force } - effort.force;
    Vec3::Map (without.torque.data()) = Vec3 { latest.effort.torque } - effort.torque;
    removed.store (without);

    driven = true;
    written = now;
    DriverReport why;
    int answer = TACTUS_DEVICE_FAILED;
    {
        const Call call (write_since);
        answer = device->write (effort, latest.effort.is_withheld != 0, max_signal, why);
    }
    writes.fetch_add (1, std::memory_order_relaxed);
    slow_writes = Clock::now() - now > longest_write ? slow_writes + 1 : 0;
    if (slow_writes == most_slow_writes) noteFailure ("`write` of the driver takes longer than 20 ms again and again: a stop comes up to twice as late");
    if (answer == TACTUS_DEVICE_OK) return failing_since.reset();
    if (! failing_since) failing_since = now;
    write_errors.fetch_add (1, std::memory_order_relaxed);
    if (answer == TACTUS_DEVICE_GONE)
        lose ("the device is gone: " + why.text ("it was unplugged, or does not answer"));
    else
        noteFailure ("the driver cannot write: " + why.text());
}

/// Asks the driver for rest. The device counts as driven until the driver says that it is at rest. [with `calling` held]
void PluginDevice::Link::quieten()
{
    DriverReport why;
    int answer = TACTUS_DEVICE_FAILED;
    if (failsafe && ! rest_fails) failsafe->beat (driven);
    {
        const Call call (write_since);
        answer = device->rest (why);
    }
    limiter.forget();
    removed.store ({});
    rest_fails = answer != TACTUS_DEVICE_OK;   // from now on, nothing beats, and the guardian takes the device
    if (! rest_fails)
    {
        driven = false;
        failing_since.reset();
    }
    else
    {
        write_errors.fetch_add (1, std::memory_order_relaxed);
        if (answer == TACTUS_DEVICE_GONE)
            lose ("the device is gone: " + why.text ("it was unplugged, or does not answer"));
        else
            noteFailure ("the device does not come to rest: " + why.text());
    }
    if (failsafe && ! rest_fails) failsafe->beat (driven);
}

/// [with `calling` held]
void PluginDevice::Link::leaveDevice()
{
    const auto end = Clock::now() + longest_leave;
    quieten();
    for (int tries = 1; driven && (tries < least_tries || Clock::now() < end); ++tries)
    {
        std::this_thread::sleep_for (between_tries);
        quieten();
    }
}

void PluginDevice::Link::leave()
{
    const std::lock_guard lock (calling);
    if (! device) return;
    leaveDevice();
    failsafe.reset();   // now, because the reading thread may hang in the driver
}

void PluginDevice::Link::close()
{
    const std::lock_guard lock (calling);
    device.reset();
}

}   // namespace tactus::host
