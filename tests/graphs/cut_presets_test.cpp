// SPDX-License-Identifier: MIT
// The presets whose cut has a place do what their descriptions say.

#include "figures/figure_data.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;

namespace
{
/// The number of ticks between two times at which a condition holds.
template <typename Condition>
int count (const test::Record& run, double from, double to, const Condition& condition)
{
    int ticks = 0;
    for (std::size_t k = 0; k < run.rows(); ++k)
        if (const double t = run.at ("t", k); t >= from && t < to) ticks += condition (k);
    return ticks;
}
}   // namespace

TEST_CASE ("the preset Potato slices snaps in each new place, and not in an old cut", "[graphs]")
{
    const auto run = test::renderOnce ("../../graphs/potato_edge", { "--duration", "9", "--record", "edge.state,edge.resistance" });
    const auto bursts = [&] (std::size_t k) { return run.at ("edge.state", k) == 2.0; };
    CHECK (count (run, 0.0, 2.5, bursts) > 0);
    CHECK (count (run, 3.1, 5.6, bursts) > 0);
    CHECK (count (run, 6.2, 9.0, bursts) == 0);
    CHECK (count (run, 6.2, 9.0, [&] (std::size_t k) { return run.at ("edge.resistance", k) > 3.9; }) > 100);
}

TEST_CASE ("the preset Liver cut deforms, slips over and cuts one body", "[graphs]")
{
    const auto ports = "edge.state,edge.crack,edge.resistance,flesh.state,flesh.deflection.y";
    const auto run = test::renderOnce ("../../graphs/liver_cut", { "--duration", "9", "--record", ports });
    const auto whole = [&] (std::size_t k) { return run.at ("edge.crack", k) == 0.0 && run.at ("edge.resistance", k) > 0.1; };
    const auto bursts = [&] (std::size_t k) { return run.at ("edge.state", k) == 2.0; };

    const auto follows = [&] (std::size_t k) { return run.at ("flesh.state", k) == 1.0 && run.at ("flesh.deflection.y", k) > 1e-3; };
    CHECK (count (run, 0.0, 2.4, [&] (std::size_t k) { return whole (k) && follows (k); }) > 100);
    CHECK (count (run, 0.0, 2.4, [&] (std::size_t k) { return whole (k) && run.at ("flesh.state", k) == 2.0; }) > 100);
    CHECK (count (run, 0.0, 2.4, bursts) == 0);
    CHECK (count (run, 2.4, 3.4, bursts) == 1);
    CHECK (count (run, 3.4, 6.2, bursts) > 5);    // drawn along its edge, the blade opens column after column
    CHECK (count (run, 6.2, 9.0, bursts) == 0);   // back in the cut, which has moved with the flesh
}
