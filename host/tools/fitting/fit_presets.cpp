// SPDX-License-Identifier: MIT
#include "fit_presets.hpp"
#include "surface_preset.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/kit/math/math.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tactus::host
{

namespace
{
/// The part that differs from preset to preset. In each, a simulated stylus with a guard moves along a path.
struct Sketch
{
    std::string path, tags, nodes, wires;
    int rate_hz = 4000;
};

graph::Graph graphOf (const Sketch& sketch)
{
    const auto text = R"({ "format": "tactus-graph", "version": 2, "name": "", "tags": [)" + sketch.tags + R"(, "fitted"], "rate_hz": )"
                      + std::to_string (sketch.rate_hz) + R"(,
  "devices": {
    "stylus": {
      "driver": "sim", "mass": "60 g", "damping": "2 N*s/m",
      "hand": { "stiffness": "500 N/m", "damping": "6 N*s/m", "path": ")"
                      + sketch.path + R"(" },
      "guard": {
        "max_force": "10 N", "max_speed": "2 m/s", "max_impulse": "50 N*s", "impulse_window": "10 s", "max_energy": "200 mJ", "energy_window": "1 s"
      }
    }
  },
  "nodes": { "hand": { "type": "device.position", "role": "stylus" }, )"
                      + sketch.nodes + R"(, "motor": { "type": "device.force", "role": "stylus" } },
  "wires": [)" + sketch.wires
                      + "] }";
    return readGraph (text).graph;
}

constexpr const char* board = R"("board": {
      "type": "deform.plane", "params": { "stiffness": "2 N/mm", "damping": "0.3 N*s/m" }, "settings": { "window": "1 ms" } })";

constexpr const char* strike = R"("strike": {
      "type": "contact.impact", "params": { "release": "50 um", "min_speed": "5 mm/s", "refractory": "10 ms" } })";

Sketch frictionSketch()
{
    return { .path = "stroke",
             .tags = R"("friction", "stroke")",
             .nodes = std::string (board) + R"(, "drag": { "type": "friction.elasto_plastic" })",
             .wires = R"("hand.position -> board.position", "hand.position -> drag.position", "board.resistance -> drag.normal_force",
                         "board.force -> motor.force", "drag.force -> motor.force")" };
}

Sketch modesSketch()
{
    return { .path = "tap",
             .tags = R"("vibration", "tap")",
             .nodes = std::string (board) + ", " + strike + R"(, "ring": { "type": "vibration.modal" },
                         "touch": { "type": "contact.window", "params": { "window": "0.1 mm" } },
                         "felt": { "type": "signal.multiply" }, "up": { "type": "vector.join" })",
             .wires = R"("hand.position -> board.position", "board.depth -> strike.depth", "board.depth -> touch.depth",
                         "strike.hit -> ring.hit", "ring.value -> felt.in[0]", "touch.gain -> felt.in[1]", "felt.out -> up.z",
                         "board.force -> motor.force", "up.out -> motor.force")" };
}

Sketch textureSketch()
{
    return { .path = "stroke",
             .tags = R"("texture", "stroke", "noise")",
             .nodes = std::string (board) + R"(, "motion": { "type": "motion.velocity", "settings": { "window": "10 ms" } },
                         "grain": { "type": "texture.noise" }, "side": { "type": "vector.join" },
                         "drag": { "type": "friction.elasto_plastic", "params": { "mu": 0.3, "d_max": "0.2 mm" } })",
             .wires = R"("hand.position -> board.position", "hand.position -> motion.position", "motion.speed -> grain.speed",
                         "board.resistance -> grain.normal_force", "grain.value -> side.y", "hand.position -> drag.position",
                         "board.resistance -> drag.normal_force", "board.force -> motor.force", "drag.force -> motor.force",
                         "side.out -> motor.force")" };
}

Sketch bladeSketch()
{
    return { .path = "cut",
             .tags = R"("cut")",
             .nodes = R"("split": { "type": "vector.split" }, "down": { "type": "signal.gain", "params": { "gain": -1 } },
                         "blade": { "type": "cut.blade" }, "up": { "type": "vector.join" })",
             .wires = R"("hand.position -> split.in", "split.z -> down.in", "down.out -> blade.depth", "blade.resistance -> up.z",
                         "up.out -> motor.force")" };
}

Sketch shockSketch()
{
    return { .path = "tap",
             .tags = R"("shock", "tap")",
             .nodes = std::string (R"("wall": {
      "type": "deform.plane", "params": { "stiffness": "4 N/mm", "damping": "1 N*s/m" }, "settings": { "window": "1 ms" } }, )")
                      + strike + R"(,
      "blow": { "type": "shock.hunt_crossley" }, "felt": { "type": "shock.handover" }, "up": { "type": "vector.join" })",
             .wires = R"("hand.position -> wall.position", "wall.depth -> strike.depth", "strike.hit -> blow.hit", "strike.hit -> felt.hit",
                         "wall.resistance -> felt.contact", "blow.resistance -> felt.shock", "felt.resistance -> up.z",
                         "up.out -> motor.force")",
             .rate_hz = 10000 };
}

graph::Node& nodeIn (graph::Graph& graph, const std::string& name) { return *std::ranges::find (graph.root.nodes, name, &graph::Node::name); }

void setSources (graph::Graph& graph, std::initializer_list<std::pair<const char*, std::string>> sources)
{
    auto& all = graph.extra["ui"]["sources"];
    all = Json::object();
    for (const auto& [place, text] : sources)
        all[place] = text;
}

constexpr const char* board_guess = "guess: what the simulated device can render";
}   // namespace

graph::Graph frictionPreset (const FrictionFit& fit, const std::string& load_source, const std::string& source)
{
    auto graph = graphOf (frictionSketch());
    constexpr const char* names[] { "stick", "dupont", "ramp", "dahl", "curve" };
    auto& params = nodeIn (graph, "drag").params;
    params = { { "mu", tidy (fit.mu, 4) },
               { "d_max", tidy (fit.d_max, 4) },
               { "adhesion", names[static_cast<std::size_t> (fit.adhesion)] },
               { "reference_load", tidy (fit.reference_load, 4) } };
    if (fit.adhesion == BristleAdhesion::dupont) params["break_away"] = tidy (fit.break_away, 4);
    graph.about = "Friction fitted to a recording: it slides at " + roundedText (fit.mu, 3) + " times the load. The contact stretches "
                  + roundedText (1e3 * fit.d_max, 3) + " mm before it slides at a load of " + roundedText (fit.reference_load, 3) + " N.";
    setSources (graph, { { "drag.mu", source },
                         { "drag.d_max", source },
                         { "drag.adhesion", source },
                         { "drag.reference_load", load_source },
                         { "board.stiffness", board_guess } });
    return graph;
}

graph::Graph modesPreset (const ModesFit& fit, double newtons_per_unit, const std::string& amplitude_source, const std::string& source)
{
    double highest = 0.0;
    for (const auto& tone : fit.tones)
        highest = std::max (highest, tone.frequency);
    auto sketch = modesSketch();
    sketch.rate_hz = highest < 800.0 ? 4000 : 8000;
    if (highest >= 1800.0) sketch.rate_hz = 20000;
    auto graph = graphOf (sketch);
    Json modes = Json::array();
    for (const auto& tone : fit.tones)
        modes.push_back ({ { "frequency", tidy (tone.frequency) }, { "decay", tidy (tone.decay) }, { "amplitude", tidy (newtons_per_unit * tone.amplitude) } });
    nodeIn (graph, "ring").settings["modes"] = modes;
    graph.about = "A tap that rings as a recorded object did: " + std::to_string (fit.tones.size()) + (fit.tones.size() == 1 ? " mode." : " modes.");
    setSources (graph, { { "ring.modes", source + "; amplitudes: " + amplitude_source }, { "board.stiffness", board_guess } });
    return graph;
}

graph::Graph texturePreset (const TextureFit& fit, double mass, const std::string& mass_source, const std::string& source)
{
    auto sketch = textureSketch();
    constexpr int rates[] { 4000, 8000, 10000, 20000 };
    const auto* enough = std::ranges::find_if (rates, [&] (int rate) { return rate >= fit.rate; });
    sketch.rate_hz = enough != std::end (rates) ? *enough : rates[std::size (rates) - 1];
    auto graph = graphOf (sketch);
    Json models = Json::array();
    for (const auto& m : fit.models)
    {
        Json a = Json::array();
        for (const double v : m.coefficients)
            a.push_back (v);   // in full: near the edge of stability, digits matter
        models.push_back ({ { "speed", tidy (m.speed) },
                            { "force", tidy (m.force) },
                            { "rate", tidy (fit.rate) },
                            { "coefficients", a },
                            { "variance", tidy (mass * mass * m.variance) } });
    }
    nodeIn (graph, "grain").settings["models"] = models;
    graph.about = "A texture fitted to recorded vibrations, at " + std::to_string (fit.models.size())
                  + (fit.models.size() == 1 ? " speed and force." : " combinations of speed and force.");
    setSources (graph, { { "grain.models", source + "; force is acceleration times " + roundedText (1e3 * mass, 3) + " g, " + mass_source },
                         { "drag.mu", "guess: not fitted" },
                         { "board.stiffness", board_guess } });
    return graph;
}

graph::Graph gratingPreset (const GratingFit& fit, double load, const std::string& source)
{
    std::string nodes = board, wires = R"("hand.position -> board.position", "board.depth -> touch.depth", "board.force -> motor.force")";
    nodes += R"(, "touch": { "type": "contact.window", "params": { "window": "0.2 mm" } })";
    for (const auto& h : fit.harmonics)
    {
        const auto i = std::to_string (h.number);
        nodes += R"(, "ridges)" + i + R"(": { "type": "texture.grating" }, "felt)" + i + R"(": { "type": "vector.scale" })";
        wires += R"(, "hand.position -> ridges)" + i + R"(.position", "ridges)" + i + R"(.force -> felt)" + i + R"(.in", "touch.gain -> felt)" + i
                 + R"(.gain", "felt)" + i + R"(.out -> motor.force")";
    }
    auto graph = graphOf ({ .path = "stroke", .tags = R"("texture", "grating", "stroke")", .nodes = nodes, .wires = wires });
    for (const auto& h : fit.harmonics)
    {
        // The force is -load times the slope of the height a sin (k x + p), that is load a k sin (k x + p - 90 deg).
        const double per_metre = h.number / fit.period;
        nodeIn (graph, "ridges" + std::to_string (h.number)).params = {
            { "amplitude", tidy (load * 2.0 * std::numbers::pi * per_metre * h.amplitude) },
            { "spatial_frequency", tidy (per_metre) },
            { "phase", tidy (math::remainder (h.phase - 0.5 * std::numbers::pi, 2.0 * std::numbers::pi)) }
        };
    }
    graph.about = "Ridges fitted to a scanned profile, one every " + roundedText (1e3 * fit.period, 3) + " mm, as felt by a tool that presses with "
                  + roundedText (load, 3) + " N.";
    setSources (graph, { { "ridges1.spatial_frequency", source },
                         { "ridges1.amplitude", "slope of the fitted height times a load of " + roundedText (load, 3) + " N, without friction" },
                         { "board.stiffness", board_guess } });
    return graph;
}

graph::Graph bladePreset (const BladeFit& fit, const std::string& source)
{
    auto graph = graphOf (bladeSketch());
    auto& node = nodeIn (graph, "blade");
    node.params = { { "width", tidy (fit.width) },
                    { "toughness", tidy (fit.toughness) },
                    { "rupture_force", std::max (tidy (fit.rupture_force), tidy (fit.width) * tidy (fit.toughness)) } };
    node.settings["law"] = toJson (fit.law);
    if (fit.cracked_law) node.settings["cracked_law"] = toJson (fit.cracked_law);
    graph.about =
        "A fitted cut: the sample bursts at " + roundedText (fit.rupture_force, 3) + " N and is cut at " + roundedText (fit.toughness * fit.width, 3) + " N.";
    if (! fit.bursts)
        graph.about = "The start of a recorded cut. The recording ended before the sample burst, so the forces of bursting and cutting are guesses.";
    setSources (graph, { { "blade.law", source },
                         { "blade.toughness", fit.bursts ? source + ", for a width of " + roundedText (1e3 * fit.width, 3) + " mm" : "guess" },
                         { "blade.rupture_force", fit.bursts ? source : "guess" } });
    return graph;
}

graph::Graph shockPreset (const ShockFit& fit, const std::string& source)
{
    auto graph = graphOf (shockSketch());
    graph.about = "A tap whose loop of force against depth has the same area as a recorded loop: " + energyText (fit.recorded_area) + " at "
                  + roundedText (fit.speed, 3) + " m/s.";
    auto& blow = nodeIn (graph, "blow");
    blow.params["mass"] = tidy (fit.mass);
    blow.settings["stiffness"] = toJson (fit.stiffness);
    blow.settings["damping"] = toJson (fit.damping);
    graph.controls = { { .id = "blow", .name = "Blow", .value = 0.5, .to = { { .path = "blow.gain", .low = 0, .high = 2 } } } };
    setSources (graph, { { "blow", source }, { "wall", "guess: what the simulated device can render" } });
    return graph;
}

graph::Graph switchPreset (const SwitchLoop& loop, double stiffness, const std::string& source)
{
    const auto asJson = [] (const Curve& curve) { return Json { curve.x, curve.y }; };
    const Json key = {
        { "format", "tactus-graph" },
        { "version", 2 },
        { "about", "A measured key. A stroke down and up loses " + numberText (std::round (1e7 * lostEnergy (loop)) / 1e4) + " mJ." },
        { "tags", { "key", "press", "measured" } },
        { "rate_hz", 4000 },
        { "devices",
          { { "finger",
              { { "driver", "sim" },
                { "mass", "50 g" },
                { "damping", "3 N*s/m" },
                { "hand", { { "stiffness", "800 N/m" }, { "damping", "6 N*s/m" }, { "path", "press" }, { "scale", 1.3 } } },
                { "guard", { { "max_force", "6 N" } } } } } } },
        { "nodes",
          { { "hand", { { "type", "device.position" }, { "role", "finger" } } },
            { "key", { { "type", "deform.plane" }, { "settings", { { "law", { { "table", asJson (meanOf (loop)) } } } } } } },
            { "bound", { { "type", "signal.map" }, { "settings", { { "curve", asJson (boundOf (loop)) } } } } },
            { "rub", { { "type", "friction.elasto_plastic" }, { "params", { { "mu", 1 }, { "stiffness", stiffness } } } } },
            { "motor", { { "type", "device.force" }, { "role", "finger" } } } } },
        { "wires",
          { "hand.position -> key.position", "key.depth -> bound.in", "key.depth -> rub.position.x", "bound.out -> rub.normal_force", "key.force -> motor.force", { { "wire", "rub.force.x -> motor.force.z" }, { "gain", -1 } } } },
    };
    auto graph = readGraph (key.dump()).graph;
    setSources (graph, { { "key.law", source }, { "bound.curve", source } });
    return graph;
}

}   // namespace tactus::host
