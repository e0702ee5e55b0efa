// SPDX-License-Identifier: GPL-3.0-or-later
#include "clip_graph.hpp"

#include <host/app/text/filled.hpp>

namespace tactus::host
{

namespace
{
constexpr const char* clip_role = "stylus";

void addTo (graph::Graph& g, const char* name, const char* type, double x, double y = 0.0)
{
    graph::Node node;
    node.name = name;
    node.type = type;
    node.extra["ui"] = Json { { "at", Json::array ({ x, y }) } };
    if (std::string_view (type).starts_with ("device.")) node.role = clip_role;
    g.root.nodes.push_back (std::move (node));
}

void wireIn (graph::Graph& g, const char* from, const char* out, const char* to, const char* in)
{
    graph::Wire w;
    w.from = { from, out };
    w.to = { to, in };
    g.root.wires.push_back (std::move (w));
}
}   // namespace

void playClip (graph::Node& node, const std::string& file)
{
    node.settings["clip"] = file;
    node.params["drive"] = "run";
    node.params["repeat"] = "loop";
}

graph::Graph graphOfClip (const std::filesystem::path& file)
{
    graph::Graph g;
    g.name = file.stem().string();
    g.about = filled (TRANS ("Plays the clip %1 over and over."), file.filename().string()).toStdString();
    g.rate_hz = 4000.0;
    g.folder = file.parent_path().string();
    const Json hand { { "stiffness", "600 N/m" }, { "damping", "6 N*s/m" }, { "path", "hold" } };
    const Json guard { { "max_force", "6 N" } };
    g.devices.emplace_back (clip_role, Json { { "driver", "sim" }, { "mass", "50 g" }, { "damping", "1 N*s/m" }, { "hand", hand }, { "guard", guard } });
    addTo (g, "clip", clip_type, 0.0);
    addTo (g, "hand", "device.position", 0.0, 208.0);   // to wire, such as for a clip along the path
    addTo (g, "up", "vector.join", 288.0);
    addTo (g, "motor", "device.force", 576.0);
    playClip (g.root.nodes.front(), file.filename().string());
    g.root.nodes.front().params["gain"] = "1 N";
    wireIn (g, "clip", "value", "up", "z");
    wireIn (g, "up", "out", "motor", "force");
    return g;
}

}   // namespace tactus::host
