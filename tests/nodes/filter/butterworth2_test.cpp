// SPDX-License-Identifier: MIT
#include "response.hpp"

#include <tactus/nodes/filter/butterworth2.hpp>

#include <golden/golden.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>

using tactus::nodes::Butterworth2;
using tactus::test::ready;

TEST_CASE ("butterworth: overshoots a step by 4 %", "[nodes][filter]")
{
    auto node = ready<Butterworth2> ({ .cutoff = 10.0 }, 10'000.0);
    double highest = 0.0;
    for (int k = 0; k < 5000; ++k)
        highest = std::max (highest, node.tick ({ .in = 1.0 }).out);
    CHECK (highest == Approx (1.0 + std::exp (-std::numbers::pi)).epsilon (1e-4));
}

TEST_CASE ("butterworth: reproduces the golden texture", "[nodes][filter][golden]")
{
    const tactus::test::Golden golden { "texture" };
    CHECK (golden.rows() == 900);
    auto node = ready<Butterworth2> ({ .cutoff = 120.0 });
    for (std::size_t row = 0; row < golden.rows(); ++row)
    {
        INFO ("row " << row);
        REQUIRE (node.tick ({ .in = golden (row, "windowed") }).out == Approx (golden (row, "filtered")).margin (1e-9).epsilon (0));
    }
}
