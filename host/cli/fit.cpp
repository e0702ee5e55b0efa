// SPDX-License-Identifier: GPL-3.0-or-later
#include "commands.hpp"
#include "fit_curve.hpp"
#include "overwriting.hpp"
#include "report.hpp"
#include "surface_preset.hpp"

#include <host/io/plot.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/shock_fit.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

namespace tactus::host
{

namespace
{
struct FitOptions
{
    std::string recording, preset, plot, mass;
};

RecordedLoop readLoop (const std::string& file)
{
    const auto table = orFail (readTable (std::filesystem::path (file)));
    const auto column = [&] (const char* name, bool required) {
        std::vector<double> values;
        const auto at = table.column (name);
        if (! at && required)
            fail (Message::error ("fit/column", file, "there is no column " + quote (name),
                                  "name the columns depth (m), force (N) and, if the recording has times, t (s)"));
        for (std::size_t r = 0; at && r < table.rows(); ++r)
            values.push_back (table.at (r, *at));
        return values;
    };
    return { .depth = column ("depth", true), .force = column ("force", true), .time = column ("t", false) };
}

/// The graph of a tap on a soft wall. The force of the wall hands over to a shock.
constexpr const char* tap_preset = R"({
  "format": "tactus-graph", "version": 1, "name": "", "tags": ["shock", "tap", "fitted"], "rate_hz": 10000,
  "devices": {
    "stylus": {
      "driver": "sim", "mass": "60 g", "damping": "3 N*s/m",
      "hand": { "stiffness": "500 N/m", "damping": "6 N*s/m", "path": "tap" },
      "guard": {
        "max_force": "10 N", "max_speed": "2 m/s", "max_impulse": "50 N*s", "impulse_window": "10 s", "max_energy": "200 mJ", "energy_window": "1 s"
      }
    }
  },
  "nodes": {
    "hand": { "type": "device.position", "role": "stylus" },
    "wall": { "type": "deform.plane", "params": { "stiffness": "4 N/mm", "damping": "1 N*s/m" } },
    "strike": { "type": "contact.impact", "params": { "release": "50 um", "min_speed": "5 mm/s", "refractory": "10 ms" } },
    "blow": { "type": "shock.hunt_crossley" },
    "felt": { "type": "shock.handover" },
    "up": { "type": "vector.join" },
    "motor": { "type": "device.force", "role": "stylus" }
  },
  "wires": [
    "hand.position -> wall.position", "wall.depth -> strike.depth", "strike.hit -> blow.hit", "strike.hit -> felt.hit",
    "wall.resistance -> felt.contact", "blow.resistance -> felt.shock", "felt.resistance -> up.z", "up.out -> motor.force"
  ],
  "controls": { "blow": { "name": "Blow", "value": 0.5, "to": { "blow.gain": [0, 2] } } }
})";

/// A preset with the fitted shock. Everything else in it is a guess.
graph::Graph presetOf (const ShockFit& fit, const std::string& name, const std::string& source)
{
    auto graph = readGraph (tap_preset).graph;
    graph.name = name;
    graph.about = "A tap whose loop of force against depth has the same area as a recorded loop: ";
    graph.about += rounded (1e3 * fit.recorded_area) + " mJ at " + rounded (fit.speed) + " m/s.";
    for (auto& node : graph.root.nodes)
        if (node.name == "blow")
        {
            node.params["mass"] = fit.mass;
            node.settings["stiffness"] = toJson (fit.stiffness);
            node.settings["damping"] = toJson (fit.damping);
        }
    graph.extra["ui"]["sources"] = { { "blow", source }, { "wall", "guess: what the simulated device can render" } };
    return graph;
}

void describe (const ShockFit& fit, const std::string& file)
{
    std::cout << printableName (file) << ": " << fit.depth.size() << " rows of contact, " << rounded (1e3 * *std::ranges::max_element (fit.depth))
              << " mm deep, at most " << rounded (fit.peak) << " N\n"
              << "  stiffness  " << toJson (fit.stiffness).dump() << "\n"
              << "  damping    " << toJson (fit.damping).dump() << "\n"
              << "  mass       " << rounded (fit.mass) << " kg, at " << rounded (fit.speed) << " m/s\n"
              << "  area       " << rounded (1e3 * fit.recorded_area, 6) << " mJ recorded, " << rounded (1e3 * fit.fitted_area, 6) << " mJ fitted, "
              << rounded (1e3 * fit.played_area, 6) << " mJ when the shock is played at this speed\n"
              << "  residual   " << rounded (fit.residual) << " N rms, " << rounded (100.0 * fit.residual / fit.peak, 2) << " % of the peak\n";

    constexpr double much = 0.1;
    if (! (std::abs (fit.played_area - fit.recorded_area) <= much * fit.recorded_area))
        std::cerr << printableName (file) << ": warning: a free impact of this mass at this speed does not lose the same energy as the recorded one\n"
                  << "    the tool was probably pushed during the recording, or --mass is wrong: correct --mass, or record a tool that moves freely; the\n"
                  << "    fitted force over the recorded depth still has the recorded area [fit/not_free]\n";
}

void draw (const ShockFit& fit, const std::string& name, const std::string& file)
{
    const Figure figure { .title = name,
                          .panels = { { .x = { "depth", "m" },
                                        .y = { "force", "N" },
                                        .series = { { .label = "recorded", .x = fit.depth, .y = fit.recorded },
                                                    { .label = "fitted, with the same area", .x = fit.depth, .y = fit.fitted } } } } };
    orFail (writeFigure (figure, file));
}

void fitShock (const FitOptions& options)
{
    const double mass = options.mass.empty() ? 0.0 : readAmount ("--mass", options.mass, "kg", "50 g");
    std::vector<std::string> outputs { options.preset };
    if (! options.plot.empty()) outputs.push_back (options.plot);
    refuseOverwriting (outputs, { options.recording });

    auto fitted = tactus::fitShock (readLoop (options.recording), mass);
    if (! fitted) fail (Message::error (fitted.error().id, options.recording, fitted.error().text, fitted.error().remedy));
    const auto& fit = *fitted;

    const auto name = std::filesystem::path (options.recording).filename().string();
    const auto source = "`tactus fit shock` from " + name + ": residual " + rounded (100.0 * fit.residual / fit.peak, 2) + " % of the peak";
    orFail (saveGraph (presetOf (fit, std::filesystem::path (options.preset).stem().string(), source), options.preset));
    if (! options.plot.empty()) draw (fit, name, options.plot);
    describe (fit, options.recording);
    std::cout << "wrote " << printableName (options.preset) << "\n";
}
}   // namespace

void addFit (const Command& app)
{
    const auto command = app.add ("fit", "Fit the parameters of a model to a recording, and write a preset with them");
    command.requireCommand();

    const auto options = std::make_shared<FitOptions>();
    const auto shock = command.add ("shock", "Fit the spring and damper of shock.hunt_crossley to a recorded impact");
    shock.addOption ("recording", options->recording, "CSV file with the columns depth (m), force (N) and, if it has times, t (s)").required();
    shock.addOption ("-o,--out", options->preset, "The preset to write: a graph file").required();
    shock.addOption ("--mass", options->mass,
                     "The mass that was thrown back, such as \"50 g\"; required if the recording has no times. Default: impulse divided by change of speed");
    shock.addOption ("--plot", options->plot, "Draw both loops into this PNG file");
    shock.footer ("The loop of the fitted force over the recorded depth has exactly the area of the recorded loop, because the hand\n"
                  "feels the lost energy more than the shape of the loop. Depth and force are positive inside the object.\n\n"
                  "Examples:\n"
                  "  tactus fit shock tap_on_steel.csv -o tap_on_steel.json\n"
                  "  tactus fit shock loop.csv --mass \"30 g\" -o rubber.json --plot rubber.png");
    shock.callback ([options] { fitShock (*options); });
    addFitCurve (command);
}

}   // namespace tactus::host
