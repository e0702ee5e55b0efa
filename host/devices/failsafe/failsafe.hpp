// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/result.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tactus::host
{

/// Reports that are written to a device file if this process dies or freezes, for whatever reason, while the object exists:
///  - after a fault (SIGSEGV, SIGABRT, SIGFPE, SIGBUS, SIGILL) immediately, by a signal handler that only writes; then the
///    previous signal handler runs;
///  - after anything else (kill -9, out of memory) by a guardian: a small process that also has the device file open, and
///    notices the death because a socket closes;
///  - by the guardian, too, if the thread that drives the device gives no sign of life (beat()) for as long as `patience`, for
///    example because the process was suspended (kill -STOP, a debugger);
///  - by the guardian, too, if the object goes while an effort may be on the device: its last beat was that of a driven device, which did not come to
///    rest. The guardian then tries for up to 10 s. This raises no alarm.
///
/// Three events raise an alarm, after which the forces of the whole run must stay at zero until someone rearms: a device was
/// taken, the guardian itself was killed or frozen, or the computer has slept. Runs compare alarms() on every tick.
///
/// Good to know
///  - After a fault both the handler and the guardian write, so the device must tolerate receiving the reports twice.
///  - After a stack overflow the handler has no stack, so only the guardian writes.
///  - The guardian is a program of its own (host/devices/failsafe). It starts when the first failsafe is armed, and ends with this process. It has its own
///    session and ignores all signals but KILL, STOP and faults, so nothing that is sent to the group or the terminal of this process reaches it.
///    If it is killed, a thread of this process starts another one at once; if it is frozen, within about 2 s.
///  - The handlers for faults are set while anything is armed. Then those of before are back, unless the program has replaced ours meanwhile.
///  - The child of a fork has none of this: it writes nothing to the devices, cannot arm any, and does not keep the guardian from noticing the end
///    of its parent.
///  - The guardian counts its own looks at the beats and reads no clock, so it takes no device when the whole computer pauses.
///    While program and guardian are frozen together, nothing is sent. Afterwards, beat() detects a pause of more than a second.
class Failsafe
{
public:
    struct Report
    {
        std::vector<std::uint8_t> bytes;   ///< in the form that write(2) expects
        bool is_feature = false;           ///< sent as a feature report of a hidraw device
    };

    static constexpr std::size_t most_devices = 16, most_reports = 16, most_bytes = 4096;

    /// While an effort is on a device, the guardian takes the device about this long after its last beat.
    static constexpr std::chrono::milliseconds patience { 100 };

    /// Arms the failsafe. Writes nothing now. Ids: device/failsafe; device/no_failsafe on systems without one, after allowUnguarded().
    /// [main thread, or one that opens devices]
    static Result<Failsafe> arm (const std::string& device_file, const std::vector<Report>&);

    /// The same for a device that is open already, such as a socket, whatever its name. The descriptor is duplicated; it must not block.
    static Result<Failsafe> arm (int descriptor, const std::string& name, const std::vector<Report>&);

#if ! defined(__linux__)
    /// This system has no guardian. From now on, devices with forces open without one; before, arm() refuses them. [main thread]
    static void allowUnguarded() noexcept;
#endif

    Failsafe (Failsafe&&) noexcept;
    Failsafe& operator= (Failsafe&&) noexcept;
    ~Failsafe();   ///< disarms the failsafe, or leaves a device that is still driven to the guardian

    /// A sign of life from the thread that writes to the device. Call it several times per `patience` while an effort may be on the
    /// device (`driven`), and once more when there is none. Makes no system call. Returns false if the guardian has taken the device,
    /// if the computer has slept, or if more than a second has passed since the last beat while an effort was on the device. Then
    /// open the device again before sending any effort. [one thread at a time]
    bool beat (bool driven) noexcept;

    /// The number of alarms so far. One atomic read. [any thread, including the tick thread]
    static std::uint32_t alarms() noexcept;

    /// The message of the latest alarm. Ids: run/frozen, run/unguarded, run/slept. [any thread but the tick thread]
    static Message alarm();

private:
    Failsafe (int s, std::int64_t slept) noexcept : slot (s), asleep (slept) {}

    static constexpr int none = -1;
    int slot = none;
    std::int64_t asleep = 0;   // how long the computer had slept when this was armed, in ns
};

}   // namespace tactus::host
