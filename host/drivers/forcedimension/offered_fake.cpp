// SPDX-License-Identifier: MIT
#include "fake_drd.hpp"

#include <host/drivers/fake_library.hpp>

namespace tactus::host
{

namespace
{
/// The library of Force Dimension: x towards the person, y to the right, in m.
struct FakeForceDimension
{
    using Memory = FakeArms;
    static constexpr const char *name = "forcedimension", *what = "omega.3";
    static constexpr int stepped = 1;
    static constexpr double per_m = 1.0;
    static Vec3 fromTactus (const Vec3& v) { return { -v.y(), v.x(), v.z() }; }
    static Vec3 toTactus (const Vec3& v) { return { v.y(), -v.x(), v.z() }; }
    static Vec3 force (const FakeArms::Arm& arm)
    {
        const auto ns = std::chrono::nanoseconds (std::chrono::steady_clock::now().time_since_epoch()).count();
        return { FakeArms::forceAt (arm, ns, 0), FakeArms::forceAt (arm, ns, 1), FakeArms::forceAt (arm, ns, 2) };
    }
    static std::uint64_t pushes (const FakeArms::Arm& arm) { return arm.forces; }
    static std::string environment (const std::string& library, const std::string& memory)
    {
        return "FDSDK='" + library + "' TACTUS_FAKE_DRD='" + memory + "'";
    }
    static void fail (FakeArms& all, std::string_view fault)
    {
        auto& arm = all.arms[0];
        arm.read_stall_ms = fault == "stall" ? -1 : 0;
        arm.is_unplugged = fault == "away" ? 1 : 0;
        if (fault == "lie") arm.off_cause = 2;
        if (arm.is_open != 0) arm.is_calibrated = fault == "reset" ? 0 : 1;
    }
};
}   // namespace

extern const OfferedFakeKind forcedimension_fake { "forcedimension", "an omega.3 behind the library of its maker",
                                                   "stall (a call does not return), away, reset (the arm does not know its position), lie (its forces go off)",
                                                   true, FakeLibrary<FakeForceDimension>::make };

}   // namespace tactus::host
