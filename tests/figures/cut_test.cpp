// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_data.hpp"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tactus;

namespace
{
constexpr double f_cut = 4.0;   // N, 200 J/m2 times 20 mm
}

TEST_CASE ("figure: a cut passes through all branches, and the work on the crack equals the energy of its surface", "[figures]")
{
    const auto ports = "blade.depth,blade.resistance,blade.crack,blade.state,blade.dissipated_energy";
    const auto run = test::renderFigure ("cut", "cut", { "--duration", "8", "--record", ports });

    double work = 0.0;
    int ruptures = 0, cutting = 0;
    for (std::size_t k = 0; k < run.rows(); ++k)
    {
        const double f = run.at ("blade.resistance", k), state = run.at ("blade.state", k);
        if (state == 2.0) ++ruptures;
        if (state == 4.0)
        {
            ++cutting;
            CHECK (f == Approx (f_cut));
        }
        if (k > 0) work += 0.5 * (f + run.at ("blade.resistance", k - 1)) * (run.at ("blade.depth", k) - run.at ("blade.depth", k - 1));
    }
    CHECK (ruptures == 1);
    CHECK (cutting > 500);

    const auto last = run.rows() - 1;
    CHECK (run.at ("blade.resistance", last) == 0.0);
    CHECK (work == Approx (f_cut * run.at ("blade.crack", last)).epsilon (1e-3));
    CHECK (work == Approx (run.at ("blade.dissipated_energy", last)).epsilon (1e-3));
}

TEST_CASE ("figure: three samples with the same toughness are cut at the same force, whatever their stiffness and skin", "[figures]")
{
    const std::vector<std::string> samples { "soft", "crisp", "skinned" };
    std::string ports = "path.out";
    for (const auto& s : samples)
        ports += "," + s + ".resistance," + s + ".state";
    const auto run = test::renderFigure ("cut_three", "cut_three", { "--duration", "9", "--record", ports });

    for (const auto& s : samples)
    {
        INFO (s);
        int cutting = 0;
        double dip = f_cut;
        bool burst = false;
        for (std::size_t k = 0; k < run.rows(); ++k)
        {
            const double f = run.at (s + ".resistance", k), state = run.at (s + ".state", k);
            burst = burst || state == 2.0;
            if (burst && cutting == 0) dip = std::min (dip, f);
            if (state != 4.0) continue;
            ++cutting;
            CHECK (f == Approx (f_cut));
        }
        CHECK (cutting > 100);
        CHECK (dip < 0.9 * f_cut);   // the force falls below f_cut and rises again
    }
}
