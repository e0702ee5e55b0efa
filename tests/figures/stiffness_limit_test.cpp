// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include "host/cli/program.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>

using namespace tactus;

namespace
{
constexpr double T = 1e-3, lean = 20.0, nudge = 1e-5;   // s, N, m

struct Tool
{
    double damping;   // N s/m
    int delay;        // ticks

    double limit() const { return 2.0 * damping / ((2.0 * delay + 1.0) * T); }
};

std::vector<std::string> against (const test::Scratch& scratch, const Tool& tool, double stiffness)
{
    std::ostringstream device;
    device.precision (17);
    device << R"({ "driver": "sim", "mass": 0.1, "damping": )" << tool.damping << R"(, "delay": )" << tool.delay << R"(, "position": [0, 0, )"
           << -lean / stiffness - nudge << R"(], "hand_force": [0, 0, )" << -lean << "] }";
    std::ostringstream set;
    set.precision (17);
    set << "wall.stiffness=" << stiffness;
    return { "--device", "tool=" + scratch.write ("tool.json", device.str()), "--set", set.str(), "--duration", "1",
             "--record", "hand.position.z,motor.force.z" };
}

/// Growth rate of the oscillation about the point of rest, in 1/s, from the second quarter of the run to the last one.
double growth (const test::Record& run, double stiffness)
{
    const auto z = run["hand.position.z"];
    const auto swing = [&] (std::size_t from, std::size_t to) {
        double squares = 0.0;
        for (std::size_t k = from; k < to; ++k)
            squares += std::pow (z[k] + lean / stiffness, 2);
        return std::sqrt (squares);
    };
    const auto quarter = z.size() / 4;
    return std::log (swing (3 * quarter, 4 * quarter) / swing (quarter, 2 * quarter)) / (2.0 * static_cast<double> (quarter) * T);
}
}   // namespace

TEST_CASE ("figure: a wall is stable up to 2 B / T, and each tick of delay lowers the limit", "[figures]")
{
    const test::Scratch scratch;
    test::Columns limits;
    for (const int delay : { 0, 1, 2 })
        for (const double damping : { 0.5, 1.0, 2.0, 3.0, 4.0 })
        {
            const Tool tool { damping, delay };
            const double below = 0.9 * tool.limit(), above = 1.1 * tool.limit();
            const double dies = growth (test::renderOnce ("stiffness_limit", against (scratch, tool, below)), below);
            const double grows = growth (test::renderOnce ("stiffness_limit", against (scratch, tool, above)), above);
            INFO ("damping " << damping << ", delay " << delay);
            CHECK (dies < 0.0);
            CHECK (grows > 0.0);

            const double measured = below + (above - below) * dies / (dies - grows);   // where the oscillation neither grows nor decays
            CHECK (measured == Approx (tool.limit()).epsilon (0.03));
            limits.push_back ({ double (delay), damping, measured, tool.limit() });
        }
    test::writeFigure ("stiffness_limit", { "delay", "damping", "measured", "limit" }, limits);

    const Tool tool { 2.0, 0 };
    test::renderFigure ("stiffness_limit", "stiffness_limit_below", against (scratch, tool, 0.85 * tool.limit()));
    test::renderFigure ("stiffness_limit", "stiffness_limit_above", against (scratch, tool, 1.15 * tool.limit()));
}
