// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include "host/cli/program.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

using namespace tactus;

namespace
{
constexpr double B = 2.0, lean = 20.0;   // N s/m, N: as in the graph
constexpr int ticks = 40;

/// How much the oscillation at half the rate grows from the second quarter of the run to the last one, as a logarithm. The third
/// difference leaves out the slow approach to the point of rest.
double growth (double rate_hz, double stiffness, double virtual_damping)
{
    const test::Scratch scratch;
    std::ostringstream device, k, b, rate, duration;
    for (auto* out : { &device, &k, &b, &rate, &duration })
        out->precision (17);
    device << R"({ "driver": "sim", "mass": 1e-7, "damping": 2, "position": [0, 0, )" << -lean / stiffness - 1e-7 << R"(], "hand_force": [0, 0, )"
           << -lean << "] }";
    k << "wall.stiffness=" << stiffness;
    b << "wall.damping=" << virtual_damping;
    rate << rate_hz;
    duration << ticks / rate_hz;
    const auto run = test::renderOnce ("rate_limits", { "--device", "tool=" + scratch.write ("tool.json", device.str()), "--rate", rate.str(), "--set", k.str(),
                                                        "--set", b.str(), "--duration", duration.str(), "--record", "hand.position.z" });
    const auto z = run["hand.position.z"];
    const auto swing = [&] (std::size_t from, std::size_t to) {
        double squares = 0.0;
        for (std::size_t i = from + 3; i < to; ++i)
            squares += std::pow (z[i] - 3.0 * z[i - 1] + 3.0 * z[i - 2] - z[i - 3], 2);
        return std::sqrt (squares);
    };
    const auto quarter = z.size() / 4;
    return std::log (swing (3 * quarter, 4 * quarter) / swing (quarter, 2 * quarter));
}

/// Where `grows` is 0, between 0.95 and 1.05 times the law.
template <typename Growth>
double measured (double law, Growth&& grows)
{
    const double dies = grows (0.95 * law), swells = grows (1.05 * law);
    CHECK (dies < 0.0);
    CHECK (swells > 0.0);
    return law * (0.95 + 0.1 * dies / (dies - swells));
}
}   // namespace

TEST_CASE ("figure: twice the rate holds a wall twice as stiff, but no more damping than the device has", "[figures]")
{
    constexpr double soft = 1000.0;   // N/m, under the damper
    test::Columns rows;
    for (const double rate : { 1e3, 2e3, 4e3, 8e3, 16e3 })
    {
        INFO ("at " << rate << " Hz");
        const double stiffness = measured (2.0 * B * rate, [&] (double k) { return growth (rate, k, 0.0); });
        const double damping = measured (B - 0.5 * soft / rate, [&] (double b) { return growth (rate, soft, b); });
        CHECK (stiffness == Approx (2.0 * B * rate).epsilon (0.02));
        CHECK (damping == Approx (B - 0.5 * soft / rate).epsilon (0.01));
        CHECK (damping < B);
        rows.push_back ({ rate, stiffness, damping });
    }
    test::writeFigure ("rate_limits", { "rate", "stiffness", "damping" }, rows);
}
