// SPDX-License-Identifier: MIT
#include "fake_hd.hpp"

#include <host/drivers/fake_library.hpp>

namespace tactus::host
{

namespace
{
/// The library of OpenHaptics: x to the right, y up, z towards the person, in mm.
struct FakeOpenHaptics
{
    using Memory = FakeTouches;
    static constexpr const char *name = "openhaptics", *what = "Touch";
    static constexpr int stepped = 2;
    static constexpr double per_m = 1e3;
    static Vec3 fromTactus (const Vec3& v) { return { v.x(), v.z(), -v.y() }; }
    static Vec3 toTactus (const Vec3& v) { return { v.x(), -v.z(), v.y() }; }
    static Vec3 force (const FakeTouches::Arm& arm)
    {
        if (arm.is_open == 0) return Vec3::Zero();
        return { arm.force[0], arm.force[1], arm.force[2] };
    }
    static std::uint64_t pushes (const FakeTouches::Arm& arm) { return arm.frames; }
    static std::string environment (const std::string& library, const std::string& memory)
    {
        return "LD_LIBRARY_PATH='" + library + "' TACTUS_FAKE_HD='" + memory + "'";
    }
    static void fail (FakeTouches& all, std::string_view fault)
    {
        auto& arm = all.arms[0];
        all.stall_ms = fault == "stall" ? -1 : 0;
        arm.is_unplugged = fault == "away" ? 1 : 0;
        arm.calibration = fault == "reset" ? 2 : 0;
        arm.lasting_error = fault == "lie" ? 0x200 : 0;
    }
};
}   // namespace

extern const OfferedFakeKind openhaptics_fake { "openhaptics", "a Touch behind the library of its maker",
                                                "stall (a call does not return), away, reset (the arm does not know its position), "
                                                "lie (its motors are warm)",
                                                true,
                                                FakeLibrary<FakeOpenHaptics>::make };

}   // namespace tactus::host
