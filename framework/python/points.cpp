// SPDX-License-Identifier: MIT
#include "run.hpp"

#include <pybind11/stl.h>

#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/kit/state_archive.hpp>
#include <tactus/node/node_fault.hpp>
#include <tactus/plan/flat/make_node.hpp>
#include <tactus/plan/prepared_shelf.hpp>
#include <tactus/plan/rules/examine.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace tactus::python
{

namespace
{
constexpr double most_ticks = 1e10;

/// A run that renders one point after another. The graph is compiled for the first one. For each other point, the run goes back to before its first
/// tick, and the parameters that differ are set; a graph whose state cannot be saved is compiled again. Both give the same bits and messages.
class Points
{
public:
    using Rows = PythonRun::Rows;
    using Values = std::vector<std::string>;   // as JSON

    /// common: values that all points share, by parameter. names: what varies. seconds: of each render; 0: as long as the table, or the longest path of a
    /// hand.
    Points (const EditedGraph& g, double hz, std::vector<std::string> records, const std::map<std::string, std::string>& common, Values n,
            const std::optional<PythonRun::FeedTable>& table, py::object own_assets, double s)
        : graph (g.graph()), names (std::move (n)), seconds (s), assets (std::move (own_assets))
    {
        options = { .rate_hz = hz, .records = std::move (records), .services = { .nearest_triangle = nearestByBoxes } };
        for (const auto& [name, value] : common)
            options.overrides.push_back ({ name, jsonOf (value) });
        if (! table) return;
        auto made = feedOf (*table, hz, graph.rate_hz);
        if (! made) fail (std::move (made).error());
        options.feeds = made->drives();
        options.rate_hz = made->rate();
        first_feed = std::move (*made);
    }

    /// The records of some points, shape (points, ticks, columns); errors of points: number, id, place and text, and the numbers of a bad point are not
    /// numbers; and warnings, one of each kind and place.
    py::tuple render (const std::vector<Values>& points)
    {
        Rows all ({ py::ssize_t (points.size()), py::ssize_t (0), py::ssize_t (0) });
        py::list errors;
        py::dict warnings;
        for (std::size_t k = 0; k < points.size(); ++k)
        {
            Messages messages;
            auto at = options;
            for (std::size_t i = 0; i < points[k].size(); ++i)
                at.overrides.push_back ({ names[i], jsonOf (points[k][i]) });
            withoutGil ([&] { begin (at, messages); });
            if (tell (messages, k, errors, warnings)) continue;
            const auto width = count * columns.size();
            if (all.size() == 0)
            {
                all = Rows ({ points.size(), count, columns.size() });
                std::fill_n (all.mutable_data(), all.size(), std::numeric_limits<double>::quiet_NaN());
            }
            if (static_cast<std::size_t> (all.size()) != points.size() * width) throw std::length_error ("a point has other columns than those before it");
            withoutGil ([&, row = all.mutable_data() + k * width] { tactus_run_steps (run.get(), count, nullptr, row); });
        }
        return py::make_tuple (all, errors, warnings);
    }

    // Of the last point that could be rendered.
    std::vector<std::string> columns {}, units {};
    double rate_hz = 0.0;
    std::size_t count = 0;   // ticks

private:
    template <typename F>
    void withoutGil (F&& f)
    {
        {
            const py::gil_scoped_release without_gil;
            f();
            assets.release();
        }
        assets.raiseFailure();
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }

    /// True if there are errors, of which the first is told.
    static bool tell (const Messages& messages, std::size_t point, py::list& errors, py::dict& warnings)
    {
        const auto first = std::ranges::find (messages, Message::Severity::error, &Message::severity);
        if (first != messages.end()) errors.append (py::make_tuple (point, first->id, first->where, first->text));
        for (const auto& m : messages)
            if (const auto kind = py::str (m.id + ' ' + m.where); m.severity != Message::Severity::error && ! warnings.contains (kind)) warnings[kind] = m.text;
        return first != messages.end();
    }

    void begin (const CompileOptions& at, Messages& messages)
    {
        if (! goBack (at, messages)) compile (at, messages);
        if (hasErrors (messages)) return;
        if (first_feed) *feed = *first_feed;
        const double length_s = seconds > 0.0 || feed ? seconds : tactus_run_duration (run.get());
        const double ticks = std::ceil (length_s * rate_hz - 1e-6);
        count = ticks >= 1.0 && ticks <= most_ticks ? static_cast<std::size_t> (ticks) : 0;
        if (feed) count = length_s <= 0.0 ? feed->ticks() : std::min (count, feed->ticks());
        if (count > 0) return;
        messages.push_back (Message::error ("run/no_length", "", "the length of the run is unknown, or more than 10^10 ticks", "give the duration in s"));
    }

    void compile (const CompileOptions& at, Messages& messages)
    {
        state.clear();
        tactus_messages found;
        run.reset (capi::makeRun (graph, at, assets.reader(), catalogue(), &found));
        if (run) tactus_run_open (run.get(), &found);
        messages = std::move (found.list);
        if (! run || ! run->is_open) return run.reset();
        columns = run->names;
        units = run->units;
        rate_hz = run->run->rate();
        if (first_feed) run->run->add (feed.emplace (*first_feed));
        if (! goes_back) return;
        StateArchive saving { state };
        run->run->serialize (saving);
        if (saving.isRefused()) state.clear();
        goes_back = ! state.empty();
    }

    Setup setupAt (double hz) const
    {
        Setup setup { .rate_hz = hz, .services = options.services };
        setup.services.prepared = &plan::preparedOfAll();
        return setup;
    }

    /// Goes back to before the first tick, with the values of another point. False if the graph must be compiled for it.
    bool goBack (const CompileOptions& at, Messages& messages)
    {
        if (! run || state.empty() || run->run->engine().isEmergency()) return false;
        StateArchive restoring { std::span<const std::byte> (state) };
        run->run->serialize (restoring);
        if (restoring.isRefused() || ! restoring.isAtEnd()) return false;
        try
        {
            auto found = plan::examine (graph, catalogue(), setupAt (rate_hz), at.overrides, &run->assets).flattened;
            const auto& flat = found.flat;
            const auto& before = run->run->engine().newest().flat();
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

    /// Gives a node the values of its parameters, and the state that it would have begun with. False if that needs a new node.
    bool set (const plan::Flat& flat, std::size_t i)
    {
        const auto& now = flat.nodes[i];
        const auto& plan = run->run->engine().newest();
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

        const auto made = plan::makeNode (flat, static_cast<int> (i));
        const auto* role = type.learn ? plan.findRole (now.role) : nullptr;
        if (role != nullptr) type.learn (made.get(), DeviceState {}.layout.mechanics);   // as a plan does before it has devices
        if (type.prepare) type.prepare (made.get(), setupAt (rate_hz * flat.speed (now.section)));
        if (type.update) type.update (made.get());
        if (role != nullptr) type.learn (made.get(), role->state->layout.mechanics);
        std::vector<std::byte> bytes;
        StateArchive saving { bytes };
        type.serialize (made.get(), saving);
        StateArchive restoring { std::span<const std::byte> (bytes) };
        type.serialize (instance.node.get(), restoring);
        return ! saving.isRefused() && ! restoring.isRefused() && restoring.isAtEnd();
    }

    graph::Graph graph;
    CompileOptions options {};   // with the values that all points share
    Values names;
    double seconds;
    PythonAssets assets;
    bool goes_back = true;   // worth a try
    std::optional<Feed> first_feed {}, feed {};
    std::vector<std::byte> state {};                                                        // before the first tick; empty: none could be saved
    std::unique_ptr<tactus_run, void (*) (tactus_run*)> run { nullptr, tactus_run_free };   // declared last, because it uses the others
};
}   // namespace

void bindPoints (py::module_& module)
{
    module.def ("read_table", [] (const std::string& path) {
        const auto table = readTable (std::filesystem::path (path));
        if (! table) fail (table.error());
        return std::make_pair (table->columns, Points::Rows ({ table->rows(), table->columns.size() }, table->values.data()));
    });
    py::class_<Points> (module, "Points")
        .def (py::init<const EditedGraph&, double, std::vector<std::string>, const std::map<std::string, std::string>&, Points::Values,
                       const std::optional<PythonRun::FeedTable>&, py::object, double>())
        .def ("render", &Points::render)
        .def_readonly ("columns", &Points::columns)
        .def_readonly ("units", &Points::units)
        .def_readonly ("rate", &Points::rate_hz)
        .def_property_readonly ("width", [] (const Points& points) { return points.count * points.columns.size(); });
}

}   // namespace tactus::python
