// SPDX-License-Identifier: MIT
#pragma once

#include "role_devices.hpp"
#include "stop_switch.hpp"

#include <host/code/fuse/fuser.hpp>
#include <host/devices/sessions/device_health.hpp>
#include <host/devices/sessions/needs.hpp>
#include <host/devices/sessions/run_clock.hpp>
#include <tactus/run/run.hpp>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// One run of a graph on the devices of this computer, from its clock to its stop. The window, the command line and the C API all play through
/// this class.
///
///     LiveSession session { catalogue, hardware, { .devices = { .session = loadDefaultSession (home) }, .stops = &stops } };
///     auto messages = session.load (graph);        // chooses the clock, and compiles
///     messages = session.openDevices();
///     messages = session.beginSound();
///     session.start ({});
///     while (session.isRunning()) session.poll();   // many times a second
///     session.end();
///
/// Each step returns messages. After errors, the caller decides whether to take the next step: the window plays a graph with placeholders for
/// unknown nodes, the command line plays it only if that was asked for. [main thread]
class LiveSession final : private RunListener
{
public:
    struct Options
    {
        RoleDevices::Choice devices {};
        CompileOptions compile {};                           ///< its rate is a fixed rate of the run, or 0
        std::string clock {};                                ///< role of the device that ticks, "timer" or "audio"; "": that of the session, else chooseClock
        bool keeps_records = false;                          ///< the ports that the first plan taps without listeners stay tapped (Run::keepRecords)
        std::vector<RunListener*> listeners {};              ///< in the order in which they are called; must outlive this object
        StopSwitch* stops = nullptr;                         ///< obeyed from the first tick on; may be null; must outlive this object
        std::map<std::string, GuardLimits> kept_limits {};   ///< see Run::keepLimits
        bool is_stopped = false;                             ///< the run starts with its forces at zero, until rearm()
        double least_ramp_s = 0.0;                           ///< the guards' ramp where it would be shorter, in s
        bool may_move = false;                               ///< the workspaces of devices can be moved by holdWorkspaces()
        Run::Queries queries = Run::Queries::on_thread;
    };

    LiveSession (const Catalogue&, Hardware, Options);
    ~LiveSession() override;   ///< waits until the forces are zero, and releases the devices
    LiveSession (const LiveSession&) = delete;
    LiveSession& operator= (const LiveSession&) = delete;

    //==========================================================================
    // Before the first tick.

    /// Chooses the clock and compiles the graph. Without isLoaded(), there is nothing to run. Ids: those of chooseClock and compile().
    Messages load (const graph::Graph&);
    bool isLoaded() const noexcept { return running != nullptr && running->hasEngine(); }

    /// Opens the devices of all roles. Also tells which parts of the graph and of the devices are missing. Ids: those of RoleDevices::open,
    /// missingParts and missingTools.
    Messages openDevices();

    /// Opens the sound card, if one is needed or `anyway`. Ids: those of RunSound::begin.
    Messages beginSound (bool anyway = false);

    /// Logs all inputs (Run::startLog), from the first tick to the last.
    Result<> log (const std::filesystem::path&, std::string program, std::vector<std::string> sets);
    Result<> endLog() { return running ? running->endLog() : Result<> {}; }   ///< completes the log; the run goes on

    struct Start
    {
        std::optional<std::uint64_t> length {};     ///< in ticks
        std::optional<double> length_s {};          ///< in s, as for Runner
        std::optional<int> core {};                 ///< the CPU core for the tick thread
        bool (*stop_wanted)() noexcept = nullptr;   ///< see Runner::Options
    };

    /// Starts the tick thread; call it once. Returns a sentence for each real-time privilege that the system refuses.
    std::vector<std::string> start (const Start&);

    //==========================================================================
    // While it runs.

    /// The events that poll() noticed, each only once.
    struct Events
    {
        std::optional<Message> alarm {};    ///< of the failsafe: all forces are held at zero until rearm()
        std::optional<Message> log {};      ///< the log is incomplete
        std::optional<Message> fusion {};   ///< the plan cannot be fused
        std::optional<Message> sound {};    ///< the capture of the sound has failed
    };

    /// Frees what is no longer used, writes the log, and looks after the devices, the sound and the compiled code. Call it many times a second.
    Events poll();

    void stop() noexcept;            ///< ramps the forces to zero, then ends the ticks; does not wait   [any thread]
    void emergencyStop() noexcept;   ///< ramps the forces to zero and keeps them there; the graph keeps running   [any thread]

    /// Lets the forces rise again, if StopSwitch::mayRearm allows it, and for a program also StopSwitch::mayStart. Only a person should decide
    /// this: its caller also calls StopSwitch::startedAfter. [any thread]
    Result<> rearm (std::chrono::steady_clock::time_point asked = std::chrono::steady_clock::now(), By who = By::person);

    /// Lets the workspaces of all real devices whose position is read move with the hand, without force, or ends this (WorkspaceDevice::hold).
    /// False if there is none. [main thread]
    bool holdWorkspaces (bool);

    /// True if a stop is latched: an emergency stop, or a limit that only a rearm ends. Also after the last tick.
    bool isLatched() const;

    /// An edit of the graph, and what became of it.
    struct EditResult
    {
        bool is_taken_over = false;   ///< false: the previous graph keeps running
        Messages messages {};
    };

    /// The conditions that an edit must satisfy, besides having a plan.
    enum class EditPolicy
    {
        errors,      ///< nothing else: the window shows the errors, and placeholders run in place of unknown nodes
        no_errors,   ///< an edit with errors is refused, except for placeholders if the graph of before had some
    };

    /// Plays an edited graph from the next tick on. Roles keep their devices, and a new role gets one.
    EditResult edit (const graph::Graph&, EditPolicy, const std::function<bool (const Plan&)>& agrees = {});

    /// The user's session has changed: roles that come later get their devices from the new one.
    void rebind (LoadedSession s) { devices.rebind (std::move (s)); }

    /// From now on, replaces the plan that runs by compiled code (docs/fusion.md); empty: runs by the plan. The forces do not change.
    void fuse (std::optional<Fuser::Options>);
    const Fuser* fuser() const noexcept { return fusing ? &*fusing : nullptr; }

    //==========================================================================
    // After the last tick.

    struct FinalResults
    {
        Result<> log {}, sound {};   ///< why the log or the capture is incomplete
    };

    /// Stops, waits until the forces are zero, and completes the log and the sound. The devices stay open until the destructor. May be called
    /// again.
    FinalResults end();

    //==========================================================================
    // What it is.

    Run& run() noexcept { return *running; }   ///< after load()
    const Run& run() const noexcept { return *running; }
    Engine& engine() noexcept { return running->engine(); }
    const graph::Graph& graph() const noexcept { return playing; }
    double rate() const noexcept { return running->rate(); }   ///< in Hz

    bool isLive() const noexcept { return running && running->isLive(); }
    bool isRunning() const noexcept { return isLive() && ! running->live().isOver(); }
    bool hasPlaceholders() const noexcept { return has_placeholders; }

    /// The role whose device ticks the run; empty if a timer or a sound card does.
    const std::string& clockRole() const noexcept { return clock_role; }
    const RunClock* deviceClock() const noexcept { return device_clock.get(); }   ///< null if no device ticks the run
    RunSound* sound() const noexcept { return hardware.sound(); }

    std::vector<RealDevice> realDevices() const;
    std::vector<PluginRole> pluginRoles() const;
    const std::vector<DeviceHealth>& health() const noexcept { return watch.health(); }   ///< of the real devices, present or awaited

    /// True if the run drives something that can push or shake: a device, present or awaited, or a sound card.
    bool drivesDevice() const;

private:
    void before (Plan&, std::uint64_t tick) noexcept override;

    void showStops();
    TickClock& clock();
    std::optional<Message> noticeAlarm();
    std::optional<Message> attendFusion();

    const Catalogue& catalogue;
    Hardware hardware;
    Options options;
    RoleDevices devices;
    graph::Graph playing;
    std::string clock_role;
    bool has_placeholders = false;
    StopSwitch own_stops;   // if the caller has none
    StopSwitch& stops;
    StopSwitch::PressCounts obeyed;                      // by the tick thread
    std::uint32_t alarms_told = 0, alarms_stopped = 0;   // alarms of the failsafe; the second is for the tick thread
    HealthWatch watch;
    std::chrono::steady_clock::time_point looked_at {};   // at the devices
    std::optional<Fuser> fusing;
    std::unique_ptr<RunClock> device_clock;
    std::optional<AbsoluteTimer> timer;
    std::unique_ptr<Run> running;   // declared last: it uses the other members
};

}   // namespace tactus::host
