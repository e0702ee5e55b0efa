// SPDX-License-Identifier: GPL-3.0-or-later
#include "amount.hpp"
#include "commands.hpp"
#include "overwriting.hpp"
#include "report.hpp"

#include <host/tools/figures/plot.hpp>
#include <host/tools/fitting/surface_preset.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/half_space.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <numbers>

namespace tactus::host
{

namespace
{
struct CurveOptions
{
    std::string young, tool, depth = "2 mm", preset, plot;
    double poisson = 0.5, mu = 0.3;
    int points = 0;
};

/// A shape of tool whose curve has a closed form.
struct Shape
{
    const char *name, *about, *option, *option_about, *unit, *example;
    std::function<Law (const HalfSpace&, double size)> law;
    const char* formula;
};

/// The law as a table: it equals the law at evenly spaced depths.
Law tableOf (const Law& law, double depth, int points)
{
    Law table { .kind = Law::Kind::table };
    for (int i = 1; i <= points; ++i)
    {
        table.table.x.push_back (depth * i / points);
        table.table.y.push_back (law (table.table.x.back()));
    }
    return table;
}

void draw (const Shape& shape, const Law& law, double depth, const std::string& file)
{
    constexpr int points = 200;
    const Law fine = tableOf (law, depth, points);
    const Axes panel { .x = { "depth", "m" }, .y = { "force", "N" }, .series = { { .x = fine.table.x, .y = fine.table.y } } };
    const Figure figure { .title = shape.formula, .panels = { panel } };
    orFail (writeFigure (figure, file));
}

void compute (const Shape& shape, const CurveOptions& options)
{
    const double young = readAmount ("--young", options.young, "Pa", "10 kPa"), size = readAmount (shape.option, options.tool, shape.unit, shape.example);
    const double depth = readAmount ("--depth", options.depth, "m", "2 mm");
    if (shape.unit == std::string ("rad") && ! (size < 0.5 * std::numbers::pi)) throw UsageError (shape.option, "the angle must be below 90 deg");
    std::vector<std::string> outputs;
    for (const auto& output : { options.preset, options.plot })
        if (! output.empty()) outputs.push_back (output);
    refuseOverwriting (outputs, {});

    const HalfSpace body { .young = young, .poisson = options.poisson };
    const Law law = shape.law (body, size);
    if (const double deepest = law (depth); ! (deepest > 0.0 && std::isfinite (deepest)))
        fail ("curve/out_of_range", "the force at a depth of " + roundedText (depth, 3) + " m would be " + roundedText (deepest, 3) + " N",
              "correct the sizes and their units");
    const UniformBody even { .along = options.points > 0 ? tableOf (law, depth, options.points) : law,
                             .mu = options.mu,
                             .ratio = body.ratio (options.mu > 0.0 ? options.mu : 1.0) };

    const auto curves = curvesOf (even);
    std::cout << shape.formula << ", E* = " << roundedText (body.modulus(), 6) << " Pa: " << roundedText (law (depth), 6) << " N at "
              << roundedText (1e3 * depth, 3) << " mm\n"
              << "  for deform.plane    \"law\": " << toJson (even.along).dump() << "\n"
              << "  for deform.surface  \"curves\": " << curves.at ("curves").dump() << ", \"mu\": " << curves.at ("mu").dump() << "\n";
    if (! options.preset.empty())
    {
        const auto name = std::filesystem::path (options.preset).stem().string();
        const auto source = "`tactus curve " + std::string (shape.name) + "`: " + shape.formula + ", E = " + options.young + ", nu = "
                            + roundedText (options.poisson, 3)
                            + ", " + options.tool;
        const auto about = "A flat, homogeneous body, computed: " + std::string (shape.formula) + ".";
        orFail (saveGraph (surfacePreset (even, name, about, source), options.preset));
        std::cout << "wrote " << printableName (options.preset) << "\n";
    }
    if (! options.plot.empty()) draw (shape, law, depth, options.plot);
}

const Shape shapes[] {
    { "hertz", "The curve of a sphere, by Hertz", "--radius", "Radius of the sphere, such as \"5 mm\"", "m", "5 mm",
      [] (const HalfSpace& body, double radius) { return body.sphere (radius); }, "f = 4/3 E* sqrt (R) d^1.5" },
    { "punch", "The curve of the flat end of a cylinder, by Boussinesq", "--radius", "Radius of the cylinder, such as \"2 mm\"", "m", "2 mm",
      [] (const HalfSpace& body, double radius) { return body.punch (radius); }, "f = 2 a E* d" },
    { "cone", "The curve of a cone, by Sneddon", "--angle", "Angle between the axis and the side of the cone, such as \"60 deg\"", "rad", "60 deg",
      [] (const HalfSpace& body, double angle) { return body.cone (angle); }, "f = 2/pi E* tan (angle) d^2" },
};
}   // namespace

void addCurve (const Command& app)
{
    const auto command = app.add ("curve", "Compute the curve of force over depth of a large, flat, homogeneous elastic body");
    command.requireCommand();
    for (const auto& shape : shapes)
    {
        const auto options = std::make_shared<CurveOptions>();
        const auto one = command.add (shape.name, shape.about);
        one.addOption ("--young", options->young, "Young's modulus E, such as \"10 kPa\"").required();
        one.addOption (shape.option, options->tool, shape.option_about).required();
        one.addOption ("--poisson", options->poisson, "Poisson's ratio; 0.5, the default, is a body that keeps its volume, such as wet tissue")
            .check (finiteWithin (0.0, 0.5));
        one.addOption ("--mu", options->mu, "Drag over push while the tool slides; default 0.3").check (finiteWithin (0.0, 10.0));
        one.addOption ("--depth", options->depth, "Depth at which the force is printed, and where tables and plots end; default 2 mm");
        one.addOption ("--table", options->points, "Write the curve as a table with this many points up to --depth, instead of as a power of the depth")
            .check (within (1, 1000));
        one.addOption ("-o,--out", options->preset, "Also write a preset, a graph file in which a finger strokes this body");
        one.addOption ("--plot", options->plot, "Draw the curve into this PNG file");
        one.footer ("The tool is rigid, and the depth is small compared with its size. E* = E / (1 - nu^2). The sideways curve has the shape of the one\n"
                    "along the normal, so that drag over push is mu at every depth; it is not that of Cattaneo and Mindlin, which is stiffest at\n"
                    "first. The printed lines are settings of nodes,\n"
                    "in SI units, ready to be pasted into a graph file.\n\n"
                    "Examples:\n  tactus curve "
                    + std::string (shape.name) + " --young \"10 kPa\" " + shape.option + " \"" + shape.example + "\" -o body.json");
        one.callback ([options, shape] { compute (shape, *options); });
    }
}

}   // namespace tactus::host
