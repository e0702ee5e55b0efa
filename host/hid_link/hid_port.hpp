// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/hid_model.hpp>
#include <host/hid_link/doorbell.hpp>
#include <host/hid_link/report_ring.hpp>
#include <host/hid_link/transport.hpp>
#include <host/runtime/snapshot.hpp>

#include <framework/message.hpp>

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <variant>
#include <vector>

namespace tactus::host::hid
{

/// What went through a port since it was opened.
struct PortCounts
{
    std::uint64_t reports = 0;                                         ///< that came in, whatever was in them
    std::uint64_t overflown = 0;                                       ///< that found nobody to take them for a long time
    std::uint64_t writes = 0;                                          ///< that were sent, the neutral ones too
    std::uint64_t write_errors = 0;                                    ///< that the system did not take
    std::uint64_t dropped = 0;                                         ///< that were overwritten by later ones before they were sent
    std::uint64_t silences = 0;                                        ///< times that nobody gave an effort for too long, so that the neutral reports were sent
    std::uint64_t departures = 0;                                      ///< times that the device went away
    double latency_min = 0.0, latency_mean = 0.0, latency_max = 0.0;   ///< s from the arrival of a report until its answer was sent
};

/// An open HID device with a thread that reads it and one that writes to it. Reports wait for whoever takes them; of what
/// is to be sent only the latest is kept, so that nothing ever queues up.
///
///  - On opening, also after the device was away, the profile's init steps are done; on closing, the neutral reports and
///    the exit steps. A number that the device gives in a step (Answer) is put into what is sent from then on.
///  - A device that goes away is looked for every half second, by its serial number, else by its path, else by its ids.
///  - If nobody gives an effort for longer than the watchdog, the neutral reports are sent.
///  - If the process dies, they are too (Transport::leaveWill).
///
/// After the device was away, and after a silence, there is another `episode`. Efforts that were given for an earlier one
/// are not sent: whoever gives them has to begin at zero (HidDevice does).
class HidPort
{
public:
    struct Options
    {
        std::chrono::milliseconds look_again { 500 };   ///< for a device that is away
        bool real_time = true;                          ///< priorities for the threads, if the system grants them
    };

    using Clock = std::chrono::steady_clock;

    /// Opens it, or says why not. The system outlives the port. [main thread]
    /// Ids: hid/not_permitted, hid/not_opened, hid/init, and those that an Answer of the profile means.
    static std::variant<std::unique_ptr<HidPort>, Message> open (HidSystem&, const ConnectedDevice&, std::shared_ptr<const Profile>, Options);
    static std::variant<std::unique_ptr<HidPort>, Message> open (HidSystem& s, const ConnectedDevice& d, std::shared_ptr<const Profile> p) { return open (s, d, std::move (p), Options {}); }

    ~HidPort();   ///< neutral and exit first   [main thread]
    HidPort (const HidPort&) = delete;
    HidPort& operator= (const HidPort&) = delete;

    const std::shared_ptr<const Profile>& profile() const noexcept { return description; }
    bool hasIds() const noexcept { return has_ids; }   ///< reports begin with an id
    const ConnectedDevice& device() const noexcept { return wanted; }

    //==========================================================================
    // Efforts and readings. No system call, no lock, no allocation. [one thread, the tick thread of a run]

    /// Hands over all reports that came since the last time, in order.
    template <typename F>
    void drain (F&& f)
    {
        ring.drain (std::forward<F> (f));
    }

    /// What this report is to be from now on, in answer to a report that came then (0: to none).
    void offer (std::size_t report, std::span<const std::uint8_t> bytes, std::uint64_t episode, Nanoseconds answers) noexcept;

    std::uint64_t episode() const noexcept { return current_episode.load (std::memory_order_acquire); }
    std::uint64_t overflown() const noexcept { return ring.lost(); }

    //==========================================================================
    // For a clock. [tick thread]

    /// True as soon as a report has come that was not waited for before.
    bool waitForReport (Clock::time_point until) noexcept { return arrived.wait (until); }
    Nanoseconds lastArrival() const noexcept { return last_arrival.load (std::memory_order_acquire); }

    /// Has what was offered sent now; else it takes up to half a period.
    void kick() noexcept { something.ring(); }

    //==========================================================================
    bool isConnected() const noexcept { return connected.load (std::memory_order_acquire); }   ///< [any thread]
    PortCounts counts() const noexcept;                                                        ///< [any thread]
    std::string trouble() const;                                                               ///< what failed last, in words; else empty [any thread]

private:
    HidPort (HidSystem&, ConnectedDevice, std::shared_ptr<const Profile>, Options);

    /// What is to be sent, as the two threads share it: words.
    struct Offer
    {
        std::uint64_t number = 0, episode = 0, size = 0;
        Nanoseconds answers = 0;
        std::array<std::uint8_t, longest_report + 8> bytes {};
    };

    struct Output
    {
        Snapshot<Offer> offered;
        Offer draft;   // of the tick thread

        // Of the writing thread.
        std::uint64_t seen = 0;             // number of the offer that was dealt with
        double credit = 0.0;                // reports that may be sent at once
        Clock::time_point earned;           // until when credit was given
        Clock::time_point sent;             // the last time
        std::vector<std::uint8_t> latest;   // what was sent
    };

    using Opened = std::shared_ptr<Transport>;

    std::optional<Message> wake (Transport&);
    std::optional<Message> perform (Transport&, const Step&);
    std::optional<Message> ask (Transport&, const Step&);
    std::string leaveWill (Transport&);
    Bytes addressed (std::span<const std::uint8_t> wire, const std::optional<Bits>& place) const;
    Bytes wireOf (const Step&) const;
    void become (Opened);
    Opened transport() const;
    void note (const std::string& what);
    bool isStopping() const noexcept { return stopping.load (std::memory_order_acquire); }

    void readOn();
    void lookAgain();
    void lose (Transport&, const std::string& why);
    const ConnectedDevice* sameAmong (const std::vector<ConnectedDevice>&) const;

    void writeOn();
    void attend (Transport&, Output&, std::size_t report, Clock::time_point now);
    Clock::time_point nextLook (Clock::time_point now) const;
    std::optional<std::string> send (Transport&, std::size_t report, std::span<const std::uint8_t>);
    void quieten (Transport&);
    void leave (Transport&);
    std::vector<OutgoingReport> farewell();
    void count (Nanoseconds answers, Clock::time_point sent_at) noexcept;

    HidSystem& system;
    const ConnectedDevice wanted;
    const std::shared_ptr<const Profile> description;
    const Options options;
    const Clock::duration watchdog;
    const bool has_ids;

    ReportRing ring;
    Doorbell arrived, something;
    std::atomic<Nanoseconds> last_arrival = 0;
    std::atomic<std::uint64_t> current_episode = 1;
    std::atomic<bool> connected = false, stopping = false;
    std::vector<std::unique_ptr<Output>> outputs;

    mutable std::mutex opening;   // of `link` and `last_trouble`
    Opened link;
    std::string last_trouble;
    std::condition_variable stopped;

    std::mutex writing;              // of all that is written, and of what is below
    HidModel quiet;                  // makes the neutral reports
    std::uint32_t assigned = 0;      // the number that the device gave, to be sent along; 0: none
    std::uint64_t connections = 0;   // of the reading thread
    bool driven = false;             // something else than neutral was sent last
    Clock::time_point given;         // when there was a new offer last

    std::atomic<std::uint64_t> reports = 0, writes = 0, write_errors = 0, dropped = 0, silences = 0, departures = 0;
    std::atomic<std::uint64_t> answers_sent = 0;
    std::atomic<double> latency_sum = 0.0, latency_min = 0.0, latency_max = 0.0;

    std::jthread reader, writer;   // last: they use the others
};

}   // namespace tactus::host::hid
