// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include "host/cli/program.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

using namespace tactus;

namespace
{
constexpr double T = 1e-3, B = 2.0, stiffest = 2.0 * B / T;   // s, N s/m, N/m: as in the graph

/// A tool of 100 g on the wall of docs/figures/limit_cycle.json, pushed by a constant force.
struct Bouncing
{
    double factor = 1.3;     // stiffness of the wall over 2 B / T
    double lean = 0.5;       // N
    bool from_rest = true;   // nudged by 10 um where it would rest, or let go 2 mm above the wall
    std::string name {};     // of the file, if it is drawn

    double stiffness() const { return factor * stiffest; }

    test::Record run (double seconds) const
    {
        const test::Scratch scratch;
        std::ostringstream device, set, duration;
        for (auto* out : { &device, &set, &duration })
            out->precision (17);
        device << R"({ "driver": "sim", "mass": 0.1, "damping": 2, "position": [0, 0, )" << (from_rest ? -lean / stiffness() - 1e-5 : 2e-3)
               << R"(], "hand_force": [0, 0, )" << -lean << "] }";
        set << "wall.stiffness=" << stiffness();
        duration << seconds;
        const std::vector<std::string> options { "--device", "tool=" + scratch.write ("tool.json", device.str()), "--set", set.str(),
                                                 "--duration", duration.str(), "--record", "hand.position.z,wall.resistance" };
        return name.empty() ? test::renderOnce ("limit_cycle", options) : test::renderFigure ("limit_cycle", name, options);
    }
};

/// The way from the lowest to the highest position from one tick to another, in m.
double swing (const std::vector<double>& z, std::size_t from, std::size_t to)
{
    const auto [low, high] = std::minmax_element (z.begin() + static_cast<std::ptrdiff_t> (from), z.begin() + static_cast<std::ptrdiff_t> (to));
    return *high - *low;
}
}   // namespace

TEST_CASE ("figure: on a wall that is too stiff, a tool ends in the same bounce from a nudge and from a fall", "[figures]")
{
    const auto nudged = Bouncing { .name = "limit_cycle_nudged" }.run (8.0), dropped = Bouncing { .from_rest = false, .name = "limit_cycle_dropped" }.run (8.0);
    const auto from_nudge = nudged["hand.position.z"], from_fall = dropped["hand.position.z"];
    CHECK (swing (from_nudge, 0, 50) < 3e-5);
    CHECK (swing (from_fall, 0, 50) > 2e-3);
    const double bounce = swing (from_nudge, 7000, 8000);
    CHECK (bounce == Approx (0.398e-3).epsilon (2e-3));   // as docs/chapter.md says
    CHECK (swing (from_nudge, 4000, 5000) == Approx (bounce).epsilon (2e-3));
    CHECK (swing (from_fall, 7000, 8000) == Approx (bounce).epsilon (2e-3));

    // In the bounce, the device takes what the held force gives.
    const auto f = nudged["wall.resistance"];
    double given = 0.0, taken = 0.0, in_air = 0.0;   // J, J, ticks
    for (std::size_t k = 4000; k < 8000; ++k)
    {
        const double dz = from_nudge[k + 1 < from_nudge.size() ? k + 1 : k] - from_nudge[k];
        given += f[k] * dz;
        taken += B * dz * dz / T;
        if (f[k] == 0.0) in_air += 1.0;
    }
    CHECK (given > 1e-4);
    CHECK (given == Approx (taken).epsilon (0.03));
    CHECK (in_air / 4000.0 == Approx (0.43).epsilon (0.01));   // of the time
}

TEST_CASE ("figure: the bounce grows with the stiffness beyond 2 B / T, and in proportion to the force of the hand", "[figures]")
{
    test::Columns rows;
    double last = 0.0;
    for (const double factor : { 0.9, 1.05, 1.1, 1.15, 1.2, 1.3, 1.4, 1.5 })
    {
        const double bounce = swing (Bouncing { .factor = factor, .from_rest = false }.run (20.0)["hand.position.z"], 18'000, 20'000);
        INFO ("at " << factor << " times 2 B / T");
        if (factor < 1.0)
            CHECK (bounce < 1e-9);
        else
            CHECK (bounce > last);
        last = bounce;
        rows.push_back ({ factor, bounce });
    }
    CHECK (rows[1][1] == Approx (0.29e-3).margin (5e-6));   // as docs/chapter.md says: it starts with a jump
    CHECK (last == Approx (0.470e-3).epsilon (5e-3));
    test::writeFigure ("limit_cycle", { "factor", "bounce" }, rows);

    const double heavy = swing (Bouncing { .lean = 5.0 }.run (12.0)["hand.position.z"], 10'000, 12'000);
    CHECK (heavy == Approx (10.0 * rows[5][1]).epsilon (2e-3));
}
