// SPDX-License-Identifier: MIT
#pragma once

#include "transport.hpp"

#include <host/base/platform/doorbell.hpp>
#include <host/devices/hid/hid_model.hpp>
#include <host/devices/hid/reading_judge.hpp>
#include <tactus/kit/threads/snapshot.hpp>
#include <tactus/kit/threads/spsc_ring.hpp>
#include <tactus/text/result.hpp>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace tactus::host::hid
{

/// A time on the steady clock.
inline Nanoseconds nanosecondsOf (std::chrono::steady_clock::time_point t)
{
    return std::chrono::duration_cast<std::chrono::nanoseconds> (t.time_since_epoch()).count();
}

/// A report as it arrived. A report longer than the profile's longest one is cut to one byte more than that, so that it is
/// still recognised as too long.
struct ArrivedReport
{
    std::vector<std::uint8_t> bytes;
    Nanoseconds at = 0;
    std::uint64_t connection = 0;   ///< counted from 1; increases each time the device comes back
};

/// The traffic through a port since it was opened.
struct PortCounts
{
    std::uint64_t reports = 0;                                         ///< reports received, valid or not
    std::uint64_t read_by_tick = 0;                                    ///< of these, the ones that the tick thread read itself
    std::uint64_t asked_for = 0;                                       ///< of these, the answers of a silent device that was asked for its state
    std::uint64_t stray = 0;                                           ///< bytes of a serial line that belong to no report
    std::uint64_t overflown = 0;                                       ///< dropped because no tick had taken any reports for a long time
    std::uint64_t writes = 0;                                          ///< reports sent, including neutral ones
    std::uint64_t write_errors = 0;                                    ///< writes that the system rejected
    std::uint64_t dropped = 0;                                         ///< reports that a later one replaced before they were sent
    std::uint64_t silences = 0;                                        ///< number of times neutral reports were sent because no effort was offered for too long
    std::uint64_t departures = 0;                                      ///< number of times the device was disconnected
    double latency_min = 0.0, latency_mean = 0.0, latency_max = 0.0;   ///< from the arrival of a report until its answer was sent, in s
};

/// An open device with a profile, over HID or another wire, with a reading thread and a writing thread. Incoming reports queue up until a tick
/// takes them. Only the latest of each outgoing report is kept, so nothing ever queues up on the way out.
///
/// The tick thread of a run that the device ticks reads the device itself, which saves the report a change of threads (readHere).
/// Meanwhile the reading thread sleeps; it returns to its work when the device is gone, to open it again.
///
///  - On opening, and when the device comes back, the port performs the profile's init steps; on closing, it sends the
///    neutral reports and performs the exit steps. A number that the device returns in a step (Answer) is inserted into
///    everything sent afterwards.
///  - If the device goes away, the port looks for it every half second, by serial number, else by path, else by ids; on other wires, by the
///    port or address that the person has named.
///  - A device that is driven, but sends only when something changes, is asked for the reports with its position while they do not come, once it
///    has sent something. An answer counts as a report. If the device does not answer, or takes longer than the watchdog, it is not asked
///    again until it is reopened, and its readings get old when nothing changes.
///  - If no effort is offered for longer than the watchdog, the port sends the neutral reports, again and again until the system takes them.
///  - If the process dies or freezes, the failsafe sends the neutral reports (Transport::armFailsafe). A port whose device got
///    them, or that finds that the computer has slept, treats the device as gone away and back.
///
/// Each return of the device and each silence starts a new `episode`. Efforts offered for an earlier episode are not sent:
/// the caller must start from zero again, as HidDevice does.
class HidPort
{
public:
    struct Options
    {
        std::chrono::milliseconds look_again { 500 };   ///< interval between attempts to find a disconnected device
        bool real_time = true;                          ///< real-time priority for the threads, if the system grants it
        bool lend = true;                               ///< the tick thread may read the device itself, if the system lets it
    };

    using Clock = std::chrono::steady_clock;

    /// Opens the device. The system must outlive the port. [main thread]
    /// Ids: hid/not_permitted, hid/not_opened, hid/init, and those of the profile's Answer steps.
    static Result<std::unique_ptr<HidPort>> open (HidSystem&, const ConnectedDevice&, std::shared_ptr<const Profile>, Options);
    static Result<std::unique_ptr<HidPort>> open (HidSystem& s, const ConnectedDevice& d, std::shared_ptr<const Profile> p)
    {
        return open (s, d, std::move (p), Options {});
    }

    ~HidPort();   ///< sends the neutral reports and performs the exit steps first   [main thread]
    HidPort (const HidPort&) = delete;
    HidPort& operator= (const HidPort&) = delete;

    const std::shared_ptr<const Profile>& profile() const noexcept { return description; }
    bool hasIds() const noexcept { return has_ids; }   ///< true if reports begin with an id
    const ConnectedDevice& device() const noexcept { return wanted; }

    /// The longest time that a device may be silent: the profile's watchdog, or GuardLimits::default_watchdog.
    Clock::duration watchdog() const noexcept { return longest_silence; }

    //==========================================================================
    // Readings and efforts. Nothing here allocates or locks. [one thread, the tick thread of a run]

    /// Passes on all reports that arrived since the last call, in order.
    template <typename F>
    void drain (F&& f)
    {
        ring.drain ([&] (std::span<const ArrivedReport> report) { f (report.front()); });
    }

    /// Replaces the content of an output report. `answers` is the arrival time of the report that this one answers; 0 if
    /// it answers none. A report that `rests` asks for no effort: if the last one sent did, it is sent at once, whatever the rate
    /// and the keepalive of the profile, so a stop never takes longer than promised.
    void offer (std::size_t report, std::span<const std::uint8_t> bytes, std::uint64_t episode, Nanoseconds answers, bool rests) noexcept;

    /// Wakes the writing thread, which sends what was offered. Without this call, sending may be delayed by half a report period.
    void sendNow() noexcept { something.ring(); }

    Nanoseconds now() const noexcept { return nanosecondsOf (system.now()); }
    std::uint64_t episode() const noexcept { return current_episode.load (std::memory_order_acquire); }
    std::uint64_t overflown() const noexcept { return ring.lost(); }

    //==========================================================================
    // For a clock. [tick thread]

    /// Asks to read the device on this thread, in waitForReport(). The reading thread lends the device as soon as its own read has
    /// returned, and lends it again each time it has reopened the device. If this thread cannot read it on this system
    /// (Transport::canReadUntil), the device is never lent.
    void readHere() noexcept;
    void readElsewhere() noexcept;   ///< gives the device back; to be called before this thread ends

    /// True as soon as a report has arrived since the last wait; false on timeout.
    bool waitForReport (Clock::time_point until) noexcept;

    /// The time when the latest report was read.
    Nanoseconds lastArrival() const noexcept { return last_arrival.load (std::memory_order_acquire); }

    /// True if this thread reads the device and came too late for the latest report: it was already there, or there were several.
    bool wasLate() const noexcept { return was_late; }

    /// True if so many reports were there that the system may have dropped newer ones.
    bool mayLackNewest() const noexcept { return may_lack_newest; }

    //==========================================================================
    bool isReadByTick() const noexcept { return reads.load (std::memory_order_acquire) == Reader::tick; }   ///< [any thread]
    bool isConnected() const noexcept { return connected.load (std::memory_order_acquire); }                ///< [any thread]
    PortCounts counts() const noexcept;                                                                     ///< [any thread but the tick thread]
    std::string trouble() const;                                                                            ///< the latest failure; empty: none [any thread]

private:
    HidPort (HidSystem&, ConnectedDevice, std::shared_ptr<const Profile>, Options);

    /// Outgoing content, shared by the tick thread and the writing thread.
    struct PendingReport
    {
        std::uint64_t number = 0, episode = 0, size = 0;
        Nanoseconds answers = 0;
        std::uint64_t rests = 0;   // 1 if the report asks for no effort
        std::array<std::uint8_t, longest_report + 8> bytes {};
    };

    // A device specified at 1000 Hz may send 1001 reports a second, each of which gets an answer, and several may arrive together.
    static constexpr double more_than_the_rate = 1.05;
    static constexpr double burst = 4.0;   // how many reports may be sent in a row

    struct Output
    {
        Snapshot<PendingReport> offered;
        PendingReport draft;   // [tick thread]

        // [writing thread]
        std::uint64_t seen = 0;             // number of the last offer handled
        double credit = burst;              // reports that may be sent right now
        Clock::time_point earned;           // the time up to which credit has been earned
        Clock::time_point sent;             // when the last report was sent
        std::vector<std::uint8_t> latest;   // the content of the last report
        bool pushes = false;                // the last report may have left an effort on the device
    };

    using Opened = std::shared_ptr<Transport>;

    Result<> wake (Transport&);
    Result<> perform (Transport&, const Step&);
    Result<> ask (Transport&, const Step&);
    Result<> armFailsafe (Transport&);
    Bytes addressed (std::span<const std::uint8_t> wire, const std::optional<Bits>& place, std::size_t block) const;
    Bytes wireOf (const Step&) const;
    void become (Opened);
    Opened transport() const;
    void note (const std::string& what);
    bool isStopping() const noexcept { return stopping.load (std::memory_order_acquire); }

    void readOn();
    void hear (std::span<const std::uint8_t> report);
    bool ask (Transport&, const InputReport&);
    void lend (Transport&);
    void arrive (std::span<const std::uint8_t> report) noexcept;
    bool takeWaiting() noexcept;
    void take (std::size_t size) noexcept;
    bool readUntil (Clock::time_point) noexcept;
    bool isNews() noexcept;
    void lookAgain();
    void lose (Transport&, const std::string& why);
    const ConnectedDevice* sameAmong (const std::vector<ConnectedDevice>&) const;

    void writeOn();
    bool serve (Transport&);
    void poll (Transport&, Output&, std::size_t report, Clock::time_point now);
    Clock::time_point nextLook (Clock::time_point now) const;
    Result<> send (Transport&, std::size_t report, std::span<const std::uint8_t>);
    bool quieten (Transport&);
    void leave();
    void leave (Transport&);
    std::vector<OutgoingReport> neutralReports();
    void count (Nanoseconds answers, Clock::time_point sent_at) noexcept;

    HidSystem& system;
    const ConnectedDevice wanted;
    const std::shared_ptr<const Profile> description;
    const Options options;
    const Clock::duration longest_silence;
    const bool has_ids;
    const std::vector<const InputReport*> states;   // the reports that the device is asked for while they do not come

    SpscRing<ArrivedReport> ring;
    Doorbell arrived, something;   // `arrived`: the reading thread wakes the tick thread; `something`: any thread wakes the writing thread

    /// The thread that reads the device. The tick thread asks for it, the reading thread lends it, the tick thread gives it back.
    enum class Reader : std::uint8_t
    {
        reading_thread,
        reading_thread_but_asked,
        tick
    };
    std::atomic<Reader> reads = Reader::reading_thread;
    Doorbell given_back;                              // wakes the reading thread
    Transport* lent = nullptr;                        // valid while Reads::tick: the reading thread keeps it open
    std::vector<std::uint8_t> buffer;                 // [tick thread]
    std::uint64_t known = 0;                          // reports that the tick thread knows of   [tick thread]
    bool was_late = false, may_lack_newest = false;   // [tick thread]

    std::atomic<Nanoseconds> last_arrival = 0;
    std::atomic<std::uint64_t> current_episode = 1;
    std::atomic<bool> connected = false, stopping = false;
    std::vector<std::unique_ptr<Output>> outputs;

    mutable std::mutex opening;   // protects `link`, `stray_before` and `last_trouble`; never taken on the tick thread
    Opened link;
    std::uint64_t stray_before = 0;   // stray bytes of earlier connections
    std::string last_trouble;
    std::condition_variable stopped;

    std::mutex writing;                                   // protects all writing and the members below; never taken on the tick thread
    HidModel quiet;                                       // encodes the neutral reports
    std::array<std::uint32_t, most_blocks> assigned {};   // the numbers that the device returned and expects back; 0: none
    std::vector<Clock::time_point> heard;                 // when each of `states` came last; empty before the first report   [reading thread]
    bool may_ask = true;                                  // false after the device did not answer in time   [reading thread]
    std::uint64_t connections = 0;                        // [reading thread, which does not change it while the tick thread reads]
    bool driven = false;                                  // true if the last report sent was not neutral
    Clock::time_point given;                              // time of the latest new offer
    bool is_silent = false;                               // there has been none for longer than the watchdog

    std::atomic<std::uint64_t> reports = 0, read_by_tick = 0, asked_for = 0, writes = 0, write_errors = 0, dropped = 0, silences = 0, departures = 0;
    std::atomic<std::uint64_t> answers_sent = 0;
    std::atomic<double> latency_sum = 0.0, latency_min = 0.0, latency_max = 0.0;

    std::jthread reader, writer;   // declared last: they use the other members
};

}   // namespace tactus::host::hid
