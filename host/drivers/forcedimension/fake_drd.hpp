// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace tactus::host
{

/// Two simulated arms of Force Dimension in shared memory. The fake of their library maps the file that TACTUS_FAKE_DRD names. A test maps it too, and can
/// watch the arms even after the program with the library has died. A file of this size with only zeros is two omega.3, switched on.
struct FakeArms
{
    template <typename T>
    using Shared = std::atomic<T>;

    struct Arm
    {
        // The kind of arm. 0 means the value in the comment.
        Shared<int> type, serial;                                                // 33: an omega.3; 10001 and 10002
        Shared<int> left_handed, wrist, active_wrist, gripper, active_gripper;   // it has none
        Shared<int> status_count;                                                // 17
        Shared<int> must_calibrate, calibrates_by_hand;                          // it knows its position
        Shared<int> calibration_ms;                                              // that drdAutoInit takes
        Shared<int> watchdog;                                                    // 255, in units of 125 us; -1: it has none
        Shared<int> time_guard_us;                                               // none: each position is new
        Shared<int> ignores_silence;                                             // 1: its watchdog never bites, for tests on a busy computer
        Shared<double> firmware;                                                 // 3.1
        Shared<double> max_force, max_speed;                                     // 100 N and 3 m/s; above, it saturates, and brakes
        Shared<double> mass, damping;                                            // 0.2 kg; of the arm alone, 0 N s/m
        Shared<int> is_stepped;                                                  // the tool is at `target`, and its position is new when `step` changes

        // The hand, in the axes of the library.
        std::array<Shared<double>, 3> target;
        Shared<double> stiffness;   // 500 N/m
        Shared<std::uint64_t> step;
        Shared<double> gripper_angle;          // of a right-handed one
        std::array<Shared<double>, 9> frame;   // of the wrist, by rows; only zeros: not turned
        Shared<int> buttons;

        // Faults.
        Shared<int> is_unplugged, is_muted;                                // muted: every call fails, but the status does not say that it was unplugged
        Shared<int> off_cause;                                             // forces are switched off now, for this cause; it becomes 0
        Shared<int> read_stall_ms, write_stall_ms, close_stall_ms;         // the next call takes so long; -1: until this is 0 again
        Shared<int> error_flag, has_no_power, has_no_status, has_no_gap;   // the last two: these calls fail
        Shared<int> gripper_fails;

        // The result of the driver's calls.
        Shared<int> is_open, is_enabled, is_braked, is_calibrated, cause, weight_is_carried;
        std::array<Shared<double>, 3> position, force, torque;   // of the tool; what the library was asked for last
        Shared<double> gripper_force;
        Shared<std::int64_t> commanded_at, zero_at;   // by the steady clock, in ns: the last force, and the first zero after a push
        Shared<std::uint64_t> forces, enables, calibrations, stops, closes, calls_after_close, new_positions, expert_violations;
        Shared<int> stopped_before_close;
    };

    std::array<Arm, 2> arms;
    Shared<int> count;   // of arms; 0: one, -1: none

    /// The force on the tool of an arm at this time of the steady clock: nothing if the forces are off, or no command has come for the time of its watchdog.
    static double forceAt (const Arm& arm, std::int64_t now_ns, int axis)
    {
        const int set = arm.watchdog, units = set == 0 ? 255 : set;
        const bool is_late = units > 0 && now_ns - arm.commanded_at > units * 125'000ll;
        return arm.is_enabled != 0 && ! is_late ? arm.force[static_cast<std::size_t> (axis)].load() : 0.0;
    }
};

static_assert (std::atomic<double>::is_always_lock_free && std::atomic<std::uint64_t>::is_always_lock_free);

}   // namespace tactus::host
