// SPDX-License-Identifier: MIT
#pragma once

#include "assets.hpp"
#include "graph.hpp"
#include "own_nodes.hpp"

#include <pybind11/numpy.h>

#include <tactus/run/feed.hpp>

#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

namespace tactus::python
{

/// A run of the C API for Python. Several Python threads may share it: a call waits, without the GIL, until calls from other
/// threads are over. push, take, and functions marked [any thread] do not wait.
class PythonRun
{
public:
    using Rows = py::array_t<double, py::array::c_style | py::array::forcecast>;   ///< ticks x columns

    struct Options
    {
        double rate_hz = 0.0;
        std::vector<std::string> feeds {}, records {};
        std::map<std::string, std::string> sets {};   ///< values as JSON, by parameter
    };

    using FeedTable = std::pair<std::vector<std::string>, Rows>;   ///< names of columns, and their rows

    /// A table of feeds makes the run as long as the table; its columns replace Options::feeds.
    PythonRun (const EditedGraph&, Options, const py::list& own_nodes, const std::optional<FeedTable>& table, py::object assets);
    ~PythonRun();
    PythonRun (const PythonRun&) = delete;
    PythonRun& operator= (const PythonRun&) = delete;

    double rate();
    double duration();
    std::size_t feedTicks() const noexcept { return feed ? feed->ticks() : 0; }
    const std::vector<std::string>& roles() const noexcept { return run->roles; }
    const std::vector<std::string>& columns() const noexcept { return run->names; }
    const std::vector<std::string>& units() const noexcept { return run->units; }

    // Devices, before open().
    void device (const std::string& role, const std::string& words);
    void describeDevice (const std::string& role, const std::string& description, const std::string& folder);
    void pushedDevice (const std::string& role, const std::string& options);
    void open();

    void push (const std::string& role, const py::dict& reading);
    py::dict take (const std::string& role) const;

    /// Runs ticks. Returns the number of the first one, and the records of all of them. `feeds` has one row per tick, or one row for all.
    std::pair<std::uint64_t, Rows> steps (std::size_t count, const std::optional<Rows>& feeds);

    /// Runs the ticks of a step of tactus_run_step_for, and returns how many.
    std::size_t stepFor (double dt_s);

    py::bytes save();
    void restore (const py::bytes&);

    std::uint64_t ticks() const noexcept { return done; }   ///< how many ticks steps() and stepFor() have run   [any thread]

    void start (std::uint64_t length, int core, std::size_t buffer);
    void stop();
    Rows collect();
    std::uint64_t lost();
    py::dict status();

    void set (const std::string& param, const std::string& value);
    void control (const std::string& id, double value);
    void hit (const std::string& input, double speed);
    void edit (const EditedGraph&);
    void emergencyStop() noexcept { tactus_run_emergency_stop (run.get()); }   ///< [any thread]
    void rearm() noexcept { tactus_run_rearm (run.get()); }                    ///< [any thread]

private:
    class Turn;

    template <typename F>
    void call (const char* what, F&& f);
    void stepAll (std::size_t count, const double* feeds, double* rows);
    void tellStops();

    std::optional<Feed> feed;
    OwnNodes own;
    PythonAssets assets;
    std::unique_ptr<tactus_run, void (*) (tactus_run*)> run { nullptr, tactus_run_free };   // declared after feed, own and assets, because it uses them
    std::mutex turns;
    std::atomic<std::thread::id> owner {};
    std::atomic<std::uint64_t> done = 0;
    std::size_t state_size = 4096;             // of the last state, in bytes
    std::set<std::string, std::less<>> told;   // roles whose stop was told   [with the GIL]
};

Result<Feed> feedOf (const PythonRun::FeedTable&, double rate_hz, double graph_rate_hz);

void bindRun (py::module_&);

/// Renders of one graph with many sets of values: a call of Python for many of them, and none in a tick. The bits are those of PythonRun.
void bindPoints (py::module_&);

}   // namespace tactus::python
