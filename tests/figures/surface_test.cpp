// SPDX-License-Identifier: MIT
#include "figure_data.hpp"

#include "host/cli/program.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

using namespace tactus;

namespace
{
std::vector<std::string> pressed (const std::vector<std::string>& settings, const std::string& ports)
{
    std::vector<std::string> options { "--duration", "1", "--record", ports };
    for (const auto& s : settings)
        options.insert (options.end(), { "--set", s });
    return options;
}

std::string text (double value)
{
    std::ostringstream out;
    out.precision (17);
    out << value;
    return out.str();
}
}   // namespace

TEST_CASE ("figure: a tool four times as wide raises the response by two orders of magnitude", "[figures]")
{
    std::vector<std::vector<double>> responses;
    std::vector<double> depth;
    for (const double tool : { 0.0, 0.25, 0.5, 0.75, 1.0 })
    {
        const auto run = test::renderOnce ("tools", pressed ({ "shape.value=" + text (tool) }, "pad.depth,pad.resistance"));
        depth = run["pad.depth"];
        responses.push_back (run["pad.resistance"]);
    }

    test::Columns rows;
    for (std::size_t k = 0; k < depth.size(); ++k)
    {
        const double e = depth[k];
        if (e <= 0.0) continue;
        const double thin = 4e-3 * std::expm1 (450.0 * e), wide = 0.2 * std::expm1 (900.0 * e);   // as in the graph
        std::vector<double> row { e };
        for (std::size_t i = 0; i < responses.size(); ++i)
        {
            const double w = 0.25 * double (i);
            CHECK (responses[i][k] == Approx ((1.0 - w) * thin + w * wide));
            row.push_back (responses[i][k]);
        }
        rows.push_back (row);
    }
    REQUIRE (rows.size() > 500);
    const auto ratioAt = [&] (double e) {
        const auto at = std::ranges::find_if (rows, [e] (const auto& row) { return row[0] >= e; });
        return at->back() / (*at)[1];
    };
    CHECK (ratioAt (0.0) == Approx (100.0).epsilon (0.01));   // as docs/chapter.md says
    CHECK (ratioAt (4.5e-3) == Approx (430.0).epsilon (0.01));
    test::writeFigure ("tools", { "depth", "thin", "quarter", "half", "three_quarters", "wide" }, rows);
}

TEST_CASE ("figure: between the points of a patch the response is a blend of theirs and has no step at an edge", "[figures]")
{
    struct Place
    {
        double x, y;   // m
    };
    constexpr Place places[] { { 0.0, 0.0 }, { 0.04, 0.0 }, { 0.04, 0.04 }, { 0.0, 0.04 }, { 0.02, 0.02 }, { 0.036, 0.012 }, { 0.012, 0.028 } };
    // The mix of the laws k e^1.6 of the four nodes, by (1 - r)^4 (4 r + 1) of the distance over 1.6 times the longest edge at the node.
    const auto stiffnessAt = [&] (const Place& p) {
        constexpr double stiffness[] { 2.5e4, 6e4, 4.5e4, 1.8e4 };   // N/m^1.6
        const double diagonal = 0.04 * std::numbers::sqrt2, longest[] { diagonal, 0.04, diagonal, 0.04 };
        double sum = 0.0, all = 0.0;
        for (int i = 0; i < 4; ++i)
        {
            const double r = std::hypot (p.x - places[i].x, p.y - places[i].y) / (1.6 * longest[i]);
            const double w = r < 1.0 ? std::pow (1.0 - r, 4) * (4.0 * r + 1.0) : 0.0;
            sum += w * stiffness[i];
            all += w;
        }
        return sum / all;
    };

    test::Columns rows;
    int number = 0;
    for (const auto& p : places)
    {
        // stay slightly inside the patch: a corner node belongs to one or two triangles, so which one is touched there is ambiguous
        const double x = 0.02 + (p.x - 0.02) * (1.0 - 1e-9), y = 0.02 + (p.y - 0.02) * (1.0 - 1e-9);
        const auto run = test::renderOnce ("patch", pressed ({ "x.value=" + text (x), "y.value=" + text (y) }, "patch.depth,patch.resistance"));
        INFO ("at " << p.x << ", " << p.y);
        for (std::size_t k = 0; k < run.rows(); ++k)
        {
            const double e = run.at ("patch.depth", k);
            if (e <= 0.0) continue;
            CHECK (run.at ("patch.resistance", k) == Approx (stiffnessAt (p) * std::pow (e, 1.6)).epsilon (1e-6).margin (1e-9));
            rows.push_back ({ double (number), p.x, p.y, e, run.at ("patch.resistance", k) });
        }
        ++number;
    }
    test::writeFigure ("patch", { "place", "x", "y", "depth", "resistance" }, rows);

    // along the other diagonal, with a new contact at each point
    const test::Scratch scratch;
    std::string feed = "patch.position.x,patch.position.y,patch.position.z\n";
    constexpr int steps = 400;
    for (int i = 0; i <= steps; ++i)
    {
        const double x = 0.04 * i / steps;
        for (const double z : { 1e-3, -3e-3 })
            feed += text (x) + "," + text (0.04 - x) + "," + text (z) + "\n";
    }
    const auto line = test::renderOnce ("patch", { "--feed", scratch.write ("feed.csv", feed), "--record", "patch.resistance" });
    const auto f = line["patch.resistance"];
    REQUIRE (f.size() == 2 * (steps + 1));
    const double span = std::abs (f[f.size() - 1] - f[1]);
    for (std::size_t i = 3; i < f.size(); i += 2)
        CHECK (std::abs (f[i] - f[i - 2]) < 4.0 / steps * span);
}
