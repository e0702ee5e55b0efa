// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/app/run/pointer_path.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;

TEST_CASE ("the mouse moves the hand no faster than a hand moves, even if it enters the surface at the far side", "[app][run]")
{
    constexpr double dt = 1.0 / 4000.0;
    const Vec3 far_side (0.12, -0.05, 0.003);
    PointerPath path { Vec3::Zero() };
    path.moveTo (far_side);
    auto before = path.at (0.0);
    for (int k = 1; k <= 2000; ++k)
    {
        const auto now = path.at (k * dt);
        REQUIRE (now.velocity.norm() <= 1.01 * PointerPath::top_speed);
        REQUIRE ((now.position - before.position).norm() <= 1.01 * PointerPath::top_speed * dt);
        before = now;
    }
    CHECK ((before.position - far_side).norm() < 1e-6);
}
