// SPDX-License-Identifier: MIT
#include "../exercise.hpp"

#include <host/drivers/openhaptics/fake_hd.hpp>
#include <host/drivers/openhaptics/touch.hpp>

namespace tactus::test
{

namespace
{
const Exercise touch_exercise ([] (const TemporaryFolder& folder) {
    const auto& driver = host::openhaptics::driver;
    auto& arms = sharedMemory<host::FakeTouches> (folder / "hd", "TACTUS_FAKE_HD");
    ::setenv ("LD_LIBRARY_PATH", (std::string (TACTUS_FAKE_LIBRARIES) + "/hd").c_str(), 1);
    auto& arm = arms.arms[0];
    arms.count = 2;
    for (const int dof : { 3, 6 })
    {
        arm.output_dof = dof;
        play (driver, {}, { .what = "as it should be" });
    }
    for (const int error : { 0x200, 0x201, 0x203, 0x204 })
        play (driver, {}, { .what = "errors", .disturb = [&] { arm.next_error = error; } });
    play (driver, {}, { .what = "a stall", .disturb = [&] { arms.stall_ms = 30; } });
    play (driver, "Second", { .what = "another arm" });
    play (driver, {}, { .what = "unplugged", .disturb = [&] { arm.is_unplugged = 1; }, .ends_with = TACTUS_DEVICE_GONE });
    arm.is_unplugged = arm.is_open = 0;
    play (driver, {}, { .what = "again" });
    expect (arms.frame_errors == 0, "frames out of order");
    expect (arms.calls_after_unschedule == 0, "calls after hdUnschedule");
    expect (arms.gets_outside_frames == 0, "calls outside of frames");
});
}   // namespace

}   // namespace tactus::test
