// SPDX-License-Identifier: MIT
#include "../exercise.hpp"

#include <host/drivers/forcedimension/arm.hpp>
#include <host/drivers/forcedimension/fake_drd.hpp>

#include <sys/utsname.h>

namespace tactus::test
{

namespace
{
const Exercise force_dimension_exercise ([] (const TemporaryFolder& folder) {
    const auto& driver = host::forcedimension::driver;
    auto& arms = sharedMemory<host::FakeArms> (folder / "drd", "TACTUS_FAKE_DRD");
    utsname machine {};
    ::uname (&machine);
    const auto to = folder / "sdk/lib/release" / ("lin-" + std::string (machine.machine) + "-gcc");
    std::filesystem::create_directories (to);
    std::filesystem::create_symlink (std::filesystem::path (TACTUS_FAKE_LIBRARIES) / "libfake_drd.so", to / "libdrd.so.3.17.5");
    ::setenv ("FDSDK", (folder / "sdk").c_str(), 1);
    auto& arm = arms.arms[0];
    arm.wrist = arm.active_wrist = arm.gripper = arm.active_gripper = arm.ignores_silence = 1;
    for (const int count : { 12, 14, 16, 17 })
    {
        arm.status_count = count;
        play (driver, {}, { .what = "as it should be" });
    }
    for (const int cause : { 1, 2, 3, 4, 6 })
        play (driver, {}, { .what = "forces go off", .disturb = [&] { arm.off_cause = cause; } });
    play (driver, {}, { .what = "a read that takes long", .disturb = [&] { arm.read_stall_ms = 50; } });
    play (driver, {}, { .what = "a write that takes long", .disturb = [&] { arm.write_stall_ms = 50; } });
    play (driver, {}, { .what = "saturated", .disturb = [&] { arm.max_force = 0.1; }, .then = [&] { arm.max_force = 0.0; } });
    play (driver, {}, { .what = "no status", .disturb = [&] { arm.has_no_status = 1; }, .then = [&] { arm.has_no_status = 0; } });
    play (driver, {}, { .what = "unplugged", .disturb = [&] { arm.is_unplugged = 1; }, .ends_with = TACTUS_DEVICE_GONE });
    arm.is_unplugged = 0;
    play (driver, {}, { .what = "silent", .disturb = [&] { arm.is_muted = 1; }, .ends_with = TACTUS_DEVICE_GONE });
    arm.is_muted = 0;
    expect (arm.calls_after_close == 0, "calls after close");
    expect (arm.expert_violations == 0, "a setting of the arm was changed");
    expect (arm.calibrations == 0, "the arm was moved by its motors");
});
}   // namespace

}   // namespace tactus::test
