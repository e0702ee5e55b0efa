// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tactus;

namespace
{
constexpr double d_max = 1e-4, break_away = 0.7;   // as in the graph
const std::vector<std::string> functions { "stick", "dupont", "ramp", "dahl" };

/// The adhesion functions as the literature defines them, times d_max, with r = |d| / d_max.
double zeta (const std::string& function, double r)
{
    if (function == "dahl") return 1.0;
    if (function == "ramp") return r;
    if (function == "stick" || r <= break_away) return 0.0;
    return 0.5 * (1.0 + std::sin (std::numbers::pi * (r - 0.5 * (1.0 + break_away)) / (1.0 - break_away)));
}
}   // namespace

TEST_CASE ("figure: a contact yields as its adhesion function predicts", "[figures]")
{
    std::string ports = "hand.out.x";
    for (const auto& f : functions)
        ports += "," + f + ".deflection.x," + f + ".force.x";
    const auto run = test::renderFigure ("adhesion", "adhesion", { "--duration", "1.2", "--record", ports });
    const auto p = run["hand.out.x"];

    test::Columns rows;
    for (std::size_t at = 0; at < functions.size(); ++at)
    {
        const auto d = run[functions[at] + ".deflection.x"];
        for (std::size_t k = 1; k + 1 < 4000; ++k)   // the first outward stroke
        {
            const double r = 0.5 * (d[k] + d[k + 1]) / d_max;
            if (r < 0.02 || r > 0.97) continue;   // skip the corner, and the range where two nearly equal numbers are subtracted
            const double yields = (1.0 - (d[k + 1] - d[k]) / (p[k + 1] - p[k])) / r;
            CHECK (yields == Approx (zeta (functions[at], r)).margin (0.02));
            rows.push_back ({ double (at + 1), r, yields });
        }
    }
    test::writeFigure ("adhesion_zeta", { "function", "r", "zeta" }, rows);
}

TEST_CASE ("figure: under a tremor below break-away, stick stays in place and Dahl walks as far as theory predicts", "[figures]")
{
    constexpr double cycles = 16.0;
    std::string ports;
    for (const auto& f : functions)
        ports += (ports.empty() ? "" : ",") + f + "_hand.position.x";
    const auto run = test::renderFigure ("adhesion_tremor", "adhesion_tremor", { "--duration", "4", "--record", ports });
    const auto walked = [&] (const std::string& function)   // from the trough of the first cycle to the trough of the last one
    {
        const auto x = run[function + "_hand.position.x"];
        const auto cycle = static_cast<std::size_t> (double (x.size()) / cycles);
        return x[x.size() - 1] - x[cycle - 1];
    };

    // From trough to crest, the pull rises from 0.1 to 0.5 of what the contact can hold. In each cycle, Dahl therefore walks
    // d_max ln ((1 - 0.1^2) / (1 - 0.5^2)).
    CHECK (walked ("dahl") == Approx ((cycles - 1.0) * d_max * std::log (0.99 / 0.75)).epsilon (0.02));
    CHECK (walked ("ramp") < 0.7 * walked ("dahl"));
    CHECK (walked ("ramp") > d_max);
    CHECK (std::abs (walked ("stick")) < 0.01 * d_max);
    CHECK (std::abs (walked ("dupont")) < 0.01 * d_max);
}
