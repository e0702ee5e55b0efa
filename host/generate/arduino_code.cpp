// SPDX-License-Identifier: GPL-3.0-or-later
#include "arduino_code.hpp"

namespace tactus::host
{

namespace
{
constexpr const char* properties = R"(name=@C@
version=1.0.0
author=@TOOL@
maintainer=@TOOL@
sentence=A haptic graph of Tactus: @NAME@
paragraph=@ABOUT@
category=Signal Input/Output
url=
architectures=*
includes=@S@.hpp
depends=Eigen
)";

constexpr const char* board = R"(// SPDX-License-Identifier: MIT
#pragma once

/// The reports between a board and Tactus: 64 bytes each way, little-endian, without a report id. docs/devices.md of Tactus describes them.

#include <tactus/node/device.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace tactus::board
{

using Report = std::array<std::uint8_t, 64>;

/// The state of the board, in addition to its reading.
struct State
{
    bool is_homed = false;      ///< the position is known
    bool is_driven = false;     ///< the motors do what the host asks
    bool is_released = false;   ///< the watchdog has released the motors
    bool is_hot = false;
    std::uint32_t number = 0;   ///< of this report; one more in each
    std::uint32_t us = 0;       ///< when the position was sampled
};

/// A request from the host.
struct Asked
{
    bool is_valid = false, drives = false;
    std::uint32_t answers = 0;   ///< the number of the report that this one answers
    Effort effort {};
};

inline void put (Report& r, std::size_t at, std::uint32_t value) noexcept
{
    for (std::size_t i = 0; i < 4; ++i)
        r[at + i] = static_cast<std::uint8_t> (value >> (8 * i));
}

inline std::uint32_t get (const Report& r, std::size_t at) noexcept
{
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value |= static_cast<std::uint32_t> (r[at + i]) << (8 * i);
    return value;
}

/// A number in units of `unit` as 32 bits, at the limit if it is too large.
inline void put (Report& r, std::size_t at, double value, double unit) noexcept
{
    constexpr double most = 2147483647.0;
    const double scaled = value / unit, rounded = std::floor (scaled + 0.5);
    put (r, at, static_cast<std::uint32_t> (static_cast<std::int32_t> (rounded > -most ? (rounded < most ? rounded : most) : -most)));
}

inline double get (const Report& r, std::size_t at, double unit) noexcept { return static_cast<std::int32_t> (get (r, at)) * unit; }

/// CRC-32 (IEEE) of bytes 0 to 59.
inline std::uint32_t crcOf (const Report& r) noexcept
{
    std::uint32_t crc = 0xffffffff;
    for (std::size_t i = 0; i < 60; ++i)
    {
        crc ^= r[i];
        for (int bit = 0; bit < 8; ++bit)
            crc = crc >> 1 ^ (0xedb88320 & (0u - (crc & 1u)));
    }
    return ~crc;
}

inline Report reportOf (const Reading& reading, const State& state) noexcept
{
    constexpr double nano = 1e-9, micro = 1e-6;
    Report r {};
    r[0] = 0x54;
    r[1] = 1;
    r[2] = static_cast<std::uint8_t> ((state.is_homed ? 1 : 0) | (state.is_driven ? 2 : 0) | (state.is_released ? 4 : 0) | (state.is_hot ? 8 : 0));
    put (r, 4, state.number);
    put (r, 8, state.us);
    for (int c = 0; c < 3; ++c)
    {
        put (r, 12 + 4 * static_cast<std::size_t> (c), reading.position[c], nano);
        put (r, 24 + 4 * static_cast<std::size_t> (c), reading.rotation[c], micro);
    }
    put (r, 36, reading.pressure, micro);
    put (r, 40, reading.buttons);
    for (int a = 0; a < 4; ++a)
        put (r, 44 + 4 * static_cast<std::size_t> (a), reading.axes[a], micro);
    return r;
}

inline Asked askedBy (const Report& r) noexcept
{
    constexpr double micro = 1e-6;
    Asked all;
    all.is_valid = r[0] == 0x54 && r[1] == 1 && get (r, 60) == crcOf (r);
    if (! all.is_valid) return all;
    all.drives = (r[2] & 1) != 0;
    all.answers = get (r, 4);
    for (int c = 0; c < 3; ++c)
    {
        all.effort.force[c] = get (r, 8 + 4 * static_cast<std::size_t> (c), micro);
        all.effort.torque[c] = get (r, 20 + 4 * static_cast<std::size_t> (c), micro);
    }
    for (int a = 0; a < 4; ++a)
        all.effort.axes.set (a, get (r, 32 + 4 * static_cast<std::size_t> (a), micro));
    return all;
}

}   // namespace tactus::board
)";

constexpr const char* sketch = R"(// SPDX-License-Identifier: MIT
// The board plays the graph by itself, at the rate of the patch. 1000 times a second it reports to Tactus by RawHID. While Tactus drives
// the motors, they do what Tactus asks; when its reports stop for 20 ms, or it lets go, the board's own graph drives them. Here the
// position comes from three analog sensors, and the force goes to three motor drivers. Change readPosition, drive and the numbers above
// them to what your device has, and the limits in setup to what its motors are rated for.
#include <@S@.hpp>
#include <tactus_board.hpp>

#include <cstring>

static @C@ graph;
static @C@::Inputs in;
static @C@::Outputs out;

const uint32_t period_us = @PERIOD@, report_us = 1000, watchdog_us = 20000;
const int sensors[] = { A0, A1, A2 }, motors[] = { 3, 5, 6 }, directions[] = { 7, 8, 9 };
const double metres_per_count = 0.1 / 4096, middle = 2048, counts_per_newton = 50;

static tactus::Vec3 readPosition()
{
    tactus::Vec3 p;
    for (int c = 0; c < 3; ++c)
        p[c] = (analogRead (sensors[c]) - middle) * metres_per_count;
    return p;
}

static void drive (const tactus::Effort& effort)
{
    for (int c = 0; c < 3; ++c)
    {
        const double duty = effort.force[c] * counts_per_newton;
        digitalWrite (directions[c], duty < 0 ? LOW : HIGH);
        analogWrite (motors[c], static_cast<int> (duty < 0 ? (duty > -255 ? -duty : 255) : (duty < 255 ? duty : 255)));
    }
}

static tactus::board::Asked asked;
static tactus::board::State state;
static uint32_t next_tick, next_report, last_asked;

void setup()
{
    analogReadResolution (12);
    for (int c = 0; c < 3; ++c)
    {
        pinMode (motors[c], OUTPUT);
        pinMode (directions[c], OUTPUT);
    }
    graph.@ROLE@.limits.max_force = 3.0;   // N
    graph.@ROLE@.limits.ramp = 0.5;        // s, until the full force
    graph.prepare (1e6 / period_us);
    state.is_homed = true;   // analog sensors know the position from power-on
    next_tick = next_report = micros();
}

/// Reads all waiting reports and uses the newest.
static void listen()
{
    tactus::board::Report report;
    while (RawHID.recv (report.data(), 0) > 0)
    {
        const auto now = tactus::board::askedBy (report);
        if (! now.is_valid) continue;
        asked = now;
        last_asked = micros();
    }
    state.is_released = asked.drives && micros() - last_asked > watchdog_us;
    state.is_driven = asked.drives && ! state.is_released;
}

void loop()
{
    const uint32_t now = micros();
    if (static_cast<int32_t> (now - next_tick) < 0) return;
    const uint32_t late = (now - next_tick) / period_us;
    if (late > 0) graph.loseTime (late * (period_us * 1e-6));
    next_tick += (late + 1) * period_us;

    listen();
    in.@PORT@.position = readPosition();
    state.us = now;
    graph.tick (in, out);
    drive (state.is_driven ? asked.effort : out.@PORT@);

    if (static_cast<int32_t> (now - next_report) < 0) return;
    next_report = now + report_us;
    const auto report = tactus::board::reportOf (in.@PORT@, state);
    if (RawHID.send (report.data(), 0) > 0) ++state.number;
}
)";
}   // namespace

std::vector<std::pair<std::string, std::string>> arduinoFiles (const Exported& e)
{
    const auto period = static_cast<long> (1e6 / e.wiring.plan.rateHz() + 0.999999);
    const std::vector<std::pair<std::string, std::string>> marks { { "@C@", e.class_name },
                                                                   { "@S@", e.stem },
                                                                   { "@TOOL@", e.program },
                                                                   { "@NAME@", comment (e.graph.name.empty() ? e.stem : e.graph.name) },
                                                                   { "@ABOUT@", comment (e.graph.about) },
                                                                   { "@PERIOD@", std::to_string (period) },
                                                                   { "@ROLE@", e.wiring.role_names.front() },
                                                                   { "@PORT@", e.wiring.role_ports.front() } };
    return { { "library.properties", filled (properties, marks) },
             { "src/tactus_board.hpp", board },
             { "examples/Board/Board.ino", filled (sketch, marks) } };
}

}   // namespace tactus::host
