// SPDX-License-Identifier: GPL-3.0-or-later
// The reference vectors, passed through the whole program: a graph file, a feed, `tactus render`, and the table that it writes.

#include "program.hpp"

#include <golden/golden.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/text/json.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

using namespace tactus;
using test::Golden;

namespace
{
using Map = std::map<std::string, std::string>;   // maps ports to columns

/// Renders the graph with ports fed from columns of the set, and compares what it records with other columns.
void reproduce (const std::string& set, const std::string& graph, const Map& feeds, const Map& records, std::size_t rows = 0)
{
    const test::Scratch scratch;
    const Golden golden { set };

    std::vector<std::string> arguments { "render", scratch.write ("graph.json", graph), "--out", scratch.path ("out.csv") };
    if (! feeds.empty())
    {
        std::vector<std::string> names { "t" };
        for (const auto& [port, column] : feeds)
            names.push_back (port);
        auto feed = TableWriter::create (scratch.path ("feed.csv"), names);
        REQUIRE (feed);
        for (std::size_t r = 0; r < golden.rows(); ++r)
        {
            std::vector<double> row { golden (r, "t") };
            for (const auto& [port, column] : feeds)
                row.push_back (golden (r, column));
            REQUIRE (feed->row (row));
        }
        REQUIRE (feed->commit());
        arguments.insert (arguments.end(), { "--feed", scratch.path ("feed.csv") });
    }
    else
        arguments.insert (arguments.end(), { "--duration", std::to_string (static_cast<double> (golden.rows()) * golden.dt_s()) });
    for (const auto& [port, column] : records)
        arguments.insert (arguments.end(), { "--record", port });

    const auto ran = test::runTactus (arguments);
    INFO (ran.err);
    REQUIRE (ran.status == 0);

    const auto table = readTable (std::filesystem::path (scratch.path ("out.csv")));
    REQUIRE (table);
    REQUIRE (table->rows() == golden.rows());
    for (const auto& [port, column] : records)
    {
        const auto at = table->column (port);
        REQUIRE (at);
        INFO (column);
        double most = 0.0;
        for (std::size_t r = 0; r < (rows ? rows : golden.rows()); ++r)
        {
            const double error = std::abs (table->at (r, *at) - golden (r, column));
            const double allowed = column.find ("quant") != std::string::npos ? std::max (1e-6, golden.tolerance (column)) : golden.tolerance (column);
            REQUIRE (error <= allowed);
            most = std::max (most, allowed > 0.0 ? error / allowed : error);
        }
        CHECK (most <= 1.0);
    }
}

std::string graph (const std::string& nodes, const std::string& rest = R"("wires": [])")
{
    return R"({ "format": "tactus-graph", "version": 2, "name": "Reference", "rate_hz": 1000, "nodes": {)" + nodes + "}, " + rest + "}";
}

std::string friction (const std::string& name, const std::string& params)
{
    return "\"" + name + R"(": { "type": "friction.elasto_plastic", "params": {)" + params + "} }";
}
}   // namespace

TEST_CASE ("render reproduces the friction of a point on a line", "[golden]")
{
    const std::string common = R"("mu": 0.4, "d_max": "10 um")", scaled = common + R"(, "load": "scale")";
    const Map nodes { { "eq3", scaled },
                      { "euler2", scaled + R"(, "adhesion": "dupont", "integrator": "euler")" },
                      { "euler3", scaled + R"(, "adhesion": "ramp", "integrator": "euler")" },
                      { "euler4", scaled + R"(, "adhesion": "dahl", "integrator": "euler")" },
                      { "etd4", scaled + R"(, "adhesion": "dahl")" },
                      { "etd2", scaled + R"(, "adhesion": "dupont")" },
                      { "stickslip", scaled + R"(, "static_ratio": 2.5)" },
                      { "passive", common + R"(, "load": "passive")" } };
    std::string all;
    Map feeds, records { { "eq3.force.x", "f_eq3" }, { "eq3.state", "state_eq3" }, { "passive.force.x", "f_passive" } };
    for (const auto& [name, params] : nodes)
    {
        all += (all.empty() ? "" : ", ") + friction (name, params);
        feeds[name + ".position.x"] = "p";
        feeds[name + ".normal_force"] = "fn";
        if (name != "passive") records[name + ".deflection.x"] = "d_" + name;
    }
    reproduce ("friction_1d", graph (all), feeds, records);
}

TEST_CASE ("render reproduces friction with load bound, under a moving load, mu and d_max", "[golden]")
{
    const std::string common = R"("mu": 0.45, "d_max": "20 um")";
    const Map nodes { { "stick", common }, { "dahl", common + R"(, "adhesion": "dahl")" }, { "slip", common + R"(, "static_ratio": 2.2)" } };
    std::string all;
    Map feeds, records { { "stick.state", "state_stick" } };
    for (const auto& [name, params] : nodes)
    {
        all += (all.empty() ? "" : ", ") + friction (name, params);
        feeds[name + ".position.x"] = "p";
        feeds[name + ".normal_force"] = "fn";
        feeds[name + ".mu"] = "mu";
        feeds[name + ".d_max"] = "d_max";
        records[name + ".deflection.x"] = "d_" + name;
        records[name + ".force.x"] = "f_" + name;
    }
    reproduce ("friction_bound", graph (all), feeds, records);
}

TEST_CASE ("render reproduces the friction of a point on a turning surface", "[golden]")
{
    const std::string common = R"("mu": 0.6, "d_max": "50 um", "load": "scale")";
    const Map nodes {
        { "eq3", common },
        { "euler2", common + R"(, "adhesion": "dupont", "integrator": "euler")" },
        { "etd4", common + R"(, "adhesion": "dahl")" },
    };
    std::string all;
    Map feeds, records { { "eq3.state", "state_eq3" } };
    for (const auto& [name, params] : nodes)
    {
        all += (all.empty() ? "" : ", ") + friction (name, params);
        feeds[name + ".normal_force"] = "fn";
        for (const std::string axis : { "x", "y", "z" })
        {
            feeds[name + ".position." + axis] = "p_" + axis;
            feeds[name + ".normal." + axis] = "n_" + axis;
            records[name + ".force." + axis] = "f_" + name + "_" + axis;
            if (name == "eq3") records["eq3.deflection." + axis] = "d_eq3_" + axis;
        }
    }
    reproduce ("friction_3d", graph (all), feeds, records);
}

TEST_CASE ("render reproduces modes excited by hits", "[golden]")
{
    reproduce ("modal", graph (R"("bar": { "type": "vibration.modal", "settings": { "modes": [
        { "frequency": 100, "decay": 80, "amplitude": 1 }, { "frequency": 230, "decay": 30, "amplitude": 0.4 } ] } })"),
               { { "bar.hit", "hit_v" } }, { { "bar.value", "y_modal" } });
}

TEST_CASE ("render reproduces a wavetable excited by hits", "[golden]")
{
    reproduce ("modal", graph (R"("bar": { "type": "vibration.wavetable", "settings": { "table": { "modes": [
        { "frequency": 100, "decay": 80, "amplitude": 1 }, { "frequency": 230, "decay": 30, "amplitude": 0.4 } ], "rate": 8000, "length": 1200 } } })"),
               { { "bar.hit", "hit_v" } }, { { "bar.value", "y_wavetable" } });
}

TEST_CASE ("render reproduces gratings on a line and in the plane", "[golden]")
{
    reproduce ("texture", graph (R"("line": { "type": "texture.grating", "params": { "amplitude": "0.3 N", "spatial_frequency": "200 1/m" } },
                                    "guard": { "type": "texture.antialias", "params": { "spatial_frequency": "200 1/m", "f_max": "100 Hz" } },
                                    "plane": { "type": "texture.grating",
                                        "params": { "amplitude": "0.3 N", "spatial_frequency": "500 1/m", "angle": 0.9272952180016122 } })"),
               { { "line.position.x", "x" }, { "guard.position.x", "x" }, { "plane.position.x", "x" }, { "plane.position.y", "y" } },
               {
                   { "line.value", "grating1d" },
                   { "guard.gain", "guard" },
                   { "guard.speed", "v_diff" },
                   { "plane.force.x", "grating2d_x" },
                   { "plane.force.y", "grating2d_y" },
               });
}

TEST_CASE ("render reproduces a texture that fades in with depth, is filtered, and modulates friction", "[golden]")
{
    reproduce ("texture", graph (R"("grain": { "type": "texture.grating", "params": { "amplitude": "0.3 N", "spatial_frequency": "200 1/m" } },
                                    "guard": { "type": "texture.antialias", "params": { "spatial_frequency": "200 1/m", "f_max": "100 Hz" } },
                                    "window": { "type": "contact.window", "params": { "window": "0.5 mm" } },
                                    "layer": { "type": "signal.multiply", "settings": { "inputs": 3 } },
                                    "smooth": { "type": "filter.butterworth2", "params": { "cutoff": "120 Hz" } },
                                    "wave": { "type": "texture.grating", "params": { "amplitude": "1 N", "spatial_frequency": "200 1/m" } },
                                    "drag": { "type": "friction.elasto_plastic", "params": { "d_max": "0.1 mm", "stiffness": "4 N/mm", "load": "passive" } })",
                                 R"("wires": [ "grain.value -> layer.in[0]", "guard.gain -> layer.in[1]", "window.gain -> layer.in[2]",
                                               "layer.out -> smooth.in",
                                               { "wire": "wave.value -> (+) drag.d_max", "gain": "35 um/N" } ])"),
               {
                   { "grain.position.x", "x" },
                   { "guard.position.x", "x" },
                   { "window.depth", "dz" },
                   { "wave.position.x", "x" },
                   { "drag.position.x", "x" },
                   { "drag.normal_force", "dz" },
               },
               { { "layer.out", "windowed" }, { "smooth.out", "filtered" }, { "drag.force.x", "f_friction_mod" } });
}

TEST_CASE ("render reproduces an uneven patch that is pressed and stroked, with and without friction", "[golden]")
{
    std::ifstream file (std::string (TACTUS_SOURCE_DIR) + "/tests/golden/deformation.json");
    const auto params = Json::parse (std::string { std::istreambuf_iterator<char> (file), {} })["params"];
    Json surface {
        { "nodes", params["nodes"] },
        { "triangles", params["triangles"] },
        { "frames", params["frames_rows_ux_uy_uz"] },
        { "mu", params["mu_deflection"] },
    };
    for (const auto& tool : params["curves_tool_node_axis"])
    {
        auto& nodes = surface["curves"].emplace_back();
        for (const auto& node : tool)
        {
            auto& axes = nodes.emplace_back();
            for (const auto& law : node)
                axes.push_back (Json::object ({ { law[0], { law[1], law[2] } } }));
        }
    }
    const auto patch = [&] (const std::string& name, const std::string& friction) {
        return "\"" + name + R"(": { "type": "deform.surface", "params": { "friction": ")" + friction + R"(" }, "settings": { "surface": )"
               + surface.dump() + " } }";
    };

    Map feeds { { "rough.tool", "tool_weight" }, { "smooth.tool", "tool_weight" } };
    Map records { { "rough.stored_energy", "U" }, { "rough.state", "state" }, { "rough.triangle", "tri" } };
    for (const std::string axis : { "x", "y", "z" })
    {
        for (const std::string name : { "rough", "smooth" })
            feeds[name + ".position." + axis] = "p_" + axis;
        records["rough.force." + axis] = "f_" + axis;
        records["rough.contact." + axis] = "c_" + axis;
        records["smooth.force." + axis] = "g_" + axis;
    }
    reproduce ("deformation", graph (patch ("rough", "bound") + ", " + patch ("smooth", "frictionless")), feeds, records);
}

TEST_CASE ("render reproduces a tool pushed against a sampled wall", "[golden]")
{
    const auto wall = [] (const std::string& device, const std::string& params) {
        return graph (R"("hand": { "type": "device.position", "role": "tool" }, "truth": { "type": "device.truth", "role": "tool" },
                         "wall": { "type": "deform.plane", "params": { "normal": [-1, 0, 0], )"
                          + params + R"( } }, "motor": { "type": "device.force", "role": "tool" })",
                      R"("wires": [ "hand.position -> wall.position", "wall.force -> motor.force" ],
                         "devices": { "tool": { "driver": "sim", "mass": 0.1, "damping": 2, "position": [-1e-3, 0, 0],
                             "velocity": [0.1, 0, 0], "hand_force": [0.5, 0, 0])"
                          + device + "} }");
    };
    const auto records = [] (const std::string& name) -> Map {
        return { { "truth.position.x", "x_" + name }, { "truth.velocity.x", "v_" + name }, { "motor.force.x", "f_" + name } };
    };
    const std::string coupled = graph (R"("hand": { "type": "device.position", "role": "tool" }, "truth": { "type": "device.truth", "role": "tool" },
                         "wall": { "type": "coupling.virtual", "params": { "normal": [-1, 0, 0], "stiffness": 2400, "damping": 0.2, "wall_stiffness": 1e6 } },
                         "motor": { "type": "device.force", "role": "tool" })",
                                       R"("wires": [ "hand.position -> wall.position", "wall.force -> motor.force" ],
                         "devices": { "tool": { "driver": "sim", "mass": 0.1, "damping": 2, "position": [-1e-3, 0, 0],
                             "velocity": [0.1, 0, 0], "hand_force": [0.5, 0, 0] } })");
    constexpr std::size_t compared_tightly = 300;
    reproduce ("wallsim", coupled, {}, records ("vc"), compared_tightly);
    reproduce ("wallsim", wall ("", R"("stiffness": 3600)"), {}, records ("smooth"), compared_tightly);
    reproduce ("wallsim", wall ("", R"("stiffness": 1800, "damping": 0.4)"), {}, records ("damped"), compared_tightly);
    reproduce ("wallsim", wall (R"(, "quantum": 1e-5)", R"("stiffness": 1800)"), {}, { { "truth.position.x", "x_quant" } }, compared_tightly);
}

TEST_CASE ("render reproduces the passivity controller in both pairings, and the predictive hold", "[golden]")
{
    const auto controller = [] (const std::string& name, const std::string& pairing) {
        return "\"" + name + R"(": { "type": "safety.passivity", "params": { "alpha_max": 12, "pairing": ")" + pairing + R"(" } })";
    };
    Map feeds { { "ahead.in.x", "f_env" } }, records { { "ahead.out.x", "f_predictive" } };
    for (const std::string name : { "zoh", "hr" })
    {
        feeds[name + ".position.x"] = "p";
        feeds[name + ".force.x"] = "f_env";
        records[name + ".force.x"] = "f_out_" + name;
        records[name + ".energy"] = "E_" + name;
        records[name + ".alpha"] = "alpha_" + name;
    }
    const auto nodes = controller ("zoh", "zoh") + ", " + controller ("hr", "backward") + R"(, "ahead": { "type": "hold.predictive" })";
    reproduce ("passivity", graph (nodes), feeds, records);
}

TEST_CASE ("render reproduces a blade that ruptures a potato and cuts it", "[golden]")
{
    reproduce ("cutting", graph (R"("blade": { "type": "cut.blade", "params": { "width": 0.02, "toughness": 200, "rupture_force": 6 },
        "settings": { "law": { "power": [2000, 1] } } })"),
               { { "blade.depth", "delta" } },
               {
                   { "blade.resistance", "f" },
                   { "blade.crack", "crack" },
                   { "blade.stored_energy", "U" },
                   { "blade.dissipated_energy", "dissipated" },
                   { "blade.state", "state" },
               });
}

TEST_CASE ("render reproduces scissors that close on a plate", "[golden]")
{
    reproduce ("scissors", graph (R"("scissors": { "type": "cut.scissors", "params": { "thickness": "1 mm", "toughness": "2800 J/m2",
        "stiffness": 1e6, "pivot_distance": "1.5 mm" } })"),
               { { "scissors.angle", "theta" } },
               {
                   { "scissors.torque", "torque" },
                   { "scissors.crack_front", "crack" },
                   { "scissors.stored_energy", "U" },
                   { "scissors.dissipated_energy", "dissipated" },
               });
}

TEST_CASE ("render reproduces impacts on a hard object", "[golden]")
{
    reproduce ("shock", graph (R"("shock": { "type": "shock.hunt_crossley", "params": { "mass": "50 g" },
        "settings": { "stiffness": { "power": [5e5, 1.5] }, "damping": { "dissipation": 1 }, "substeps": 8, "voices": 4 } })"),
               { { "shock.hit", "trigger_v" } }, { { "shock.resistance", "f_semi_implicit" } });
}
