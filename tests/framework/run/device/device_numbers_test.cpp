// SPDX-License-Identifier: MIT
#include <tactus/run/device/device_numbers.hpp>

#include <catch2/catch.hpp>

using namespace tactus;

TEST_CASE ("numbers of a device: all numbers of a simulated device are known", "[host][devices]")
{
    CHECK (isEmpty (DeviceNumbers {}));

    Simulation sim;
    sim.mass = 0.08;
    sim.coulomb = 0.03;
    sim.delay = 2;
    const auto rigid = numbersOf (sim);
    CHECK (rigid.mass->value == 0.08);
    CHECK (rigid.coulomb->value == 0.03);
    CHECK (rigid.delay->value == 2.0);
    CHECK (std::isinf (rigid.first_mode->value));
    CHECK_FALSE (rigid.end_mass);
    CHECK_FALSE (rigid.peak_force);
    CHECK_FALSE (rigid.rate);
    CHECK_FALSE (isEmpty (rigid));

    sim.first_mode = 30.0;
    const auto soft = numbersOf (sim, { .max_force = 3.0 });
    CHECK (soft.first_mode->value == 30.0);
    CHECK (soft.first_mode_damping->value == 0.05);
    CHECK (soft.end_mass->value == 0.04);
    CHECK (soft.peak_force->value == 3.0);
    sim.end_mass = 0.01;
    CHECK (numbersOf (sim).end_mass->value == 0.01);
}

TEST_CASE ("numbers of a device: the table names each number once", "[host][devices]")
{
    DeviceNumbers numbers;
    for (const auto& row : deviceNumberRows())
    {
        INFO (row.id);
        CHECK_FALSE (numbers.*row.member);
        numbers.*row.member = DeviceNumber { .value = 1.0 };
    }
}
