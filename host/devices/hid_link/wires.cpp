// SPDX-License-Identifier: MIT
#include "wires.hpp"
#include "line_reader.hpp"
#include "stale_datagrams.hpp"

#include <host/base/platform/device_file.hpp>
#include <host/base/platform/peer_lock.hpp>
#include <host/devices/failsafe/failsafe.hpp>
#include <host/devices/hid/hid_model.hpp>
#include <tactus/file/file_lock.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <filesystem>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>

namespace tactus::host::hid
{
namespace
{
using namespace std::chrono_literals;
using Clock = ReportFile::Clock;
using Outcome = ReportFile::Outcome;
using Kind = Outcome::Kind;

constexpr auto between_knocks = 100ms;
constexpr auto until_answer = 200ms;
constexpr int until_it_streams = 16;   // reports without another knock between them, as after a restart
constexpr auto until_gone = 1s;
constexpr auto until_late = 20ms;                               // without an answer: the device has missed a byte, or its answer was lost
constexpr auto until_settled = 5ms;                             // for a second answer after a doubt
constexpr int most_unanswered = 50, most_without_filler = 10;   // reports, after which a device that only answers counts as gone: about a second
constexpr std::size_t times_at_the_end = 3;                     // a datagram may be lost, and a dead program cannot send it again
constexpr std::size_t line_keeps = 4095;                        // bytes that Linux keeps of a serial line

Message systemError (int error) { return transferError (std::generic_category().message (error)); }

/// The common part of serial lines and UDP: the failsafe, and no feature reports.
class WireTransport : public Transport
{
public:
    WireTransport (WireFile f, std::string n, const Profile& p) : file (std::move (f)), has_ids (usesIds (p)), name (std::move (n)) {}

    bool canReadUntil() const noexcept override { return true; }

    Result<std::size_t> read (std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override
    {
        const auto got = readUntil (into, Clock::now() + timeout);
        if (got.what == Kind::failure) return systemError (got.error);
        return got.size;
    }

    Result<> write (std::span<const std::uint8_t> report) override
    {
        const int error = put (bodyOf (report));
        return error == 0 ? Result<> {} : systemError (error);
    }

    Result<> sendFeature (std::span<const std::uint8_t>) override { return transferError ("feature reports exist only in HID"); }
    Result<> getFeature (std::span<std::uint8_t>) override { return transferError ("feature reports exist only in HID"); }

    Result<> armFailsafe (const std::vector<OutgoingReport>& reports) override
    {
        std::vector<Failsafe::Report> last;
        for (const auto& r : reports)
            last.push_back ({ onTheWire (bodyOf (r.bytes)), false });
        repeat (last);
        failsafe.reset();
        auto armed = Failsafe::arm (file.descriptor(), name, last);
        if (! armed) return std::move (armed).error();
        failsafe.emplace (std::move (*armed));
        return {};
    }

    bool beat (bool driven) noexcept override { return ! failsafe || failsafe->beat (driven); }

protected:
    virtual int put (std::span<const std::uint8_t> report) = 0;   // an errno; 0: sent
    virtual Bytes onTheWire (std::span<const std::uint8_t> report) const { return { report.begin(), report.end() }; }
    virtual void repeat (std::vector<Failsafe::Report>&) const {}

    WireFile file;

private:
    std::span<const std::uint8_t> bodyOf (std::span<const std::uint8_t> report) const { return report.subspan (has_ids || report.empty() ? 0 : 1); }

    const bool has_ids;
    const std::string name;
    std::optional<Failsafe> failsafe;
};

class SerialTransport : public WireTransport
{
public:
    SerialTransport (WireFile f, FileLock l, std::string name, const Profile& p)
        : WireTransport (std::move (f), std::move (name), p), lock (std::move (l)), framing (p.wires.serial->framing),
          lines (framing, inputShapes (p), p.wires.serial->pause),
          kept (line_keeps / longestFrame (framing, longestInput (p))), room (longestFrame (framing, longest_report))
    {
        unsent.reserve (room.size());
    }

    std::size_t keptBySystem() const noexcept override { return std::max<std::size_t> (kept, 2); }

    Outcome readUntil (std::span<std::uint8_t> into, Clock::time_point until) noexcept override
    {
        const auto got = lines.read (file, into, until);
        stray.store (lines.counts().bytes, std::memory_order_relaxed);
        return got;
    }

    std::uint64_t strayBytes() const noexcept override { return stray.load (std::memory_order_relaxed); }

protected:
    int put (std::span<const std::uint8_t> report) override
    {
        if (const int error = finish(); error != 0) return error;
        const auto size = writeFrame (framing, report, room);
        if (size == 0) return EMSGSIZE;
        if (file.unsent() > size) return EAGAIN;   // the previous report still waits
        const auto sent = file.write (std::span (room).first (size));
        if (sent.error != 0) return sent.error;
        unsent.assign (room.begin() + static_cast<std::ptrdiff_t> (sent.size), room.begin() + static_cast<std::ptrdiff_t> (size));
        return 0;
    }

    /// Sends the rest of a report of which the line took only a part, because the device would not find the beginning of the next one.
    int finish()
    {
        if (unsent.empty()) return 0;
        const auto sent = file.write (unsent);
        unsent.erase (unsent.begin(), unsent.begin() + static_cast<std::ptrdiff_t> (sent.size));
        return unsent.empty() ? 0 : std::max (sent.error, EAGAIN);
    }

    Bytes onTheWire (std::span<const std::uint8_t> report) const override
    {
        Bytes bytes (longestFrame (framing, report.size()));
        bytes.resize (writeFrame (framing, report, bytes));
        return bytes;
    }

private:
    FileLock lock;   // so that only one driver uses the line
    const Framing framing;
    LineReader lines;                       // [reader]
    std::atomic<std::uint64_t> stray = 0;   // bytes, as the lines count them
    const std::size_t kept;
    Bytes room, unsent;   // [writer]
};

/// A line whose device only answers: it answers each report with one report, in order. The bytes do not show where an answer begins, nor to which
/// report it belongs. So a report with a force waits for the answer to the previous report, and bytes that come without a request are dropped. A
/// report that brings the device to rest does not wait. Fillers go before it, and complete a report of which the device may have missed a part. While
/// there is nothing to send, the neutral report is sent as a request.
class AskedTransport final : public SerialTransport
{
public:
    AskedTransport (WireFile f, FileLock l, std::string name, const Profile& p, const HidSystem& s)
        : SerialTransport (std::move (f), std::move (l), std::move (name), p), system (s), id (p.outputs.front().id),
          has_filler (p.wires.serial->filler.has_value()), last_word (system.now())
    {
        HidModel model (std::make_shared<const Profile> (p));
        const auto report = model.neutral (0);
        neutral.assign (report.begin() + (usesIds (p) ? 0 : 1), report.end());
        if (has_filler) afresh.assign (neutral.size() - 1, *p.wires.serial->filler);
        afresh.insert (afresh.end(), neutral.begin(), neutral.end());
    }

    bool canReadUntil() const noexcept override { return false; }   // the reading thread also writes, and may wait for the writing thread

    bool awaitsAnswer() const noexcept override
    {
        const std::lock_guard lock (speaking);
        return due > 0 || system.now() < settled;
    }

    Outcome readUntil (std::span<std::uint8_t> into, Clock::time_point until) noexcept override
    {
        for (;;)
        {
            const auto got = SerialTransport::readUntil (into, std::min (until, Clock::now() + std::max<Clock::duration> (untilNextWord(), 1ms)));
            if (got.what == Kind::failure) return got;
            const std::lock_guard lock (speaking);
            const auto now = system.now();
            if (got.what == Kind::report)
            {
                if (due == 0) continue;   // the answer has come too late, or was not requested
                if (--due == 0 && std::exchange (is_afresh, false)) settled = now + until_settled;
                unanswered = 0;
                is_pausing = false;
                return got;
            }
            if (now >= nextWord()) speak (now);
            if (unanswered >= (has_filler ? most_unanswered : most_without_filler)) return { .what = Kind::failure, .error = ETIMEDOUT };
            if (Clock::now() >= until) return {};
        }
    }

private:
    /// For the guardian, which does not know the state of the device.
    Bytes onTheWire (std::span<const std::uint8_t> report) const override
    {
        return SerialTransport::onTheWire (std::ranges::equal (report, neutral) ? std::span<const std::uint8_t> (afresh) : report);
    }

    int put (std::span<const std::uint8_t> report) override
    {
        const std::lock_guard lock (speaking);
        const bool rests = std::ranges::equal (report, neutral);
        if (! isAsked (report) || (due == 0 && (rests || system.now() >= settled))) return say (report);
        return rests ? sayAfresh() : EAGAIN;
    }

    /// False for a step of `init` or `exit`, which is not answered.
    bool isAsked (std::span<const std::uint8_t> report) const noexcept { return report.size() == neutral.size() && (! id || report.front() == *id); }

    /// [with `speaking` held]
    int say (std::span<const std::uint8_t> report)
    {
        const int error = SerialTransport::put (report);
        if (error == 0) last_word = system.now();
        if (error == 0 && isAsked (report)) ++due;
        return error;
    }

    /// Sends the neutral report to a device that may have missed a part of the last report. The device may answer both. [with `speaking` held]
    int sayAfresh()
    {
        const int error = SerialTransport::put (afresh);
        last_word = system.now();   // if the line has no room, this is tried again when the answer is late
        if (error != 0) return error;
        due = 1;
        is_afresh = true;
        is_pausing = false;
        return 0;
    }

    /// Called when nothing has been sent for a while. [with `speaking` held]
    void speak (Clock::time_point now)
    {
        last_word = now;
        if (due == 0)
        {
            static_cast<void> (say (neutral));   // if the line has no room, it is sent later
            return;
        }
        if (! has_filler && ! std::exchange (is_pausing, true)) return;
        ++unanswered;
        static_cast<void> (sayAfresh());
    }

    /// [with `speaking` held]
    Clock::time_point nextWord() const noexcept { return last_word + (due > 0 && ! is_pausing ? until_late : between_knocks); }

    Clock::duration untilNextWord() const noexcept
    {
        const std::lock_guard lock (speaking);
        return nextWord() - system.now();
    }

    const HidSystem& system;
    const std::optional<std::uint8_t> id;
    const bool has_filler;
    Bytes neutral, afresh;

    mutable std::mutex speaking;   // protects what follows, and writing
    int due = 0;                   // answers
    int unanswered = 0;            // reports in a row
    bool is_afresh = false;        // the last report followed fillers
    bool is_pausing = false;       // without a filler, only a pause ends a report of which the device has missed a part
    Clock::time_point last_word, settled {};
};

class UdpTransport final : public WireTransport
{
public:
    UdpTransport (WireFile f, PeerLock l, std::string name, const Profile& p)
        : WireTransport (std::move (f), std::move (name), p), lock (std::move (l)), stale (p), may_be_silent (sendsOnlyChanges (p)),
          must_stream (! may_be_silent && ! p.outputs.empty() && ! (p.rate > 0.0 && p.rate < 2.0 / std::chrono::duration<double> (between_knocks).count())),
          heard (Clock::now()), knocked (heard)
    {
    }

    void knock() noexcept
    {
        knocked = Clock::now();
        static_cast<void> (file.write ({}));   // if it does not arrive, the next one may
    }

    Outcome readUntil (std::span<std::uint8_t> into, Clock::time_point until) noexcept override
    {
        for (;;)
        {
            const auto got = file.read (into, until);
            if (got.what == Kind::failure) return got;
            const auto now = Clock::now();
            if (got.what == Kind::report)
            {
                heard = now;
                if (stale.isStale (into.first (got.size))) continue;
                if (to_come == 0) return got;
                --to_come;
                continue;
            }
            if (! may_be_silent && now - heard > until_gone) return { .what = Kind::failure, .error = ETIMEDOUT };
            if (now - std::max (heard, knocked) > between_knocks)
            {
                knock();
                // A device that only answers has no reading that a force could follow: it would get a pulse for each answer.
                if (must_stream) to_come = until_it_streams;
            }
            return got;
        }
    }

private:
    int put (std::span<const std::uint8_t> report) override
    {
        const auto sent = file.write (report);
        return sent.error == 0 && sent.size < report.size() ? EMSGSIZE : sent.error;
    }

    void repeat (std::vector<Failsafe::Report>& last) const override
    {
        const auto once = last;
        for (std::size_t n = 1; n < times_at_the_end && last.size() + once.size() <= Failsafe::most_reports; ++n)
            last.insert (last.end(), once.begin(), once.end());
    }

    PeerLock lock;          // so that only one driver uses the device
    StaleDatagrams stale;   // [reader]
    const bool may_be_silent, must_stream;
    Clock::time_point heard, knocked;   // [reader]
    int to_come = 0;                    // reports that do not count yet   [reader]
};

/// Without a remedy, the usual one helps.
Message notOpened (const ConnectedDevice& device, std::string why, std::string remedy = {})
{
    return Message::error (device.wire == Wire::serial && isForbidden (device.path) ? "hid/not_permitted" : "hid/not_opened", device.path, std::move (why),
                           std::move (remedy));
}

Result<std::unique_ptr<Transport>> openSerial (const ConnectedDevice& device, const Profile& profile, const HidSystem& system)
{
    std::error_code unseen;
    if (std::filesystem::is_directory (device.path, unseen))
        return notOpened (device, "it is a folder, not a serial line", "name the port itself, such as /dev/ttyACM0");
    auto locked = lockDevice (device.path);
    if (! locked) return std::move (locked).error();
    auto& alone = *locked;
    auto line = WireFile::openSerial (device.path, profile.wires.serial->baud);
    if (! line) return notOpened (device, line.error().text, line.error().remedy);
    if (! alone) return notOpened (device, "it cannot be locked");
    if (profile.wires.serial->framing == Framing::answer)
        return std::make_unique<AskedTransport> (std::move (*line), std::move (*alone), device.path, profile, system);
    return std::make_unique<SerialTransport> (std::move (*line), std::move (*alone), device.path, profile);
}

Result<std::unique_ptr<Transport>> openUdp (const ConnectedDevice& device, const Profile& profile)
{
    auto socket = WireFile::connectUdp (device.path);
    if (! socket) return notOpened (device, socket.error().text, socket.error().remedy);
    auto alone = PeerLock::take (socket->descriptor());   // before anything is sent, because the device would then send its reports here
    if (! alone) return inUse (device.path, std::move (alone.why));
    auto udp = std::make_unique<UdpTransport> (std::move (*socket), std::move (*alone.lock), device.path, profile);
    udp->knock();
    Bytes answer (longest_report + 1);
    const auto got = udp->readUntil (answer, Clock::now() + until_answer);
    if (got.what == Kind::failure) return notOpened (device, std::generic_category().message (got.error));
    if (got.what == Kind::nothing) return notOpened (device, "it does not answer");
    return udp;
}
}   // namespace

Result<std::unique_ptr<Transport>> HidSystem::reach (const ConnectedDevice& device, const Profile& profile)
{
    return device.wire == Wire::hid ? open (device) : openWire (device, profile, *this);
}

Result<std::unique_ptr<Transport>> openWire (const ConnectedDevice& device, const Profile& profile, const HidSystem& system)
{
    if (device.wire == Wire::serial && profile.wires.serial) return openSerial (device, profile, system);
    if (device.wire == Wire::udp && profile.wires.udp) return openUdp (device, profile);
    const std::string wire = device.wire == Wire::serial ? "serial" : "udp";
    return notOpened (device, "its profile " + profile.id + " has no wire " + quote (wire), "add it to \"wires\" of the profile, if the device really has it");
}

std::string lastingNameOf (const std::string& port, const std::string& by_id)
{
    std::error_code failed;
    const auto there = std::filesystem::canonical (port, failed);
    if (failed) return port;
    for (std::filesystem::directory_iterator it (by_id, failed), end; ! failed && it != end; it.increment (failed))
    {
        std::error_code broken;
        if (std::filesystem::canonical (it->path(), broken) == there && ! broken) return it->path().string();
    }
    return port;
}

}   // namespace tactus::host::hid
