// SPDX-License-Identifier: MIT
#include <tactus/nodes/contact/window.hpp>

#include <catch2/catch.hpp>

using tactus::nodes::ContactWindow;

TEST_CASE ("window: the gain grows from the surface to the depth of the window, and no further", "[nodes][contact]")
{
    ContactWindow node;
    node.params.window = 2e-3;
    CHECK (node.tick ({ .depth = -1.0 }).gain == 0.0);
    CHECK (node.tick ({ .depth = 0.0 }).gain == 0.0);
    CHECK (node.tick ({ .depth = 0.5e-3 }).gain == Approx (0.25));
    CHECK (node.tick ({ .depth = 2e-3 }).gain == 1.0);
    CHECK (node.tick ({ .depth = 1e308 }).gain == 1.0);
    CHECK (node.tick ({ .depth = -1e308 }).gain == 0.0);
}

TEST_CASE ("window: a fault closes it", "[nodes][contact]")
{
    ContactWindow node;
    CHECK (node.tick ({ .depth = std::numeric_limits<double>::quiet_NaN() }).gain == 0.0);
    CHECK (node.tick ({ .depth = tactus::inf }).gain == 0.0);
    CHECK (node.tick ({ .depth = 1.0 }).gain == 1.0);
}
