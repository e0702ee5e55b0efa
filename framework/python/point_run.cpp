// SPDX-License-Identifier: MIT
#include "point_run.hpp"

#include <tactus/kit/state_archive.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/node/node_fault.hpp>
#include <tactus/plan/flat/make_node.hpp>
#include <tactus/plan/prepared_shelf.hpp>
#include <tactus/plan/rules/examine.hpp>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace tactus::python
{

namespace
{
constexpr double most_ticks = 1e10;
}   // namespace

const DeviceOption* Job::deviceOf (const std::string& role) const
{
    const auto found = std::ranges::find (devices, role, &DeviceOption::role);
    return found != devices.end() ? &*found : nullptr;
}

PointRun::PointRun (const Job& j, std::size_t points) : job (j), goes_back (points > 1) {}

void PointRun::after (const Plan& plan, std::uint64_t, bool) noexcept
{
    for (auto& gauge : gauges)
        gauge.add (plan.taps(), 1.0 / rate_hz);
    if (! job.keeps || row + columns.size() > rows.size()) return;
    for (const auto& tap : plan.taps())
        rows[row++] = *tap.value;
}

std::size_t PointRun::ticks() const
{
    double seconds = job.seconds;
    if (seconds <= 0.0 && job.feed) return job.feed->ticks();
    if (seconds <= 0.0)
        for (const auto& [role, d] : run->devices())
            seconds = std::max (seconds, d.device ? d.device->duration() : 0.0);
    const double count = std::ceil (seconds * rate_hz - 1e-6);
    if (! (count >= 1.0 && count <= most_ticks)) return 0;
    return job.feed ? std::min (job.feed->ticks(), static_cast<std::size_t> (count)) : static_cast<std::size_t> (count);
}

/// Compiles the graph for a point. Without errors, there is a run then.
void PointRun::begin (const CompileOptions& options, Messages& messages)
{
    const auto open = [this] (const std::string& role, const graph::Graph& graph, const Plan&, Messages& found) {
        const auto* mine = job.deviceOf (role);
        auto made = makeDevice (mine != nullptr ? mine->description : describedByGraph (graph.device (role), role, found),
                                mine != nullptr ? mine->folder : std::filesystem::path (graph.folder));
        for (auto& m : made.messages)
            m.where = "/devices/" + role + m.where;
        std::ranges::move (made.messages, std::back_inserter (found));
        return Run::RoleDevice { std::move (made.device), made.limits };
    };
    state.clear();
    run.emplace (catalogue(), options, open, Run::Queries::within_tick);
    messages = run->load (job.graph);
    if (! hasErrors (messages)) run->openDevices (job.graph, messages);
    if (hasErrors (messages)) return run.reset();
    columns.clear();
    units.clear();
    for (const auto& tap : run->engine().newest().taps())
    {
        columns.push_back (tap.name);
        units.push_back (tap.unit);
    }
    rate_hz = run->rate();
    fresh.clear();
    for (const auto& each : job.gauges)
        fresh.emplace_back (each, columns);
    if (job.feed) run->add (feed.emplace (*job.feed));
    run->add (*this);
    if (! goes_back) return;
    if (auto saved = run->save (job.graph)) state = std::move (*saved);
    goes_back = ! state.empty();
}

/// Gives a node the values of its parameters, and the state that it would have begun with. False if that needs a new node.
bool PointRun::set (const plan::Flat& flat, std::size_t i)
{
    const auto& now = flat.nodes[i];
    const auto& plan = run->engine().newest();
    const auto& instance = plan.instances()[i];
    const auto& type = *now.type;
    if (type.bind || type.serialize == nullptr || ! instance.knobs) return false;
    for (std::size_t p = 0, first = 0; p < type.params.size(); first += plan::Knobs::roomOf (type.params[p++]))
    {
        const auto values = flat.param (static_cast<int> (i), p);
        for (std::size_t k = 0; k < values.size(); ++k)
        {
            auto& knob = instance.knobs->all[first + k];
            knob.value = knob.to = values[k];
            instance.write (first + k, values[k]);
        }
    }
    if (type.update) type.update (instance.node.get());

    Setup setup { .rate_hz = rate_hz * flat.speed (now.section), .services = job.options.services };
    if (setup.services.prepared == nullptr) setup.services.prepared = &plan::preparedOfAll();
    const auto made = plan::makeNode (flat, static_cast<int> (i));
    const auto* role = type.learn ? plan.findRole (now.role) : nullptr;
    if (role != nullptr) type.learn (made.get(), DeviceState {}.layout.mechanics);   // as a plan does before it has devices
    if (type.prepare) type.prepare (made.get(), setup);
    if (type.update) type.update (made.get());
    if (role != nullptr) type.learn (made.get(), role->state->layout.mechanics);
    std::vector<std::byte> bytes;
    StateArchive saving { bytes };
    type.serialize (made.get(), saving);
    StateArchive restoring { std::span<const std::byte> (bytes) };
    type.serialize (instance.node.get(), restoring);
    return ! saving.isRefused() && ! restoring.isRefused() && restoring.isAtEnd();
}

/// Goes back to before the first tick, with the values of another point. False if the graph must be compiled for it.
bool PointRun::goBack (const CompileOptions& options, Messages& messages)
{
    if (! run || state.empty() || ! run->restore (state, job.graph)) return false;
    try
    {
        Setup setup { .rate_hz = rate_hz, .services = options.services };
        if (setup.services.prepared == nullptr) setup.services.prepared = &plan::preparedOfAll();
        auto found = plan::examine (job.graph, catalogue(), setup, options.overrides, options.assets).flattened;
        const auto& flat = found.flat;
        const auto& before = run->engine().newest().flat();
        if (flat.values.size() != before.values.size() || flat.nodes.size() != before.nodes.size()) return false;
        messages = std::move (found.flat.messages);
        if (hasErrors (messages)) return true;
        for (std::size_t i = 0; i < flat.nodes.size(); ++i)
        {
            const auto first = flat.nodes[i].values, end = i + 1 < flat.nodes.size() ? flat.nodes[i + 1].values : flat.values.size();
            const auto valuesOf = [&] (const plan::Flat& f) { return std::as_bytes (std::span (f.values).subspan (first, end - first)); };
            if (! std::ranges::equal (valuesOf (flat), valuesOf (before)) && ! set (flat, i)) return goes_back = false;
        }
        return true;
    }
    catch (const NodeFault&)
    {
        return false;   // compile() reports it
    }
}

void PointRun::render (const CompileOptions& options, Outcome& to)
{
    if (! goBack (options, to.messages)) begin (options, to.messages);
    if (hasErrors (to.messages)) return;
    const auto count = ticks();
    if (count == 0)
    {
        to.messages.push_back (Message::error ("run/no_length", "", "the length of the run is unknown, or more than 10^10 ticks", "give the duration in s"));
        return;
    }
    if (job.feed) *feed = *job.feed;
    gauges = fresh;
    row = 0;
    rows.assign (job.keeps ? count * columns.size() : 0, 0.0);
    for (std::size_t k = 0; k < count; ++k)
        run->tick();
    for (const auto& gauge : gauges)
        to.numbers.push_back (gauge.result());
    to.rows = std::move (rows);
}

}   // namespace tactus::python
