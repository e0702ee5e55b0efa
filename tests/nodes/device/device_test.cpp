// SPDX-License-Identifier: MIT
#include <tactus/nodes/device/position.hpp>
#include <tactus/nodes/device/pressure.hpp>
#include <tactus/nodes/device/truth.hpp>

#include <catch2/catch.hpp>

using namespace tactus::nodes;
using tactus::DeviceState;
using tactus::Vec3;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
}

TEST_CASE ("device: position is the position the device measures", "[nodes][device]")
{
    DeviceState device;
    DevicePosition node;
    node.bind (device);
    device.reading = { .position = { 1, 2, 3 }, .rotation = { 0.1, 0.2, 0.3 }, .age = 0.004 };
    const auto out = node.tick ({});
    CHECK (out.position == Vec3 (1, 2, 3));
    CHECK (out.rotation == Vec3 (0.1, 0.2, 0.3));
    CHECK (out.valid == 1.0);
    CHECK (out.age == 0.004);
}

TEST_CASE ("device: while the device reports nothing, the tool stays where it was", "[nodes][device]")
{
    DeviceState device;
    DevicePosition position;
    DevicePressure pressure;
    position.bind (device);
    pressure.bind (device);

    device.reading = { .position = { 9, 9, 9 }, .pressure = 9.0, .valid = false };
    CHECK (position.tick ({}).position.isZero (0.0));
    CHECK (pressure.tick ({}).force == 0.0);

    device.reading = { .position = { 1, 2, 3 }, .rotation = { 0, 0, 1 }, .pressure = 2.5 };
    position.tick ({});
    CHECK (pressure.tick ({}).force == 2.5);

    device.reading = { .position = Vec3::Zero(), .age = 0.1, .valid = false };
    const auto out = position.tick ({});
    CHECK (out.position == Vec3 (1, 2, 3));
    CHECK (out.rotation == Vec3 (0, 0, 1));
    CHECK (out.valid == 0.0);
    CHECK (out.age == 0.1);
    CHECK (pressure.tick ({}).force == 2.5);
}

TEST_CASE ("device: a reading that is not finite moves nothing and is not kept", "[nodes][device]")
{
    DeviceState device;
    DevicePosition position;
    DevicePressure pressure;
    DeviceTruth truth;
    position.bind (device);
    pressure.bind (device);
    truth.bind (device);

    device.reading = { .position = { 1, 2, 3 }, .pressure = 2.0, .age = 0.01 };
    position.tick ({});
    pressure.tick ({});

    device.reading = {
        .position = { 1, not_a_number, 3 },
        .pressure = tactus::inf,
        .age = 0.01,
        .true_position = { 0, 0, not_a_number },
        .true_velocity = { 1, 1, 1 },
    };
    const auto out = position.tick ({});
    CHECK (out.position == Vec3 (1, 2, 3));
    CHECK (out.valid == 0.0);
    CHECK (out.age == 0.01);
    CHECK (pressure.tick ({}).force == 0.0);
    CHECK (truth.tick ({}).velocity.isZero (0.0));

    device.reading = { .valid = false };
    CHECK (position.tick ({}).position == Vec3 (1, 2, 3));
    CHECK (pressure.tick ({}).force == 2.0);
}

TEST_CASE ("device: truth is the simulated tool before its encoders", "[nodes][device]")
{
    DeviceState device;
    DeviceTruth node;
    node.bind (device);
    device.reading = { .position = { 1, 1, 1 }, .true_position = { 1.001, 1, 1 }, .true_velocity = { 0, 0.5, 0 } };
    CHECK (node.tick ({}).position == Vec3 (1.001, 1, 1));
    CHECK (node.tick ({}).velocity == Vec3 (0, 0.5, 0));
    device.reading.valid = false;
    CHECK (node.tick ({}).position.isZero (0.0));
}

TEST_CASE ("device: a node without a device reports it", "[nodes][device]")
{
    CHECK (DevicePosition().tick ({}).valid == 0.0);
    CHECK (DevicePressure().tick ({}).force == 0.0);
    CHECK (DeviceTruth().tick ({}).position.isZero (0.0));
}
