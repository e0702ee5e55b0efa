// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

using namespace tactus;

namespace
{
/// Displacements where the contact slips on the way out.
std::vector<double> slips (const test::Record& run)
{
    std::vector<double> all;
    for (std::size_t k = 1; k < run.rows(); ++k)
        if (run.at ("contact.state", k) == 2.0 && run.at ("hand.out.x", k) > run.at ("hand.out.x", k - 1)) all.push_back (run.at ("hand.out.x", k));
    return all;
}
}   // namespace

TEST_CASE ("figure: at ten times the speed, the contact slips at the same places", "[figures]")
{
    const std::string ports = "hand.out.x,contact.force.x,contact.state";
    const auto slow = test::renderFigure ("stick_slip", "stick_slip_slow", { "--duration", "0.5", "--record", ports });
    const auto fast = test::renderFigure ("stick_slip", "stick_slip_fast", { "--duration", "0.05", "--record", ports, "--set", "rub.frequency=5 Hz" });

    constexpr double d_max = 1e-4, static_ratio = 2.5, step = 1e-3 / 1000;   // step: in m per tick of the fast run
    const auto a = slips (slow), b = slips (fast);
    REQUIRE (a.size() >= 4);
    REQUIRE (a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i)
        CHECK (a[i] == Approx (b[i]).margin (step * double (i + 1)));
    for (std::size_t i = 1; i < a.size(); ++i)
        CHECK (a[i] - a[i - 1] == Approx ((static_ratio - 1.0) * d_max).margin (step));
}
