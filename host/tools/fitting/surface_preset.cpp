// SPDX-License-Identifier: MIT
#include "surface_preset.hpp"

#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/half_space.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/read_number.hpp>

#include <vector>

namespace tactus::host
{

namespace
{
constexpr const char* pressed_preset = R"({
  "format": "tactus-graph", "version": 2, "name": "", "tags": ["deformation", "press"], "rate_hz": 4000,
  "devices": {
    "finger": {
      "driver": "sim", "mass": "50 g", "damping": "1 N*s/m",
      "hand": { "stiffness": "400 N/m", "damping": "4 N*s/m", "path": "circle" },
      "guard": {
        "max_force": "6 N", "max_speed": "2 m/s", "max_impulse": "30 N*s", "impulse_window": "10 s", "max_energy": "120 mJ", "energy_window": "1 s"
      }
    }
  },
  "nodes": {
    "hand": { "type": "device.position", "role": "finger" },
    "body": {
      "type": "deform.surface",
      "settings": {
        "surface": {
          "nodes": [[-0.1, -0.1, 0], [0.1, -0.1, 0], [0.1, 0.1, 0], [-0.1, 0.1, 0]], "triangles": [[0, 1, 2], [0, 2, 3]]
        }
      }
    },
    "motor": { "type": "device.force", "role": "finger" }
  },
  "wires": ["hand.position -> body.position", "body.force -> motor.force"]
})";
}   // namespace

double tidy (double value, int digits) { return readNumber (roundedText (value, digits)).value; }

Json toJson (const Law& law)
{
    const auto column = [] (std::vector<double> numbers) {
        for (double& v : numbers)
            v = tidy (v);
        return numbers;
    };
    switch (law.kind)
    {
    case Law::Kind::power:
        return { { "power", { tidy (law.a), tidy (law.b) } } };
    case Law::Kind::exponential:
        return { { "exponential", { tidy (law.a), tidy (law.b) } } };
    case Law::Kind::table:
        return { { "table", { column (law.table.x), column (law.table.y) } } };
    case Law::Kind::dissipation:
        return { { "dissipation", tidy (law.a) } };
    case Law::Kind::none:
        break;
    }
    return nullptr;
}

Json curvesOf (const UniformBody& body)
{
    // Without friction, the sideways curve is not felt, but the contact point needs one to follow the tool.
    const double drag = body.mu > 0.0 ? body.mu : 1.0;
    const Json across = toJson (acrossOf (body.along, drag, body.ratio)), along = toJson (body.along);
    Json curves = Json::array();
    curves.push_back (Json::array ({ across, across, along }));
    return { { "curves", curves }, { "mu", body.mu > 0.0 ? tidy (body.ratio) : 0.0 } };
}

graph::Graph surfacePreset (const UniformBody& body, const std::string& name, const std::string& about, const std::string& source)
{
    auto graph = readGraph (pressed_preset).graph;
    graph.name = name;
    graph.about = about;
    for (auto& node : graph.root.nodes)
        if (node.name == "body") node.settings["surface"].update (curvesOf (body));
    graph.extra["ui"]["sources"] = { { "body.curves.z", source },
                                     { "body.curves.x",
                                       "the z curve, scaled so that drag over push is " + roundedText (body.mu, 3) + " at every depth: guess" } };
    return graph;
}

}   // namespace tactus::host
