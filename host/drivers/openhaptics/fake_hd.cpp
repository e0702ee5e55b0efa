// SPDX-License-Identifier: MIT
// A fake of OpenHaptics' libHD.so, with simulated arms and hands. Written from a public description of the functions, apart from the driver.
// fake_hd.hpp says how it is told what to do.

#include "fake_hd.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

using namespace std::chrono_literals;
using tactus::host::FakeTouches;
using Arm = FakeTouches::Arm;

#define EXPORTED extern "C" __attribute__ ((visibility ("default")))

struct ErrorInfo
{
    unsigned code;
    int internal;
    unsigned device;
};

namespace
{
enum : unsigned
{
    invalid_value = 0x101,
    invalid_operation = 0x102,
    bad_handle = 0x104,
    device_fault = 0x300,
    already_initiated = 0x301,
    communication = 0x302,
    illegal_begin = 0x400,
    illegal_end = 0x401,
    nowhere = 0xffffffff
};

using Callback = unsigned (*) (void*);

FakeTouches& shared()
{
    static FakeTouches unnamed {};
    static FakeTouches& all = []() -> FakeTouches& {
        const char* path = std::getenv ("TACTUS_FAKE_HD");
        const int file = path != nullptr ? ::open (path, O_RDWR | O_CLOEXEC) : -1;
        if (file < 0) return unnamed;
        void* at = ::mmap (nullptr, sizeof (FakeTouches), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
        ::close (file);
        return at != MAP_FAILED ? *static_cast<FakeTouches*> (at) : unnamed;
    }();
    return all;
}

template <typename T>
T orElse (const std::atomic<T>& value, T otherwise)
{
    const T v = value;
    return v != T {} ? v : otherwise;
}

std::mutex errors_mutex;
std::deque<ErrorInfo> errors;   // the newest first

void raise (unsigned code, unsigned device, int internal = 0)
{
    const std::lock_guard lock (errors_mutex);
    errors.push_front ({ code, internal, device });
    if (errors.size() > 64) errors.pop_back();
}

/// The part of an arm that a frame has latched, and what it sets.
struct Frame
{
    bool is_open = false;
    std::uint64_t last_tick = 0;   // in which it was begun
    std::array<double, 3> position {}, velocity {}, force {}, torque {};
};
std::array<Frame, 2> frames;
unsigned current = nowhere;

struct Scheduled
{
    unsigned long handle;
    Callback call;
    void* user;
    unsigned short priority;
};
std::mutex schedule_mutex;   // held during callbacks: stopping and unscheduling wait for them
std::vector<Scheduled> schedule;
unsigned long handles = 0;
std::atomic<bool> is_running = false;
std::atomic<std::uint64_t> ticks = 0;
std::thread servo;
thread_local bool is_servo = false;

Arm* armOf (unsigned device) { return device < 2 && shared().arms[device].is_open != 0 ? &shared().arms[device] : nullptr; }

/// The open frame of the current device; null, with an error, if there is none.
Frame* inFrame()
{
    if (armOf (current) != nullptr && (frames[current].is_open || ! is_running)) return &frames[current];
    ++shared().gets_outside_frames;
    raise (invalid_operation, current);
    return nullptr;
}

/// The tool moves for one tick: a mass at the hand's spring, with the force of the last frame.
void move (Arm& arm, Frame& frame)
{
    constexpr double mass = 0.1, stiffness = 500.0, part_s = 250e-6;
    const double damping = 2.0 * std::sqrt (mass * stiffness);
    for (std::size_t i = 0; i < 3; ++i)
    {
        if (arm.is_stepped != 0)
        {
            arm.position[i] = arm.target[i].load();
            continue;
        }
        for (int k = 0; k < 4; ++k)
        {
            const double force = arm.force[i] + stiffness * 1e-3 * (arm.target[i] - arm.position[i]) - damping * frame.velocity[i];
            frame.velocity[i] += force / mass * part_s;
            arm.position[i] = arm.position[i] + 1e3 * frame.velocity[i] * part_s;
        }
    }
}

void stall()
{
    auto& all = shared();
    const int ms = all.stall_ms;
    if (ms > 0)
    {
        all.stall_ms = 0;
        std::this_thread::sleep_for (std::chrono::milliseconds (ms));
    }
    while (all.stall_ms < 0)
        std::this_thread::sleep_for (1ms);
}

void serve()
{
    is_servo = true;
    auto& all = shared();
    const auto period = std::chrono::microseconds (1'000'000 / orElse (all.rate, 1000));
    auto due = std::chrono::steady_clock::now();
    std::uint64_t step = 0;
    while (is_running)
    {
        if (all.arms[0].is_stepped == 1 && all.arms[0].step == step)
        {
            std::this_thread::sleep_for (20us);
            continue;
        }
        step = all.arms[0].step;
        stall();
        ++ticks;
        for (std::size_t i = 0; i < 2; ++i)
            if (all.arms[i].is_open != 0) move (all.arms[i], frames[i]);
        {
            const std::lock_guard lock (schedule_mutex);
            const auto now = schedule;
            for (const auto& each : now)
                if (each.call (each.user) == 0) std::erase_if (schedule, [&] (const Scheduled& s) { return s.handle == each.handle; });
        }
        due = std::max (due + period, std::chrono::steady_clock::now());
        if (all.arms[0].is_stepped != 1) std::this_thread::sleep_until (due);
    }
}
}   // namespace

//==============================================================================
EXPORTED ErrorInfo hdGetError()
{
    const std::lock_guard lock (errors_mutex);
    if (errors.empty()) return {};
    const auto error = errors.front();
    errors.pop_front();
    return error;
}
EXPORTED const char* hdGetErrorString (unsigned code)
{
    switch (code)
    {
    case 0x200:
        return "motors are warm";
    case 0x203:
        return "too fast";
    case device_fault:
        return "device fault";
    case communication:
        return "communication error";
    default:
        return "an error";
    }
}

EXPORTED unsigned hdInitDevice (const char* name)
{
    auto& all = shared();
    all.process = ::getpid();
    constexpr const char* names[] { "Default Device", "Second" };
    for (unsigned i = 0; i < static_cast<unsigned> (orElse (all.count, 1)); ++i)
    {
        const char* own = i == 0 && all.only_old_name != 0 ? "Default PHANToM" : names[i];
        const bool is_it = name == nullptr ? i == 0 && all.refuses_null == 0 : std::strcmp (name, own) == 0;
        if (! is_it || all.arms[i].is_missing != 0) continue;
        if (all.arms[i].is_open.exchange (1) != 0)
        {
            raise (already_initiated, i);
            return nowhere;
        }
        all.arms[i].is_unplugged = 0;
        current = i;
        return i;
    }
    raise (device_fault, nowhere, -3);
    return nowhere;
}
EXPORTED void hdDisableDevice (unsigned device)
{
    auto* arm = armOf (device);
    if (arm == nullptr) return raise (bad_handle, device);
    arm->is_open = 0;   // and nothing else: no source says what the motors do then
    ++arm->disables;
}
EXPORTED unsigned hdGetCurrentDevice() { return current; }
EXPORTED void hdMakeCurrentDevice (unsigned device)
{
    if (armOf (device) == nullptr) return raise (bad_handle, device);
    current = device;
}
EXPORTED void hdBeginFrame (unsigned device)
{
    auto* arm = armOf (device);
    if (arm == nullptr) return raise (bad_handle, device);
    auto& frame = frames[device];
    if (frame.is_open || (is_running && frame.last_tick == ticks))
    {
        ++shared().frame_errors;
        return raise (illegal_begin, device);
    }
    current = device;
    frame.is_open = true;
    frame.last_tick = ticks;
    frame.force = frame.torque = {};
    for (std::size_t i = 0; i < 3; ++i)
        frame.position[i] = std::round (arm->position[i] / 1e-3) * 1e-3;
}
EXPORTED void hdEndFrame (unsigned device)
{
    auto* arm = armOf (device);
    if (arm == nullptr || ! frames[device].is_open)
    {
        ++shared().frame_errors;
        return raise (illegal_end, device);
    }
    auto& frame = frames[device];
    frame.is_open = false;
    ++arm->frames;
    if (arm->is_unplugged != 0) return raise (communication, device, -28);
    const auto isZero = [] (const auto& force) { return std::ranges::all_of (force, [] (double f) { return f == 0.0; }); };
    if (isZero (frame.force) && ! isZero (arm->force)) arm->zero_at = std::chrono::nanoseconds (std::chrono::steady_clock::now().time_since_epoch()).count();
    for (std::size_t i = 0; i < 3; ++i)
    {
        arm->force[i] = frame.force[i];   // 0 unless this frame has set it
        arm->torque[i] = orElse (arm->output_dof, 3) >= 6 ? frame.torque[i] : 0.0;
    }
    if (const int error = arm->next_error.exchange (0); error != 0) raise (static_cast<unsigned> (error), device);
    if (const int error = arm->lasting_error; error != 0) raise (static_cast<unsigned> (error), device);
    for (unsigned other = 0; other < 2; ++other)
        if (const int error = other != device ? shared().arms[other].error_elsewhere.exchange (0) : 0; error != 0) raise (static_cast<unsigned> (error), other);
}

EXPORTED void hdGetDoublev (unsigned what, double* to)
{
    auto* arm = armOf (current);
    if (arm == nullptr) return raise (bad_handle, current);
    if (shared().needs_frame != 0 && ! frames[current].is_open) return raise (invalid_operation, current);
    switch (what)
    {
    case 0x2050:
        if (const auto* frame = inFrame()) std::copy_n (frame->position.begin(), 3, to);
        return;
    case 0x2052:
        if (const auto* frame = inFrame())
        {
            const bool is_turned = std::ranges::any_of (arm->transform, [] (const auto& v) { return v != 0.0; });
            for (std::size_t i = 0; i < 16; ++i)
                to[i] = is_turned ? arm->transform[i].load() : i % 5 == 0 ? 1.0
                                                                          : 0.0;
            std::copy_n (frame->position.begin(), 3, to + 12);
        }
        return;
    case 0x2551:
        for (int i = 0; i < 6; ++i)
            to[i] = i < 3 ? -80.0 : 80.0;
        return;
    case 0x2603:
        if (arm->max_force >= 0.0) *to = orElse (arm->max_force, 3.3);
        return;
    case 0x2604:
        *to = 0.88;
        return;
    case 0x2605:
        to[0] = to[1] = 0.1;
        to[2] = arm->temperature;
        return;
    default:
        raise (0x100, current);
    }
}
EXPORTED void hdSetDoublev (unsigned what, const double* from)
{
    auto* frame = inFrame();
    if (frame == nullptr) return;
    if (what == 0x2700)
        std::copy_n (from, 3, frame->force.begin());
    else if (what == 0x2701)
        std::copy_n (from, 3, frame->torque.begin());
    else
        raise (0x100, current);
}
EXPORTED void hdGetIntegerv (unsigned what, int* to)
{
    auto* arm = armOf (current);
    if (arm == nullptr) return raise (bad_handle, current);
    switch (what)
    {
    case 0x2000:
        *to = arm->buttons;
        return;
    case 0x2553:
        *to = 6;
        return;
    case 0x2554:
        *to = orElse (arm->output_dof, 3);
        return;
    case 0x2555:
        *to = orElse (arm->styles, 2);
        return;
    case 0x2601:
        *to = orElse (shared().rate, 1000);
        return;
    default:
        raise (0x100, current);
    }
}
EXPORTED const char* hdGetString (unsigned what)
{
    switch (what)
    {
    case 0x2500:
        return "3.4";
    case 0x2501:
        return armOf (current) != nullptr && orElse (armOf (current)->output_dof, 3) >= 6 ? "PHANTOM Premium 1.5 6DOF" : "Touch";
    case 0x2504:
        return current == 1 ? "SN2" : "SN1";
    default:
        return nullptr;
    }
}
EXPORTED void hdEnable (unsigned) {}
EXPORTED void hdDisable (unsigned) {}
EXPORTED unsigned char hdIsEnabled (unsigned) { return 1; }

EXPORTED unsigned hdCheckCalibration()
{
    const auto* arm = armOf (current);
    return arm == nullptr || arm->calibration == 2 ? 0x5002u : arm->calibration == 1 ? 0x5001u
                                                                                     : 0x5000u;
}
EXPORTED unsigned hdCheckCalibrationStyle() { return armOf (current) != nullptr ? static_cast<unsigned> (orElse (armOf (current)->styles, 2)) : 0; }
EXPORTED void hdUpdateCalibration (unsigned style)
{
    auto* arm = armOf (current);
    if (arm == nullptr) return raise (bad_handle, current);
    ++arm->updates;
    if (frames[current].is_open) ++arm->updates_in_frame;
    if ((orElse (arm->styles, 2) & static_cast<int> (style)) == 0) return raise (invalid_value, current);
    if (arm->calibration == 1) arm->calibration = 0;
}

//==============================================================================
EXPORTED void hdSetSchedulerRate (unsigned long hz)
{
    if (shared().refuses_rate != 0 || (hz != 500 && hz != 1000)) return raise (invalid_value, current);
    shared().rate = static_cast<int> (hz);
}
EXPORTED void hdStartScheduler()
{
    ++shared().starts;
    if (shared().does_not_start != 0) return raise (0x304, current);
    if (is_running.exchange (true)) return;
    servo = std::thread (serve);
}
EXPORTED void hdStopScheduler()
{
    while (shared().stop_hangs != 0)
        std::this_thread::sleep_for (1ms);
    is_running = false;
    if (servo.joinable() && ! is_servo) servo.join();   // waits for the callback that runs
    ++shared().stops;
}
EXPORTED unsigned long hdScheduleAsynchronous (Callback call, void* user, unsigned short priority)
{
    const std::lock_guard lock (schedule_mutex);
    schedule.push_back ({ ++handles, call, user, priority });
    std::ranges::stable_sort (schedule, std::greater {}, &Scheduled::priority);
    return handles;
}
EXPORTED void hdUnschedule (unsigned long handle)
{
    const std::lock_guard lock (schedule_mutex);
    if (std::erase_if (schedule, [&] (const Scheduled& s) { return s.handle == handle; }) == 0) ++shared().calls_after_unschedule;
}
EXPORTED void hdScheduleSynchronous (Callback call, void* user, unsigned short)
{
    const std::lock_guard lock (schedule_mutex);
    call (user);
}
EXPORTED unsigned char hdWaitForCompletion (unsigned long, unsigned) { return 0; }
EXPORTED double hdGetSchedulerTimeStamp() { return 0.0; }
