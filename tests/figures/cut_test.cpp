// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

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
        if (state == 2.0)
        {
            ++ruptures;
            CHECK (f == Approx (2.0).margin (0.03));   // N, from 6 N
        }
        if (state == 4.0)
        {
            ++cutting;
            CHECK (f == Approx (f_cut));
        }
        if (k > 0) work += 0.5 * (f + run.at ("blade.resistance", k - 1)) * (run.at ("blade.depth", k) - run.at ("blade.depth", k - 1));
    }
    CHECK (ruptures == 1);
    CHECK (cutting > 500);

    // The branches as Fig. 6 numbers them. After the rupture the blade retreats out of the crack (3), returns and cuts (4), and retreats twice
    // (5, 6). State 3 stands for 3, 5 and 6, and 0 for a crack without force.
    std::vector<double> branches;
    for (std::size_t k = 1; k < run.rows(); ++k)
        if (const double state = run.at ("blade.state", k); branches.empty() || state != branches.back()) branches.push_back (state);
    CHECK (branches == std::vector<double> { 1, 2, 3, 0, 3, 4, 3, 0, 3, 4, 3, 0 });

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

TEST_CASE ("figure: three noisy responses scatter about one synthesis", "[figures]")
{
    const std::vector<std::pair<std::string, double>> responses { { "1", 3.78 }, { "2", 4.02 }, { "3", 4.20 } };   // and their cutting force, in N
    std::string ports = "path.out,synthesis.resistance,synthesis.state";
    for (const auto& [number, force] : responses)
        ports += ",response_" + number + ".out";
    const auto run = test::renderFigure ("cut_overlay", "cut_overlay", { "--duration", "6", "--record", ports });

    for (const auto& [number, force] : responses)
    {
        INFO ("response " << number);
        double sum = 0.0, squares = 0.0;
        int cutting = 0;
        for (std::size_t k = 0; k < run.rows(); ++k)
        {
            if (run.at ("path.out", k) < 5e-3) continue;   // deeper, all of them cut
            const double f = run.at ("response_" + number + ".out", k);
            CHECK (run.at ("synthesis.resistance", k) == Approx (f_cut));
            sum += f;
            squares += (f - force) * (f - force);
            ++cutting;
        }
        CHECK (cutting > 2000);
        CHECK (sum / cutting == Approx (force).margin (0.05));
        CHECK (std::sqrt (squares / cutting) == Approx (0.12).epsilon (0.2));   // the noise
        CHECK (std::abs (force / f_cut - 1.0) < 0.06);
    }
}
