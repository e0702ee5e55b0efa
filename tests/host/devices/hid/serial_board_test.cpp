// SPDX-License-Identifier: MIT
// The C code and the sketch in docs/examples/serial_board, against the code that Tactus itself reads and writes reports with.

#include "hid.hpp"

#include <docs/examples/serial_board/tactus_serial.h>
#include <host/devices/hid/report/crc32.hpp>
#include <host/devices/hid/report/framing.hpp>
#include <support/property.hpp>

#include <fuzz/framing_target.hpp>
#include <host/code/generate/boards/Arduino.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

using namespace tactus;
using namespace tactus::host::hid;

namespace tactus::serial_board
{
#include "../../../../docs/examples/serial_board/serial_board.ino"
}   // namespace tactus::serial_board

using namespace tactus::serial_board;

namespace
{

using Report64 = std::array<std::uint8_t, 64>;

/// Many zeros, or few of them, because COBS counts these.
Report64 anyReport()
{
    const auto zeros = *rc::gen::element (1, 8, 256);
    Report64 report {};
    for (auto& byte : report)
        byte = *rc::gen::inRange (0, 256) < zeros ? std::uint8_t { 0 } : static_cast<std::uint8_t> (*rc::gen::inRange (1, 256));
    return report;
}

Bytes writtenInC (const Report64& report)
{
    Bytes written (tactus_frame_size);
    tactus_frame (report.data(), written.data());
    return written;
}

Bytes writtenByTactus (std::span<const std::uint8_t> report)
{
    Bytes written (longestFrame (Framing::cobs, report.size()));
    written.resize (writeFrame (Framing::cobs, report, written));
    return written;
}

/// What the C code takes from a line, and what Tactus takes.
std::vector<Report64> takenInC (std::span<const std::uint8_t> bytes)
{
    tactus_line from {};
    Report64 taken {};
    std::vector<Report64> all;
    for (const auto byte : bytes)
        if (tactus_take (&from, byte, taken.data()) != 0) all.push_back (taken);
    return all;
}

std::vector<Report64> takenByTactus (std::span<const std::uint8_t> bytes)
{
    std::vector<Report64> all;
    for (const auto& taken : fuzz::framed (Framing::cobs, { { {}, 64, 64, {} } }, std::string (bytes.begin(), bytes.end()), 7))
        if (taken.size() == 64) std::ranges::copy (taken, all.emplace_back().begin());
    return all;
}

/// A board with this sketch, with Tactus at the other end of its line.
class Board
{
public:
    Board()
    {
        RawHID = {};
        Serial = {};
        RawHID.now_us = 0xffffffff - 1500000ull;   // the clock wraps
        line = {};
        is_driven = has_timed_out = false;
        std::ranges::fill (force_un, 0);
        setup();
    }

    /// Tactus asks for this force on x, or lets go.
    void ask (double newtons, bool drives = true)
    {
        Bytes request (64, 0);
        request[0] = 0x54;
        request[1] = 1;
        request[2] = drives ? 1 : 0;
        tactus_put (request.data(), 8, static_cast<std::uint32_t> (static_cast<std::int32_t> (std::lround (1e6 * newtons))));
        tactus_put (request.data(), 60, crc32 (std::span (request).first (60)));
        arrive (writtenByTactus (request));
    }

    void arrive (const Bytes& bytes) { Serial.to_board.insert (Serial.to_board.end(), bytes.begin(), bytes.end()); }

    void pass (int ms)
    {
        for (int i = 0; i < 20 * ms; ++i)
        {
            RawHID.now_us += 50;
            loop();
        }
    }

    double force() const { return (RawHID.level[7] == LOW ? -0.02 : 0.02) * RawHID.duty[3]; }

    /// The reports that Tactus has taken since the last call.
    std::vector<Report64> reports()
    {
        const auto all = takenByTactus (Serial.from_board);
        Serial.from_board.clear();
        return all;
    }
};
}   // namespace

TEST_CASE ("the C code for a serial board writes the frames of Tactus, and takes them, whatever else is on the line", "[hid][wires][property]")
{
    test::property ("frames both ways", [] {
        const auto sent = anyReport();
        RC_ASSERT (writtenInC (sent) == writtenByTactus (sent));
        RC_ASSERT (tactus_crc (sent.data(), 60) == crc32 (std::span (sent).first (60)));
        const auto at = *rc::gen::inRange (0, 61);
        const auto value = *rc::gen::arbitrary<std::uint32_t>();
        auto put = sent;
        tactus_put (put.data(), at, value);
        RC_ASSERT (tactus_get (put.data(), at) == value);
    });
    test::property ("lost, changed and additional bytes", [] {
        Bytes bytes;
        for (int i = 0; i < 20; ++i)
        {
            const Bytes other (static_cast<std::size_t> (*rc::gen::inRange (1, 200)), 7);   // of another size
            auto frame = *rc::gen::inRange (0, 8) == 0 ? writtenByTactus (other) : writtenInC (anyReport());
            const auto fault = *rc::gen::inRange (0, 12);
            const auto at = *rc::gen::inRange (0, static_cast<int> (frame.size()));
            if (fault == 1) frame.erase (frame.begin() + at);
            if (fault == 2) frame[static_cast<std::size_t> (at)] ^= static_cast<std::uint8_t> (1 << *rc::gen::inRange (0, 8));
            if (fault == 3) frame.resize (static_cast<std::size_t> (at));
            if (fault == 4) frame.insert (frame.begin() + at, static_cast<std::uint8_t> (*rc::gen::inRange (0, 256)));
            bytes.insert (bytes.end(), frame.begin(), frame.end());
        }
        const auto taken = takenInC (bytes);
        RC_ASSERT (taken == takenByTactus (bytes));
    });
}

TEST_CASE ("the sketch for a serial board reports its position, and drives its motors as Tactus asks", "[hid][wires]")
{
    Board board;
    RawHID.counts = { 2048, 2148, 1948 };
    board.pass (1000);
    const auto reports = board.reports();
    CHECK (reports.size() > 900);
    CHECK (reports.size() < 1010);
    const auto profile = test::profileOf ("tactus_board");
    for (std::size_t i = 0; i < reports.size(); ++i)
    {
        REQUIRE (tactus_get (reports[i].data(), 4) == tactus_get (reports[0].data(), 4) + i);
        REQUIRE (reports[i][2] == 1);   // homed, not driven
    }
    const auto nm = [&] (int axis) { return static_cast<std::int32_t> (tactus_get (reports.back().data(), 12 + 4 * axis)); };
    CHECK (nm (0) == 0);
    CHECK (nm (1) == 2441400);
    CHECK (nm (2) == -2441400);

    // The force, within the limits of the board, and no faster than these.
    double last = 0.0;
    for (const double asked : { 1.0, -100.0, 100.0, -0.5 })
        for (int ms = 0; ms < 20; ++ms)
        {
            board.ask (asked);
            board.pass (1);
            CHECK (std::abs (board.force()) <= 2.0);
            CHECK (std::abs (board.force() - last) <= 0.5 + 0.02);
            last = board.force();
        }
    CHECK (board.force() == Approx (-0.5));
    CHECK (board.reports().back()[2] == 3);   // driven

    SECTION ("Tactus lets go")
    {
        board.ask (1.0, false);
        board.pass (2);
        CHECK (board.force() == 0.0);
        board.pass (1000);
        CHECK (board.reports().back()[2] == 1);
    }
    SECTION ("Tactus falls silent, for longer than the clock counts")
    {
        board.pass (19);
        CHECK (board.force() == Approx (-0.5));
        board.pass (2);
        CHECK (board.force() == 0.0);
        board.pass (2);
        CHECK (board.reports().back()[2] == 5);   // homed; the watchdog has released the motors
        RawHID.now_us += 0x80000000ull;
        board.pass (1);
        RawHID.now_us += 0x7fff0000ull;
        board.pass (100);
        CHECK (board.force() == 0.0);
        board.ask (1.0);
        board.pass (1);
        CHECK (board.force() == Approx (0.5));
    }
    SECTION ("what is not a request changes nothing")
    {
        auto wrong = Bytes (64, 0);
        wrong[0] = 0x54;
        wrong[1] = 1;
        wrong[2] = 1;
        tactus_put (wrong.data(), 8, 1000000);
        board.arrive (writtenByTactus (wrong));   // its own CRC is wrong
        board.arrive (Bytes (200, 0x54));
        board.pass (1);
        CHECK (board.force() == Approx (-0.5));
        board.pass (30);
        CHECK (board.force() == 0.0);
    }
}
