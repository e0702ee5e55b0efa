// SPDX-License-Identifier: MIT
#include "wires.hpp"
#include "line_reader.hpp"
#include "stale_datagrams.hpp"

#include <host/platform/device_file.hpp>
#include <host/platform/failsafe.hpp>
#include <tactus/file/file_lock.hpp>

#include <algorithm>
#include <cerrno>
#include <filesystem>
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
constexpr auto until_gone = 1s;
constexpr std::size_t times_at_the_end = 3;   // a datagram may be lost, and nobody sends it again when this program is dead
constexpr std::size_t line_keeps = 4095;      // bytes that Linux keeps of a serial line

Message systemError (int error) { return transferError (std::generic_category().message (error)); }

/// What serial lines and UDP have in common: the failsafe, and that there are no feature reports.
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

class SerialTransport final : public WireTransport
{
public:
    SerialTransport (WireFile f, FileLock l, std::string name, const Profile& p)
        : WireTransport (std::move (f), std::move (name), p), lock (std::move (l)), framing (p.wires.serial->framing), lines (framing, inputShapes (p)),
          kept (line_keeps / longestFrame (framing, longestInput (p))), room (longestFrame (framing, longest_report))
    {
        unsent.reserve (room.size());
    }

    std::size_t keptBySystem() const noexcept override { return std::max<std::size_t> (kept, 2); }

    Outcome readUntil (std::span<std::uint8_t> into, Clock::time_point until) noexcept override
    {
        return lines.read (file, into, until);
    }

private:
    Bytes onTheWire (std::span<const std::uint8_t> report) const override
    {
        Bytes bytes (longestFrame (framing, report.size()));
        bytes.resize (writeFrame (framing, report, bytes));
        return bytes;
    }

    int put (std::span<const std::uint8_t> report) override
    {
        if (const int error = finish(); error != 0) return error;
        const auto size = writeFrame (framing, report, room);
        if (size == 0) return EMSGSIZE;
        if (file.unsent() > size) return EAGAIN;   // another one still waits
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

    FileLock lock;   // only one driver uses the line
    const Framing framing;
    LineReader lines;   // [reader]
    const std::size_t kept;
    Bytes room, unsent;   // [writer]
};

class UdpTransport final : public WireTransport
{
public:
    UdpTransport (WireFile f, std::string name, const Profile& p)
        : WireTransport (std::move (f), std::move (name), p), stale (p), may_be_silent (sendsOnlyChanges (p)), heard (Clock::now()), knocked (heard)
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
                if (! stale.isStale (into.first (got.size))) return got;
                continue;
            }
            if (! may_be_silent && now - heard > until_gone) return { .what = Kind::failure, .error = ETIMEDOUT };
            if (now - std::max (heard, knocked) > between_knocks) knock();
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

    StaleDatagrams stale;   // [reader]
    const bool may_be_silent;
    Clock::time_point heard, knocked;   // [reader]
};

Message notOpened (const ConnectedDevice& device, std::string why)
{
    return Message::error (device.wire == Wire::serial && isForbidden (device.path) ? "hid/not_permitted" : "hid/not_opened", device.path, std::move (why));
}

Result<std::unique_ptr<Transport>> openSerial (const ConnectedDevice& device, const Profile& profile)
{
    auto alone = FileLock::takeExisting (device.path);
    std::error_code unseen;
    if (! alone && std::filesystem::exists (device.path, unseen) && ! isForbidden (device.path))
        return notOpened (device, "another role or another instance of Tactus is using it");
    auto line = WireFile::openSerial (device.path, profile.wires.serial->baud);
    if (! line) return notOpened (device, line.error().text);
    if (! alone) return notOpened (device, "it cannot be locked");
    return std::make_unique<SerialTransport> (std::move (*line), std::move (*alone), device.path, profile);
}

Result<std::unique_ptr<Transport>> openUdp (const ConnectedDevice& device, const Profile& profile)
{
    auto socket = WireFile::connectUdp (device.path);
    if (! socket) return notOpened (device, socket.error().text);
    auto udp = std::make_unique<UdpTransport> (std::move (*socket), device.path, profile);
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
    return device.wire == Wire::hid ? open (device) : openWire (device, profile);
}

Result<std::unique_ptr<Transport>> openWire (const ConnectedDevice& device, const Profile& profile)
{
    if (device.wire == Wire::serial && profile.wires.serial) return openSerial (device, profile);
    if (device.wire == Wire::udp && profile.wires.udp) return openUdp (device, profile);
    return notOpened (device, "its profile " + profile.id + " does not know this wire");
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
