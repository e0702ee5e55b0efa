// SPDX-License-Identifier: MIT
#include "points.hpp"

#include "assets.hpp"
#include "graph.hpp"
#include "point_run.hpp"
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
        const auto* mine = job.deviceOf (role.role);
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

Outcome renderOne (const Job& job, PointRun& run, const std::vector<Json>& values)
{
    Outcome outcome;
    auto options = job.options;
    for (std::size_t i = 0; i < values.size(); ++i)
        options.overrides.push_back ({ job.names[i], values[i] });
    const auto begin = std::chrono::steady_clock::now();
    try
    {
        run.render (options, outcome);
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
    std::vector<Gauge::Options> all;
    for (const auto& each : described)
    {
        all.push_back ({ .kind = each["kind"].cast<std::string>(),
                         .port = each["port"].cast<std::string>(),
                         .position = each["position"].cast<std::string>(),
                         .level = each["level"].cast<double>(),
                         .hold_s = each["hold"].cast<double>(),
                         .is_above = each["above"].cast<bool>() });
        const auto reference = each["reference"].cast<Rows>();
        all.back().reference.assign (reference.data(), reference.data() + reference.size());
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
    PointRun run (job, values.size());
    for (std::size_t k = 0; k < values.size(); ++k)
    {
        std::vector<Json> parsed;
        for (const auto& text : values[k])
            parsed.push_back (jsonOf (text));
        Outcome outcome;
        {
            const py::gil_scoped_release without_gil;
            outcome = renderOne (job, run, parsed);
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
            const auto count = run.columns.empty() || is_broken ? 0 : outcome.rows.size() / run.columns.size();
            kept.append (Rows ({ static_cast<py::ssize_t> (count), static_cast<py::ssize_t> (run.columns.size()) }, outcome.rows.data()));
        }
    }
    py::dict all;
    all["numbers"] = numbers;
    all["seconds"] = durations;
    all["errors"] = errors;
    all["warnings"] = warnings;
    all["rows"] = kept;
    all["columns"] = run.columns;
    all["units"] = run.units;
    all["rate"] = run.rate_hz;
    return all;
}
}   // namespace

void bindPoints (py::module_& module) { module.def ("render_points", &renderPoints); }

}   // namespace tactus::python
