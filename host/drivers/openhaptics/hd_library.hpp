// SPDX-License-Identifier: MIT
#pragma once

#include <host/drivers/makers_library.hpp>

#include <string>

namespace tactus::host::openhaptics
{

/// An error of the library, which is returned by value.
struct HdError
{
    unsigned code;
    int internal;
    unsigned device;
};

using HdCallback = unsigned (*) (void*);   ///< 1: call again on the next tick

// clang-format off
/// The functions of OpenHaptics that the helper calls: result, name, parameters. `unsigned` is a device, a parameter, an error or a capability.
#define TACTUS_HD_FUNCTIONS(X) \
    X (unsigned, hdInitDevice, (const char*)) X (void, hdDisableDevice, (unsigned)) X (void, hdMakeCurrentDevice, (unsigned)) \
    X (void, hdBeginFrame, (unsigned)) X (void, hdEndFrame, (unsigned)) X (HdError, hdGetError, ()) X (const char*, hdGetErrorString, (unsigned)) \
    X (const char*, hdGetString, (unsigned)) X (void, hdEnable, (unsigned)) \
    X (void, hdGetIntegerv, (unsigned, int*)) X (void, hdGetDoublev, (unsigned, double*)) X (void, hdSetDoublev, (unsigned, const double*)) \
    X (unsigned, hdCheckCalibration, ()) X (unsigned, hdCheckCalibrationStyle, ()) X (void, hdUpdateCalibration, (unsigned)) X (void, hdStartScheduler, ()) \
    X (void, hdStopScheduler, ()) X (void, hdSetSchedulerRate, (unsigned long)) X (unsigned long, hdScheduleAsynchronous, (HdCallback, void*, unsigned short)) \
    X (void, hdUnschedule, (unsigned long))
// clang-format on

struct HdFunctions
{
    TACTUS_HD_FUNCTIONS (TACTUS_FUNCTION_OF_LIBRARY)

    /// Opens the library of this computer. Returns the reason if that fails; empty: all functions are there.
    std::string load()
    {
#if defined(_WIN32)
        MakersLibrary library { "HD.dll" };   // with 32 and 64 bits
#else
        MakersLibrary library { "libHD.so", "libHD.so.3.4", "libHD.so.3.0" };
#endif
        TACTUS_HD_FUNCTIONS (TACTUS_NEED_IN_LIBRARY)
        return library.why().empty() ? std::string() : "the library of OpenHaptics " + library.why();
    }
};

/// The numbers that the library gives its parameters, states and errors.
namespace hd
{
constexpr unsigned buttons = 0x2000, position = 0x2050, transform = 0x2052, force = 0x2700, torque = 0x2701;
constexpr unsigned model_type = 0x2501, driver_version = 0x2502, serial_number = 0x2504, firmware_version = 0x2505, version = 0x2500;
constexpr unsigned usable_workspace = 0x2551, input_dof = 0x2553, output_dof = 0x2554, calibration_styles = 0x2555;
constexpr unsigned instantaneous_rate = 0x2601, max_force = 0x2603, max_continuous_force = 0x2604, motor_temperature = 0x2605;
constexpr unsigned force_output = 0x4000, is_calibrated = 0x5000, needs_update = 0x5001, needs_person = 0x5002;
constexpr int by_encoder_reset = 1, by_itself = 2, by_inkwell = 4;
constexpr unsigned no_device = 0xffffffff;
constexpr unsigned short usual_priority = 32767;

constexpr unsigned success = 0, warm_motors = 0x200, exceeded_max_force = 0x201, exceeded_impulse = 0x202, exceeded_max_velocity = 0x203, force_error = 0x204;
constexpr unsigned device_fault = 0x300, communication = 0x302, communication_setup = 0x303, timer = 0x304, bad_priority = 0x500, scheduler_full = 0x501;
}   // namespace hd

}   // namespace tactus::host::openhaptics
