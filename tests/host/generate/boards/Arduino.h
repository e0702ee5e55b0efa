// SPDX-License-Identifier: MIT
#pragma once

// Simulates the parts of a board that the sketch of an exported Arduino library uses: a sensor that moves into the object, motors, a
// clock, and RawHID. simulated_board.cpp is its program.

#include <array>
#include <cstdint>
#include <cstring>
#include <deque>

#define LOW 0
#define HIGH 1
#define OUTPUT 1

enum
{
    A0 = 14,
    A1,
    A2
};

struct SimulatedBoard
{
    using Report = std::array<std::uint8_t, 64>;

    std::uint32_t now_us = 0;
    std::array<int, 3> counts { 2048, 2048, 2048 };   ///< of the sensors
    std::array<int, 16> duty {}, level {};            ///< by pin
    std::deque<Report> to_board;
    Report from_board {};
    int reports = 0;

    int recv (void* to, int)
    {
        if (to_board.empty()) return 0;
        std::memcpy (to, to_board.front().data(), 64);
        to_board.pop_front();
        return 64;
    }

    int send (const void* from, int)
    {
        std::memcpy (from_board.data(), from, 64);
        ++reports;
        return 64;
    }
};

inline SimulatedBoard RawHID;

inline std::uint32_t micros() { return RawHID.now_us; }
inline int analogRead (int pin) { return RawHID.counts[static_cast<std::size_t> (pin - A0)]; }
inline void analogReadResolution (int) {}
inline void analogWrite (int pin, int duty) { RawHID.duty[static_cast<std::size_t> (pin)] = duty; }
inline void digitalWrite (int pin, int level) { RawHID.level[static_cast<std::size_t> (pin)] = level; }
inline void pinMode (int, int) {}
