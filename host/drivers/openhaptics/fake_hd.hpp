// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace tactus::host
{

/// Two simulated arms of 3D Systems in shared memory. The fake of their library maps the file that TACTUS_FAKE_HD names. A test maps it too, and can watch
/// the arms even after the process with the library has died. A file of this size with only zeros is one arm, "Default Device", calibrated.
struct FakeTouches
{
    template <typename T>
    using Shared = std::atomic<T>;

    struct Arm
    {
        // The kind of arm. 0 means the value in the comment.
        Shared<int> output_dof;     // 3
        Shared<double> max_force;   // 3.3 N; -1: the library does not tell
        Shared<int> styles;         // 2: it calibrates itself; 1: by resetting its encoders; 4: in its inkwell
        Shared<int> calibration;    // 0: it knows its position; 1: once it is told to update; 2: it needs a person, who sets this to 1
        Shared<int> is_stepped;     // the tool is at `target`; 1: and the servo loop ticks once when `step` changes

        // The hand, in the axes of the library, in mm.
        std::array<Shared<double>, 3> target;
        std::array<Shared<double>, 16> transform;   // only zeros: not turned
        Shared<std::uint64_t> step;
        Shared<int> buttons;
        Shared<double> temperature;

        // Faults.
        Shared<int> is_unplugged, is_missing;
        Shared<int> next_error, lasting_error;   // in the next frame; in each one
        Shared<int> error_elsewhere;             // in the next frame of the other arm

        // The result of the calls.
        Shared<int> is_open;
        std::array<Shared<double>, 3> position, force, torque;   // mm, N, mN m: what the last frame has set
        Shared<std::int64_t> zero_at;                            // by the steady clock, in ns: the first zero after a push
        Shared<std::uint64_t> frames, updates, updates_in_frame, disables;
    };

    std::array<Arm, 2> arms;
    Shared<int> count;            // of arms; 0: one
    Shared<int> refuses_null;     // arms have to be opened by name
    Shared<int> only_old_name;    // the first arm is "Default PHANToM"
    Shared<int> refuses_rate;     // 1000 Hz
    Shared<int> rate;             // 1000 Hz
    Shared<int> does_not_start;   // the servo loop
    Shared<int> needs_frame;      // hdGetDoublev, for everything
    Shared<int> stall_ms;         // the next tick takes so long; -1: until this is 0 again
    Shared<int> stop_hangs;       // hdStopScheduler, until this is 0 again

    Shared<int> process;   // that owns the library; 0: none yet
    Shared<std::uint64_t> starts, stops, calls_after_unschedule, gets_outside_frames, frame_errors;
};

static_assert (std::atomic<double>::is_always_lock_free && std::atomic<std::uint64_t>::is_always_lock_free);

}   // namespace tactus::host
