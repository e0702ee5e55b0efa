// SPDX-License-Identifier: MIT
#pragma once

#include "asset_list.hpp"
#include "engine.hpp"
#include "log/run_log.hpp"
#include "query_thread.hpp"
#include "runner.hpp"
#include <tactus/run/probe/taps.hpp>

#include <tactus/plan/compile.hpp>
#include <tactus/text/result.hpp>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace tactus
{

struct IncludedGuard;

/// Takes part in every tick of a run, for example a feed, a recording, probes or sound.
class RunListener
{
public:
    virtual ~RunListener() = default;

    /// The ports that this listener needs tapped, such as "drag.force", in every plan of the run. [main thread]
    virtual std::vector<std::string> ports() const { return {}; }

    /// True if the run may continue without this port after an edit has removed it. [main thread]
    virtual bool isOptional (const std::string& /*port*/) const { return true; }

    /// Announces that this plan is submitted next. [main thread]
    virtual void planComes (const Plan&) {}

    virtual void before (Plan&, std::uint64_t /*tick*/) noexcept {}   ///< called before the devices are read   [tick thread]

    /// Called after the devices have been written. A tick that `halts` comes after the end of the run and only removes the
    /// forces. [tick thread]
    virtual void after (const Plan&, std::uint64_t /*tick*/, bool /*halts*/) noexcept {}
};

/// Plays a graph: compiles it, gives its roles their devices, ticks it, and swaps plans when the graph is edited. The
/// command line, the window, replay, tests and programs that embed Tactus all use this class, live and offline.
///
///     Run run { catalogue(), { .rate_hz = 4000.0 }, openDevice };
///     auto messages = run.load (graph);                     // compiles; without a plan, there is nothing to run
///     run.openDevices (graph, messages);
///     run.tick();                                           // offline: one tick; or
///     run.start (clock);                                    // live: on a thread ticked by the clock
///     ...
///     auto edit = run.edit (graph);                         // compiled on top of the running plan
///     if (edit.plan()) edit.commit();                       // taken over between two ticks
///
/// The caller keeps the graph. All functions are for the main thread, which is any one thread at a time, unless noted otherwise. In a loop of your
/// own, tick() may have a thread of its own beside it (docs/threads.md).
class Run final : private TickHooks
{
public:
    /// The device of a role, and the limits of its guard.
    struct RoleDevice
    {
        std::unique_ptr<Device> device {};   ///< null: the role reads a tool at rest at the origin, and its efforts have no effect
        GuardLimits limits {};
        Device* driver = nullptr;   ///< the same device without its adapters; null means `device`
        bool is_logged = false;     ///< the limits are those of a log, which contain what its graphs asked for
    };

    /// Opens the device of a role and adds any problems to the messages. `plan` is the one that needs the device. The run tightens
    /// the limits by the guard that the graph describes for the role.
    using OpenDevice = std::function<RoleDevice (const std::string& role, const graph::Graph&, const Plan&, Messages&)>;

    enum class Queries
    {
        within_tick,   ///< offline: async queries are answered when they are due
        on_thread      ///< live: they are answered on their own thread
    };

    /// The catalogue, and the assets and services in the options, must outlive the run. The run sets CompileOptions::before and withdrawn
    /// itself.
    Run (const Catalogue&, CompileOptions, OpenDevice = {}, Queries = Queries::within_tick);
    ~Run() override;
    Run (const Run&) = delete;
    Run& operator= (const Run&) = delete;

    //==========================================================================
    // Before the first tick.

    /// Listeners must outlive the run. They are called in the order in which they were added.
    void add (RunListener&);

    /// The tick rate in Hz for the next load(). 0: the graph's own rate.
    void setRate (double hz) noexcept { options.rate_hz = hz; }

    /// Compiles the first plan. May be called again, for instance at a different rate, until devices are open. Without a plan, there is nothing
    /// to run, even if an earlier load had one.
    Messages load (const graph::Graph&);

    /// Starts from a plan compiled elsewhere with the same options.
    void begin (std::shared_ptr<Plan>);

    /// From now on, every plan of the run taps what the current plan taps, so that a recording keeps its columns through edits.
    /// Call it after load().
    void keepRecords();

    /// Tightens the guards of this run as if its graph asked for these limits, by role: those that graphs asked for in an earlier run which this
    /// one continues. Call it before openDevices().
    void keepLimits (std::map<std::string, GuardLimits> limits) { asked = std::move (limits); }

    /// By role, the strictest limits that the graphs of this run have asked for so far.
    const std::map<std::string, GuardLimits>& askedLimits() const noexcept { return asked; }

    /// Opens the device of every role that has none and hands it to the engine. Call it after load().
    void openDevices (const graph::Graph&, Messages&);

    /// Logs all inputs of the run, so that it can be replayed bit for bit. Call it after openDevices. Sets are written as in
    /// --set. Ids: output/unwritable.
    Result<> startLog (const std::filesystem::path&, std::string program, std::vector<std::string> sets, const graph::Graph&);

    //==========================================================================
    // Ticking.

    /// Runs one tick, in a loop of your own. Not after start(): then the clock ticks the run. [tick thread]
    void tick() noexcept;

    /// Starts the tick thread; call it once. The clock must outlive the run. Returns a sentence for each real-time privilege
    /// that the system refuses.
    std::vector<std::string> start (TickClock&, Runner::Options = {});

    bool isLive() const noexcept { return runner != nullptr; }

    /// The tick thread. Only while isLive().
    Runner& live() noexcept { return *runner; }
    const Runner& live() const noexcept { return *runner; }

    /// Frees plans that are no longer used, collects node costs, writes the log. Call it many times a second. Returns what went
    /// wrong with the log, only once: ids output/unwritable, log/broken.
    std::optional<Message> poll();

    /// Stops the tick thread, if there is one, and waits until the forces are zero and the thread has ended.
    void end();

    /// Completes the log, which then ends with the latest tick; the run goes on. Returns why the log is incomplete, if it is.
    Result<> endLog();

    /// Like end(), but also ends the log. Returns why the log is incomplete, if it is.
    Result<> finish();

    //==========================================================================
    // Editing while it ticks.

    /// An edited graph on its way into the run: a plan compiled on top of the running one. Unless it is committed, the run
    /// continues unchanged. Only one edit may exist at a time.
    ///
    /// The guards that the graph and the graphs that it includes describe for the roles tighten the limits of their guards, from the first tick
    /// of the plan. What they no longer ask for still applies until the next run, and a message says so (watch/guard). A guard that cannot be read
    /// is an error, and there is no plan.
    class Edit
    {
    public:
        Edit (Edit&&) noexcept;
        ~Edit();

        Plan* plan() noexcept { return compiled.plan.get(); }   ///< null if the graph does not compile
        Messages& messages() noexcept { return compiled.messages; }

        /// Opens the devices of roles that have none yet. Call it before commit().
        void openDevices();

        /// The next tick switches to the plan. Roles that have received a device are read and written from that tick on, and so
        /// are roles that the caller connects to its own devices.
        void commit (std::span<const Engine::Joining> others = {});

        /// These limits by role take the place of those that the guards of the graph ask for. Call it before commit().
        void tightenOnly (std::map<std::string, GuardLimits> limits) { asks = std::move (limits); }

        /// Discards the edit now rather than in the destructor.
        void drop();

    private:
        friend Run;
        Edit (Run&, const graph::Graph&, std::vector<std::string> kept);
        void readGuards();

        Run* run;
        const graph::Graph& graph;
        std::shared_ptr<Plan> withdrawn;
        Compiled compiled;
        std::vector<std::pair<std::string, RoleDevice>> opened;
        std::map<std::string, GuardLimits> asks;   // by role, what the guards of the graph ask for
    };

    /// Compiles an edited graph. The run keeps its rate: if the graph has a different one, a message reports it (watch/rate). For
    /// `kept`, see CompileOptions.
    Edit edit (const graph::Graph& g, std::vector<std::string> kept = {}) { return { *this, g, std::move (kept) }; }

    /// Compiles the graph without affecting the run, to find out what is wrong with it.
    Compiled check (const graph::Graph& g) { return compile (g, nullptr, nullptr, {}); }

    //==========================================================================
    // States. Not while a clock ticks the run.

    /// The part of a state that the loop around the run adds, for both directions, such as a Stepper.
    using MoreState = std::function<void (StateArchive&)>;

    /// The state of the run between two ticks: nodes, parameters and their ramps, wires under way, guards and simulated devices, as bytes. Another
    /// run of the same graph, with the same options and devices, can go on from there, in any process with the same version of Tactus: its next ticks
    /// have the same bits. `graph` is the one that the run plays. Ids: state/live, state/edit, state/refused (a node or a device whose state cannot
    /// be saved, by name). [tick thread]
    Result<std::vector<std::byte>> save (const graph::Graph&, const MoreState& = {});

    /// Goes back, or on, to a state. If it does not fit, nothing changes. Nothing that keeps people safe is undone: limits stay, a halt stays, and after
    /// an emergency stop a state is refused until rearm(). It is not for devices that somebody holds, because the effort may step: only simulated
    /// ones have a state. Restore only what you have saved: the checksum finds damage, not malice. Ids: those of save(), state/format (no state, or
    /// one of another version), state/damaged, state/graph (of another graph), state/stopped, state/log (a log could not replay it). [tick thread]
    Result<> restore (std::span<const std::byte>, const graph::Graph&, const MoreState& = {});

    /// The state alone, in both directions: for a run that goes back to a state of its own. What save() refuses must not be the case. [tick thread]
    void serialize (StateArchive&, const MoreState& = {});

    //==========================================================================
    // Observing.

    /// Captures a port around the first edge of another port, replacing any earlier capture. Returns the names of the
    /// captured components. Ids: those of compile() for a port, probe/trigger, probe/too_many.
    Result<std::vector<std::string>> capture (const graph::Graph&, const std::string& port, const std::string& watched, const Trigger&);

    const TriggeredCapture* captured() const noexcept { return slot.complete(); }   ///< null until the capture is complete
    bool isCapturing() const noexcept { return ! captured_ports.empty(); }
    void endCapture();

    /// The engine, for parameters, hits, stops and guards. After load().
    Engine& engine() noexcept { return *running; }
    const Engine& engine() const noexcept { return *running; }
    bool hasEngine() const noexcept { return running != nullptr; }

    double rate() const noexcept { return running->newest().rateHz(); }   ///< tick rate in Hz

    /// Devices by role, in the order in which they were opened.
    const std::vector<std::pair<std::string, RoleDevice>>& devices() const noexcept { return by_role; }

    /// Taps of the columns of a recording: CompileOptions::records, without the ports of listeners.
    std::vector<Tap> recorded() const;

    /// The asset files that the latest plan reads.
    const std::set<std::string>& assetPaths() const noexcept { return assets.paths; }

    /// Ticks on which an async query was not answered in time. [any thread]
    std::uint64_t lateTicks() const noexcept { return queries ? queries->lateTicks() : 0; }

private:
    void before (std::uint64_t tick) noexcept override;
    void after (std::uint64_t tick, bool halts) noexcept override;

    Compiled compile (const graph::Graph&, const Plan* before, const Plan* withdrawn, std::vector<std::string> kept);
    bool isOptional (const std::string& port) const;
    bool hasDevice (const std::string& role) const;
    RoleDevice openOne (const std::string& role, const graph::Graph&, const std::vector<IncludedGuard>&, const Plan&, std::map<std::string, GuardLimits>& asks,
                        Messages&);
    GuardLimits asksFor (const std::string& role, const graph::Graph&, const std::vector<IncludedGuard>&, const RoleDevice&, Messages&) const;
    const RoleDevice* deviceOf (const std::string& role) const;
    std::optional<Message> cannotSave() const;
    const std::string& hashOf (const graph::Graph&);
    void logNext (const std::shared_ptr<Plan>&, const graph::Graph&, const std::vector<std::pair<std::string, RoleDevice>>& joining);

    const Catalogue& catalogue;
    CompileOptions options;
    AssetList assets;   // the assets from the options, with a list of the files read
    OpenDevice open;
    std::vector<RunListener*> listeners;

    std::map<std::string, GuardLimits> asked;   // by role, the strictest of what the graphs of this run have asked for so far

    std::vector<std::pair<std::string, RoleDevice>> by_role;
    std::unique_ptr<QueryThread> queries;   // must precede the engine and the log, which hold nodes that use it
    std::unique_ptr<RunLog> log;            // must precede the engine, which reports to it
    std::unique_ptr<Engine> running;
    CaptureSlot slot;
    std::vector<std::string> captured_ports;
    std::vector<std::size_t> captured_taps;
    std::optional<Message> log_failure;
    std::string graph_hash;   // of the graph of the plan with this serial, once a state was saved
    std::uint64_t hashed_serial = 0;
    bool log_broke = false, log_ended = false;
    double graph_rate_hz = 0.0;       // the rate in the first graph; 0 if the options set the rate
    std::uint64_t now = 0;            // tick number, offline only
    std::unique_ptr<Runner> runner;   // declared last, so that it is destroyed first: it ticks the engine
};

}   // namespace tactus
