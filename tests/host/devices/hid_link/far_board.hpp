// SPDX-License-Identifier: MIT
#pragma once

#include "host/devices/hid/hid.hpp"
#include "support/waiting.hpp"

#include <host/devices/hid_link/transport.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <deque>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace tactus::test::ffboard
{

using namespace host;
using namespace host::hid;
using namespace std::chrono_literals;

inline const std::string vendor_fields =   // type, class, instance, command, value, address
    "85 a1 09 01 15 00 25 04 75 08 95 01 %1 02 09 02 75 10 %1 02 09 03 75 08 %1 02 09 04 75 20 %1 02 09 05 75 40 %1 02 09 06 %1 02 ";

inline std::string vendorFields (const char* item)
{
    auto text = vendor_fields;
    for (auto at = text.find ("%1"); at != text.npos; at = text.find ("%1"))
        text.replace (at, 2, item);
    return text;
}

/// The reports of a board with two axes, as its firmware lays them out.
inline Bytes boardDescriptor (bool has_channel = true)
{
    const auto channel = has_channel ? "06 00 ff 09 00 a1 01 " + vendorFields ("91") + vendorFields ("81") + "c0 " : std::string();
    return test::bytes (
        "05 01 09 04 a1 01 85 01 "                                                                     // joystick, report 1
        "05 09 19 01 29 40 15 00 25 01 75 01 95 40 81 02 "                                             // 64 buttons
        "05 01 09 30 09 31 09 32 09 33 09 34 09 35 09 37 09 36 16 01 80 26 ff 7f 75 10 95 08 81 02 "   // 8 axes, s16
        + channel
        + "05 0f 09 21 a1 02 85 01 09 22 15 01 25 28 75 08 95 01 91 02 "                                                // set effect: block
          "09 25 a1 02 09 26 09 30 15 01 25 02 91 00 c0 "                                                               // type
          "09 50 09 54 09 51 09 a7 15 00 26 ff 7f 35 00 46 ff 7f 66 03 10 55 fd 75 10 95 04 91 02 55 00 66 00 00 "      // times
          "09 52 26 ff 00 75 08 95 01 91 02 09 53 15 01 25 08 91 02 "                                                   // gain, trigger
          "09 55 a1 02 05 01 09 30 09 31 15 00 25 01 75 01 95 02 91 02 c0 05 0f 09 56 95 01 91 02 95 05 91 03 "         // axes, direction
          "09 57 a1 02 0b 01 00 0a 00 0b 02 00 0a 00 27 a0 8c 00 00 75 10 95 02 91 02 c0 c0 "                           // 0-36000
          "09 73 a1 02 85 05 09 22 15 01 25 28 75 08 95 01 91 02 09 70 16 01 80 26 ff 7f 75 10 91 02 c0 "               // constant force
          "09 77 a1 02 85 0a 09 22 15 01 25 28 75 08 91 02 09 78 a1 02 09 79 09 7a 09 7b 25 03 91 00 c0 "               // operation
          "09 7c 15 00 26 ff 00 91 02 c0 "                                                                              // loops
          "09 90 a1 02 85 0b 09 22 15 01 25 28 91 02 c0 "                                                               // free
          "09 95 a1 02 85 0c 09 96 a1 02 09 97 09 98 09 99 09 9a 15 01 25 04 91 00 c0 c0 "                              // control
          "09 7d a1 02 85 0d 09 7e 15 00 26 ff 00 91 02 c0 "                                                            // gain of the device
          "09 ab a1 02 85 11 09 25 a1 02 09 26 09 30 15 01 25 02 b1 00 c0 05 01 09 3b 15 00 26 ff 01 75 10 b1 02 c0 "   // create
          "05 0f 09 89 a1 02 85 12 09 22 15 01 25 28 75 08 b1 02 09 8b a1 02 09 8c 09 8d 09 8e 25 03 b1 00 c0 "         // block load
          "09 ac 15 00 27 ff ff 00 00 75 10 b1 02 c0 c0");
}

inline int s16At (const Bytes& b, std::size_t at) { return static_cast<std::int16_t> (b[at] | b[at + 1] << 8); }

/// The far end: a board that plays constant forces in two axes, answers on its own channel, and has an emergency stop with a button.
class FarBoard final : public host::hid::HidSystem
{
public:
    FarBoard()
    {
        what.vid = 0x1209;
        what.pid = 0xffb0;
        what.product = "OpenFFBoard";
        what.path = "fake/board";
    }

    struct Effect
    {
        int direction = -1, magnitude = 0;   // hundredths of a degree, counts
        bool plays = false;
    };

    struct Seen
    {
        std::vector<Bytes> forces, commands;   // constant forces; writes on its own channel
        std::array<int, 2> torque {};          // of its motors, in counts
        bool stopped = false;
        int unknown = 0;
    };

    ConnectedDevice what;
    std::atomic<bool> answers_by_ack = false;
    Bytes descriptor = boardDescriptor();

    std::atomic<std::int64_t> ns = 1'000'000'000;   // by which efforts are limited
    std::chrono::steady_clock::time_point now() const noexcept override { return std::chrono::steady_clock::time_point (std::chrono::nanoseconds (ns.load())); }

    bool isStopped() const
    {
        const std::lock_guard lock (mutex);
        return all.stopped;
    }
    std::array<int, 2> torque() const
    {
        const std::lock_guard lock (mutex);
        return torques();
    }
    Seen seen() const
    {
        const std::lock_guard lock (mutex);
        auto now = all;
        now.torque = torques();
        return now;
    }
    void moveTo (int x, int y)
    {
        Bytes report (25);
        report[0] = 1;
        for (const auto& [at, value] : { std::pair { 9, x }, std::pair { 11, y } })
            for (int byte = 0; byte < 2; ++byte)
                report[static_cast<std::size_t> (at + byte)] = static_cast<std::uint8_t> (static_cast<unsigned> (value) >> 8 * byte);
        const std::lock_guard lock (mutex);
        state = report;
        inbox.push_back (report);
    }
    Bytes position() const
    {
        const std::lock_guard lock (mutex);
        return state;
    }
    void press (bool on)   // its button
    {
        const std::lock_guard lock (mutex);
        all.stopped = on;
    }

    std::vector<ConnectedDevice> connected() override { return { what }; }
    Bytes reportDescriptor (const ConnectedDevice&) override { return descriptor; }
    Result<std::unique_ptr<Transport>> open (const ConnectedDevice&) override { return std::make_unique<Line> (*this); }

private:
    struct Line final : Transport
    {
        explicit Line (FarBoard& b) : board (b) {}

        Result<std::size_t> read (std::span<std::uint8_t> into, std::chrono::milliseconds timeout) override
        {
            for (int tries = 0; tries < 2; ++tries)
            {
                if (tries > 0 && timeout > 0ms) letPass (500us);
                const std::lock_guard lock (board.mutex);
                if (board.inbox.empty()) continue;
                const auto report = board.inbox.front();
                board.inbox.pop_front();
                std::ranges::copy (report, into.begin());
                return report.size();
            }
            return std::size_t { 0 };
        }
        Result<std::size_t> getInput (std::span<std::uint8_t> report) override
        {
            const std::lock_guard lock (board.mutex);
            if (report.size() != board.state.size() || report[0] != 1) return transferError ("Broken pipe");
            std::ranges::copy (board.state, report.begin());
            return board.state.size();
        }
        Result<> write (std::span<const std::uint8_t> report) override
        {
            const std::lock_guard lock (board.mutex);
            board.take ({ report.begin(), report.end() });
            return {};
        }
        Result<> sendFeature (std::span<const std::uint8_t> report) override
        {
            const std::lock_guard lock (board.mutex);
            if (report.size() != 4 || report[0] != 0x11 || report[1] != 1) return transferError ("Protocol error");
            board.effects[board.newest = board.next_block++] = {};
            return {};
        }
        Result<> getFeature (std::span<std::uint8_t> report) override
        {
            const std::lock_guard lock (board.mutex);
            if (report.size() != 5 || report[0] != 0x12) return transferError ("Protocol error");
            report[1] = board.newest;
            report[2] = 1;
            return {};
        }

        FarBoard& board;
    };

    void take (const Bytes& r)
    {
        const auto effect = [&]() -> Effect* {
            const auto found = effects.find (r[1]);
            return found != effects.end() ? &found->second : nullptr;
        };
        const auto id = r.front();
        if (id == 1 && r.size() == 18 && effect() != nullptr && r[2] == 1 && r[13] == 4)   // directions count, not single axes
            effect()->direction = r[14] | r[15] << 8;
        else if (id == 5 && r.size() == 4 && effect() != nullptr)
        {
            effect()->magnitude = s16At (r, 2);
            all.forces.push_back (r);
        }
        else if (id == 0xa && r.size() == 4 && effect() != nullptr)
            effect()->plays = r[2] == 1;
        else if (id == 0xb && r.size() == 2)
            effects.erase (r[1]);
        else if (id == 0xc && r.size() == 2)
        {
            if (r[1] == 4) effects.clear();
            if (r[1] >= 3)
                for (auto& [block, e] : effects)
                    e.plays = false;
        }
        else if (id == 0xa1 && r.size() == 25)
            command (r);
        else if (id != 0xd)
            ++all.unknown;
    }

    /// Class u16 at 2, instance at 4, command u32 at 5, value s64 at 9.
    void command (Bytes r)
    {
        const int of_class = r[2] | r[3] << 8;
        const bool is_stop = of_class == 0x1 && r[4] == 0 && r[5] == 0xa, is_torque = of_class == 0xa01 && r[4] < 2 && r[5] == 0xd;
        if (r[1] == 0)
        {
            all.commands.push_back (r);
            if (is_stop) all.stopped = r[9] != 0;
            r[1] = 1;   // a write is answered as a request
        }
        else if (is_stop)
            r[9] = all.stopped ? 1 : 0;
        else if (is_torque)
            for (int byte = 0; byte < 8; ++byte)
                r[static_cast<std::size_t> (9 + byte)] = static_cast<std::uint8_t> (static_cast<std::int64_t> (torques()[r[4]]) >> 8 * byte);
        if (! is_stop && ! is_torque) r[1] = 13;
        if (r[1] == 1 && answers_by_ack) r[1] = 10;
        inbox.push_back (r);
    }

    /// An effect pushes towards where it does not come from: 0 is from "away", which is where y decreases.
    std::array<int, 2> torques() const
    {
        std::array<double, 2> sum {};
        for (const auto& [block, e] : effects)
            if (e.plays && ! all.stopped)
            {
                const double angle = e.direction * 3.14159265358979323846 / 18000.0;
                sum[0] -= e.magnitude * std::sin (angle);
                sum[1] += e.magnitude * std::cos (angle);
            }
        return { static_cast<int> (std::lround (sum[0])), static_cast<int> (std::lround (sum[1])) };
    }

    mutable std::mutex mutex;
    std::map<std::uint8_t, Effect> effects;
    std::uint8_t next_block = 7, newest = 0;
    std::deque<Bytes> inbox;
    Bytes state { Bytes (25) };
    Seen all;
};

}   // namespace tactus::test::ffboard
