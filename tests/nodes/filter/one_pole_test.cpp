// SPDX-License-Identifier: MIT
#include "response.hpp"

#include <tactus/nodes/filter/one_pole.hpp>

#include <support/ready.hpp>

#include <catch2/catch.hpp>

using tactus::nodes::OnePole;
using tactus::test::ready;

TEST_CASE ("one-pole: approaches a step without overshoot", "[nodes][filter]")
{
    auto node = ready<OnePole> ({ .cutoff = 20.0 });
    double before = 0.0;
    for (int k = 0; k < 200; ++k)
    {
        const double out = node.tick ({ .in = 1.0 }).out;
        CHECK (out >= before);
        CHECK (out <= 1.0 + 1e-12);
        before = out;
    }
}
