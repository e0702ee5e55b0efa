// SPDX-License-Identifier: MIT
#include "points.hpp"

#include "assets.hpp"
#include "gauge.hpp"
#include "graph.hpp"
#include "run.hpp"

#include <pybind11/stl.h>

#include <tactus/check/hands.hpp>
#include <tactus/check/trials/trials.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/node/catalogue.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <utility>

namespace tactus::python
{

namespace
{
using Rows = PythonRun::Rows;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double most_ticks = 1e10;

/// The graph and options that all points share.
struct Job
{
    graph::Graph graph {};
    CompileOptions options {};              // with the values that all points share
    std::vector<std::string> names {};      // of what varies
    std::vector<DeviceOption> devices {};   // instead of those of the graph
    std::vector<Gauge::Options> gauges {};
    double seconds = 0.0;     // 0: as long as the feed, or the longest path of a hand
    bool keeps = false;       // the records, too
    std::size_t places = 0;   // of the check of stability; 0: none
    std::optional<Feed> feed {};
};

struct Outcome
{
    std::vector<double> numbers {}, rows {};   // rows: tick by tick
    Messages messages {};
    std::vector<std::string> columns {}, units {};
    double seconds = 0.0, rate_hz = 0.0;
};

/// Computes the gauges of a run, and keeps its records if asked for.
class Listener final : public RunListener
{
public:
    Listener (const Job& job, Outcome& o, double step_s) : to (o), dt (step_s), keeps (job.keeps)
    {
        for (const auto& options : job.gauges)
            gauges.emplace_back (options, o.columns);
    }

    void after (const Plan& plan, std::uint64_t, bool) noexcept override
    {
        for (auto& gauge : gauges)
            gauge.add (plan.taps(), dt);
        if (! keeps || row + to.columns.size() > to.rows.size()) return;
        for (std::size_t i = 0; i < to.columns.size(); ++i)
            to.rows[row++] = *plan.taps()[i].value;
    }

    void finish() const
    {
        for (const auto& gauge : gauges)
            to.numbers.push_back (gauge.result());
    }

private:
    Outcome& to;
    std::vector<Gauge> gauges {};
    double dt;
    bool keeps;
    std::size_t row = 0;
};

const DeviceOption* given (const Job& job, const std::string& role)
{
    const auto found = std::ranges::find (job.devices, role, &DeviceOption::role);
    return found != job.devices.end() ? &*found : nullptr;
}

std::size_t ticksOf (const Job& job, const Run& run)
{
    double seconds = job.seconds;
    if (seconds <= 0.0 && job.feed) return job.feed->ticks();
    if (seconds <= 0.0)
        for (const auto& [role, d] : run.devices())
            seconds = std::max (seconds, d.device ? d.device->duration() : 0.0);
    const double ticks = std::ceil (seconds * run.rate() - 1e-6);
    if (! (ticks >= 1.0 && ticks <= most_ticks)) return 0;
    return job.feed ? std::min (job.feed->ticks(), static_cast<std::size_t> (ticks)) : static_cast<std::size_t> (ticks);
}

void render (const Job& job, const CompileOptions& options, Outcome& to)
{
    auto feed = job.feed;
    const auto open = [&] (const std::string& role, const graph::Graph& graph, const Plan&, Messages& messages) {
        const auto* mine = given (job, role);
        auto made = makeDevice (mine != nullptr ? mine->description : describedByGraph (graph.device (role), role, messages),
                                mine != nullptr ? mine->folder : std::filesystem::path (graph.folder));
        for (auto& m : made.messages)
            m.where = "/devices/" + role + m.where;
        std::ranges::move (made.messages, std::back_inserter (messages));
        return Run::RoleDevice { std::move (made.device), made.limits };
    };
    std::optional<Listener> listener;   // outlives the run
    Run run (catalogue(), options, open, Run::Queries::within_tick);
    to.messages = run.load (job.graph);
    if (hasErrors (to.messages) || ! run.hasEngine()) return;
    run.openDevices (job.graph, to.messages);
    if (hasErrors (to.messages)) return;
    for (const auto& tap : run.engine().newest().taps())
    {
        to.columns.push_back (tap.name);
        to.units.push_back (tap.unit);
    }
    to.rate_hz = run.rate();
    const auto ticks = ticksOf (job, run);
    if (ticks == 0)
    {
        to.messages.push_back (Message::error ("run/no_length", "", "the length of the run is unknown, or more than 10^10 ticks", "give the duration in s"));
        return;
    }
    if (job.keeps) to.rows.resize (ticks * to.columns.size());
    listener.emplace (job, to, 1.0 / run.rate());
    if (feed) run.add (*feed);
    run.add (*listener);
    for (std::size_t k = 0; k < ticks; ++k)
        run.tick();
    listener->finish();
}

/// 2: passive, at least along the motion. 1: stable. 0: it swings, or may swing. Not a number: not known.
double rankOf (check::Verdict verdict)
{
    switch (verdict)
    {
    case check::Verdict::passive:
    case check::Verdict::passive_here:
        return 2.0;
    case check::Verdict::stable:
        return 1.0;
    case check::Verdict::unstable:
    case check::Verdict::broken:
        return 0.0;
    default:
        return unknown;
    }
}

/// The worst verdict of the conditions `stiffness` and `coupling`, and their smallest known margin.
void judge (const Job& job, const CompileOptions& options, Outcome& to)
{
    const check::Subject subject { job.graph, catalogue(), options };
    std::vector<check::HandChoice> hands;
    for (const auto& d : job.devices)
        hands.push_back ({ d.role, d.description, d.folder });
    auto recorded = check::recordMotion (subject, hands, job.graph.folder, job.seconds);
    const bool is_broken = hasErrors (recorded.messages);
    std::ranges::move (recorded.messages, std::back_inserter (to.messages));
    if (is_broken) return;
    const auto compiled = compile (job.graph, catalogue(), options);
    std::vector<check::RoleDevice> devices;
    for (const auto& role : recorded.motion.roles)
    {
        const auto* mine = given (job, role.role);
        const auto* description = mine != nullptr ? &mine->description : job.graph.device (role.role);
        const auto folder = mine != nullptr ? mine->folder : std::filesystem::path (job.graph.folder);
        check::RoleDevice device { .role = role.role };
        if (const auto numbers = description != nullptr ? check::numbersOf (*description, folder) : std::nullopt)
        {
            device.numbers = *numbers;
            device.simulated = check::simulationOf (*description, folder);
        }
        devices.push_back (std::move (device));
    }
    const auto budget = check::affordableTicks (*compiled.plan);
    const auto demand = check::measure (subject, recorded.motion, { .places = job.places, .ticks = budget });
    const auto trials = check::tryLoops (subject, recorded.motion, demand, devices, { .ticks = budget / 2 });
    double rank = std::numeric_limits<double>::infinity(), margin = unknown;
    for (const auto& c : check::judge (demand, devices, { .trials = &trials }))
    {
        if (c.id != "stiffness" && c.id != "coupling") continue;
        const double r = rankOf (c.verdict);
        if (rank != 0.0 && (std::isnan (r) || r < rank)) rank = r;   // what swings is certain, whatever else is unknown
        if (c.isKnown()) margin = std::isnan (margin) ? c.margin() : std::min (margin, c.margin());
    }
    to.numbers.push_back (std::isinf (rank) ? unknown : rank);
    to.numbers.push_back (margin);
}

Outcome renderOne (const Job& job, const std::vector<Json>& values)
{
    Outcome outcome;
    auto options = job.options;
    for (std::size_t i = 0; i < values.size(); ++i)
        options.overrides.push_back ({ job.names[i], values[i] });
    const auto begin = std::chrono::steady_clock::now();
    try
    {
        render (job, options, outcome);
        if (job.places > 0 && ! hasErrors (outcome.messages)) judge (job, options, outcome);
    }
    catch (const std::invalid_argument& why)
    {
        outcome.messages.push_back (Message::error ("study/measure", "/measures", why.what(), "correct the measure"));
    }
    outcome.seconds = std::chrono::duration<double> (std::chrono::steady_clock::now() - begin).count();
    return outcome;
}

std::vector<Gauge::Options> gaugesOf (const py::list& described)
{
    static const std::map<std::string, Gauge::Kind> kinds {
        { "peak", Gauge::Kind::peak },
        { "max", Gauge::Kind::largest },
        { "min", Gauge::Kind::least },
        { "mean", Gauge::Kind::mean },
        { "rms", Gauge::Kind::rms },
        { "last", Gauge::Kind::last },
        { "work", Gauge::Kind::work },
        { "given", Gauge::Kind::given },
        { "reach", Gauge::Kind::reach },
        { "misfit", Gauge::Kind::misfit },
    };
    std::vector<Gauge::Options> all;
    for (const auto& each : described)
    {
        const auto from = each.cast<py::dict>();
        Gauge::Options options { .kind = kinds.at (from["kind"].cast<std::string>()), .port = from["port"].cast<std::string>() };
        if (from.contains ("position")) options.position = from["position"].cast<std::string>();
        if (from.contains ("level")) options.level = from["level"].cast<double>();
        if (from.contains ("hold")) options.hold_s = from["hold"].cast<double>();
        if (from.contains ("above")) options.is_above = from["above"].cast<bool>();
        if (from.contains ("reference"))
        {
            const auto values = from["reference"].cast<Rows>();
            options.reference.assign (values.data(), values.data() + values.size());
        }
        all.push_back (std::move (options));
    }
    return all;
}

py::dict renderPoints (const EditedGraph& graph, double rate_hz, std::vector<std::string> records, const std::map<std::string, std::string>& common,
                       std::vector<std::string> names, const std::vector<std::vector<std::string>>& values,
                       const std::map<std::string, std::string>& devices, const std::string& folder,
                       const std::optional<std::pair<std::vector<std::string>, Rows>>& table, py::object own_assets, double seconds,
                       const py::list& measures, bool keeps, std::size_t places)
{
    PythonAssets reader (std::move (own_assets));
    capi::CallerAssets assets (reader.reader());
    Job job;
    job.graph = graph.graph();
    job.options = { .rate_hz = rate_hz, .records = std::move (records), .assets = &assets };
    job.names = std::move (names);
    job.gauges = gaugesOf (measures);
    job.seconds = seconds;
    job.keeps = keeps;
    job.places = places;
    job.options.services.nearest_triangle = nearestByBoxes;
    for (const auto& [name, value] : common)
        job.options.overrides.push_back ({ name, jsonOf (value) });
    for (const auto& [role, description] : devices)
        job.devices.push_back ({ role, jsonOf (description), folder });
    if (table)
    {
        Table rows;
        rows.columns = table->first;
        rows.values.assign (table->second.data(), table->second.data() + table->second.size());
        auto feed = Feed::make (std::move (rows), "feed", rate_hz, job.graph.rate_hz);
        if (! feed) fail (std::move (feed).error());
        job.options.feeds = feed->drives();
        job.options.rate_hz = feed->rate();
        job.feed = std::move (*feed);
    }

    const auto width = job.gauges.size() + (places > 0 ? 2u : 0u);
    Rows numbers ({ static_cast<py::ssize_t> (values.size()), static_cast<py::ssize_t> (width) });
    Rows durations (static_cast<py::ssize_t> (values.size()));
    std::fill_n (numbers.mutable_data(), numbers.size(), unknown);
    py::list errors, kept;
    std::map<std::string, std::string> warnings;   // one of each kind and place
    Outcome latest;
    for (std::size_t k = 0; k < values.size(); ++k)
    {
        std::vector<Json> parsed;
        for (const auto& text : values[k])
            parsed.push_back (jsonOf (text));
        Outcome outcome;
        {
            const py::gil_scoped_release without_gil;
            outcome = renderOne (job, parsed);
            reader.release();
        }
        reader.raiseFailure();
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        durations.mutable_data()[k] = outcome.seconds;
        bool is_broken = false;
        for (const auto& m : outcome.messages)
        {
            if (m.severity != Message::Severity::error)
                warnings.emplace (m.id + ' ' + m.where, m.text);
            else if (! std::exchange (is_broken, true))
                errors.append (py::make_tuple (k, m.id, m.where, m.text));
        }
        if (! is_broken) std::ranges::copy (outcome.numbers, numbers.mutable_data() + k * width);
        if (keeps)
        {
            const auto count = outcome.columns.empty() || is_broken ? 0 : outcome.rows.size() / outcome.columns.size();
            kept.append (Rows ({ static_cast<py::ssize_t> (count), static_cast<py::ssize_t> (outcome.columns.size()) }, outcome.rows.data()));
        }
        if (! is_broken) latest = std::move (outcome);
    }
    py::dict all;
    all["numbers"] = numbers;
    all["seconds"] = durations;
    all["errors"] = errors;
    all["warnings"] = warnings;
    all["rows"] = kept;
    all["columns"] = latest.columns;
    all["units"] = latest.units;
    all["rate"] = latest.rate_hz;
    return all;
}
}   // namespace

void bindPoints (py::module_& module) { module.def ("render_points", &renderPoints); }

}   // namespace tactus::python
