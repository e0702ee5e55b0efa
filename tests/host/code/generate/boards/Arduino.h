// SPDX-License-Identifier: MIT
#pragma once

// Simulates the parts of a board that sketches use: a sensor that moves into the object, motors, a button, a clock, RawHID, and a serial line.
// simulated_board.cpp is the program for the sketch of an exported Arduino library.

#include <array>
#include <cstdint>
#include <cstring>
#include <deque>
#include <vector>

#define LOW 0
#define HIGH 1
#define OUTPUT 1
#define INPUT_PULLUP 2

enum
{
    A0 = 14,
    A1,
    A2
};

struct SimulatedBoard
{
    using Report = std::array<std::uint8_t, 64>;

    /// A report on its way to the board, of which only the first bytes may arrive.
    struct Sent
    {
        Report bytes {};
        int size = 64;
    };

    std::uint64_t now_us = 0;                         ///< what micros() returns has only its lower half
    std::array<int, 3> counts { 2048, 2048, 2048 };   ///< of the sensors
    std::uint64_t ticks = 0;                          ///< how often the first sensor was read
    std::array<int, 16> duty {}, level {};            ///< by pin
    bool is_button_down = false;
    std::deque<Sent> to_board;
    Report from_board {};
    int reports = 0;
    void (*received) (const Sent&) = nullptr;   ///< called for each report that the board reads

    int recv (void* to, int)
    {
        if (to_board.empty()) return 0;
        const auto sent = to_board.front();
        to_board.pop_front();
        std::memcpy (to, sent.bytes.data(), static_cast<std::size_t> (sent.size));
        if (received != nullptr) received (sent);
        return sent.size;
    }

    int send (const void* from, int)
    {
        std::memcpy (from_board.data(), from, 64);
        ++reports;
        return 64;
    }
};

inline SimulatedBoard RawHID;

/// A serial line, whose buffer is smaller than a frame.
struct SimulatedLine
{
    std::deque<std::uint8_t> to_board;
    std::vector<std::uint8_t> from_board;
    void (*before_reading)() = nullptr, (*after_writing)() = nullptr, (*emptied)() = nullptr;

    void begin (unsigned long) {}

    int available()
    {
        if (before_reading != nullptr) before_reading();
        return static_cast<int> (to_board.size());
    }

    int read()
    {
        const auto byte = to_board.front();
        to_board.pop_front();
        if (to_board.empty() && emptied != nullptr) emptied();
        return byte;
    }

    int availableForWrite() const { return 32; }

    std::size_t write (const std::uint8_t* bytes, std::size_t count)
    {
        from_board.insert (from_board.end(), bytes, bytes + count);
        if (after_writing != nullptr) after_writing();
        return count;
    }
};

inline SimulatedLine Serial;

inline std::uint32_t micros() { return static_cast<std::uint32_t> (RawHID.now_us); }
inline int analogRead (int pin)
{
    if (pin == A0) ++RawHID.ticks;
    return RawHID.counts[static_cast<std::size_t> (pin - A0)];
}
inline int digitalRead (int) { return RawHID.is_button_down ? LOW : HIGH; }
inline void analogReadResolution (int) {}
inline void analogWrite (int pin, int duty) { RawHID.duty[static_cast<std::size_t> (pin)] = duty; }
inline void digitalWrite (int pin, int level) { RawHID.level[static_cast<std::size_t> (pin)] = level; }
inline void pinMode (int, int) {}
