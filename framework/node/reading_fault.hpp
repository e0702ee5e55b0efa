// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus
{

/// The reason why a reading must not be used, or gets old. Logs contain these numbers, so new faults go to the end.
enum class ReadingFault : std::uint32_t
{
    none,

    // reported by the device: the alarms of its profile
    too_hot,
    timed_out,
    not_driven,
    not_homed,
    stopped,
    failed,

    // found by the driver
    no_report,
    unplugged,
    malformed,
    repeated,
    clock_stopped,
    restarted,
    lost,
    impossible_pose,

    // found by the guard
    frozen,

    // found by the driver
    stuck,

    // no fault of the device: its workspace moves, and the nodes keep the position that they know
    moved
};

struct ReadingFaultInfo
{
    std::string_view id;      ///< in a profile
    std::string_view words;   ///< for people
};

/// In the order of ReadingFault.
inline constexpr std::array<ReadingFaultInfo, 18> reading_faults { {
    { "none", "" },
    { "too_hot", "the device reports that a motor is too hot" },
    { "timed_out", "the device reports that its watchdog has released the motors" },
    { "not_driven", "the device reports that its motors are not driven" },
    { "not_homed", "the device reports that it does not know its position" },
    { "stopped", "the device reports that its emergency stop is pressed" },
    { "failed", "the device reports a fault" },
    { "no_report", "the device has sent no report yet" },
    { "unplugged", "the device is unplugged" },
    { "malformed", "the latest report of the device is malformed" },
    { "repeated", "the device repeats the same report" },
    { "clock_stopped", "the clock of the device has stopped" },
    { "restarted", "the report number or the clock of the device went back, as after a restart" },
    { "lost", "more than half of the device's reports are missing" },
    { "impossible_pose", "the device reports a pose that its arm cannot have" },
    { "frozen", "the position does not change" },
    { "stuck", "the driver of the device does not return" },
    { "moved", "its workspace is being moved" },
} };
static_assert (reading_faults.size() == static_cast<std::size_t> (ReadingFault::moved) + 1, "a new fault needs words");

/// True for a fault that a device can report itself.
constexpr bool isAlarm (ReadingFault fault) noexcept { return fault >= ReadingFault::too_hot && fault <= ReadingFault::failed; }

/// The fault in words, as a sentence; empty for none.
constexpr std::string_view describe (ReadingFault fault) noexcept
{
    const auto i = static_cast<std::size_t> (fault);
    return i < reading_faults.size() ? reading_faults[i].words : std::string_view();
}

}   // namespace tactus
