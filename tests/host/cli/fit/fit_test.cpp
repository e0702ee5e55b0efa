// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/cli/program.hpp"

#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <sstream>
#include <string>

using namespace tactus;
using test::checkRefused;
using test::runTactus;
using test::Scratch;

namespace
{
/// The recording of a free impact: 30 g at 0.8 m/s on a spring of 5e5 d^1.5 N, with a dissipation of 0.5 s/m.
std::string recording (bool with_times)
{
    std::ostringstream csv;
    csv << (with_times ? "t,depth,force\n" : "depth,force\n");
    const double m = 0.03, h = 1e-7;
    double d = -0.4 * 2e-5, v = 0.8;
    for (int i = 0; d >= 0.0 || v > 0.0; ++i)
    {
        const double f = d > 0.0 ? std::max (0.0, 5e5 * std::pow (d, 1.5) * (1.0 + 0.5 * v)) : 0.0;
        if (i % 100 == 0)
        {
            if (with_times) csv << i * h << ',';
            csv << d << ',' << f << '\n';
        }
        v -= h * f / m;
        d += h * v;
    }
    csv << (with_times ? "1," : "") << "-1e-3,0\n";
    return csv.str();
}
}   // namespace

TEST_CASE ("fit shock: the preset has the law of the recording, and can be played", "[cli][fit]")
{
    const Scratch scratch;
    const auto csv = scratch.write ("tap.csv", recording (false)), preset = scratch.path ("tap.json"), picture = scratch.path ("tap.png");
    const auto ran = runTactus ({ "fit", "shock", csv, "-o", preset, "--mass", "30 g", "--plot", picture });
    INFO (ran.out << ran.err);
    REQUIRE (ran.status == 0);
    CHECK (ran.err == "");
    CHECK (ran.out.find ("mJ recorded") != std::string::npos);
    CHECK (test::textOf (picture).substr (1, 3) == "PNG");

    const auto loaded = loadGraph (preset);
    CHECK (loaded.messages.empty());
    CHECK (writeGraph (loaded.graph) == test::textOf (preset));
    const auto* blow = loaded.graph.root.find ("blow");
    REQUIRE (blow);
    CHECK (blow->settings.at ("stiffness").at ("power")[1].get<double>() == Approx (1.5).margin (0.02));
    CHECK (blow->settings.at ("damping").at ("dissipation").get<double>() == Approx (0.5).epsilon (0.05));
    CHECK (blow->params.at ("mass").get<double>() == Approx (0.03));

    const auto valid = runTactus ({ "validate", preset });
    CHECK (valid.status == 0);
    CHECK (valid.err == "");
    CHECK (runTactus ({ "render", preset, "--out", scratch.path ("tap.csv.out.csv"), "--duration", "0.2" }).status == 0);
}

TEST_CASE ("fit shock: with times it finds the mass itself", "[cli][fit]")
{
    const Scratch scratch;
    const auto csv = scratch.write ("tap.csv", recording (true)), preset = scratch.path ("tap.json");
    REQUIRE (runTactus ({ "fit", "shock", csv, "-o", preset }).status == 0);
    CHECK (loadGraph (preset).graph.root.find ("blow")->params.at ("mass").get<double>() == Approx (0.03).epsilon (0.02));
}

TEST_CASE ("fit shock: a recording or a command that cannot be used is refused, and nothing is written", "[cli][fit]")
{
    const Scratch scratch;
    const auto csv = scratch.write ("tap.csv", recording (false)), preset = scratch.path ("tap.json");
    const auto refused = [&] (const std::vector<std::string>& arguments, int status, const char* id) { checkRefused (arguments, status, id, preset); };
    refused ({ "fit", "shock", csv, "-o", preset }, 1, "[fit/mass]");
    refused ({ "fit", "shock", scratch.path ("none.csv"), "-o", preset }, 1, "[csv/unreadable]");
    refused ({ "fit", "shock", scratch.write ("other.csv", "a,b\n1,2\n"), "-o", preset }, 1, "[fit/column]");
    refused ({ "fit", "shock", scratch.write ("short.csv", "depth,force\n1,2\n"), "-o", preset }, 1, "[fit/too_short]");
    refused ({ "fit", "shock", csv, "-o", csv, "--mass", "30 g" }, 1, "[output/is_input]");
    refused ({ "fit", "shock", csv, "-o", preset, "--mass", "30 N" }, 2, "--mass");
    refused ({ "fit", "shock", csv, "-o", preset, "--mass", "-1" }, 2, "--mass");
    refused ({ "fit", "shock", csv }, 2, "--out");
    refused ({ "fit" }, 2, "");
    refused ({ "fit", "nothing", csv, "-o", preset }, 2, "");
}
