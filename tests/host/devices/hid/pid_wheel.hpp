// SPDX-License-Identifier: MIT
#pragma once

#include "hid.hpp"

namespace tactus::test
{

/// An invented wheel: one axis, eight buttons, and everything that one constant force needs. Device Control is an array here.
inline const host::hid::Bytes& wheel()
{
    static const host::hid::Bytes all = bytes (
        "05 01 09 04 a1 01 85 01 "                                                                         // joystick, report 1
        "09 30 16 01 80 26 ff 7f 75 10 95 01 81 02 "                                                       // x, s16
        "05 09 19 01 29 08 15 00 25 01 75 01 95 08 81 02 "                                                 // buttons 1-8
        "05 0f "                                                                                           // physical interface
        "09 21 a1 02 85 02 09 22 15 01 25 28 75 08 95 01 91 02 "                                           // set effect: block
        "09 25 a1 02 09 26 09 30 15 01 25 02 91 00 c0 "                                                    // type: constant, square
        "09 50 15 00 26 10 27 35 00 46 10 27 66 01 10 55 fd 75 10 91 02 "                                  // duration, ms
        "45 00 66 00 00 55 00 09 52 26 ff 00 75 08 91 02 "                                                 // gain
        "09 56 25 01 75 01 91 02 95 07 91 03 "                                                             // direction enable
        "09 57 a1 02 0b 01 00 0a 00 26 68 01 75 10 95 01 91 02 c0 c0 "                                     // direction, 0-360
        "09 73 a1 02 85 03 09 22 15 01 25 28 75 08 91 02 09 70 16 f0 d8 26 10 27 75 10 91 02 c0 "          // constant force, ±10000
        "09 77 a1 02 85 04 09 22 15 01 25 28 75 08 91 02 09 78 a1 02 09 79 09 7a 09 7b 25 03 91 00 c0 "    // operation
        "09 7c 15 00 26 ff 00 91 02 c0 "                                                                   // loop count
        "09 95 a1 02 85 05 09 96 a1 02 09 97 09 98 09 99 15 01 25 03 91 00 c0 c0 "                         // control
        "09 ab a1 02 85 06 09 25 a1 02 09 26 09 30 15 01 25 02 b1 00 c0 c0 "                               // create
        "09 89 a1 02 85 07 09 22 15 01 25 28 b1 02 09 8b a1 02 09 8c 09 8d 09 8e 25 03 b1 00 c0 c0 c0");   // block load
    return all;
}

}   // namespace tactus::test
