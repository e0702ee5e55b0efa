// SPDX-License-Identifier: MIT
// Numbers in section 1 of docs/chapter.md that no picture shows.

#include "figure_data.hpp"

#include "host/cli/program.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <sstream>

using namespace tactus;

namespace
{
std::string text (double value)
{
    std::ostringstream out;
    out.precision (17);
    out << value;
    return out.str();
}

/// A simulated tool of 100 g that leans on the wall of docs/figures/stiffness_limit.json, and starts 10 um beyond its point of rest.
struct Leaning
{
    double stiffness = 2000.0, virtual_damping = 0.0;   // of the wall, in N/m and N s/m
    double damping = 2.0, lean = 20.0;                  // of the device, in N s/m; N
    double quantum = 0.0, coulomb = 0.0;                // of the device, in m and N
    double rate_hz = 1000.0;

    /// The range of the measured position from one time to another, both in s.
    double swing (double from, double to) const
    {
        const test::Scratch scratch;
        const auto device = R"({ "driver": "sim", "mass": 0.1, "damping": )" + text (damping) + R"(, "quantum": )" + text (quantum) + R"(, "coulomb": )"
                            + text (coulomb) + R"(, "position": [0, 0, )" + text (-lean / stiffness - 1e-5) + R"(], "hand_force": [0, 0, )"
                            + text (-lean) + "] }";
        const auto run = test::renderOnce ("stiffness_limit", { "--device", "tool=" + scratch.write ("tool.json", device), "--rate", text (rate_hz),
                                                                "--set", "wall.stiffness=" + text (stiffness),
                                                                "--set", "wall.damping=" + text (virtual_damping),
                                                                "--duration", text (to), "--record", "hand.position.z" });
        const auto z = run["hand.position.z"];
        const auto [low, high] = std::minmax_element (z.begin() + static_cast<std::ptrdiff_t> (from * rate_hz), z.end());
        return *high - *low;
    }

    bool calms() const { return swing (0.9, 1.0) < 0.5 * swing (0.0, 0.1); }
    bool swings() const { return swing (0.9, 1.0) > 2.0 * swing (0.0, 0.1); }
};
}   // namespace

TEST_CASE ("chapter: a virtual damper is stable up to 2 M / T + 4 B / 3, which is 202.7 N s/m for 100 g, 2 N s/m and 1 ms", "[figures]")
{
    CHECK (Leaning { .stiffness = 100.0, .virtual_damping = 202.0 }.swing (7.5, 8.0) < 1e-7);
    CHECK (Leaning { .stiffness = 100.0, .virtual_damping = 203.0 }.swing (7.5, 8.0) > 5e-6);
}

TEST_CASE ("chapter: between two steps of 10 um of the sensor, a wall of 2 N/mm rests if the Coulomb friction is at least 10 mN", "[figures]")
{
    const double midway = 1000.5 * 2000.0 * 1e-5;   // N: half of the forces of two adjacent steps
    CHECK (Leaning { .lean = midway, .quantum = 1e-5, .coulomb = 10.1e-3 }.swing (3.0, 4.0) == 0.0);
    CHECK (Leaning { .lean = midway, .quantum = 1e-5, .coulomb = 9.9e-3 }.swing (3.0, 4.0) >= 0.99e-5);
}

TEST_CASE ("chapter: at 10 kHz, a stiffness of 1 N per 10 um needs a damping of 5 N s/m", "[figures]")
{
    CHECK (Leaning { .stiffness = 1e5, .damping = 5.3, .rate_hz = 10e3 }.calms());
    CHECK (Leaning { .stiffness = 1e5, .damping = 4.7, .rate_hz = 10e3 }.swings());
}
