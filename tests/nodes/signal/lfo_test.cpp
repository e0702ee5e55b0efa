// SPDX-License-Identifier: MIT
#include <tactus/nodes/signal/lfo.hpp>

#include <support/property.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>

#include <numbers>

using tactus::nodes::SignalLfo;
using tactus::test::ready;

namespace
{
constexpr double pi = std::numbers::pi;
}   // namespace

TEST_CASE ("lfo: sample k of the sine is at k over the rate", "[nodes][signal]")
{
    auto node = ready<SignalLfo> ({ .frequency = 7.0, .amplitude = 2.0, .offset = 0.5, .phase = 0.3 });
    for (int k = 0; k < 10'000; ++k)
        REQUIRE (node.tick ({}).out == Approx (0.5 + 2.0 * std::sin (2 * pi * 7.0 * k / 1000.0 + 0.3)).margin (1e-11));
}

TEST_CASE ("lfo: a square wave switches on the exact tick for an hour", "[nodes][signal]")
{
    auto node = ready<SignalLfo> ({ .frequency = 3.0, .shape = SignalLfo::Shape::square }, 1000.0);
    bool exact = true;
    for (long k = 0; k < 3'600'000; ++k)
        exact = exact && node.tick ({}).out == (3 * k % 1000 < 500 ? 1.0 : -1.0);
    CHECK (exact);
}

TEST_CASE ("lfo: shapes start at their phase, in step with the sine", "[nodes][signal]")
{
    using Shape = SignalLfo::Shape;
    const auto at = [] (Shape shape, double turn) { return ready<SignalLfo> ({ .phase = 2 * pi * turn, .shape = shape }).tick ({}).out; };

    CHECK (at (Shape::triangle, 0.0) == Approx (0.0).margin (1e-12));
    CHECK (at (Shape::triangle, 0.125) == Approx (0.5));
    CHECK (at (Shape::triangle, 0.25) == Approx (1.0));
    CHECK (at (Shape::triangle, 0.75) == Approx (-1.0));
    CHECK (at (Shape::saw, 0.0) == 0.0);
    CHECK (at (Shape::saw, 0.25) == Approx (0.5));
    CHECK (at (Shape::saw, 0.75) == Approx (-0.5));
    CHECK (at (Shape::square, 0.25) == 1.0);
    CHECK (at (Shape::square, 0.75) == -1.0);
}

TEST_CASE ("lfo: a new frequency continues from the current phase", "[nodes][signal]")
{
    tactus::test::property ("any sequence of frequencies", [] (const std::vector<unsigned char>& frequencies) {
        auto node = ready<SignalLfo> ({ .shape = SignalLfo::Shape::sine });
        double turn = 0.0;
        for (const double f : frequencies)
        {
            // a frequency set before a tick counts from the previous tick
            node.params.frequency = f;
            node.update();
            for (int k = 0; k < 5; ++k)
            {
                RC_ASSERT (std::abs (node.tick ({}).out - std::sin (2 * pi * turn)) < 1e-9);
                turn += f / 1000.0;
            }
        }
    });
}
