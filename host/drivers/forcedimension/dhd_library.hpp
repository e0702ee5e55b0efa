// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

namespace tactus::host::forcedimension
{

// clang-format off
/// The functions of Force Dimension's library that the driver calls: result, name, parameters. The first nine are in every version. `char` is the id of
/// an open device. An int is at least 0 after a success, and -1 after a failure; the code of the failure belongs to the calling thread. Lengths are in m,
/// angles in rad, forces in N, torques in N m. The status has as many numbers as the version of the library, the watchdog is in units of 125 us, and
/// drdAutoInit moves the arm.
#define TACTUS_DHD_FUNCTIONS(X) \
    X (void, dhdGetSDKVersion, (int*, int*, int*, int*)) X (int, dhdOpenID, (char)) X (int, dhdClose, (char)) X (int, dhdStop, (char)) \
    X (int, dhdErrorGetLast, ()) X (int, dhdEnableForce, (unsigned char, char)) X (int, dhdGetStatus, (int*, char)) \
    X (int, dhdGetPosition, (double*, double*, double*, char)) X (int, dhdSetForce, (double, double, double, char)) X (const char*, dhdErrorGetStr, (int)) \
    X (int, dhdGetDeviceCount, ()) X (int, dhdOpenType, (int)) X (int, dhdOpenSerial, (int)) X (int, dhdGetSerialNumber, (unsigned short*, char)) \
    X (int, dhdGetSystemType, (char)) X (const char*, dhdGetSystemName, (char)) X (int, dhdGetVersion, (double*, char)) X (bool, dhdIsLeftHanded, (char)) \
    X (bool, dhdHasWrist, (char)) X (bool, dhdHasActiveWrist, (char)) X (bool, dhdHasGripper, (char)) X (bool, dhdHasActiveGripper, (char)) \
    X (int, dhdEnableGripperForce, (unsigned char, char)) X (int, dhdSetBrakes, (int, char)) X (int, dhdSetGravityCompensation, (int, char)) \
    X (int, dhdGetOrientationFrame, (double (*)[3], char)) X (int, dhdGetGripperAngleRad, (double*, char)) X (int, dhdGetGripperGap, (double*, char)) \
    X (int, dhdGetButton, (int, char)) X (unsigned, dhdGetButtonMask, (char)) \
    X (int, dhdSetForceAndTorque, (double, double, double, double, double, double, char)) \
    X (int, dhdSetForceAndGripperForce, (double, double, double, double, char)) \
    X (int, dhdSetForceAndTorqueAndGripperForce, (double, double, double, double, double, double, double, char)) X (double, dhdGetMaxForce, (char)) \
    X (int, dhdEnableExpertMode, ()) X (int, dhdDisableExpertMode, ()) X (int, dhdGetWatchdog, (unsigned char*, char)) X (int, drdOpenID, (char)) \
    X (int, drdClose, (char)) X (bool, drdIsInitialized, (char)) X (bool, drdIsSupported, (char)) X (int, drdAutoInit, (char)) \
    X (int, drdStop, (bool, char))
// clang-format on

/// Each is null if this version of the library lacks it.
struct DhdFunctions
{
#define TACTUS_DECLARE(result, name, parameters) result (*name) parameters = nullptr;
    TACTUS_DHD_FUNCTIONS (TACTUS_DECLARE)
#undef TACTUS_DECLARE

    static constexpr int nothing_new = 1, saturated = 2;   ///< results of readings and of forces: successes, too
};

/// The library of this computer, with the functions of robots if there is one that has them (libdrd before libdhd). It is looked for in the folders that
/// FDSDK, FORCEDIM_SDK and LD_LIBRARY_PATH name, in ~/.local/lib and in those of the system, and its highest version counts. Once loaded, it stays until
/// the program ends, because it may have threads of its own.
struct DhdLibrary : DhdFunctions
{
    /// Null, with the reason, if there is none that can be used. [opening thread]
    static std::shared_ptr<const DhdLibrary> load (std::string& why);

    std::string version() const;
    std::string lastError() const;   ///< of the last call that failed on this thread
};

}   // namespace tactus::host::forcedimension
