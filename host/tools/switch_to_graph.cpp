// SPDX-License-Identifier: MIT
// Converts a measured force curve of a key switch to a graph: switch_to_graph switch.csv --out key.json
#include "measure_option.hpp"
#include "switch_loop.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/text/number_text.hpp>

#include <cmath>
#include <filesystem>
#include <iostream>

using namespace tactus;
using namespace tactus::host;

namespace
{
constexpr int input_at_fault = 1, usage = 2;

std::string millijoule (double joule) { return numberText (std::round (1e7 * joule) / 1e4) + " mJ"; }
}   // namespace

int main (int argc, char** argv)
{
    const Command app { "Converts a force curve of a key switch, pressed and released, to a passive graph." };
    double tolerance = 10e-3, stiffness = 1e4, backlash = 0.0;
    std::string in, out;

    app.addOption ("CURVE", in, "CSV with columns such as x_um and force_gf: down to the stop and back up").required();
    app.addOption ("--out", out, "Graph file; default: standard output");
    addMeasure (app, "--tolerance", tolerance, unit::newton, "Largest distance between the curve and the straight lines that replace it; default: 10 mN");
    addMeasure (app, "--stiffness", stiffness, unit::stiffness,
                "Stiffness with which the force changes between the two curves when the finger reverses; default: 10 N/mm");
    addMeasure (app, "--backlash", backlash, unit::metre, "Backlash of the meter: on the way up, the key is this much deeper than measured; default: 0", true);

    if (const auto status = app.parse (argc, argv)) return *status == 0 ? 0 : usage;

    const auto table = readTable (std::filesystem::path (in));
    const auto measured = table ? switchFrom (*table, in, backlash) : table.error();
    if (! measured)
    {
        std::cerr << describe (measured.error()) << '\n';
        return input_at_fault;
    }

    const auto loop = simplified (withoutGain (*measured), tolerance);
    const auto key = keyFrom (loop, std::filesystem::path (in).stem().string(), stiffness);
    std::cerr << in << ": measured loss " << millijoule (loss (*measured)) << " per stroke, loss of the graph " << millijoule (loss (loop)) << ", with "
              << loop.travel.size() << " points\n";
    if (const double gain = loss (withoutGain (*measured)) - loss (*measured); gain > 0.0)
        std::cerr << in << ": in places the measured curve returns more energy than it takes, by " << millijoule (gain) << "; the graph never does\n";

    if (out.empty())
    {
        std::cout << writeGraph (key) << std::flush;
        return std::cout ? 0 : input_at_fault;
    }
    const auto done = saveGraph (key, out);
    if (! done) std::cerr << describe (done.error()) << '\n';
    return done ? 0 : input_at_fault;
}
