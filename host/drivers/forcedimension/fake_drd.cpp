// SPDX-License-Identifier: MIT
// A fake of Force Dimension's library, with simulated arms and hands: libdrd.so, or with FAKE_OLD libdhd.so of an early version, and with FAKE_ANCIENT one
// from before versions. Written from a public description of the functions, apart from the driver. fake_drd.hpp says how it is told what to do.

#include "fake_drd.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <utility>

using namespace std::chrono_literals;
using tactus::host::FakeArms;
using Arm = FakeArms::Arm;
using Clock = std::chrono::steady_clock;

#define EXPORTED extern "C" __attribute__ ((visibility ("default")))

namespace
{
// Errors.
constexpr int communication = 2, no_device = 5, invalid_index = 15, in_use = 20;
[[maybe_unused]] constexpr int not_available = 6, expert_disabled = 9, not_ready = 12;

constexpr int nothing_new = 1, saturated = 2;
constexpr double gravity = 9.81, step_s = 250e-6, resolution = 1e-6;

thread_local int last_error = 0;

int fail (int error)
{
    last_error = error;
    return -1;
}

FakeArms& mapped()
{
    static FakeArms unnamed {};   // without a file
    const char* path = std::getenv ("TACTUS_FAKE_DRD");
    const int file = path != nullptr ? ::open (path, O_RDWR | O_CLOEXEC) : -1;
    if (file < 0) return unnamed;
    void* at = ::mmap (nullptr, sizeof (FakeArms), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    ::close (file);
    return at != MAP_FAILED ? *static_cast<FakeArms*> (at) : unnamed;
}

/// An arm as the library sees it.
class Opened
{
public:
    std::atomic<Arm*> arm = nullptr;   // null: it was never opened. A call of an earlier device, which has not returned, may still look
    std::mutex mutex;                  // of what follows
    std::array<double, 3> velocity {}, known {};
    Clock::time_point moved_to, sampled;
    std::uint64_t sampled_step = 0;
    bool has_sample = false, is_at_rest = true;
};

std::array<Opened, 2> opened;
std::atomic<FakeArms*> arms = nullptr;
[[maybe_unused]] std::atomic<bool> is_expert = false;   // the ancient library has no expert mode

Clock::time_point now() { return Clock::now(); }
std::int64_t nanoseconds (Clock::time_point t) { return std::chrono::duration_cast<std::chrono::nanoseconds> (t.time_since_epoch()).count(); }
template <typename T>
T orElse (const std::atomic<T>& value, T otherwise)
{
    const T v = value;
    return v != T {} ? v : otherwise;
}

void stall (std::atomic<int>& for_ms)
{
    const int ms = for_ms;
    if (ms > 0)
    {
        for_ms = 0;
        std::this_thread::sleep_for (std::chrono::milliseconds (ms));
    }
    while (for_ms < 0)
        std::this_thread::sleep_for (1ms);
}

/// The arm that this id has, or had; null: it was never opened.
Opened* everOpened (char id)
{
    const auto index = static_cast<std::size_t> (id < 0 ? 0 : id);
    return index < opened.size() && opened[index].arm != nullptr ? &opened[index] : nullptr;
}

/// Without a lock: what reads and what pushes do not wait for each other.
void stallAt (char id, std::atomic<int> Arm::*what)
{
    if (auto* o = everOpened (id); o != nullptr) stall (o->arm.load()->*what);
}

void switchOff (Arm& arm, int cause)
{
    arm.is_enabled = 0;
    arm.is_braked = 1;
    arm.cause = cause;
}

/// Catches up with the time since the last call: the watchdog, buttons, and the hand that moves the tool. [with the mutex held]
void live (Opened& o)
{
    auto& arm = *o.arm;
    const auto until = now();
    if (const int cause = arm.off_cause.exchange (0); cause != 0) switchOff (arm, cause);
    if (arm.is_stepped != 0)
    {
        for (std::size_t i = 0; i < 3; ++i)
            arm.position[i] = arm.target[i].load();
        return;
    }
    if (until - o.moved_to > 200ms) o.moved_to = until - 200ms;
    const int units = orElse (arm.watchdog, 255);
    const double mass = orElse (arm.mass, 0.2), stiffness = orElse (arm.stiffness, 500.0);
    const double damping = 2.0 * std::sqrt (mass * stiffness);
    for (; o.moved_to + 250us <= until; o.moved_to += 250us)
    {
        const auto passed = nanoseconds (o.moved_to) - arm.commanded_at;
        if (arm.is_enabled != 0 && arm.ignores_silence == 0 && units > 0 && passed > units * 125'000ll) switchOff (arm, 3);
        const bool acts = arm.is_enabled != 0;
        double speed = 0.0;
        for (std::size_t i = 0; i < 3; ++i)
        {
            double force = stiffness * (arm.target[i] - arm.position[i]) - damping * o.velocity[i] * (arm.is_braked != 0 ? 5.0 : 1.0);
            force += (acts ? arm.force[i].load() : 0.0) - arm.damping * o.velocity[i];
            if (i == 2 && ! (acts && arm.weight_is_carried != 0)) force -= mass * gravity;
            o.velocity[i] += force / mass * step_s;
            arm.position[i] = arm.position[i] + o.velocity[i] * step_s;
            speed = std::hypot (speed, o.velocity[i]);
        }
        if (acts && speed > orElse (arm.max_speed, 3.0)) switchOff (arm, 2);
    }
}

/// The arm of an open id; null, with the error, if it cannot be used.
Opened* use (char id)
{
    auto* o = everOpened (id);
    const bool is_open = o != nullptr && o->arm.load()->is_open != 0;
    if (o != nullptr && ! is_open) ++o->arm.load()->calls_after_close;
    if (is_open && o->arm.load()->is_unplugged == 0 && o->arm.load()->is_muted == 0) return o;
    fail (is_open ? communication : invalid_index);
    return nullptr;
}

template <typename F>
int with (char id, F&& act)
{
    auto* o = use (id);
    if (o == nullptr) return -1;
    const std::lock_guard lock (o->mutex);
    live (*o);
    return act (*o);
}

int howMany() { return arms.load()->count < 0 ? 0 : orElse (arms.load()->count, 1); }

int openAt (int index)
{
    arms = &mapped();
    if (index < 0 || index >= howMany()) return fail (no_device);
    auto& o = opened[static_cast<std::size_t> (index)];
    const std::lock_guard lock (o.mutex);
    auto& arm = arms.load()->arms[static_cast<std::size_t> (index)];
    if (arm.is_unplugged != 0) return fail (no_device);
    if (arm.is_open.exchange (1) != 0) return fail (in_use);
    o.arm = &arm;
    o.velocity = {};
    o.moved_to = now();
    o.has_sample = false;
    arm.stopped_before_close = 0;
    switchOff (arm, 0);
    arm.weight_is_carried = 1;
    if (arm.must_calibrate == 0) arm.is_calibrated = 1;
    return index;
}

[[maybe_unused]] int openThat (std::atomic<int> Arm::*what, int is, int otherwise, int more)   // `more`: of the second arm
{
    arms = &mapped();
    for (int i = 0; i < howMany(); ++i)
        if (auto& arm = arms.load()->arms[static_cast<std::size_t> (i)]; orElse (arm.*what, otherwise + i * more) == is && arm.is_open == 0) return openAt (i);
    return fail (no_device);
}

int closeArm (char id)
{
    auto* o = everOpened (id);
    if (o == nullptr) return fail (invalid_index);
    auto& arm = *o->arm;
    stall (arm.close_stall_ms);
    if (arm.is_open.exchange (0) == 0)
    {
        ++arm.calls_after_close;
        return fail (invalid_index);
    }
    ++arm.closes;   // and nothing else: no source says that closing takes the forces off
    return 0;
}

int push (char id, std::array<double, 3> force, std::array<double, 3> torque, double grip)
{
    stallAt (id, &Arm::write_stall_ms);
    return with (id, [&] (Opened& o) {
        auto& arm = *o.arm;
        if (arm.is_calibrated == 0 && arm.calibrates_by_hand == 0 && std::hypot (force[0], force[1], force[2]) > 0.0) return fail (not_ready);
        const double most = orElse (arm.max_force, 100.0), size = std::hypot (force[0], force[1], force[2]);
        for (std::size_t i = 0; i < 3; ++i)
        {
            arm.force[i] = size > most ? force[i] * most / size : force[i];
            arm.torque[i] = torque[i];
        }
        arm.gripper_force = grip;
        arm.commanded_at = nanoseconds (now());
        if (size == 0.0 && ! o.is_at_rest) arm.zero_at = arm.commanded_at.load();
        o.is_at_rest = size == 0.0;
        ++arm.forces;
        return size > most ? saturated : 0;
    });
}

/// Tells a value of the arm.
template <typename To, typename T>
int tell (char id, To* to, std::atomic<T> Arm::*what, T otherwise)
{
    return with (id, [&] (Opened& o) { return *to = static_cast<To> (orElse (o.arm.load()->*what, otherwise)), 0; });
}

[[maybe_unused]] int set (char id, std::atomic<int> Arm::*what, int on)
{
    return with (id, [&] (Opened& o) { return o.arm.load()->*what = on != 0 ? 1 : 0, 0; });
}

[[maybe_unused]] bool has (char id, std::atomic<int> Arm::*what)
{
    auto* o = use (id);
    return o != nullptr && (o->arm.load()->*what) != 0;
}

[[maybe_unused]] int tellGripper (char id, double* to, std::atomic<int> Arm::*fails, double scale)
{
    return with (id, [&] (Opened& o) {
        if (o.arm.load()->gripper == 0 || o.arm.load()->*fails != 0) return fail (not_available);
        *to = scale * o.arm.load()->gripper_angle;
        return nothing_new;   // it was read with the position
    });
}

[[maybe_unused]] int enterExpertMode (bool is)
{
    is_expert = is;
    return 0;
}

[[maybe_unused]] int violate (char id)
{
    return with (id, [] (Opened& o) { return static_cast<int> (++o.arm.load()->expert_violations); });
}
}   // namespace

//==============================================================================
EXPORTED int dhdErrorGetLast() { return last_error; }
EXPORTED const char* dhdErrorGetStr (int error)
{
    for (const auto& [code, text] : { std::pair { communication, "communication error" }, { no_device, "no device found" }, { in_use, "device in use" } })
        if (code == error) return text;
    return "an error";
}
EXPORTED int dhdGetDeviceCount()
{
    arms = &mapped();
    return howMany();
}
EXPORTED int dhdOpenID (char index) { return openAt (index < 0 ? 0 : index); }
EXPORTED int dhdClose (char id) { return closeArm (id); }
EXPORTED int dhdGetPosition (double* x, double* y, double* z, char id)
{
    stallAt (id, &Arm::read_stall_ms);
    return with (id, [&] (Opened& o) {
        auto& arm = *o.arm;
        const auto at = now();
        const auto step = arm.step.load();   // before the target that belongs to it
        if (arm.is_stepped != 0) live (o);
        const bool is_new = arm.is_stepped != 0 ? step != o.sampled_step || ! o.has_sample
                                                : ! o.has_sample || at - o.sampled >= std::chrono::microseconds (arm.time_guard_us);
        if (is_new)
        {
            o.sampled_step = step;
            for (std::size_t i = 0; i < 3; ++i)
                o.known[i] = std::round (arm.position[i] / resolution) * resolution;
            o.sampled = at;
            o.has_sample = true;
            ++arm.new_positions;
        }
        *x = o.known[0];
        *y = o.known[1];
        *z = o.known[2];
        return is_new ? 0 : nothing_new;
    });
}
EXPORTED int dhdSetForce (double x, double y, double z, char id) { return push (id, { x, y, z }, {}, 0.0); }
EXPORTED int dhdStop (char id)
{
    return with (id, [&] (Opened& o) {
        switchOff (*o.arm, 4);
        ++o.arm.load()->stops;
        o.arm.load()->stopped_before_close = 1;
        return 0;
    });
}
EXPORTED int dhdGetStatus (int* status, char id)
{
    const auto* o = everOpened (id);
    if (o == nullptr) return fail (invalid_index);
    const auto* arm = o->arm.load();
    if ((arm->is_open != 0 && arm->is_muted != 0) || arm->has_no_status != 0) return fail (communication);
    const bool is_there = arm->is_unplugged == 0;
    if (is_there && with (id, [] (Opened&) { return 0; }) < 0) return -1;
#if defined(FAKE_ANCIENT)
    const int count = 12;
#else
    const int count = orElse (arm->status_count, 17);
#endif
    const std::array<int, 17> all { arm->has_no_power != 0 ? 0 : 1, is_there ? 1 : 0, 0, arm->is_calibrated != 0 ? 0 : 1, 0, arm->is_enabled, arm->is_braked, 0,
                                    arm->wrist, arm->error_flag, arm->weight_is_carried, 1, 1, 0, is_there ? arm->cause.load() : 5, 0, 0 };
    std::copy_n (all.begin(), count, status);
    std::fill (status + count, status + 20, 0x0badcafe);   // a library of another version may write so many
    return 0;
}

#if ! defined(FAKE_ANCIENT)
EXPORTED void dhdGetSDKVersion (int* a, int* b, int* c, int* d)
{
#if defined(FAKE_OLD)
    *a = 3, *b = 2, *c = 1, *d = 0;
#else
    *a = 3, *b = 17, *c = 5, *d = 0;
#endif
}
EXPORTED int dhdEnableForce (unsigned char on, char id)
{
    return with (id, [&] (Opened& o) {
        auto& arm = *o.arm;
        if (arm.is_calibrated == 0) return fail (not_ready);
        arm.is_enabled = on != 0 ? 1 : 0;
        arm.is_braked = on != 0 ? 0 : 1;
        arm.cause = on != 0 ? 0 : 4;
        arm.commanded_at = nanoseconds (now());
        arm.enables += on != 0 ? 1 : 0;
        return 0;
    });
}
EXPORTED int dhdSetBrakes (int on, char id) { return set (id, &Arm::is_braked, on); }
EXPORTED int dhdSetGravityCompensation (int on, char id) { return set (id, &Arm::weight_is_carried, on); }
EXPORTED int dhdGetSystemType (char id)
{
    return with (id, [] (Opened& o) { return orElse (o.arm.load()->type, 33); });
}
EXPORTED int dhdGetButton (int index, char id)
{
    return with (id, [&] (Opened& o) { return (o.arm.load()->buttons >> index) & 1; });
}
EXPORTED bool dhdHasWrist (char id) { return has (id, &Arm::wrist); }
EXPORTED int
#if defined(FAKE_OLD)
dhdGetRotatorMatrix
#else
dhdGetOrientationFrame
#endif
    (double (*frame)[3], char id)
{
    return with (id, [&] (Opened& o) {
        const auto& from = o.arm.load()->frame;
        const bool is_turned = std::ranges::any_of (from, [] (const auto& v) { return v != 0.0; });
        for (std::size_t i = 0; i < 9; ++i)
            frame[i / 3][i % 3] = is_turned ? from[i].load() : i % 4 == 0 ? 1.0
                                                                          : 0.0;
        return 0;
    });
}
#endif

#if ! defined(FAKE_ANCIENT) && ! defined(FAKE_OLD)
EXPORTED int dhdOpenType (int type)
{
    return openThat (&Arm::type, type, 33, 0);
}
EXPORTED int dhdOpenSerial (int serial) { return openThat (&Arm::serial, serial, 10001, 1); }
EXPORTED int dhdGetSerialNumber (unsigned short* to, char id) { return tell (id, to, &Arm::serial, 10001 + static_cast<int> (id)); }
EXPORTED const char* dhdGetSystemName (char id)
{
    auto* o = use (id);
    if (o == nullptr) return nullptr;
    for (const auto& [type, name] : { std::pair { 33, "omega.3" }, { 37, "omega.7 (left-hand)" }, { 60, "Falcon" }, { 63, "delta.3" }, { 104, "sigma.7" } })
        if (type == orElse (o->arm.load()->type, 33)) return name;
    return "";
}
EXPORTED int dhdGetVersion (double* to, char id) { return tell (id, to, &Arm::firmware, 3.1); }
EXPORTED bool dhdIsLeftHanded (char id) { return has (id, &Arm::left_handed); }
EXPORTED bool dhdHasActiveWrist (char id) { return has (id, &Arm::active_wrist); }
EXPORTED bool dhdHasGripper (char id) { return has (id, &Arm::gripper); }
EXPORTED bool dhdHasActiveGripper (char id) { return has (id, &Arm::active_gripper); }
EXPORTED int dhdEnableGripperForce (unsigned char, char id) { return use (id) != nullptr ? 0 : -1; }
EXPORTED int dhdGetGripperAngleRad (double* to, char id)
{
    return tellGripper (id, to, &Arm::gripper_fails, has (id, &Arm::left_handed) ? -1.0 : 1.0);
}
EXPORTED int dhdGetGripperGap (double* to, char id) { return tellGripper (id, to, &Arm::has_no_gap, 0.06); }
EXPORTED unsigned dhdGetButtonMask (char id)
{
    auto* o = use (id);
    return o != nullptr ? static_cast<unsigned> (o->arm.load()->buttons.load()) : 0;
}
EXPORTED int dhdSetForceAndTorque (double x, double y, double z, double a, double b, double c, char id) { return push (id, { x, y, z }, { a, b, c }, 0.0); }
EXPORTED int dhdSetForceAndGripperForce (double x, double y, double z, double grip, char id) { return push (id, { x, y, z }, {}, grip); }
EXPORTED int dhdSetForceAndTorqueAndGripperForce (double x, double y, double z, double a, double b, double c, double grip, char id)
{
    return push (id, { x, y, z }, { a, b, c }, grip);
}
EXPORTED double dhdGetMaxForce (char id)
{
    auto* o = use (id);
    return o != nullptr && o->arm.load()->max_force > 0.0 ? o->arm.load()->max_force.load() : -1.0;
}
EXPORTED int dhdEnableExpertMode() { return enterExpertMode (true); }
EXPORTED int dhdDisableExpertMode() { return enterExpertMode (false); }
EXPORTED int dhdGetWatchdog (unsigned char* to, char id)
{
    return with (id, [&] (Opened& o) {
        if (! is_expert) return fail (expert_disabled);
        if (o.arm.load()->watchdog < 0) return fail (not_available);   // firmware before 3.0
        *to = static_cast<unsigned char> (orElse (o.arm.load()->watchdog, 255));
        return 0;
    });
}
// Functions that the driver must not call.
EXPORTED int dhdSetWatchdog (unsigned char, char id) { return violate (id); }
EXPORTED int dhdSetVelocityThreshold (unsigned, char id) { return violate (id); }
EXPORTED int dhdSetTimeGuard (int, char id) { return violate (id); }
EXPORTED int drdOpenID (char index) { return openAt (index < 0 ? 0 : index); }
EXPORTED int drdClose (char id) { return closeArm (id); }
EXPORTED bool drdIsInitialized (char id) { return has (id, &Arm::is_calibrated); }
EXPORTED bool drdIsSupported (char id)
{
    auto* o = use (id);
    return o != nullptr && o->arm.load()->calibrates_by_hand == 0;
}
EXPORTED int drdAutoInit (char id)
{
    auto* o = use (id);
    if (o == nullptr) return -1;
    ++o->arm.load()->calibrations;
    for (int i = 0; i < 100; ++i)   // the arm moves
    {
        std::this_thread::sleep_for (std::chrono::microseconds (10 * orElse (o->arm.load()->calibration_ms, 50)));
        o->arm.load()->position[0] = 1e-4 * i;
    }
    o->arm.load()->is_calibrated = 1;
    o->arm.load()->is_enabled = 1;
    o->arm.load()->commanded_at = nanoseconds (now());
    return 0;
}
EXPORTED int drdStop (bool with_force, char id)
{
    return with (id, [&] (Opened& o) {
        if (! with_force) switchOff (*o.arm, 4);
        return 0;
    });
}
#endif
