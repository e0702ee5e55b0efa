// SPDX-License-Identifier: MIT
// Limits on motors, decoded from the reports on the wire.

#include "hid.hpp"

#include <host/devices/hid/bits.hpp>

#include <support/property.hpp>
#include <tactus/run/guard.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
constexpr double dt = 1e-3;

double any (double size)
{
    return *rc::gen::map (rc::gen::inRange (-1000, 1001), [=] (int i) { return size * i / 1000.0; });
}
Vec3 anyVector (double size) { return { any (size), any (size), any (size) }; }

std::shared_ptr<const Profile> with (const std::string& id, double max_motor, double max_motor_slew)
{
    Profile profile = *test::profileOf (id);
    profile.limits.max_motor = max_motor;
    profile.limits.max_motor_slew = max_motor_slew;
    return std::make_shared<const Profile> (std::move (profile));
}

/// An input report of this profile with random values in its position fields and valid marks.
Bytes anyReport (const Profile& profile, int range)
{
    const auto& in = profile.inputs[0];
    Bytes bytes (in.length);
    for (const auto& field : in.fields)
    {
        const bool moves = std::ranges::count (profile.position, field.name) > 0;
        const auto value = moves ? *rc::gen::inRange (-range, range + 1) : static_cast<int> (field.expect.value_or (field.name == profile.valid ? 1 : 0));
        putBits (field.bits, static_cast<std::uint32_t> (value), bytes);
    }
    return bytes;
}

/// The values that the report carries for the motors that render the force.
Vec3 motorsIn (const Profile& profile, std::span<const std::uint8_t> wire)
{
    const auto& report = profile.outputs[0];
    const auto body = report.id ? wire : wire.subspan (1);
    Vec3 v = Vec3::Zero();
    for (const auto& field : report.fields)
        for (int i = 0; i < 3; ++i)
            if (! field.name.empty() && field.name == profile.force[static_cast<std::size_t> (i)])
                v[i] = numberOf (field.bits, bitsAt (field.bits, body)) * field.encoding.scale + field.encoding.offset;
    return v;
}
}   // namespace

TEST_CASE ("no motor exceeds its limit or changes faster than its slew on the wire, whatever the efforts and the poses", "[hid][property]")
{
    for (const std::string id : { "tactus_board", "woodenhaptics_usb" })
        test::property (id, [&] {
            const double most = *rc::gen::element (0.2, 1.0, 2.5), slew = *rc::gen::element (20.0, 100.0, 600.0);
            const auto profile = with (id, most, slew);
            HidModel model (profile);
            auto limits = profile->limits.guard;
            limits.ramp = 0.0;
            Guard guard;
            guard.prepare (limits, dt);
            constexpr double rounding = 1e-3;   // one count of the coarser of the two devices

            Vec3 last = Vec3::Zero();
            for (int k = 0; k < 60; ++k)
            {
                // The encoders jump, as no hand could move them.
                model.decode (anyReport (*profile, 20000));
                auto reading = model.reading();
                const Effort wanted { anyVector (50.0), anyVector (1.0) };
                const auto guarded = guard (wanted, reading);
                HidEffort effort { guarded.force, guarded.torque, model.restEfforts() };
                const auto values = model.drive (effort, dt);
                const Vec3 now = motorsIn (*profile, model.encodeValues (0, values));
                RC_ASSERT (now.cwiseAbs().maxCoeff() <= most + rounding);
                RC_ASSERT ((now - last).cwiseAbs().maxCoeff() <= slew * dt + 2.0 * rounding);
                last = now;
            }
        });
}

TEST_CASE ("a motor at its limit scales all mechanical efforts of the device, so the direction of the force is kept", "[hid][property]")
{
    test::property ("any force at any pose of a WoodenHaptics", [] {
        const auto limited = with ("woodenhaptics_usb", 0.3, GuardLimits::none), plain = with ("woodenhaptics_usb", GuardLimits::none, GuardLimits::none);
        HidModel a (limited), b (plain);
        const auto report = anyReport (*plain, 1000);
        a.decode (report);
        b.decode (report);
        const HidEffort effort { anyVector (0.5), Vec3::Zero(), a.restEfforts() };   // so small that the drives' own limit does not act
        const auto of = [&] (HidModel& m) {
            const auto v = m.drive (effort, dt);
            return Vec3 (v[0], v[1], v[2]);
        };
        const Vec3 short_one = of (a), whole = of (b);
        RC_ASSERT (short_one.cwiseAbs().maxCoeff() <= 0.3 * (1.0 + 1e-12));
        RC_ASSERT (short_one.cross (whole).norm() <= 1e-12 * (1e-3 + whole.squaredNorm()));
        RC_ASSERT (short_one.dot (whole) >= 0.0);
        if (whole.cwiseAbs().maxCoeff() <= 0.3) RC_ASSERT (short_one == whole);
    });

    SECTION ("force and torque of a board shrink together, and efforts that are not mechanical stay as they are")
    {
        const auto profile = with ("tactus_board", 1.0, GuardLimits::none);
        HidModel model (profile);
        model.decode (profile->samples[0].input[0]);
        HidEffort effort { { 2.0, 0.0, 0.0 }, { 0.0, 0.04, 0.0 }, model.restEfforts() };
        const auto own = static_cast<std::size_t> (indexOf (model.effortNames(), "effort1"));
        effort.efforts[own] = 0.7;
        const auto v = model.drive (effort, 1.0);
        CHECK (v[static_cast<std::size_t> (indexOf (model.effortNames(), "fx"))] == 1.0);
        CHECK (v[static_cast<std::size_t> (indexOf (model.effortNames(), "ty"))] == 0.02);
        CHECK (v[own] == 0.7);
    }
}

TEST_CASE ("after neutral reports, the motors start from rest", "[hid]")
{
    const auto profile = with ("tactus_board", 2.0, 100.0);
    HidModel model (profile);
    model.decode (profile->samples[0].input[0]);
    const HidEffort effort { { 2.0, 0.0, 0.0 }, Vec3::Zero(), model.restEfforts() };
    const auto fx = static_cast<std::size_t> (indexOf (model.effortNames(), "fx"));
    for (int k = 1; k <= 20; ++k)
        CHECK (model.drive (effort, dt)[fx] == Approx (0.1 * k));
    CHECK (model.drive (effort, dt)[fx] == 2.0);
    model.rest();
    CHECK (model.drive (effort, dt)[fx] == Approx (0.1));
}

TEST_CASE ("a profile's limits of motors need motors, a size, and their unit", "[hid]")
{
    const auto idsOf = [] (const std::string& limits) {
        std::ifstream in (test::profile_folder / "woodenhaptics_usb.json");
        auto json = readJson (std::string (std::istreambuf_iterator<char> (in), {})).root;
        const auto more = readJson (limits).root;
        for (const auto& [key, value] : more.items())
            json["limits"][key] = value;
        std::string ids;
        for (const auto& m : readProfile (json).messages)
            ids += m.id + " ";
        return ids;
    };
    CHECK (idsOf (R"({"max_motor": 3, "max_motor_slew": 300})") == "");
    CHECK (idsOf (R"({"max_motor": 3, "max_motor_slew": 2})") == "device/slow_stop ");
    CHECK (idsOf (R"({"max_motor": "3 N", "max_motor_slew": 300})") == "profile/unit ");
    CHECK (idsOf (R"({"max_motor": -1})") == "profile/out_of_range ");
}
