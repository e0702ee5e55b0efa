// SPDX-License-Identifier: MIT
// Reports in a stream of bytes: what is written is found again, however it comes, and a fault costs no report but its own.

#include "hid.hpp"
#include "support/corpus.hpp"

#include <support/property.hpp>

#include <fuzz/framing_target.hpp>

#include <algorithm>
#include <string>

using namespace tactus;
using namespace tactus::host::hid;
using fuzz::framed;

namespace
{
using Shapes = std::vector<FrameReader::Shape>;

std::string onTheWire (Framing framing, const Bytes& report)
{
    Bytes bytes (longestFrame (framing, report.size()));
    bytes.resize (writeFrame (framing, report, bytes));
    return { bytes.begin(), bytes.end() };
}

Bytes anyReport (std::size_t size)
{
    // Many zeros, and long runs without any, because COBS counts these.
    const auto zeros = *rc::gen::element (0, 1, 8, 256);
    Bytes report (size);
    for (auto& byte : report)
        byte = *rc::gen::inRange (0, 256) < zeros ? std::uint8_t { 0 } : static_cast<std::uint8_t> (*rc::gen::inRange (1, 256));
    return report;
}

const auto all_framings = { Framing::none, Framing::cobs, Framing::length, Framing::dualpanto };
}   // namespace

TEST_CASE ("frames have the bytes that the manual describes", "[hid][wires]")
{
    // The CRC-32 of "123456789" is CBF43926.
    const Bytes digits { '1', '2', '3', '4', '5', '6', '7', '8', '9' };
    CHECK (onTheWire (Framing::none, digits) == "123456789");
    CHECK (onTheWire (Framing::cobs, digits) == std::string ("\0\x0e"
                                                             "123456789\x26\x39\xf4\xcb\0",
                                                             16));

    // The example in docs/wires.md: the neutral report to the Tactus board.
    Bytes neutral (64, 0);
    std::ranges::copy (Bytes { 0x54, 0x01 }, neutral.begin());
    std::ranges::copy (Bytes { 0x90, 0x2a, 0x5e, 0x87 }, neutral.begin() + 60);
    const auto beginning = std::string ("\0\x03\x54\x01", 4), zeros = std::string (57, '\x01');
    CHECK (onTheWire (Framing::cobs, neutral) == beginning + zeros + std::string ("\x09\x90\x2a\x5e\x87\x1c\xdf\x44\x21\0", 10));

    const auto framed_length = onTheWire (Framing::length, digits);
    CHECK (framed_length.substr (0, 11) == std::string ("\x09\0"
                                                        "123456789",
                                                        11));
    CHECK (framed_length.size() == 15);
    CHECK (onTheWire (Framing::dualpanto, digits) == std::string ("DP1\0\x08"
                                                                  "23456789",
                                                                  13));
    CHECK (onTheWire (Framing::dualpanto, Bytes (1, 0x81)) == std::string ("DP\x81\0\0", 5));
    CHECK (onTheWire (Framing::dualpanto, {}).empty());

    // 300 bytes without a zero need a second run after 254 of them.
    const auto long_frame = onTheWire (Framing::cobs, Bytes (300, 1));
    CHECK (static_cast<std::uint8_t> (long_frame[1]) == 255);
    CHECK (std::ranges::count (long_frame, '\0') == 2);
    CHECK (onTheWire (Framing::cobs, Bytes (longest_report + 1)).empty());
}

TEST_CASE ("every report arrives as it was sent, however its bytes come", "[hid][wires][property]")
{
    test::property ("reports of any content", [] {
        const auto framing = *rc::gen::elementOf (std::vector<Framing> (all_framings));
        const auto size = static_cast<std::size_t> (*rc::gen::element (2, 8, 64, 253, 254, 255, 600, 1024));
        const Shapes shapes { { {}, size, size, { { Bits { .at = 0 }, 0x54 } } } };
        std::vector<Bytes> sent;
        std::string line;
        for (int i = 0; i < 12; ++i)
        {
            sent.push_back (anyReport (size));
            sent.back().front() = 0x54;
            line += onTheWire (framing, sent.back());
        }
        const auto piece = static_cast<std::size_t> (*rc::gen::inRange (1, 3000));
        auto got = framed (framing, shapes, line, piece);
        if (framing != Framing::none) RC_ASSERT (got == sent);

        // Without framing, the last report waits for the next one, or for a pause, until the beginning is known.
        if (framing == Framing::none)
        {
            RC_ASSERT (got == sent);
            RC_ASSERT (framed (framing, shapes, onTheWire (framing, sent[0]), 5).empty());
            RC_ASSERT (framed (framing, shapes, onTheWire (framing, sent[0]), size, true) == std::vector<Bytes> { sent[0] });
        }
    });
}

TEST_CASE ("a fault on the line costs only the reports that it touches", "[hid][wires][property]")
{
    test::property ("lost, changed and additional bytes", [] {
        const auto framing = *rc::gen::element (Framing::cobs, Framing::length, Framing::dualpanto);
        constexpr std::size_t size = 24;
        const Shapes shapes { { {}, size, size, {} } };
        std::vector<Bytes> untouched;
        std::string line;
        bool was_touched = false;
        for (int i = 0; i < 40; ++i)
        {
            const auto report = anyReport (size);
            auto bytes = onTheWire (framing, report);
            const auto fault = i == 39 ? 0 : *rc::gen::inRange (0, 12);   // the last one is whole, so nothing stays unfinished
            const auto at = static_cast<std::size_t> (*rc::gen::inRange (0, static_cast<int> (bytes.size())));
            if (fault == 1) bytes.erase (at, 1);
            if (fault == 2) bytes[at] = static_cast<char> (bytes[at] ^ (1 << *rc::gen::inRange (0, 8)));
            if (fault == 3) bytes = bytes.substr (0, at);
            if (fault == 4) bytes.insert (at, 1, static_cast<char> (*rc::gen::inRange (0, 256)));
            // The zero at either end of a COBS frame is also enough, so such a fault may leave it whole.
            const bool is_touched = fault >= 1 && fault <= 4;
            if (! is_touched && ! was_touched) untouched.push_back (report);
            was_touched = is_touched;
            line += bytes;
        }
        line += onTheWire (framing, Bytes (size, 9)) + onTheWire (framing, Bytes (size, 9));
        const auto got = framed (framing, shapes, line, 50);
        auto next = got.begin();
        for (const auto& report : untouched)
        {
            next = std::find (next, got.end(), report);   // all of them, in order
            RC_ASSERT (next != got.end());
            ++next;
        }
    });
}

TEST_CASE ("without framing, the beginning is found again by the marks, and by a pause", "[hid][wires]")
{
    const Shapes shapes { { {}, 6, 6, { { Bits { .at = 0 }, 0x54 }, { Bits { .at = 8 }, 1 } } } };
    const std::string report ("\x54\x01"
                              "abcd",
                              6),
        other ("\x54\x01"
               "efgh",
               6),
        like ("\x54\x01"
              "x\x54\x01y",
              6);
    const auto count = [&] (const std::string& line) { return framed (Framing::none, shapes, line, 4).size(); };
    CHECK (count (report + other) == 2);
    CHECK (count ("\x01"
                  "abcd"
                  + report + other)
           == 2);
    CHECK (count (report + other + report.substr (1) + other + report) == 4);   // one byte is lost in the third
    CHECK (count (report.substr (3) + like + other + report) == 3);
    CHECK (count (like.substr (2) + other + report) == 2);                                   // marks within a report mislead nobody
    CHECK (framed (Framing::none, shapes, report.substr (0, 3) + other, 3, true).empty());   // pauses within reports
    CHECK (framed (Framing::none, shapes, report + other, 6, true).size() == 2);
    CHECK (framed (Framing::none, shapes, report, 6, true).size() == 1);
}

TEST_CASE ("of a DualPanto, a pause ends what is not whole, and the next message is found by its mark", "[hid][wires]")
{
    const Shapes shapes { { std::uint8_t { 0x10 }, 6, 6, {} }, { std::uint8_t { 1 }, 1, 1, {} } };
    const auto report = onTheWire (Framing::dualpanto, { 0x10, 1, 2, 3, 4, 5 }), life = onTheWire (Framing::dualpanto, { 1 });
    const auto count = [&] (const std::string& line) { return framed (Framing::dualpanto, shapes, line, 3).size(); };
    CHECK (count (report + life + report) == 3);
    CHECK (count ("DDP\x10 noise" + report) == 1);
    CHECK (count (report.substr (4) + report) == 1);
    auto longer = report;
    longer[4] = 6;   // the length of no report
    CHECK (count (longer + report) == 1);
    for (std::size_t lost = 0; lost < report.size(); ++lost)
    {
        FrameReader reader (Framing::dualpanto, shapes);
        const auto comes = [&] (std::string_view bytes) {
            std::ranges::copy (bytes, reader.room().begin());
            reader.arrived (bytes.size());
            return reader.next().has_value();
        };
        auto less = report;
        less.erase (lost, 1);
        CHECK_FALSE (comes (less));
        reader.pause();
        CHECK (comes (report));
    }
    CHECK (framed (Framing::dualpanto, shapes, report, 3, true).empty());   // pauses within it
}

TEST_CASE ("every file of the framing corpus is taken apart in the same way, however it comes", "[hid][wires]")
{
    CHECK (test::replay ("framing", fuzz::tryFraming) > 20);
}
