// SPDX-License-Identifier: MIT
// The fade between two plans. tests/framework/live has its effect on a device.
#include <tactus/run/guard/bumpless.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using namespace tactus;

TEST_CASE ("without a switch, nothing is faded: an effort of -0 stays -0, as in exported code", "[engine]")
{
    Bumpless bumpless;
    bumpless.prepare (1.0 / 4000.0);
    const Effort wanted { .force = { 1.0, -0.0, 0.0 } };
    for (int k = 0; k < 100; ++k)
    {
        const auto& passed = bumpless (wanted);
        CHECK (passed.force == wanted.force);
        CHECK (std::signbit (passed.force.y()));
        CHECK_FALSE (std::signbit (passed.force.z()));
    }
}
