// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_curve.hpp"
#include "overwriting.hpp"
#include "report.hpp"
#include "surface_preset.hpp"

#include <host/io/plot.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/curve_fit.hpp>
#include <tactus/text/quote.hpp>

#include <filesystem>
#include <iostream>
#include <memory>

namespace tactus::host
{

namespace
{
struct FitCurveOptions
{
    std::string recording, preset, plot;
    std::string depth = "depth", depth_unit = "1 m", force = "force", force_unit = "1 N", touch;
    double mu = 0.3, ratio = 0.45;
    int points = 20;
};

RecordedLoop readIndentation (const FitCurveOptions& options)
{
    const double metres = readAmount ("--depth-unit", options.depth_unit, "m", "1 um"), newtons = readAmount ("--force-unit", options.force_unit, "N", "1 mN");
    const double touch = options.touch.empty() ? 0.0 : readAmount ("--touch", options.touch, "m", "0.2 mm");
    const auto table = orFail (readTable (std::filesystem::path (options.recording)));
    const auto column = [&] (const std::string& name, double unit, const char* option) {
        const auto at = table.column (name);
        if (! at)
            fail (Message::error ("fit/column", options.recording, "there is no column " + quote (name),
                                  std::string ("give the name of the column with ") + option));
        std::vector<double> values;
        for (std::size_t r = 0; r < table.rows(); ++r)
            values.push_back (unit * table.at (r, *at));
        return values;
    };
    RecordedLoop loop { .depth = column (options.depth, metres, "--depth"), .force = column (options.force, newtons, "--force") };
    for (double& d : loop.depth)
        d -= touch;
    return loop;
}

void describe (const CurveFit& fit, const Json& curves, const std::string& file)
{
    std::cout << printableName (file) << ": " << fit.depth_in.size() << " rows on the way in, " << fit.depth_out.size() << " on the way out, "
              << rounded (1e3 * fit.law.table.x.back()) << " mm deep, at most " << rounded (fit.peak) << " N\n"
              << "  residual    " << rounded (fit.residual) << " N rms, " << rounded (100.0 * fit.residual / fit.peak, 2) << " % of the peak\n";
    if (fit.out.empty())
        std::cout << "  hysteresis  unknown: the way out was not recorded\n";
    else
        std::cout << "  hysteresis  " << rounded (1e3 * fit.area, 6) << " mJ, " << rounded (100.0 * fit.area / fit.work, 2)
                  << " % of the work on the way in; the curve is the mean of both ways and loses nothing\n";
    std::cout << "  for deform.plane    \"law\": " << toJson (fit.law).dump() << "\n"
              << "  for deform.surface  \"curves\": " << curves.at ("curves").dump() << ", \"mu\": " << curves.at ("mu").dump() << "\n";

    constexpr double much = 0.02;
    if (fit.drop > much * fit.peak)
        std::cerr << printableName (file) << ": warning: the recorded force falls by up to " << rounded (fit.drop)
                  << " N as the depth grows; the curve is flat there\n"
                  << "    a curve of deform.surface does not snap: for a button or a cut, see the presets tactile_key and potato_cut [fit/falls]\n";
}

void draw (const CurveFit& fit, const std::string& name, const std::string& file)
{
    Axes axes { .x = { "depth", "m" }, .y = { "force", "N" }, .series = { { .label = "recorded, on the way in", .x = fit.depth_in, .y = fit.force_in } } };
    if (! fit.depth_out.empty()) axes.series.push_back ({ .label = "recorded, on the way out", .x = fit.depth_out, .y = fit.force_out });
    auto x = fit.law.table.x, y = fit.law.table.y;
    x.insert (x.begin(), 0.0);
    y.insert (y.begin(), 0.0);
    axes.series.push_back ({ .label = "curve", .x = x, .y = y });
    orFail (writeFigure ({ .title = name, .panels = { axes } }, file));
}

void fitCurve (const FitCurveOptions& options)
{
    std::vector<std::string> outputs { options.preset };
    if (! options.plot.empty()) outputs.push_back (options.plot);
    refuseOverwriting (outputs, { options.recording });

    auto fitted = tactus::fitCurve (readIndentation (options), options.points);
    if (! fitted) fail (Message::error (fitted.error().id, options.recording, fitted.error().text, fitted.error().remedy));
    const auto& fit = *fitted;

    const auto name = std::filesystem::path (options.recording).filename().string();
    const EvenBody body { .along = fit.law, .mu = options.mu, .ratio = options.ratio };
    std::string about = "An even body with the curve of a recorded indentation.";
    if (! fit.out.empty()) about += " The recording lost " + rounded (1e3 * fit.area) + " mJ per push; this body loses energy only by friction.";
    const auto source = "`tactus fit curve` from " + name + ": residual " + rounded (100.0 * fit.residual / fit.peak, 2) + " % of the peak";
    orFail (saveGraph (surfacePreset (body, std::filesystem::path (options.preset).stem().string(), about, source), options.preset));
    if (! options.plot.empty()) draw (fit, name, options.plot);
    describe (fit, curvesOf (body), options.recording);
    std::cout << "wrote " << printableName (options.preset) << "\n";
}
}   // namespace

void addFitCurve (const Command& fit)
{
    const auto options = std::make_shared<FitCurveOptions>();
    const auto curve = fit.add ("curve", "Fit a curve of deform.surface to a recorded indentation");
    curve.addOption ("recording", options->recording, "CSV file with a column of depths and one of forces, in the order of time").required();
    curve.addOption ("-o,--out", options->preset, "The preset to write: a graph file").required();
    curve.addOption ("--depth", options->depth, "Name of the column of depths; default: depth");
    curve.addOption ("--depth-unit", options->depth_unit, "What 1 in this column means, such as \"1 um\"; default: 1 m");
    curve.addOption ("--force", options->force, "Name of the column of forces; default: force");
    curve.addOption ("--force-unit", options->force_unit, "What 1 in this column means, such as \"9.80665 mN\"; default: 1 N");
    curve.addOption ("--touch", options->touch, "Depth in the recording at which the tool touches the object, such as \"0.2 mm\"; default: 0");
    curve.addOption ("--points", options->points, "Number of points of the curve; default 20").check (within (2, 1000));
    curve.addOption ("--mu", options->mu, "Drag over push while the tool slides; default 0.3, a guess").check (finiteWithin (0.0, 10.0));
    curve.addOption ("--ratio", options->ratio, "Sideways deflection at which the tool slides, over its depth; default 0.45, a guess")
        .check (finiteWithin (1e-6, 1e3));
    curve.addOption ("--plot", options->plot, "Draw both ways and the curve into this PNG file");
    curve.footer ("The curve never falls and never pulls. It lies halfway between the way in and the way out, so a node that plays it gives\n"
                  "back what it takes; the energy that the recording lost is printed. Record slowly, and only along the normal.\n\n"
                  "Examples:\n"
                  "  tactus fit curve liver.csv -o liver.json --plot liver.png\n"
                  "  tactus fit curve switch.csv --depth x_um --depth-unit \"1 um\" --force force_gf --force-unit \"9.80665 mN\" -o switch.json");
    curve.callback ([options] { fitCurve (*options); });
}

}   // namespace tactus::host
