// SPDX-License-Identifier: GPL-3.0-or-later
#include "limit_regions.hpp"

#include <host/base/platform/signals.hpp>
#include <host/cli/commands.hpp>
#include <host/cli/graph_argument.hpp>
#include <host/cli/overwriting.hpp>
#include <host/cli/progress.hpp>
#include <host/cli/render/figure_size.hpp>
#include <host/cli/run_options.hpp>
#include <host/tools/figures/plot.hpp>
#include <tactus/check/report.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/json_writer.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>
#include <utility>

namespace tactus::host
{

namespace
{
struct LimitsOptions : FigureSize
{
    std::string graph, role, x, y, file;
    std::vector<std::string> devices, sets;
    double rate_hz = 0.0, duration_s = 0.0;
    int steps = 40;
    bool json = false;
};

std::string number (double v) { return roundedText (v, 3); }

std::string padded (std::string text, std::size_t width)
{
    text.resize (std::max (width, text.size() + 1), ' ');
    return text;
}

std::string describe (const std::optional<Range>& r, bool is_least)
{
    if (! r) return "nowhere";
    if (is_least) return (r->is_low_known ? "at least " : "unknown below ") + number (r->low);
    if (std::isinf (r->high)) return "any";
    const auto most = (r->is_high_known ? "at most " : "unknown above ") + number (r->high);
    return most + (r->low > 0.0 && r->low > 0.01 * r->high ? ", at least " + number (r->low) : "");
}

void print (const LimitRegions& report, Contact& contact, const LimitsOptions& options, const Limits& passive, const Limits& stable)
{
    const auto& here = report.workingPoint();
    const auto& device = contact.device().device;
    const double B = contact.damping();
    std::cout << printableName (options.graph) << " at " << numberText (contact.rate()) << " Hz, " << printableName (device.role) << " on "
              << printableName (device.name) << ": " << check::describe (device.numbers) << '\n';
    std::cout << "the heaviest contact" << (contact.axis().empty() ? "" : " of the axis " + quote (contact.axis())) << ", "
              << (contact.node().empty() ? "" : quote (contact.node()) + " ") << "at " << number (contact.time()) << " s: stiffness "
              << number (here.stiffness) << " N/m, virtual damping " << number (here.damping) << " N*s/m; "
              << (here.passive (B) < 0.0 ? "passive"
                  : here.rests() < 0.0   ? "stable, but not passive"
                  : here.radius          ? "it swings"
                                         : "not passive; its loop is not known")
              << "\n\n";
    const auto row = [] (const std::string& what, const std::string& now, const std::string& is_passive, const std::string& is_stable) {
        std::cout << "  " << padded (what, 26) << padded (now, 12) << padded (is_passive, 34) << is_stable << '\n';
    };
    const auto rests = [&] (const std::optional<Range>& r, bool is_least) { return here.radius ? describe (r, is_least) : std::string ("unknown"); };
    row ("", "now", "passive (sufficient)", "stable");
    row ("stiffness (N/m)", number (here.stiffness), describe (passive.stiffness, false), rests (stable.stiffness, false));
    row ("virtual damping (N*s/m)", number (here.damping), describe (passive.damping, false), rests (stable.damping, false));
    row ("rate (Hz)", number (contact.rate()), describe (passive.rate, true), rests (stable.rate, true));
    std::cout << "  varied: " << (contact.stiffnessParam().empty() ? "the whole response" : printableName (contact.stiffnessParam())) << ", "
              << (contact.dampingParam().empty() ? "a damper along the steepest direction" : printableName (contact.dampingParam()))
              << "; the slopes at one place of the motion, without quanta and dry friction: `tactus check` lets go of the tool\n";
    if (const auto& n = device.numbers; std::isfinite (here.stiffest_held))
        std::cout << "  sensor of " << number (1e6 * n.quantum->value) << " um and dry friction of " << number (n.coulomb->value)
                  << " N: rests where it is held up to " << number (here.stiffest_held) << " N/m (2 f_f/delta), without blows up to a damping of "
                  << number (here.quietest_damper) << " N*s/m over one tick (f_f T/delta); both are sufficient (Abbott & Okamura 2005; Diolaiti et al. 2006)\n";
    std::cout << "\nfootnote 2 of the chapter: b < 2M/T + 4B/3 " << (here.damperHolds() < 0.0 ? "holds" : "is broken") << " (" << number (here.damping)
              << " of " << number (here.largest_damper) << " N*s/m); sigma T < b + B " << (here.footnote (B) < 0.0 ? "holds" : "is broken") << " ("
              << number (here.stiffness * here.period_s) << " of " << number (here.damping + B) << " N*s/m)\n";
}

Json toJson (const std::optional<Range>& r)
{
    if (! r) return {};
    Json range { { "from", r->low }, { "to", std::isfinite (r->high) ? Json (r->high) : Json() } };
    if (! r->is_low_known) range["unknown_below"] = r->low;
    if (! r->is_high_known) range["unknown_above"] = r->high;
    return range;
}

Json toJson (const Limits& l) { return Json { { "stiffness", toJson (l.stiffness) }, { "damping", toJson (l.damping) }, { "rate", toJson (l.rate) } }; }

bool isTable (const std::string& file) { return file.ends_with (".csv"); }
bool isJson (const std::string& file) { return file.ends_with (".json"); }

void run (LimitsOptions& options)
{
    if (! options.file.empty() && ! isTable (options.file) && ! isJson (options.file) && ! isFigureFile (options.file))
        throw UsageError ("--out", quotePath (options.file) + " should end in " + figure_kinds + ", in .csv or in .json");
    if (options.x.empty() != options.y.empty()) throw UsageError ("--x and --y: give both, or none");
    options.readSize();
    refuseOverwriting ({ options.file }, { options.graph });
    const CheckedGraph graph { options.graph, options.devices, options.sets, options.rate_hz };
    const auto& roles = graph.roles;
    if (! options.role.empty() && std::ranges::none_of (roles, [&] (const CheckedRole& r) { return r.device.role == options.role; }))
    {
        std::vector<std::string> names;
        for (const auto& r : roles)
            names.push_back (r.device.role);
        fail (Message::error ("device/unknown_role", "--role", "the graph has no role " + quote (options.role) + didYouMean (options.role, names),
                              "name one of its roles"));
    }
    std::vector<std::string> params;
    std::vector<Varied> axes;
    if (! options.x.empty()) axes = { readVaried ("--x", options.x, *graph.plan, params), readVaried ("--y", options.y, *graph.plan, params) };
    if (axes.size() == 2 && axes[0].name == axes[1].name) throw UsageError ("--y", quote (axes[1].name) + " is already along --x");
    watchForStop();

    Contact contact { graph.subject, graph.motion (options.duration_s), roles, *graph.plan, options.role };
    LimitRegions limits { options.steps, contact };
    limits.vary (axes);
    const auto passive = limits.limitsOf (LimitRegions::Rule::passive), stable = limits.limitsOf (LimitRegions::Rule::stable);
    const auto report = [&] {
        const auto& here = limits.workingPoint();
        Json all { { "graph", graph.loaded.graph.name },
                   { "role", contact.device().device.role },
                   { "device", contact.device().device.name },
                   { "rate_hz", contact.rate() } };
        if (! contact.axis().empty()) all["axis"] = contact.axis();
        all["node"] = contact.node();
        all["t"] = contact.time();
        all["stiffness"] = here.stiffness;
        all["damping"] = here.damping;
        all["stiffness_param"] = contact.stiffnessParam();
        all["damping_param"] = contact.dampingParam();
        all["load"] = here.load;
        all["radius"] = here.radius ? Json (*here.radius) : Json();
        all["largest_damper"] = here.largest_damper;
        all["passive"] = toJson (passive);
        all["passive"]["rule"] = "sufficient";
        all["stable"] = toJson (stable);
        if (std::isfinite (here.stiffest_held))
            all["quanta"] = Json { { "rule", "sufficient" }, { "stiffness", here.stiffest_held }, { "damping", here.quietest_damper } };
        return all;
    };
    if (options.json)
        std::cout << writeJson (report());
    else
        print (limits, contact, options, passive, stable);
    if (options.file.empty()) return;

    std::vector<View> views;
    if (axes.empty())
        views = limits.usualViews (stable);
    else
    {
        for (auto& v : axes)
        {
            if (v.what == Varied::What::stiffness) v.now = limits.workingPoint().stiffness;
            if (v.what == Varied::What::damping) v.now = limits.workingPoint().damping;
            if (v.what == Varied::What::rate) v.now = contact.rate();
        }
        views.push_back ({ "", axes[0], axes[1] });
    }
    if (isFigureFile (options.file))
    {
        Figure figure { .title = graph.loaded.graph.name + ": limits of the heaviest contact",
                        .panels = {},
                        .width = options.width,
                        .height = options.height,
                        .dpi = options.dpi };
        Progress progress { (std::isfinite (limits.workingPoint().stiffest_held) ? 6u : 4u) * views.size() };
        std::size_t done = 0;
        for (const auto& view : views)
            figure.panels.push_back (limits.draw (view, progress, done));
        return orFail (writeFigure (figure, options.file));
    }
    const auto rows = limits.rows (views);
    if (isTable (options.file))
    {
        auto table = orFail (TableWriter::create (options.file, limits.columns()));
        for (const auto& row : rows)
            orFail (table.row (row));
        return orFail (table.commit());
    }
    auto all = report();
    all["columns"] = Json::array();
    for (const auto& column : limits.columns())
        all["columns"].push_back (column);
    all["rows"] = Json::array();
    for (const auto& row : rows)
    {
        auto entry = Json::array();
        for (const double v : row)
            entry.push_back (std::isfinite (v) ? Json (v) : Json());
        all["rows"].push_back (std::move (entry));
    }
    orFail (writeTextFile (options.file, writeJson (all)));
}
}   // namespace

void addLimitsOf (const Command& app)
{
    const auto options = std::make_shared<LimitsOptions>();
    const auto command =
        app.add ("limits", "Find how stiff, damped and slow the heaviest contact of a graph may be to stay passive or stable, and plot it");
    command
        .addOption (
            "graph", [options] (const std::string& given) { options->graph = graphArgument (given); }, "The graph file, or the name of a preset")
        .required();
    command.addOption ("--device", options->devices, "The device or the hand of a role, as for `tactus check`; may be given more than once").oneValueEach();
    command.addOption ("--role", options->role, "The role whose contact is examined; default: the one with the heaviest contact");
    command.addOption ("--x", options->x, "What varies along x, in SI units: stiffness=FROM:TO, damping=FROM:TO, rate=FROM:TO or NODE.PARAM=FROM:TO");
    command.addOption ("--y", options->y, "What varies along y; without --x and --y: the damping over the stiffness, and the stiffness over the rate");
    command.addOption ("-o,--out", options->file,
                       std::string ("The file to write: ") + figure_kinds + " for a picture, .csv for a table, .json for all numbers");
    command.addOption ("--steps", options->steps, "Steps along each axis; default: 40").check (within (2, 400));
    options->addSize (command);
    command.addOption ("--rate", options->rate_hz, "Ticks per second; default: the graph's rate").check (finiteWithin (10.0, 1e5));
    command.addOption ("--duration", options->duration_s, "Length of the motion in s").check (finiteWithin (1e-3, 60.0));
    command.addOption ("--set", options->sets, "Set a parameter, NODE.PARAM=VALUE, or a control, CONTROL=0…1; may be given more than once").oneValueEach();
    command.addFlag ("--json", options->json, "Print JSON, for use by programs");
    addLimits (command);
    addPlugins (command);
    command.footer ("passive: sup of T/2 Re[(1 - e^-jwT) H]/(1 - cos wT) <= B (Colgate), which is sufficient. "
                    "stable: the sampled loop comes to rest without a hand and with the usual hands (docs/check.md).\n\n"
                    "Examples:\n"
                    "  tactus limits granite_wall\n"
                    "  tactus limits granite_wall -o wall.pdf\n"
                    "  tactus limits soft_pad --x stiffness=0:20000 --y damping=0:20 -o pad.png\n"
                    "  tactus limits granite_wall --x wall.stiffness=100:5000 --y rate=500:4000 --steps 20 -o wall.csv");
    command.callback ([options] { run (*options); });
}

}   // namespace tactus::host
