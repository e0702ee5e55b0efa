// SPDX-License-Identifier: MIT
// Runs the sketch SKETCH on a simulated board: presses the tool into the object and out again, lets a host drive the motors, and lets it
// fall silent. Returns the number of what went wrong, or 0.
#include "Arduino.h"

#include SKETCH

#include <cmath>

namespace
{
constexpr int motor_z = 6, direction_z = 9;

/// Loops for this time.
void pass (std::uint32_t us)
{
    for (const auto end = RawHID.now_us + us; RawHID.now_us < end; RawHID.now_us += 50)
        loop();
}

/// Moves the sensor to this count, slowly.
void moveTo (int count)
{
    while (RawHID.counts[2] != count)
    {
        RawHID.counts[2] += RawHID.counts[2] < count ? 1 : -1;
        pass (1000);
    }
    pass (1000000);
}

SimulatedBoard::Report asking (double force_z)
{
    SimulatedBoard::Report r {};
    r[0] = 0x54;
    r[1] = r[2] = 1;
    tactus::board::put (r, 16, force_z, 1e-6);
    tactus::board::put (r, 60, tactus::board::crcOf (r));
    return r;
}
}   // namespace

int main()
{
    RawHID.counts[2] = 2048 + 100;
    setup();
    pass (1000000);
    if (RawHID.duty[motor_z] != 0) return 1;   // outside, so no force
    if (RawHID.reports < 900 || RawHID.reports > 1100) return 2;
    if (RawHID.from_board[0] != 0x54 || (RawHID.from_board[2] & 1) == 0) return 3;

    moveTo (2048 - 60);   // 1.5 mm deep
    const int pushed = RawHID.duty[motor_z];
    if (pushed <= 0 || RawHID.level[direction_z] != HIGH) return 4;
    const double reported = tactus::board::get (RawHID.from_board, 20, 1e-9);
    if (! (std::abs (reported + 60 * 0.1 / 4096) < 1e-9)) return 5;

    for (int i = 0; i < 10; ++i)
    {
        RawHID.to_board.push_back (asking (-1.0));
        pass (1000);
    }
    if (RawHID.duty[motor_z] != 50 || RawHID.level[direction_z] != LOW) return 6;   // as the host asks: 50 counts per N
    if ((RawHID.from_board[2] & 2) == 0) return 7;

    auto broken = asking (2.0);
    broken[16] ^= 1;
    RawHID.to_board.push_back (broken);
    pass (2000);
    if (RawHID.duty[motor_z] != 50) return 8;   // a report with a wrong CRC is ignored

    pass (50000);   // silence: the board's own graph again
    if (RawHID.duty[motor_z] != pushed || RawHID.level[direction_z] != HIGH) return 9;
    if ((RawHID.from_board[2] & 4) == 0) return 10;

    moveTo (2048 + 100);
    return RawHID.duty[motor_z] == 0 ? 0 : 11;
}
