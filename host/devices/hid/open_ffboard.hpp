// SPDX-License-Identifier: MIT
#pragma once

#include "profile.hpp"
#include "report_descriptor.hpp"

#include <cstdint>

namespace tactus::host::hid
{

/// True for the ids of the OpenFFBoard, which force feedback boards with its firmware share.
constexpr bool isOpenFFBoard (std::uint16_t vid, std::uint16_t pid) noexcept { return vid == 0x1209 && pid == 0xffb0; }

/// Adds the board's own channel to the profile of its standard force feedback: report 0xA1, 24 bytes each way after its id, with type u8, class u16,
/// instance u8, command u32, value s64 and address s64 (Ultrawipf/OpenFFBoard, HidCommandInterface.h; facts only). Does nothing if the descriptor
/// has no such report.
///
///  - `torque_x` and, on a board with two axes, `torque_y` are the torques that the board gives its motors now, in parts of what their drivers can
///    do, 50 times a second.
///  - `board_stopped` is 1 while the emergency stop of the board is on: an alarm. The board is asked 20 times a second.
///  - The emergency stop of Tactus is that of the board, too (BoardStop). [main thread]
void addOpenFFBoard (Profile&, const ReportDescriptor&, bool two_axes);

}   // namespace tactus::host::hid
