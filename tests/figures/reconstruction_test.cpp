// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <sstream>

using namespace tactus;

namespace
{
constexpr double rate = 4000.0, first_mode = 30.0, cutoff = 30.0;   // Hz: as in the graph

const std::string ports = "command.out.x,smooth_motor.force.x,plain_tip.velocity.x,smooth_tip.velocity.x";

/// The force that would move a rigid tool of this mass as the tip moves, in N, at each tick but the last one.
std::vector<double> reaching (const test::Record& run, const std::string& tip, double mass)
{
    const auto v = run[tip + ".velocity.x"];
    std::vector<double> all;
    for (std::size_t k = 0; k + 1 < v.size(); ++k)
        all.push_back (mass * rate * (v[k + 1] - v[k]));
    return all;
}

double rms (const std::vector<double>& all, std::size_t from = 0)
{
    double squares = 0.0;
    for (std::size_t k = from; k < all.size(); ++k)
        squares += all[k] * all[k];
    return std::sqrt (squares / static_cast<double> (all.size() - from));
}

/// What reaches the tip for each newton of a tone: half of the mass at the motor, half at the tip, a spring and a damper between them.
double theory (double frequency, double mass, double damping, double ratio)
{
    using namespace std::complex_literals;
    const double w = 2.0 * std::numbers::pi * frequency, w0 = 2.0 * std::numbers::pi * first_mode, half = 0.5 * mass;
    const auto joint = half * w0 * w0 + 2.0i * ratio * half * w0 * w, tip = -half * w * w + joint;
    const auto motor = -half * w * w + 1.0i * damping * w + joint;
    return std::abs (-mass * w * w * joint / (motor * tip - joint * joint));
}
}   // namespace

TEST_CASE ("figure: a structure with a first mode of 30 Hz gives what theory says, and the filter takes what it cannot follow", "[figures]")
{
    constexpr double mass = 0.075, damping = 0.1;   // kg, N s/m: as in the graph
    test::Columns rows;
    for (const double f : { 5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 42.5, 45.0, 50.0, 60.0, 80.0, 100.0, 150.0, 200.0 })
    {
        std::ostringstream tone;
        tone << "tone.frequency=" << f;
        const auto run = test::renderOnce ("reconstruction", { "--set", "drum.gain=0", "--set", "tone.amplitude=1", "--set", tone.str(), "--duration", "3",
                                                               "--record", ports });
        const std::size_t settled = 8000;   // ticks; the last second holds whole periods of each tone
        const double sent = rms (run["command.out.x"], settled);
        const double plain = rms (reaching (run, "plain_tip", mass), settled) / sent, smooth = rms (reaching (run, "smooth_tip", mass), settled) / sent;
        INFO (f << " Hz");
        CHECK (plain == Approx (theory (f, mass, damping, 0.05)).epsilon (0.02));
        CHECK (smooth / plain == Approx (1.0 / std::sqrt (1.0 + std::pow (f / cutoff, 4))).epsilon (0.02));
        rows.push_back ({ f, plain, smooth });
    }
    test::writeFigure ("reconstruction", { "frequency", "plain", "smooth" }, rows);

    const auto peak = std::ranges::max_element (rows, {}, [] (const auto& row) { return row[1]; });
    CHECK ((*peak)[0] == 42.5);   // as docs/chapter.md says
    CHECK ((*peak)[1] == Approx (6.9).epsilon (0.02));
    CHECK ((*peak)[2] == Approx (3.1).epsilon (0.02));
}

TEST_CASE ("figure: a drum swings a PHANTOM more than it drives it, and reaches the tip of a Pantograph as it is", "[figures]")
{
    const struct
    {
        std::string profile, cutoff;
        double mass;                  // kg
        double wrong, smooth_wrong;   // N rms: what reaches the tip, less what was sent, as it is and filtered
        double peak, smooth_peak;     // N
    } devices[] {
        { "phantom_1_0", "30 Hz", 0.075, 0.367, 0.235, 1.91, 1.03 },
        { "pantograph_mk2", "400 Hz", 0.05, 0.035, 0.06, 2.16, 2.09 },
    };
    for (const auto& d : devices)
    {
        const auto run = test::renderFigure ("reconstruction", "reconstruction_" + d.profile,
                                             { "--device", "plain=" + d.profile, "--device", "smooth=" + d.profile, "--set", "filter.cutoff=" + d.cutoff,
                                               "--duration", "0.6", "--record", ports });
        auto plain = reaching (run, "plain_tip", d.mass), smooth = reaching (run, "smooth_tip", d.mass);
        const auto size = [] (double a, double b) { return std::abs (a) < std::abs (b); };
        INFO (d.profile);
        CHECK (std::abs (*std::ranges::max_element (plain, size)) == Approx (d.peak).epsilon (0.01));
        CHECK (std::abs (*std::ranges::max_element (smooth, size)) == Approx (d.smooth_peak).epsilon (0.01));
        const auto sent = run["command.out.x"];
        CHECK (rms (sent) == Approx (0.27).epsilon (0.02));
        for (std::size_t k = 0; k < plain.size(); ++k)
        {
            plain[k] -= sent[k];
            smooth[k] -= sent[k];
        }
        CHECK (rms (plain) == Approx (d.wrong).margin (5e-3));
        CHECK (rms (smooth) == Approx (d.smooth_wrong).margin (5e-3));
    }
}
