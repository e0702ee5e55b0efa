// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

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
/// A slow push to 3 mm and back, in um and mN, that loses a fifth of its work. The touch is at 500 um.
std::string indentation()
{
    std::ostringstream csv;
    csv << "x_um,f_mN\n";
    const auto row = [&] (int um, double gain) {
        const double d = 1e-6 * std::max (0, um - 500);
        csv << um << ',' << 1e3 * gain * 1257.0 * std::pow (d, 1.5) << '\n';
    };
    for (int um = 0; um <= 3500; um += 10)
        row (um, 1.0);
    for (int um = 3490; um >= 0; um -= 10)
        row (um, 0.8);
    return csv.str();
}

bool isValid (const std::string& preset)
{
    const auto valid = runTactus ({ "validate", preset });
    INFO (valid.out << valid.err);
    CHECK (valid.err == "");
    return valid.status == 0 && writeGraph (loadGraph (preset).graph) == test::textOf (preset);
}
}   // namespace

TEST_CASE ("curve: the preset has the curve that the formula says", "[cli][curve]")
{
    const Scratch scratch;
    const auto preset = scratch.path ("ball.json"), picture = scratch.path ("ball.png");
    const auto ran = runTactus ({ "curve", "hertz", "--young", "10 kPa", "--radius", "5 mm", "--mu", "0.2", "-o", preset, "--plot", picture });
    INFO (ran.out << ran.err);
    REQUIRE (ran.status == 0);
    CHECK (ran.out.find ("0.112437 N at 2 mm") != std::string::npos);
    CHECK (test::textOf (picture).substr (1, 3) == "PNG");
    CHECK (isValid (preset));

    const auto surface = loadGraph (preset).graph.root.find ("body")->settings.at ("surface");
    const auto& z = surface.at ("curves")[0][2].at ("power");
    CHECK (z[0].get<double>() == Approx (1257.08).epsilon (1e-5));
    CHECK (z[1].get<double>() == 1.5);
    CHECK (surface.at ("mu").get<double>() == Approx (0.3));   // for a ratio of 0.5, mu 3/2
    CHECK (runTactus ({ "render", preset, "--out", scratch.path ("ball.csv"), "--duration", "0.5" }).status == 0);
}

TEST_CASE ("curve: units, shapes and tables", "[cli][curve]")
{
    const auto law = [] (const std::vector<std::string>& arguments) {
        const auto ran = runTactus (arguments);
        INFO (ran.out << ran.err);
        REQUIRE (ran.status == 0);
        const auto at = ran.out.find ("\"law\": ");
        REQUIRE (at != std::string::npos);
        return Json::parse (ran.out.substr (at + 7, ran.out.find ('\n', at) - at - 7));
    };
    CHECK (law ({ "curve", "punch", "--young", "0.01 MPa", "--radius", "2 mm" }).at ("power")[0].get<double>() == Approx (53.3333).epsilon (1e-5));
    CHECK (law ({ "curve", "punch", "--young", "1e4", "--radius", "0.002", "--poisson", "0" }).at ("power")[0].get<double>() == Approx (40.0));
    const auto cone = law ({ "curve", "cone", "--young", "10 kPa", "--angle", "45 deg" }).at ("power");
    CHECK (cone[0].get<double>() == Approx (8488.26).epsilon (1e-5));
    CHECK (cone[1].get<double>() == 2.0);
    const auto table = law ({ "curve", "hertz", "--young", "10 kPa", "--radius", "5 mm", "--depth", "4 mm", "--table", "8" }).at ("table");
    REQUIRE (table[0].size() == 8);
    CHECK (table[0][3].get<double>() == Approx (0.002));
    CHECK (table[1][3].get<double>() == Approx (0.1124365).epsilon (1e-5));
}

TEST_CASE ("curve: wrong usage is refused, and nothing is written", "[cli][curve]")
{
    const Scratch scratch;
    const auto preset = scratch.path ("no.json");
    const auto refused = [&] (std::vector<std::string> arguments, const char* says) {
        arguments.insert (arguments.begin(), "curve");
        arguments.insert (arguments.end(), { "-o", preset });
        checkRefused (arguments, 2, says, preset);
    };
    refused ({ "hertz", "--young", "10 kPa" }, "--radius");
    refused ({ "hertz", "--young", "10 N", "--radius", "5 mm" }, "--young");
    refused ({ "hertz", "--young", "-1", "--radius", "5 mm" }, "--young");
    refused ({ "punch", "--young", "10 kPa", "--radius", "5 s" }, "--radius");
    refused ({ "cone", "--young", "10 kPa", "--angle", "90 deg" }, "--angle");
    refused ({ "hertz", "--young", "10 kPa", "--radius", "5 mm", "--poisson", "0.6" }, "--poisson");
    refused ({ "torus" }, "");
}

TEST_CASE ("fit curve: a recorded indentation becomes a body that can be played, and its hysteresis is printed", "[cli][fit][curve]")
{
    const Scratch scratch;
    const auto csv = scratch.write ("push.csv", indentation()), preset = scratch.path ("push.json"), picture = scratch.path ("push.png");
    const auto ran = runTactus ({ "fit", "curve", csv, "--depth", "x_um", "--depth-unit", "1 um", "--force", "f_mN", "--force-unit", "1 mN", "--touch",
                                  "0.5 mm", "-o", preset, "--plot", picture });
    INFO (ran.out << ran.err);
    REQUIRE (ran.status == 0);
    CHECK (ran.err == "");
    CHECK (ran.out.find ("20 % of the work") != std::string::npos);
    CHECK (test::textOf (picture).substr (1, 3) == "PNG");
    CHECK (isValid (preset));

    const auto z = loadGraph (preset).graph.root.find ("body")->settings.at ("surface").at ("curves")[0][2].at ("table");
    REQUIRE (z[0].size() == 20);
    CHECK (z[0][19].get<double>() == Approx (3e-3));
    CHECK (z[1][19].get<double>() == Approx (0.9 * 1257.0 * std::pow (3e-3, 1.5)).epsilon (0.02));
    CHECK (runTactus ({ "render", preset, "--out", scratch.path ("push.out.csv"), "--duration", "0.5" }).status == 0);
}

TEST_CASE ("fit curve: a recording or a command that cannot be used is refused, and nothing is written", "[cli][fit][curve]")
{
    const Scratch scratch;
    const auto csv = scratch.write ("push.csv", indentation()), preset = scratch.path ("push.json");
    const auto refused = [&] (const std::vector<std::string>& arguments, int status, const char* id) { checkRefused (arguments, status, id, preset); };
    const auto rows = indentation();
    const auto unknown = scratch.write ("unknown.csv", "x_um,w_mN" + rows.substr (rows.find ('\n')));
    refused ({ "fit", "curve", unknown, "-o", preset }, 1, "[fit/column]");
    refused ({ "fit", "curve", scratch.path ("none.csv"), "-o", preset }, 1, "[csv/unreadable]");
    refused ({ "fit", "curve", scratch.write ("short.csv", "depth,force\n1,2\n"), "-o", preset }, 1, "[fit/too_short]");
    refused ({ "fit", "curve", csv, "-o", csv, "--depth", "x_um", "--force", "f_mN" }, 1, "[output/is_input]");
    refused ({ "fit", "curve", csv, "-o", preset, "--depth-unit", "1 N" }, 2, "--depth-unit");
    refused ({ "fit", "curve", csv, "-o", preset, "--points", "1" }, 2, "--points");
    refused ({ "fit", "curve", csv }, 2, "--out");
}

TEST_CASE ("curve: sizes that give no force, or an infinite one, are refused, and nothing is written", "[cli][curve]")
{
    const Scratch scratch;
    const auto preset = scratch.path ("body.json");
    checkRefused ({ "curve", "hertz", "--young", "1e308 Pa", "--radius", "1e308 m", "--depth", "1e308 m", "-o", preset }, 1, "[curve/out_of_range]", preset);
    checkRefused ({ "curve", "cone", "--young", "1e-308 Pa", "--angle", "1e-300 rad", "-o", preset }, 1, "[curve/out_of_range]", preset);
}
