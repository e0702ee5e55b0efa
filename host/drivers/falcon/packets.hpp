// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace tactus::host::falcon
{

/// A packet in either direction: '<', twelve nibbles of three numbers with the lowest first, a byte of bits, a byte of 0, and '>'. Each byte between the
/// marks is written as its value + 'A'.
using Packet = std::array<std::uint8_t, 16>;

constexpr unsigned homing = 1, green = 2, red = 8;   // bits to the Falcon; the first one, in every packet, keeps its homing
constexpr unsigned homed = 0x70;                     // from it: each encoder has passed its mark. The lowest four are the buttons

constexpr Packet packetOf (const std::array<int, 3>& motors, unsigned bits)
{
    Packet p { '<' };
    p.back() = '>';
    for (std::size_t i = 0; i < 12; ++i)
        p[1 + i] = static_cast<std::uint8_t> ('A' + ((static_cast<unsigned> (motors[i / 4]) >> 4 * (i % 4)) & 0xfu));
    p[13] = static_cast<std::uint8_t> ('A' + bits);
    p[14] = 'A';
    return p;
}

constexpr Packet at_rest = packetOf ({}, homing);

// Of the line: for packets, for the first words to a Falcon without firmware, and for loading that.
constexpr unsigned normal_baud = 1'500'000, hello_baud = 9600, loading_baud = 142'857;

/// The contents of a packet from the Falcon.
struct Report
{
    std::array<int, 3> counts {};
    unsigned bits = 0;
};

/// Finds packets in a stream of bytes, some of which may be lost or added.
class PacketFinder
{
public:
    /// The report that ends with this byte, if one does.
    std::optional<Report> take (std::uint8_t byte)
    {
        std::shift_left (last.begin(), last.end(), 1);
        last.back() = byte;
        if (last.front() != '<' || byte != '>') return std::nullopt;
        Report report { {}, static_cast<unsigned> (last[13] - 'A') };
        for (std::size_t i = 0; i < 12; ++i)
            report.counts[i / 4] |= (last[1 + i] - 'A') << 4 * (i % 4);
        for (int& count : report.counts)
            count = static_cast<std::int16_t> (count);
        auto whole = packetOf (report.counts, report.bits);
        whole[14] = std::clamp<std::uint8_t> (last[14], 'A', 'P');   // which is nothing, but may be anything
        if (whole != last || report.bits > (homed | 0xf)) return std::nullopt;
        last = {};   // its bytes belong to no other packet
        return report;
    }

private:
    Packet last {};
};

}   // namespace tactus::host::falcon
