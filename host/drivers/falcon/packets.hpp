// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace tactus::host::falcon
{

/// A packet in either direction: '<', twelve nibbles of three numbers with the lowest first, a byte of bits, a byte of 0, and '>'. Each byte between the
/// marks is written as its value + 'A'.
using Packet = std::array<std::uint8_t, 16>;

enum Bits : std::uint8_t
{
    homing = 1,   // to the Falcon, in every packet: keeps its homing
    green = 2,
    red = 8,
    homed = 0x70   // from the Falcon: each encoder has passed its mark. The lowest four are the buttons
};

constexpr Packet packetOf (const std::array<int, 3>& motors, unsigned bits)
{
    Packet p {};
    p.front() = '<';
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
        for (std::size_t i = 0; i + 1 < last.size(); ++i)
            last[i] = last[i + 1];
        last.back() = byte;
        if (last.front() != '<' || byte != '>' || last[14] < 'A' || last[14] > 'P' || last[13] < 'A' || last[13] > 'A' + 0x7f) return std::nullopt;
        Report report { {}, static_cast<unsigned> (last[13] - 'A') };
        for (std::size_t i = 0; i < 12; ++i)
        {
            const int nibble = last[1 + i] - 'A';
            if (nibble < 0 || nibble > 15) return std::nullopt;
            report.counts[i / 4] |= nibble << 4 * (i % 4);
        }
        for (int& count : report.counts)
            count = static_cast<std::int16_t> (count);
        last = {};   // its bytes belong to no other packet
        return report;
    }

private:
    Packet last {};
};

}   // namespace tactus::host::falcon
