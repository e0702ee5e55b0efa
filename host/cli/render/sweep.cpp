// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectrum_options.hpp"
#include "stroke.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/base/platform/signals.hpp>
#include <host/cli/amount.hpp>
#include <host/cli/commands.hpp>
#include <host/cli/graph_argument.hpp>
#include <host/cli/overwriting.hpp>
#include <host/cli/progress.hpp>
#include <host/cli/report.hpp>
#include <host/cli/run_options.hpp>
#include <host/devices/sessions/audio_settings.hpp>
#include <host/tools/fitting/surface_preset.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/run/run.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/closest_match.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/read_number.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <iostream>
#include <iterator>
#include <memory>
#include <utility>

namespace tactus::host
{

namespace
{
struct SweepOptions
{
    std::string graph, role, speeds, length = "60 mm", depth = "1 mm";
    std::vector<std::string> sets;
    double rate_hz = 0.0;
    int steps = 48;
    bool as_map = false;
    SpectrumOptions picture;
};

/// Reads LOW..HIGH, in m/s.
Extent readSpeeds (const std::string& text)
{
    const auto dots = text.find ("..");
    const auto read = [] (std::string_view part) { return wholeNumber (part).value_or (0.0); };
    const Extent range { dots == text.npos ? 0.0 : read (std::string_view (text).substr (0, dots)),
                         dots == text.npos ? 0.0 : read (std::string_view (text).substr (dots + 2)) };
    if (! (range.low >= 1e-4 && range.low < range.high && range.high <= 100.0))
        throw UsageError ("--speed", quote (text) + " is not a range of speeds in m/s, such as 0.02..0.3");
    return range;
}

void refuseIfStopped()
{
    if (stopRequested()) fail ("run/interrupted", "stopped; nothing was written", "run it again, or with fewer --steps");
}

/// Runs strokes over a graph, and keeps the samples of a port.
class Strokes
{
public:
    explicit Strokes (const SweepOptions& o) : options (o), loaded (loadGraph (o.graph))
    {
        if (report (loaded.messages, loaded, options.graph) > 0) throw Stop {};
    }

    const std::string& name() const { return loaded.graph.name; }
    double rate() const { return options.rate_hz > 0.0 ? options.rate_hz : loaded.graph.rate_hz; }

    PortSamples samplesOf (const Stroke& stroke)
    {
        CompileOptions compile { .rate_hz = options.rate_hz,
                                 .records = options.picture.records(),
                                 .overrides = readSets (options.sets),
                                 .assets = &assets,
                                 .services = { .nearest_triangle = nearestByBoxes } };
        Run run { catalogue(), std::move (compile), [&] (const std::string& role, const graph::Graph&, const Plan&, Messages&) {
                     return role == moved ? Run::RoleDevice { std::make_unique<StrokeDevice> (stroke) } : Run::RoleDevice {};
                 } };
        auto messages = run.load (loaded.graph);
        if (! run.hasEngine()) messages.push_back (Message::error ("run/no_plan", "", "the graph does not compile", "correct the problems above"));
        if (hasErrors (messages) || ! is_reported) report (messages, loaded, options.graph);
        if (hasErrors (messages)) throw Stop {};
        if (! std::exchange (is_reported, true)) moved = choose (run.engine().newest());
        Messages of_devices;
        run.openDevices (loaded.graph, of_devices);
        PortSamples samples { run.engine().plan().taps(), run.rate() };
        const auto ticksIn = [&] (double seconds) { return static_cast<std::size_t> (std::llround (seconds * run.rate())); };
        const auto lead_in = ticksIn (Stroke::lead_in_s), length = std::max<std::size_t> (16, ticksIn (stroke.length / stroke.speed));
        for (std::size_t k = 0; k < lead_in + length; ++k)
        {
            run.tick();
            if (k >= lead_in) samples.frame (run.engine().plan());
            refuseIfStopped();
        }
        return samples;
    }

private:
    /// The role that makes the strokes.
    std::string choose (const Plan& plan) const
    {
        std::vector<std::string> roles;
        for (const auto& role : plan.roles())
            if (const auto* described = loaded.graph.device (role.name); described == nullptr || ! audio::isAudio (*described)) roles.push_back (role.name);
        if (roles.empty()) fail ("sweep/no_hand", "the graph has no hand that could make a stroke", "add a device.position, and connect it");
        if (options.role.empty()) return roles.front();
        if (std::ranges::count (roles, options.role) > 0) return options.role;
        fail (Message::error ("device/unknown_role", "--role", "the graph has no role " + quote (options.role) + didYouMean (options.role, roles),
                              "name one of its roles"));
    }

    const SweepOptions& options;
    LoadedGraph loaded;
    FileAssets assets;
    std::string moved;
    bool is_reported = false;
};

/// The period of the pattern on the surface, in m, from the strongest lines; 0 if these are not in proportion to the speed.
double periodOf (const Spectrogram& s, double length)
{
    constexpr double fewest_periods = 5.0;   // on the stroke; fewer periods are the shape of the surface
    std::vector<double> per_metre;
    for (std::size_t i = 0; i < s.at.size(); ++i)
        if (const double hz = ridgeOf (s, i, fewest_periods * s.at[i] / length); hz > 0.0) per_metre.push_back (hz / s.at[i]);
    if (2 * per_metre.size() < s.at.size() || per_metre.size() < 3) return 0.0;
    const auto middle = per_metre.begin() + static_cast<std::ptrdiff_t> (per_metre.size() / 2);
    std::ranges::nth_element (per_metre, middle);
    const auto agree = std::ranges::count_if (per_metre, [&, most = *middle] (double k) { return std::abs (k - most) < 1.5 / length; });
    return 4 * static_cast<std::size_t> (agree) >= 3 * per_metre.size() ? 1.0 / *middle : 0.0;
}

void drawSpectra (const SweepOptions& options, const std::string& name, double length, const std::vector<double>& speeds,
                  const std::vector<PortSamples>& strokes)
{
    std::size_t longest = 0;
    for (const auto& s : strokes)
        longest = std::max (longest, s.all().front().size());
    const auto fft_length = 2 * std::bit_ceil (longest);   // the same for all, so that their lines are at the same frequencies
    const double rate_hz = strokes.front().rate();
    Spectrogram spectra { .at = speeds, .step_hz = rate_hz / static_cast<double> (fft_length) };
    for (const auto& s : strokes)
    {
        refuseIfStopped();
        const std::vector<std::span<const double>> parts (s.all().begin(), s.all().end());
        spectra.columns.push_back (amplitudesOf (parts, rate_hz, fft_length, options.picture.up_to_hz));
    }
    options.picture.write (name + ": " + strokes.front().name(), { "speed", "m/s" }, spectra, strokes.front().unit());
    if (const double period = periodOf (spectra, length); period > 0.0)
        std::cout << "the strongest frequency is the speed divided by " << roundedText (1e3 * period, 3) << " mm: " << roundedText (speeds.front() / period, 3)
                  << " to " << roundedText (speeds.back() / period, 3) << " Hz\n";
}

/// Draws the force, or the quantity of the port, against position and speed.
void drawPlaces (const SweepOptions& options, const std::string& name, double length, const std::vector<double>& speeds,
                 const std::vector<PortSamples>& strokes)
{
    constexpr std::size_t most_places = 400;
    std::size_t places = most_places;
    for (const auto& s : strokes)
        places = std::min (places, s.all().front().size());
    const double step = length / static_cast<double> (places), half = 0.5 * (speeds[1] - speeds[0]);
    HeatMap map { .x = { -0.5 * length, 0.5 * length }, .y = { speeds.front() - half, speeds.back() + half }, .columns = places, .rows = speeds.size() };
    map.values.resize (map.columns * map.rows);
    std::vector<std::vector<double>> rows;
    for (std::size_t r = 0; r < strokes.size(); ++r)
    {
        const auto& along = strokes[r].all().front();
        auto& row = rows.emplace_back();
        for (std::size_t c = 0; c < places; ++c)
        {
            const auto from = c * along.size() / places, to = (c + 1) * along.size() / places;
            double sum = 0.0;
            for (auto i = from; i < to; ++i)
                sum += along[i];
            row.push_back (sum / static_cast<double> (to - from));
            map.values[c * map.rows + r] = row.back();
            if (isPlottable (row.back())) map.range.include (row.back());
        }
    }
    const auto& port = strokes.front();
    if (options.picture.isTable())
    {
        std::vector<std::string> columns;
        for (std::size_t c = 0; c < places; ++c)
        {
            const double x = (static_cast<double> (c) + 0.5) * step - 0.5 * length;
            columns.push_back ("x = " + roundedText (x) + " m (" + (port.unit().empty() ? "1" : port.unit()) + ")");
        }
        return options.picture.writeTable ("speed (m/s)", speeds, columns, rows);
    }
    map.range = widened (map.range, 0.0);
    map.colour = { port.component(), port.unit() };
    options.picture.write (name, { "position along the stroke", "m" }, { "speed", "m/s" }, std::move (map));
}

/// The samples of all strokes, and the lines of their spectra, are kept until the picture is drawn.
void checkSlowest (double seconds, double rate_hz, int steps)
{
    constexpr double most_ticks = 1 << 18;
    const double ticks = seconds * rate_hz;
    if (! (ticks <= most_ticks))
        throw UsageError ("--speed", "the slowest stroke would take " + roundedText (seconds, 3) + " s, which is " + std::to_string (std::llround (ticks))
                                         + " ticks; at most " + std::to_string (std::llround (most_ticks)) + " are analysed");
    if (const double numbers = ticks * steps; numbers > budgets().numbers)
        fail (overBudget ("sweep/too_long", &Budgets::numbers, "the strokes", numbers, "make fewer --steps, or faster or shorter strokes"));
}

void sweepSpeeds (SweepOptions& options)
{
    options.picture.finish();
    const auto range = readSpeeds (options.speeds);
    const double length = readAmount ("--length", options.length, "m", "60 mm"), depth = readAmount ("--depth", options.depth, "m", "1 mm");
    refuseOverwriting ({ options.picture.file }, { options.graph });
    watchForStop();
    Strokes source { options };
    checkSlowest (length / range.low, source.rate(), options.steps);
    std::vector<double> speeds;
    std::vector<PortSamples> strokes;
    Progress progress { static_cast<std::size_t> (options.steps) };
    for (int i = 0; i < options.steps; ++i)
    {
        speeds.push_back (range.low + range.size() * i / (options.steps - 1));
        strokes.push_back (source.samplesOf ({ speeds.back(), length, depth }));
        progress (static_cast<std::size_t> (i));
    }
    options.as_map ? drawPlaces (options, source.name(), length, speeds, strokes) : drawSpectra (options, source.name(), length, speeds, strokes);
}
}   // namespace

void addSweep (const Command& app)
{
    const auto options = std::make_shared<SweepOptions>();
    const auto command = app.add ("sweep", "Make strokes at constant speeds, and plot their frequencies against the speed as a map");
    command.addOption (
               "graph", [options] (const std::string& given) { options->graph = graphArgument (given); },
               "A graph file, such as graphs/dry_wood.json, or the name of a preset, such as dry_wood")
        .required();
    command.addOption ("--speed", options->speeds, "The slowest and the fastest stroke in m/s, such as 0.02..0.3").required();
    options->picture.addTo (command);
    command.addOption ("--steps", options->steps, "Number of strokes, each at another speed; default: 48").check (within (2, 1000));
    command.addOption ("--length", options->length, "Length of each stroke, along x around the origin; default: 60 mm");
    command.addOption ("--depth", options->depth, "How deep the tool is below z = 0; default: 1 mm");
    command.addOption ("--role", options->role, "The role that makes the strokes; the others are at rest at the origin; default: the first one");
    command.addFlag ("--map", options->as_map, "Plot the force against position and speed instead of the frequencies; for a vector, its first component");
    command.addOption ("--rate", options->rate_hz, "Ticks per second; default: the graph's rate").check (finiteWithin (1.0, 1e6));
    command.addOption ("--set", options->sets, "Set a parameter, NODE.PARAM=VALUE, or a control, CONTROL=0…1; may be given more than once").oneValueEach();
    addLimits (command);
    addPlugins (command);
    command.footer ("A pattern on the surface with a period p gives a line: its frequency is the speed divided by p. A resonance keeps its frequency.\n"
                    "Forces do not change the speed of the tool. The tool moves for 0.2 s before a stroke begins.\n"
                    "A table has a row for each speed, and a column for each frequency or position.\n\n"
                    "Examples:\n"
                    "  tactus sweep dry_wood --speed 0.02..0.3 -o wood.png\n"
                    "  tactus sweep dry_wood --speed 0.02..0.3 --port grain.force --up-to 400 -o grain.pdf\n"
                    "  tactus sweep dry_wood --speed 0.02..0.3 --map --length \"10 mm\" -o places.png");
    command.callback ([options] { sweepSpeeds (*options); });
}

}   // namespace tactus::host
