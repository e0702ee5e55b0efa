// SPDX-License-Identifier: GPL-3.0-or-later
// Turns a measured force curve of a key switch into a graph: switch_to_graph switch.csv --out key.json
#include <host/tools/measure_option.hpp>
#include <host/tools/switch_loop.hpp>

#include <framework/file/graph_file.hpp>
#include <framework/number_text.hpp>

#include <CLI/CLI.hpp>

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
    CLI::App app { "Turns a force curve of a key switch, pressed and released, into a passive graph." };
    double tolerance = 10e-3, stiffness = 1e4, backlash = 0.0;
    std::string in, out;

    app.add_option ("CURVE", in, "CSV with columns such as x_um and force_gf: down to the stop and back up")->required();
    app.add_option ("--out", out, "the graph; standard output without it");
    addMeasure (app, "--tolerance", tolerance, unit::newton, "between the curve and the straight lines drawn for it, otherwise 10 mN");
    addMeasure (app, "--stiffness", stiffness, unit::stiffness, "with which the key changes from one way to the other, otherwise 10 N/mm");
    addMeasure (app, "--backlash", backlash, unit::metre, "of the meter: on the way up the key is that much deeper than it says, otherwise 0", true);

    try
    {
        app.parse (argc, argv);
    }
    catch (const CLI::ParseError& error)
    {
        return app.exit (error) == 0 ? 0 : usage;
    }

    const auto table = readTable (std::filesystem::path (in));
    const auto measured = table ? switchFrom (*table, in, backlash) : tl::unexpected (table.error());
    if (! measured)
    {
        std::cerr << describe (measured.error()) << '\n';
        return input_at_fault;
    }

    const auto loop = simplified (withoutGain (*measured), tolerance);
    const auto key = keyFrom (loop, std::filesystem::path (in).stem().string(), stiffness);
    std::cerr << in << ": measured to lose " << millijoule (loss (*measured)) << " a stroke, made to lose " << millijoule (loss (loop)) << ", with " << loop.travel.size() << " points\n";
    if (const double gain = loss (withoutGain (*measured)) - loss (*measured); gain > 0.0)
        std::cerr << in << ": where it was measured to give " << millijoule (gain) << " back, it is made to give none\n";

    if (out.empty())
    {
        std::cout << writeGraph (key) << std::flush;
        return std::cout ? 0 : input_at_fault;
    }
    const auto messages = saveGraph (key, out);
    for (const auto& message : messages)
        std::cerr << message.where << ": " << message.text << "; " << message.remedy << " [" << message.id << "]\n";
    return hasErrors (messages) ? input_at_fault : 0;
}
