// SPDX-License-Identifier: MIT
// The device's side of a profile is the inverse of the host's.

#include "hid.hpp"

#include <support/property.hpp>

#include <host/devices/hid/device_side.hpp>

using namespace tactus;
using namespace tactus::host::hid;

namespace
{
double within (double least, double most) { return least + (most - least) * *rc::gen::inRange (0, 100'001) / 100'000.0; }
Vec3 anyVector (double size) { return { within (-size, size), within (-size, size), within (-size, size) }; }

bool pushes (const Profile& p)
{
    return ! p.outputs.empty() && ! p.force[0].empty();
}
}   // namespace

TEST_CASE ("what a device says is what the host reads, and what the host asks for is what the device hears", "[hid][wires][property]")
{
    for (const auto* id : { "tactus_board", "woodenhaptics_usb", "haply_2diy" })
    {
        const auto profile = test::profileOf (id);
        REQUIRE (pushes (*profile));
        test::property (std::string ("any reading and any force of ") + id, [&] {
            DeviceSide device (profile);
            HidModel host (profile);
            const bool is_board = profile->id == "tactus_board";
            // One count of an encoder of the arm moves its tool by less than 0.1 mm.
            const double position_step = is_board ? 1e-9 : 1e-4;
            for (int i = 1; i <= 5; ++i)
            {
                Reading reading;
                reading.position = anyVector (0.03);
                if (profile->id == "haply_2diy") reading.position.z() = 0.0;   // it moves in a plane
                reading.rotation = is_board ? anyVector (1.0) : Vec3::Zero();
                const auto report = device.input (0, reading, 1e-3 * i);
                RC_ASSERT (host.decode (report).refusal == Refusal::none);
                RC_ASSERT ((host.sample().position - reading.position).norm() < position_step);
                RC_ASSERT ((host.sample().rotation - reading.rotation).norm() < 2e-6);
                RC_ASSERT (host.reading (1.0).valid);   // no alarm
                RC_ASSERT (host.sample().lost == 0);

                HidEffort asked { anyVector (1.0), is_board ? anyVector (0.02) : Vec3::Zero(), host.restEfforts() };
                if (profile->id == "haply_2diy") asked.force.z() = 0.0;
                const auto wire = host.encode (0, asked);
                const auto heard = device.output (wire.subspan (profile->outputs[0].id ? 0 : 1));
                RC_ASSERT (heard.has_value());
                RC_ASSERT (heard->enabled);
                RC_ASSERT ((heard->effort.force - asked.force).norm() < 0.02);
                RC_ASSERT ((heard->effort.torque - asked.torque).norm() < 2e-6);
            }
        });
    }
}

TEST_CASE ("a device hears nothing in a damaged report, and no force in a neutral one", "[hid][wires]")
{
    const auto profile = test::profileOf ("tactus_board");
    HidModel host (profile);
    DeviceSide device (profile);
    host.decode (device.input (0, {}, 0.0));
    HidEffort asked { Vec3 (1, 0, 0), Vec3::Zero(), host.restEfforts() };
    const auto wire = host.encode (0, asked);
    Bytes report (wire.begin() + 1, wire.end());
    REQUIRE (device.output (report));
    CHECK (device.output (report)->effort.force.x() == Approx (1.0));
    for (const std::size_t at : { 2u, 9u, 60u, 63u })
    {
        auto damaged = report;
        damaged[at] ^= 0x40;
        CHECK_FALSE (device.output (damaged));
    }
    CHECK_FALSE (device.output (std::span (report).first (63)));
    const auto neutral = host.neutral (0);
    const auto rest = device.output (neutral.subspan (1));
    REQUIRE (rest);
    CHECK_FALSE (rest->enabled);
    CHECK (rest->effort.force.isZero (0.0));
}

TEST_CASE ("an encoder that is held does not change, while the others do", "[hid][wires]")
{
    const auto profile = test::profileOf ("tactus_board");
    HidModel host (profile);
    DeviceSide device (profile);
    Reading reading;
    reading.position = { 0.01, 0.02, 0.03 };
    host.decode (device.input (0, reading, 0.0));
    device.hold (true);
    reading.position = { 0.02, 0.03, 0.04 };
    host.decode (device.input (0, reading, 1e-3));
    CHECK ((host.sample().position - Vec3 (0.01, 0.03, 0.04)).norm() < 1e-8);
    device.hold (false);
    host.decode (device.input (0, reading, 2e-3));
    CHECK ((host.sample().position - reading.position).norm() < 1e-8);
}
