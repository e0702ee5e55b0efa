// SPDX-License-Identifier: MIT
#pragma once

#include "support/waiting.hpp"

#include <host/devices/failsafe/failsafe.hpp>
#include <host/devices/hid/profile_reader.hpp>
#include <host/devices/hid_link/hid_device.hpp>

#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace tactus::test
{

using Bytes = std::vector<std::uint8_t>;

/// A board on a virtual wire, with reports of 24 bytes, without ids. In: mark, flags (bit 0: valid), sequence u16,
/// x, y, z as s32 in nm. Out: mark, enable, echoed sequence u16, force as s32 in uN.
struct BoardProfile
{
    double rate = 1000.0, max_rate = 1000.0, keepalive = 0.0;
    double watchdog = 10.0;   // long, so that the port does not send neutral reports by itself when the machine is busy
    double ramp = 0.01;
    double max_slew = 0.0;                                   // N/s; 0: no limit
    std::string more_fields {}, more_of_input {}, more {};   // further fields, and keys of the input report and of the profile
    std::string steps = R"("init": [{"bytes": "aa 01"}, {"kind": "feature", "bytes": "aa 02"}], "exit": [{"bytes": "aa 03"}],)";

    std::shared_ptr<const host::hid::Profile> make() const
    {
        const auto number = [] (double v) { return Json (v).dump(); };
        auto loaded = host::hid::readProfileText (
            R"({"format": "tactus-profile", "version": 1, "id": "board", "name": "Board", "match": [{"vid": "0x1209", "pid": "0x0001"}], )" + steps + R"(
            "inputs": [{"length": 24, "verified": false, "why_not": "made up", "sequence": "count", "fields": [
                {"name": "mark", "at": 0, "type": "u8", "expect": "0x54"}, {"name": "homed", "at": 1, "type": "u1"},
                {"name": "count", "at": 2, "type": "u16le"}, {"name": "x", "at": 4, "type": "s32le", "scale": "1 nm"},
                {"name": "y", "at": 8, "type": "s32le", "scale": "1 nm"}, {"name": "z", "at": 12, "type": "s32le", "scale": "1 nm"})"
            + more_fields + "]" + more_of_input + "}], " + more + R"(
            "outputs": [{"name": "effort", "neutral": "54 00*23", "verified": false, "why_not": "made up", "fields": [
                {"source": "enable", "at": 1, "type": "u1"}, {"name": "count", "at": 2, "type": "u16le", "source": "echo"},
                {"name": "fx", "at": 4, "type": "s32le", "scale": "1 uN"}, {"name": "fy", "at": 8, "type": "s32le", "scale": "1 uN"},
                {"name": "fz", "at": 12, "type": "s32le", "scale": "1 uN"}], "max_rate": )"
            + number (max_rate) + (keepalive > 0.0 ? R"(, "keepalive": )" + number (keepalive) : "") + R"(}],
            "position": ["x", "y", "z"], "valid": "homed", "force": ["fx", "fy", "fz"],
            "limits": {"max_force": 3.0, "ramp": )"
            + number (ramp) + (max_slew > 0.0 ? R"(, "max_slew": )" + number (max_slew) : "") + R"(, "stale_input": )"
            + number (watchdog) + R"(}, "rate": )" + number (rate) + R"(, "sources": ["made up"]})");
        std::string wrong;
        for (const auto& m : loaded.messages)
            wrong += m.where + ": " + m.text + "\n";
        INFO (wrong);
        REQUIRE (loaded.profile);
        return loaded.profile;
    }
};

inline Bytes boardReport (std::uint16_t count, std::int32_t x = 0, std::int32_t y = 0, std::int32_t z = 0)
{
    Bytes b (24);
    b[0] = 0x54;
    b[1] = 1;
    std::memcpy (b.data() + 2, &count, 2);
    std::memcpy (b.data() + 4, &x, 4);
    std::memcpy (b.data() + 8, &y, 4);
    std::memcpy (b.data() + 12, &z, 4);
    return b;
}

/// A report that the board received.
struct Told
{
    enum class How
    {
        output,
        feature,
        failsafe
    };

    Bytes bytes;
    How how = How::output;
    double at_s = 0.0;   // since the board was made

    // An output report begins with a 0.
    bool isEffort() const { return how == How::output && bytes.size() == 25; }
    bool isDriven() const { return isEffort() && bytes[2] == 1; }
    bool isNeutral() const { return isEffort() && bytes[2] == 0; }
    std::uint16_t echo() const { return static_cast<std::uint16_t> (bytes[3] | bytes[4] << 8); }
    /// In uN; a number that is no force if this is not an effort.
    std::int32_t force (std::size_t axis) const
    {
        std::int32_t f = std::numeric_limits<std::int32_t>::min();
        if (! isEffort()) return f;
        std::memcpy (&f, bytes.data() + 5 + 4 * axis, 4);
        return f;
    }
};

class FakeBoard final : public host::hid::HidSystem
{
public:
    std::string no_failsafe;     ///< the id with which arming a failsafe fails; empty: it does not
    std::string failsafe_file;   ///< if set, a real failsafe is armed, which writes to this file

    FakeBoard()
    {
        what.vid = 0x1209;
        what.pid = 0x0001;
        what.product = "Fake board";
        what.path = "fake/0";
        what.serial = "S1";
    }

    host::hid::ConnectedDevice what;
    const Stopwatch watch;

    /// True if the tick thread may read the board. Set it before the board is opened.
    bool can_read_until = true;

    /// If set, the time that the port and the device see.
    std::atomic<std::int64_t> virtual_ns = -1;

    std::chrono::steady_clock::time_point now() const noexcept override
    {
        const auto ns = virtual_ns.load();
        return ns < 0 ? HidSystem::now() : std::chrono::steady_clock::time_point (std::chrono::nanoseconds (ns));
    }

    /// Called with each output, without a lock, before it is logged.
    std::function<void (const Bytes&)> on_write;

    void send (Bytes report)
    {
        change ([&] { waiting.push_back (std::move (report)); });
    }
    void sendAtOnce (const std::vector<Bytes>& reports)
    {
        change ([&] { waiting.insert (waiting.end(), reports.begin(), reports.end()); });
    }
    void plug (bool in)
    {
        change ([&] {
            plugged = in;
            ++plugging;
            waiting.clear();
        });
    }
    /// Reads of the present connection fail, as for a device that the bus has lost for a moment. The next connection works.
    void failReads()
    {
        change ([&] { unreadable = opened; });
    }
    void failWrites (bool f)
    {
        change ([&] { failing = f; });
    }
    void forbid (bool f)
    {
        change ([&] { forbidden = f; });
    }

    /// As if the guardian had brought the board to rest: it must be opened again.
    void take()
    {
        change ([&] { taken = opened; });
    }

    /// The number of beats while there could be an effort on the board.
    int beats() const
    {
        const std::lock_guard lock (mutex);
        return beaten;
    }

    /// The threads that read the reports, one entry for each report.
    std::vector<std::thread::id> readers() const
    {
        const std::lock_guard lock (mutex);
        return who_read;
    }

    std::vector<Told> told() const
    {
        const std::lock_guard lock (mutex);
        return log;
    }
    int openings() const
    {
        const std::lock_guard lock (mutex);
        return opened;
    }

    std::vector<host::hid::ConnectedDevice> connected() override
    {
        const std::lock_guard lock (mutex);
        if (! plugged) return {};
        return { what };
    }

    Result<std::unique_ptr<host::hid::Transport>> open (const host::hid::ConnectedDevice&) override
    {
        const std::lock_guard lock (mutex);
        if (forbidden) return Message::error ("hid/not_permitted", what.path, "Permission denied");
        if (! plugged) return Message::error ("hid/not_opened", what.path, "No such device");
        ++opened;
        return std::make_unique<Wire> (*this, plugging, opened);
    }

private:
    class Wire final : public host::hid::Transport
    {
    public:
        Wire (FakeBoard& b, int p, int o) : board (b), plugging (p), opening (o) {}

        Result<std::size_t> read (std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override
        {
            const auto got = take (into, fromNow (timeout));
            if (got.what == host::ReportFile::Outcome::Kind::failure) return host::hid::transferError ("Input/output error");
            return got.size;
        }

        bool canReadUntil() const noexcept override { return board.can_read_until; }

        host::ReportFile::Outcome readUntil (std::span<std::uint8_t> into, std::chrono::steady_clock::time_point until) noexcept override
        {
            return take (into, until);
        }

        Result<> write (std::span<const std::uint8_t> report) override { return tell (report, Told::How::output); }
        Result<> sendFeature (std::span<const std::uint8_t> report) override { return tell (report, Told::How::feature); }
        Result<> getFeature (std::span<std::uint8_t>) override { return {}; }
        Result<> armFailsafe (const std::vector<host::hid::OutgoingReport>& reports) override
        {
            if (! board.no_failsafe.empty()) return Message::error (board.no_failsafe, "", "the guardian is missing");
            Result<> armed;
            for (const auto& r : reports)
                armed = tell (r.bytes, Told::How::failsafe);
            if (board.failsafe_file.empty()) return armed;
            std::vector<host::Failsafe::Report> last;
            for (const auto& r : reports)
                last.push_back ({ r.bytes, r.is_feature });
            auto real = host::Failsafe::arm (board.failsafe_file, last);
            REQUIRE (real);
            failsafe.emplace (std::move (*real));
            return armed;
        }

        bool beat (bool driven) noexcept override
        {
            const std::lock_guard lock (board.mutex);
            board.beaten += driven ? 1 : 0;
            return (! failsafe || failsafe->beat (driven)) && opening > board.taken;
        }

    private:
        bool gone() const { return ! board.plugged || board.plugging != plugging; }

        host::ReportFile::Outcome take (std::span<std::uint8_t> into, std::chrono::steady_clock::time_point until)
        {
            using Kind = host::ReportFile::Outcome::Kind;
            std::unique_lock lock (board.mutex);
            const auto fails = [&] { return gone() || opening <= board.unreadable; };
            board.changed.wait_until (lock, until, [&] { return fails() || ! board.waiting.empty(); });
            if (fails()) return { .what = Kind::failure };
            if (board.waiting.empty()) return {};
            const auto report = std::move (board.waiting.front());
            board.waiting.pop_front();
            board.who_read.push_back (std::this_thread::get_id());
            const auto size = std::min (report.size(), into.size());
            std::copy_n (report.begin(), size, into.begin());
            return { .what = Kind::report, .size = size };
        }

        Result<> tell (std::span<const std::uint8_t> report, Told::How how)
        {
            const Bytes bytes (report.begin(), report.end());
            if (board.on_write && how == Told::How::output) board.on_write (bytes);
            const std::lock_guard lock (board.mutex);
            if (gone() || board.failing) return host::hid::transferError ("Input/output error");
            board.log.push_back ({ bytes, how, board.watch.s() });
            return {};
        }

        FakeBoard& board;
        const int plugging, opening;
        std::optional<host::Failsafe> failsafe;
    };

    template <typename F>
    void change (F&& f)
    {
        {
            const std::lock_guard lock (mutex);
            f();
        }
        changed.notify_all();
    }

    mutable std::mutex mutex;
    std::condition_variable changed;
    std::deque<Bytes> waiting;
    std::vector<Told> log;
    std::vector<std::thread::id> who_read;
    bool plugged = true, failing = false, forbidden = false;
    int plugging = 0, opened = 0, taken = 0, unreadable = 0, beaten = 0;
};

inline std::unique_ptr<host::hid::HidDevice> openBoard (FakeBoard& board, const BoardProfile& profile = {})
{
    const host::hid::HidPort::Options options { .look_again = std::chrono::milliseconds (5), .real_time = false };
    auto opened = host::hid::HidPort::open (board, board.what, profile.make(), options);
    INFO ((opened ? std::string() : opened.error().text));
    REQUIRE (opened);
    auto device = std::make_unique<host::hid::HidDevice> (std::move (*opened));
    device->prepare (1e-3);
    return device;
}

}   // namespace tactus::test
