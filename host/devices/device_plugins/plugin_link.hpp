// SPDX-License-Identifier: MIT
#pragma once

#include "effort_limiter.hpp"
#include "plugin_device.hpp"
#include "stamp_watch.hpp"

#include <host/base/platform/doorbell.hpp>

#include <array>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <optional>

namespace tactus::host
{

/// The two threads of a PluginDevice, and what they share with the tick thread. Lives as long as anyone uses it.
class PluginDevice::Link
{
public:
    using Clock = std::chrono::steady_clock;

    Link (std::unique_ptr<OpenedDevice>, std::optional<Failsafe>, const Options&);

    //==========================================================================
    // [tick thread]

    /// The newest reading, and what is known about it.
    struct LatestReading
    {
        tactus_reading reading {};
        std::uint64_t number = 0;     // 0: there has been none
        std::int64_t at = 0;          // when it came, in ns of the steady clock
        double lag_s = 0.0;           // its lag by the clock of the device, in s
        double numbered = 0.0;        // its number, if it has one
        std::uint64_t fault = 0;      // a ReadingFault: why it must not be used
        std::uint64_t standing = 0;   // a ReadingFault: why a later one did not count as new
    };

    /// The part of an effort that the last limit has removed.
    struct RemovedEffort
    {
        std::array<double, 3> force {}, torque {};
    };

    LatestReading taken() const noexcept { return newest.load(); }
    RemovedEffort unrendered() const noexcept { return removed.load(); }
    void offer (const Effort&, bool withheld, std::uint64_t number, std::uint64_t of_episode) noexcept;
    std::uint64_t episode() const noexcept { return current_episode.load (std::memory_order_acquire); }
    bool isConnected() const noexcept { return ! is_lost.load (std::memory_order_acquire); }
    bool isStuck (Clock::time_point now) const noexcept;   ///< a function of the driver does not return

    //==========================================================================
    // [any thread]

    bool isDriven() const noexcept { return driven.load (std::memory_order_relaxed); }
    void limitSlews (double force, double torque, double axis) noexcept;
    void limitSignals (double max) noexcept { max_signal = max; }
    PluginCounts counts() const noexcept;
    Clock::time_point lastArrival() const noexcept { return Clock::time_point (std::chrono::nanoseconds (last_arrival.load (std::memory_order_acquire))); }
    std::string trouble() const;
    void note (const std::string& what);

    //==========================================================================
    // The threads.

    enum class Thread
    {
        reading,
        writing
    };

    void readOn();                              ///< [reading thread]
    void writeOn();                             ///< [writing thread]
    void leave();                               ///< brings the device to rest at the end   [writing thread]
    void close();                               ///< after that   [reading thread]
    void ends (Thread);                         ///< [the thread itself, last]
    void stop() noexcept;                       ///< [main thread]
    bool waitFor (Thread, Clock::time_point);   ///< true if it has ended   [main thread]
    bool isStopping() const noexcept { return stopping.load (std::memory_order_acquire); }
    const std::string& name() const noexcept { return called; }

private:
    struct PendingEffort
    {
        tactus_effort effort {};
        std::uint64_t number = 0, episode = 0;
    };

    /// A call of the driver. It stores the time when it begins, in ns of the steady clock, and 0 when it ends: none is running.
    class Call
    {
    public:
        explicit Call (std::atomic<std::int64_t>& s) noexcept : since (s) { since.store (nanoseconds (Clock::now()), std::memory_order_release); }
        ~Call() { since.store (0, std::memory_order_release); }
        Call (const Call&) = delete;
        Call& operator= (const Call&) = delete;

    private:
        std::atomic<std::int64_t>& since;
    };

    static std::int64_t nanoseconds (Clock::time_point t) noexcept
    {
        return std::chrono::duration_cast<std::chrono::nanoseconds> (t.time_since_epoch()).count();
    }

    void take (tactus_reading&, const tactus_device_stamp&, Clock::time_point now) noexcept;
    bool isWhole (const tactus_reading&) const noexcept;
    void lookAgain();
    void pause (std::chrono::milliseconds);
    void lose (const std::string& why);
    void noteFailure (const std::string& what);   // of a call; the reason why the device is gone stays

    bool serve();
    void poll (Clock::time_point now);
    void quieten();
    void loseSuspended();
    void leaveDevice();

    const Options options;
    const Clock::duration longest_silence;
    const std::string called;
    const std::shared_ptr<const DeviceDriver> driver;
    const Json description;
    const DriverAbout about;

    Snapshot<LatestReading> newest;
    Snapshot<PendingEffort> offered;
    Snapshot<RemovedEffort> removed;
    Doorbell something;   // wakes the writing thread
    std::atomic<std::uint64_t> current_episode = 1;
    std::atomic<bool> is_lost = false, stopping = false, driven = false;
    std::atomic<std::int64_t> last_arrival = 0, read_since = 0, write_since = 0;
    std::array<std::atomic<double>, 3> slews;   // of the role's guard
    std::atomic<double> max_signal = GuardLimits::none;

    LatestReading draft;   // [reading thread]
    StampWatch watch;      // [reading thread]

    mutable std::mutex calling;             // held while the driver writes or rests, and while the device is replaced; never taken on the tick thread
    std::unique_ptr<OpenedDevice> device;   // null while it is gone. Only the reading thread replaces it, so it reads without the lock
    std::optional<Failsafe> failsafe;
    EffortLimiter limiter;                            // with `calling` held
    std::uint64_t handled = 0;                        // number of the last offer   [writing thread]
    Clock::time_point given;                          // when it came   [writing thread]
    Clock::time_point written;                        // when the last effort was written   [writing thread]
    std::optional<Clock::time_point> failing_since;   // the driver has not written anything since   [writing thread]
    int slow_writes = 0;                              // in a row           [writing thread]
    bool rest_fails = false;                          // it has said last that the device is not at rest; with `calling` held
    bool is_silent = true;                            // nothing has been offered for too long   [writing thread]

    mutable std::mutex telling;   // protects `said` and `ended`
    std::string said;
    std::array<bool, 2> ended {};
    std::condition_variable changed;

    std::atomic<std::uint64_t> readings = 0, refused = 0, repeated = 0, lost = 0, restarts = 0, read_errors = 0, held_up = 0;
    std::atomic<double> reached_hz = 0.0;
    std::atomic<std::uint64_t> writes = 0, write_errors = 0, silences = 0, departures = 0;
};

}   // namespace tactus::host
