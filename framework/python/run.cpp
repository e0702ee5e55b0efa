// SPDX-License-Identifier: MIT
#include "run.hpp"

#include <pybind11/stl.h>

#include <tactus/run/turn.hpp>
#include <tactus/text/json.hpp>

#include <algorithm>
#include <utility>

namespace tactus::python
{

namespace
{
/// Every so many ticks, a run checks whether the user has pressed Ctrl-C.
constexpr std::size_t ticks_at_a_time = 256;

constexpr double recorded_s = 10.0;   // how much stepFor() keeps for collect(), as much as Engine.start does by itself

}   // namespace

Result<Feed> feedOf (const PythonRun::FeedTable& from, double rate_hz, double graph_rate_hz)
{
    Table table;
    table.columns = from.first;
    table.values.assign (from.second.data(), from.second.data() + from.second.size());
    return Feed::make (std::move (table), "feed", rate_hz, graph_rate_hz);
}

/// The turn of one thread to use the run. While it exists, calls from other threads wait, and this thread does not hold the GIL. The GIL is released
/// before the lock is taken, so that a thread which holds the lock can always get the GIL.
class PythonRun::Turn
{
public:
    explicit Turn (PythonRun& r) : run (r)
    {
        if (run.owner == std::this_thread::get_id())
            fail (Message::error ("engine/busy", "", "a node in Python calls the engine that ticks it", "call the engine between two steps"));
        without_gil.emplace();
        run.turns.lock();
        run.owner = std::this_thread::get_id();
    }

    ~Turn()
    {
        run.owner = std::thread::id {};
        run.turns.unlock();
    }

    Turn (const Turn&) = delete;
    Turn& operator= (const Turn&) = delete;

private:
    PythonRun& run;
    std::optional<py::gil_scoped_release> without_gil;
};

template <typename F>
void PythonRun::call (const char* what, F&& f)
{
    tactus_messages messages;
    auto result = TACTUS_OK;
    {
        const Turn turn (*this);
        result = f (&messages);
    }
    own.raiseFailure();
    assets.raiseFailure();
    report (messages.list);
    if (result == TACTUS_OK) return;
    fail (Message::error ("engine/not_now", "", std::string ("the engine cannot ") + what + " at this time",
                          "an engine ticks either in your loop or live; a live run starts once, and is over when it is stopped"));
}

PythonRun::PythonRun (const EditedGraph& graph, Options given, const py::list& own_nodes, const std::optional<FeedTable>& table,
                      py::object own_assets)
    : own (own_nodes), assets (std::move (own_assets))
{
    CompileOptions options { .rate_hz = given.rate_hz, .feeds = std::move (given.feeds), .records = std::move (given.records) };
    if (table)
    {
        auto made = feedOf (*table, given.rate_hz, graph.graph().rate_hz);
        if (! made) fail (std::move (made).error());
        feed = std::move (*made);
        options.feeds = feed->drives();
        options.rate_hz = feed->rate();
    }
    for (const auto& [name, value] : given.sets)
        options.overrides.push_back ({ name, jsonOf (value) });

    tactus_messages messages;
    {
        auto copy = graph.graph();
        const py::gil_scoped_release without_gil;
        run.reset (capi::makeRun (std::move (copy), std::move (options), assets.reader(), own.catalogue(), &messages));
        assets.release();
        if (run && feed) run->run->add (*feed);
    }
    own.raiseFailure();
    assets.raiseFailure();
    report (messages.list);
    if (! run) fail (Message::error ("run/no_plan", "", "the graph does not compile", "see the other messages"));
}

PythonRun::~PythonRun()
{
    const py::gil_scoped_release without_gil;
    run.reset();   // waits until the forces are zero
}

double PythonRun::rate() { return tactus_run_rate (run.get()); }
double PythonRun::duration() { return tactus_run_duration (run.get()); }

//==============================================================================
void PythonRun::device (const std::string& role, const std::string& words)
{
    call ("take a device", [&] (auto* m) { return tactus_run_device (run.get(), role.c_str(), words.c_str(), m); });
}

void PythonRun::describeDevice (const std::string& role, const std::string& description, const std::string& folder)
{
    device (role, "sim");   // checks the role, and that the run is not open yet
    run->described[role] = { role, jsonOf (description), folder };
}

void PythonRun::pushedDevice (const std::string& role, const std::string& text)
{
    const auto has = jsonOf (text);
    const auto names = [&has] (const char* key) { return has.at (key).get<std::vector<std::string>>(); };
    const auto pointers = [] (const std::vector<std::string>& all) {
        std::vector<const char*> to;
        for (const auto& name : all)
            to.push_back (name.c_str());
        return to;
    };
    const auto axes = names ("axes"), efforts = names ("efforts"), buttons = names ("buttons");
    const auto axis_names = pointers (axes), effort_names = pointers (efforts), button_names = pointers (buttons);
    const auto guard = has.at ("guard").dump();
    tactus_device_options options = TACTUS_DEVICE_OPTIONS;
    options.axes = axis_names.data();
    options.axis_count = axis_names.size();
    options.efforts = effort_names.data();
    options.effort_count = effort_names.size();
    options.buttons = button_names.data();
    options.button_count = button_names.size();
    options.signal_inputs = has.at ("signal_inputs").get<int>();
    options.signal_outputs = has.at ("signal_outputs").get<int>();
    options.brake = has.at ("brake").get<double>();
    options.between = static_cast<tactus_between> (has.at ("between").get<int>());
    options.step_effort = static_cast<tactus_step_effort> (has.at ("step_effort").get<int>());
    options.simulated = has.at ("simulated").get<bool>() ? 1 : 0;
    if (! has.at ("guard").is_null()) options.guard = guard.c_str();
    call ("take a device", [&] (auto* m) { return tactus_run_pushed_device (run.get(), role.c_str(), &options, m); });
}

void PythonRun::open()
{
    call ("open its devices", [&] (auto* m) { return tactus_run_open (run.get(), m); });
}

namespace
{
void readVector (const py::dict& from, const char* key, double (&to)[3])
{
    if (! from.contains (key)) return;
    const auto values = from[key].cast<std::vector<double>>();
    if (values.size() != 3) fail (Message::error ("device/reading", key, "a vector has three components", "give x, y and z"));
    std::ranges::copy (values, to);
}

std::uint32_t readList (const py::dict& from, const char* key, double (&to)[TACTUS_CHANNELS])
{
    if (! from.contains (key)) return 0;
    const auto values = from[key].cast<std::vector<double>>();
    if (values.size() > TACTUS_CHANNELS) fail (Message::error ("device/reading", key, "there are too many values", "give at most 32"));
    std::ranges::copy (values, to);
    return static_cast<std::uint32_t> (values.size());
}

[[noreturn]] void failNotPushed (const std::string& role)
{
    fail (Message::error ("device/not_pushed", "/devices/" + role, "the role '" + role + "' has no device that Python pushes",
                          "create the engine with devices={'" + role + "': tactus.PushedDevice()}"));
}
}   // namespace

void PythonRun::push (const std::string& role, const py::dict& from)
{
    tactus_reading reading {};
    reading.size = sizeof reading;
    reading.valid = ! from.contains ("valid") || from["valid"].cast<bool>();
    readVector (from, "position", reading.position);
    readVector (from, "rotation", reading.rotation);
    if (from.contains ("pressure")) reading.pressure = from["pressure"].cast<double>();
    if (from.contains ("age")) reading.age_s = from["age"].cast<double>();
    if (from.contains ("buttons")) reading.buttons = from["buttons"].cast<std::uint32_t>();
    reading.axis_count = readList (from, "axes", reading.axes);
    reading.signal_count = readList (from, "signals", reading.signals);
    double velocity[3] = {}, angular[3] = {};
    const bool has_velocity = from.contains ("velocity");
    readVector (from, "velocity", velocity);
    readVector (from, "angular_velocity", angular);
    const auto pushed = has_velocity ? tactus_run_push_moving (run.get(), role.c_str(), &reading, velocity, angular)
                                     : tactus_run_push (run.get(), role.c_str(), &reading);
    if (pushed != TACTUS_OK) failNotPushed (role);
}

py::dict PythonRun::take (const std::string& role) const
{
    tactus_effort effort {};
    effort.size = sizeof effort;
    if (tactus_run_take (run.get(), role.c_str(), &effort) != TACTUS_OK) failNotPushed (role);
    const auto array = [] (const double* values, py::ssize_t count) { return Rows (count, values); };
    py::dict all;
    all["force"] = array (effort.force, 3);
    all["torque"] = array (effort.torque, 3);
    all["axes"] = array (effort.axes, effort.axis_count);
    all["signals"] = array (effort.signals, effort.signal_count);
    all["brake"] = effort.brake;
    tactus_guard guard = TACTUS_GUARD;
    tactus_run_guard (run.get(), role.c_str(), &guard);
    all["stop"] = tactus_stop_name (guard.stop);
    return all;
}

//==============================================================================
void PythonRun::stepAll (std::size_t count, const double* feeds, double* rows)
{
    const auto feed_count = run->options.feeds.size(), width = run->names.size();
    const auto at_a_time = own.isEmpty() ? ticks_at_a_time : 1;
    for (std::size_t k = 0; k < count && ! own.haveFailed(); k += at_a_time)
    {
        const auto now = std::min (at_a_time, count - k);
        tactus_run_steps (run.get(), now, feeds != nullptr ? feeds + k * feed_count : nullptr, rows + k * width);
        done += now;
        if ((k + now) % ticks_at_a_time != 0) continue;
        const py::gil_scoped_acquire gil;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    }
}

std::pair<std::uint64_t, PythonRun::Rows> PythonRun::steps (std::size_t count, const std::optional<Rows>& feeds)
{
    const auto feed_count = feed ? 0 : run->options.feeds.size();
    const auto given = feeds && feeds->ndim() == 2 ? static_cast<std::size_t> (feeds->shape (0)) : 0;
    if (feeds && ((given != count && given != 1) || static_cast<std::size_t> (feeds->size()) != given * feed_count))
        fail (Message::error ("feed/shape", "rows", "the feeds do not have one row per tick and one column per fed component",
                              "give an array of shape (" + std::to_string (count) + ", " + std::to_string (feed_count) + ")"));
    if (own.haveFailed()) fail (Message::error ("engine/failed", "", "a node in Python has raised an exception", "make a new engine"));
    Rows rows ({ static_cast<py::ssize_t> (count), static_cast<py::ssize_t> (run->names.size()) });
    auto* const to = rows.mutable_data();
    const auto* const from = feeds ? feeds->data() : nullptr;
    std::uint64_t first = 0;
    call ("step", [&] (auto*) {
        if (! run->is_open || run->run->isLive()) return TACTUS_MISUSE;
        first = done;
        run->recorder.is_paused = true;   // these rows are returned
        if (given == 1 && feed_count > 0) tactus_run_set_feeds (run.get(), from);
        stepAll (count, given > 1 ? from : nullptr, to);
        return TACTUS_OK;
    });
    tellStops();
    return { first, rows };
}

/// A warning for each pushed device whose guard has stopped it until rearm(). A loop that does not look at Effort.stop would see a surface vanish.
void PythonRun::tellStops()
{
    Messages found;
    for (std::size_t i = 0; i < run->guards.size(); ++i)
    {
        const auto role = run->guards.at (i);
        const bool is_mine = run->pushed.contains (role.name);   // the caller reads this effort; a simulated device uses its own
        if (! is_mine || role.is_latched == 0 || role.latest.why == Guard::Stop::emergency || told.contains (role.name)) continue;
        told.emplace (role.name);
        found.push_back (Message::warning ("guard/stopped", "/devices/" + std::string (role.name),
                                           "the guard of '" + std::string (role.name) + "' has stopped its effort, which stays 0 until rearm(): "
                                               + describe (role.latest),
                                           "look at Effort.stop in your loop; if no person holds the device, open the guard as the page on steps says"));
    }
    if (! found.empty()) report (found);
}

py::bytes PythonRun::save()
{
    std::string bytes (state_size, '\0');
    const auto write = [&] { call ("save its state", [&] (auto* m) { return tactus_run_save (run.get(), bytes.data(), bytes.size(), &state_size, m); }); };
    write();
    const bool has_fitted = state_size <= bytes.size();
    bytes.resize (state_size);
    if (! has_fitted) write();
    return bytes;
}

void PythonRun::restore (const py::bytes& state)
{
    const std::string_view bytes = state;
    call ("restore a state", [&] (auto* m) { return tactus_run_restore (run.get(), bytes.data(), bytes.size(), m); });
}

std::size_t PythonRun::stepFor (double dt_s)
{
    if (own.haveFailed()) fail (Message::error ("engine/failed", "", "a node in Python has raised an exception", "make a new engine"));
    std::size_t ticks = 0;
    call ("step", [&] (auto*) {
        if (! run->is_open || run->run->isLive()) return TACTUS_MISUSE;
        auto& recorder = run->recorder;
        if (! run->options.records.empty() && ! recorder.ring)
            recorder.ring = std::make_unique<SpscRing<double>> (static_cast<std::size_t> (recorded_s * run->run->rate()), run->names.size());
        recorder.is_paused = false;
        ticks = run->stepper->step (dt_s);
        done += ticks;
        return TACTUS_OK;
    });
    tellStops();
    return ticks;
}

//==============================================================================
void PythonRun::start (std::uint64_t length, int core, std::size_t buffer)
{
    if (! own.isEmpty())
        fail (Message::error ("node/offline", "", "nodes in Python run offline only, because Python can stop a tick for milliseconds",
                              "write the node in C++ to feel it: see the README"));
    tactus_start_options options = TACTUS_START_OPTIONS;
    options.core = core;
    options.length = length;
    options.buffer = buffer;
    call ("start", [&] (auto* m) {
        if (run->run->isLive()) return TACTUS_MISUSE;
        run->recorder.ring.reset();
        run->recorder.is_paused = false;
        return tactus_run_start (run.get(), &options, m);
    });
}

void PythonRun::stop()
{
    call ("stop", [&] (auto*) { return tactus_run_stop (run.get()); });
}

PythonRun::Rows PythonRun::collect()
{
    constexpr std::size_t block = 1024;   // ticks
    const auto width = run->names.size();
    std::vector<double> values;
    std::size_t count = 0;
    call ("give its records", [&] (auto* m) {
        for (std::size_t got = block; got == block; count += got)
        {
            values.resize ((count + block) * width);
            got = tactus_run_collect (run.get(), values.data() + count * width, block);
        }
        return tactus_run_attend (run.get(), m);
    });
    Rows rows ({ static_cast<py::ssize_t> (count), static_cast<py::ssize_t> (width) });
    std::copy_n (values.begin(), count * width, rows.mutable_data());
    return rows;
}

std::uint64_t PythonRun::lost()
{
    const Turn turn (*this);
    return tactus_run_lost (run.get());
}

py::dict PythonRun::status()
{
    tactus_status now TACTUS_STATUS;
    call ("give its status", [&] (auto*) { return tactus_run_status (run.get(), &now); });
    constexpr const char* phases[] = { "idle", "running", "halting", "over" };
    py::dict all;
    all["phase"] = phases[now.phase];
    all["ticks"] = now.ticks;
    all["late_ticks"] = now.late_ticks;
    all["force"] = now.force;
    all["peak_force"] = now.peak_force;
    all["is_emergency"] = now.is_emergency != 0;
    return all;
}

void PythonRun::set (const std::string& param, const std::string& value)
{
    const auto to = jsonOf (value);
    call ("set a parameter", [&] (auto* m) { return capi::asResult (m, turnParam (run->run->engine(), param, to)); });
}

void PythonRun::control (const std::string& id, double value)
{
    call ("turn a control", [&] (auto* m) { return capi::asResult (m, turnControl (run->run->engine(), run->graph, id, value)); });
}

void PythonRun::hit (const std::string& input, double speed)
{
    call ("take a hit", [&] (auto* m) { return capi::asResult (m, strike (run->run->engine(), input, speed)); });
}

void PythonRun::edit (const EditedGraph& graph)
{
    const tactus_graph copy { graph::History (graph.graph()) };   // another thread may edit the graph meanwhile
    call ("take an edited graph", [&] (auto* m) {
        const auto taken = tactus_run_edit (run.get(), &copy, m);
        assets.release();
        return taken;
    });
}

//==============================================================================
void bindRun (py::module_& module)
{
    const auto make = [] (const EditedGraph& graph, double rate_hz, std::vector<std::string> feeds, std::vector<std::string> records,
                          std::map<std::string, std::string> sets, const py::list& nodes,
                          const std::optional<std::pair<std::vector<std::string>, PythonRun::Rows>>& table, py::object assets) {
        return std::make_unique<PythonRun> (graph, PythonRun::Options { rate_hz, std::move (feeds), std::move (records), std::move (sets) }, nodes, table,
                                            std::move (assets));
    };
    py::class_<PythonRun> (module, "Run")
        .def (py::init (make))
        .def ("rate", &PythonRun::rate)
        .def ("duration", &PythonRun::duration)
        .def ("feed_ticks", &PythonRun::feedTicks)
        .def ("roles", &PythonRun::roles)
        .def ("columns", &PythonRun::columns)
        .def ("units", &PythonRun::units)
        .def ("device", &PythonRun::device)
        .def ("describe_device", &PythonRun::describeDevice)
        .def ("pushed_device", &PythonRun::pushedDevice)
        .def ("open", &PythonRun::open)
        .def ("push", &PythonRun::push)
        .def ("take", &PythonRun::take)
        .def ("steps", &PythonRun::steps)
        .def ("step_for", &PythonRun::stepFor)
        .def ("save", &PythonRun::save)
        .def ("restore", &PythonRun::restore)
        .def ("ticks", &PythonRun::ticks)
        .def ("start", &PythonRun::start)
        .def ("stop", &PythonRun::stop)
        .def ("collect", &PythonRun::collect)
        .def ("lost", &PythonRun::lost)
        .def ("status", &PythonRun::status)
        .def ("set", &PythonRun::set)
        .def ("control", &PythonRun::control)
        .def ("hit", &PythonRun::hit)
        .def ("edit", &PythonRun::edit)
        .def ("emergency_stop", &PythonRun::emergencyStop)
        .def ("rearm", &PythonRun::rearm);
}

}   // namespace tactus::python
