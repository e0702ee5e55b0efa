// SPDX-License-Identifier: MIT
#include <tactus/nodes/device/brake.hpp>

#include <catch2/catch.hpp>

#include <cmath>

using namespace tactus::nodes;
using tactus::DeviceState;

TEST_CASE ("device: a brake asks for its damping plus K T / 2, never for less than 0", "[nodes][device][brake]")
{
    DeviceState state;
    state.layout.brake = 5.0;
    DeviceBrake node;
    node.prepare ({ .rate_hz = 1000.0 });
    node.bind (state);

    node.tick ({ .damping = 1.0, .stiffness = 4000.0 });
    CHECK (node.effort().brake == Approx (3.0));
    CHECK (node.effort().force.isZero (0.0));
    node.tick ({ .damping = -1.0, .stiffness = 4000.0 });
    CHECK (node.effort().brake == Approx (2.0));
    node.tick ({ .damping = 1.0, .stiffness = -4000.0 });
    CHECK (node.effort().brake == 1.0);
    node.tick ({ .damping = std::nan ("") });
    CHECK (std::isnan (node.effort().brake));   // the guard stops the role

    state.applied.brake = 0.75;
    CHECK (node.peek().applied == 0.75);
}

TEST_CASE ("device: a brake has no effect on a device without one, and says so", "[nodes][device][brake]")
{
    const DeviceState none;
    DeviceBrake node;
    node.bind (none);
    node.tick ({ .damping = 1.0 });
    CHECK (node.effort().brake == 0.0);
    CHECK (node.missing (none.layout) == "no brake");
    CHECK (node.missing ({ .brake = 5.0 }).empty());
}
