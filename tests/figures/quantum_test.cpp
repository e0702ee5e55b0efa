// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include "host/cli/program.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>

using namespace tactus;

namespace
{
constexpr double sigma = 2000.0, delta = 1e-5;       // N/m, m: as in the graph
constexpr double holds = 0.5 * sigma * delta;        // N: the Coulomb friction that is needed
constexpr double between = 1000.5 * sigma * delta;   // N: a push between the forces of two steps of the sensor
constexpr std::size_t per_way = 20;                  // ticks from one sample to the next
}   // namespace

TEST_CASE ("figure: a step of the sensor gives back a triangle of energy, and friction takes a rectangle", "[figures]")
{
    const auto run = test::renderFigure ("quantum", "quantum", { "--duration", "0.00205", "--record", "press.out,spring.resistance" });
    const auto p = run["press.out"], f = run["spring.resistance"];
    REQUIRE (p.size() == 2 * per_way + 1);
    CHECK (p[per_way] - p[0] == Approx (delta));

    for (const std::size_t way : { 0u, 1u })
    {
        double held = 0.0;   // J: the work of the held force on the hand
        for (std::size_t k = way * per_way; k < (way + 1) * per_way; ++k)
            held -= f[k] * (p[k + 1] - p[k]);
        const double spring = 0.5 * sigma * (p[way * per_way] * p[way * per_way] - p[(way + 1) * per_way] * p[(way + 1) * per_way]);
        CHECK (held - spring == Approx (0.5 * sigma * delta * delta).epsilon (1e-9));
        CHECK (held - spring == Approx (holds * delta).epsilon (1e-9));   // the rectangle
    }
    CHECK (holds == Approx (10e-3));
}

TEST_CASE ("figure: a tool between two steps of the sensor hunts, unless friction takes the energy of a step", "[figures]")
{
    for (const auto& [coulomb, name] : { std::pair { 9.9e-3, "quantum_hunts" }, std::pair { 10.1e-3, "quantum_rests" } })
    {
        const test::Scratch scratch;
        std::ostringstream device;
        device.precision (17);
        device << R"({ "driver": "sim", "mass": 0.1, "damping": 2, "quantum": 1e-5, "coulomb": )" << coulomb << R"(, "position": [0, 0, )"
               << -between / sigma - delta << R"(], "hand_force": [0, 0, )" << -between << "] }";
        const auto run = test::renderFigure ("stiffness_limit", name,
                                             { "--device", "tool=" + scratch.write ("tool.json", device.str()), "--set", "wall.stiffness=2000",
                                               "--duration", "4", "--record", "hand.position.z" });
        const auto z = run["hand.position.z"];
        const auto [low, high] = std::minmax_element (z.begin() + 3000, z.end());
        INFO (name);
        if (coulomb < holds)
            CHECK (*high - *low == Approx (delta));
        else
            CHECK (*high == *low);
    }
}
