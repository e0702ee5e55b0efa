// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pointer_path.hpp"
#include "port_feed.hpp"
#include "scene_feed.hpp"
#include "sound.hpp"
#include "traces.hpp"
#include "transport_path.hpp"

#include <host/app/film/film_tape.hpp>
#include <host/app/model/document.hpp>
#include <host/base/assets/file_assets.hpp>
#include <host/devices/audio/open_audio.hpp>
#include <host/devices/live/live_session.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/device/sim.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <variant>

namespace tactus::host
{

class DeviceSetup;

/// Runs the graph of a document in real time, on the devices that it describes or that its roles are bound to. Each edit takes
/// effect between two ticks. If an edit does not compile, messages() says why, and the previous graph keeps running.
/// [main thread]
class LiveRun final : private Document::Listener, private RunListener
{
public:
    /// The source of the motion of the hand's tool, see handRole().
    struct Hand
    {
        enum class Kind
        {
            described,   ///< as the session binds it or the graph describes it: a device, a gesture or a recording
            pointer,     ///< the mouse
            path         ///< a gesture or recording that the user has chosen
        };

        Kind kind = Kind::described;
        std::string path {};   ///< name of a gesture, or a CSV file

        static Hand pointer() { return { Kind::pointer }; }
        bool operator== (const Hand&) const = default;
    };

    /// Plays the force on the hand's tool through `sound`, if that is not null. The sound must outlive this object.
    LiveRun (Document&, const Catalogue&, Sound* = nullptr);
    ~LiveRun() override;

    /// From now on, the session decides how roles are bound, which ports are played and what ticks the runs. The setup must
    /// outlive this object. If something that the run uses changes, the run restarts.
    void use (const DeviceSetup&);
    void setupChanged();

    /// Takes over files that others have read, so that the next compilation need not read them.
    void adopt (const FileAssets& read) { assets.adopt (read); }

    /// True if a run that begins now would get other devices, another clock or other sound from the session than the latest run. A tool that the mouse or
    /// a path moves keeps its hand.
    bool wouldGetOtherDevices() const;

    /// From now on, the runs obey this switch, and no run starts while the switch has a new press (StopSwitch::isAhead). When there is one, the
    /// caller must call notice() on the switch, and then stop() or emergencyStop(). The switch must outlive this object.
    void obey (StopSwitch& s) noexcept { stops = &s; }

    /// The state of the run's sound; empty if it neither plays nor records.
    std::optional<audio::AudioStatus> audioStatus() const;

    /// The user presses START: this ends latched stops, and limits may become looser. Restarts a run that is in progress, once its forces are
    /// zero. So do the next three, but they end no latched stop.
    void start (Hand);
    void startOther (Hand);   ///< another graph was opened, so the limits are those that it asks for
    void moveBy (Hand);       ///< another hand moves the tool; no limit becomes looser. What a person has stopped stays so until start().
    void changeHand (Hand);   ///< as moveBy(), but starts nothing that does not run

    /// From now on, the hand moves the tool of this role, such as another finger, until another graph is opened. No limit becomes looser.
    void moveTool (std::string role);

    /// After something else ran, or in order to record it. No limit becomes looser, and a tool that the mouse holds stays where it is. As after each restart,
    /// the forces rise within Guard::rearm_ramp_s or longer: the tool may be inside of a wall. By a person, does nothing after a person has ended the
    /// run: only start() starts then.
    void startAgain (By = By::person);

    void stop (By = By::person) noexcept;   ///< ramps the forces to zero, then stops; does not wait

    /// Brings all forces to zero smoothly while the graph keeps running. An alarm of the failsafe does this too. Like every latched
    /// stop, this ends with rearm() or when the user starts again; an edit does not end it.
    void emergencyStop (By = By::person) noexcept;

    /// Lets the forces rise again, if StopSwitch::mayRearm allows it.
    void rearm() noexcept;
    bool canRearm() const noexcept;
    void hold() noexcept { held = true; }   ///< the next run starts stopped, until rearm() or until the user starts it
    bool isHeld() const noexcept { return held; }
    bool beganHeld() const noexcept { return held && began_held; }   ///< a stop of an earlier graph still holds the forces
    bool isStoppedForGood() const;                                   ///< true after a latched stop, until rearm() or until the user starts another run

    /// Stops, waits until the forces are zero, and releases the devices.
    void letGo();

    /// By role, the limits that guards of this graph have asked for since the user started it. They stay when the run restarts by itself.
    const std::map<std::string, GuardLimits>& keptLimits() const noexcept { return kept_limits; }
    void keepLimits (std::map<std::string, GuardLimits> limits) { kept_limits = std::move (limits); }

    bool isRunning() const noexcept { return session && session->isRunning(); }
    bool isWanted() const noexcept { return wanted; }                               ///< started and not stopped since; it may still fail to compile
    bool isWaiting() const noexcept { return wanted && ! session; }                 ///< started, but the graph does not compile yet: an edit may start it
    bool isOfOpenGraph() const noexcept { return run_of == document.identity(); }   ///< false while the run of the previous graph still fades out
    bool lacksDevice() const noexcept { return ! lacking.empty(); }                 ///< a device could not be opened as the graph or the session describes it
    const Hand& hand() const noexcept { return moved_by; }

    /// True if the mouse, or a path that the user has chosen, moves the tool of the role.
    bool isMovedOtherwise (const std::string& role) const;

    /// The gesture or recording that the hand's role follows; null if there is none that can be paused.
    const std::shared_ptr<TransportPath>& transport() const noexcept { return transported; }

    const graph::Graph& edited() const { return document.graph(); }

    /// Errors and warnings about the current graph.
    const Messages& messages() const noexcept { return said; }

    std::optional<RunStatus> status() const;   ///< of the run, even if it is over, unless another graph was opened since

    /// The needs of the graph from its roles, as of the last successful compile.
    const std::vector<RoleNeeds>& needs() const noexcept { return needed; }

    /// The state of the real devices, whether present or awaited; empty while nothing runs.
    const std::vector<DeviceHealth>& health() const noexcept;

    /// True while the run drives something that can push or shake: a device, present or awaited, or a sound card. False if all roles are
    /// simulated.
    bool drivesDevice() const { return session && session->drivesDevice(); }

    /// The privileges that the system refused to the tick thread when the run started: a sentence for each, with what to do: docs/realtime.md.
    const std::vector<std::string>& refusals() const noexcept { return refused; }

    /// True if the run drives something that can push or shake, or would if it began now.
    bool meansDevice() const;

    /// The role whose device ticks the run; empty if a timer does.
    const std::string& clockRole() const noexcept;

    /// The run's tick rate, in Hz.
    double rate() const noexcept { return session ? session->rate() : document.graph().rate_hz; }

    /// Ticks from a movement of the hand to its effect on the motor, by the fastest and by the slowest path.
    struct Delay
    {
        std::int64_t shortest = 0, longest = 0;
    };

    /// The delay of the graph and of the hand's device. Empty if no source is connected to a sink.
    std::optional<Delay> delay() const;

    /// The delay of the hand's device, in ticks; 0 if it is not known.
    double handDelay() const noexcept { return hand_delay; }

    /// The stiffness that a wall may have on the first device before it buzzes, K < 2b/((2d+1)T), in N/m, on the slowest path. Empty if the damping of the
    /// device is unknown.
    std::optional<double> stiffnessLeft() const;

    /// The largest force that the guards let through, in N; empty if they do not limit it.
    std::optional<double> mostForce() const;
    std::optional<double> mostSignal() const;   ///< the same for signal outputs, in their unit

    /// Sets the position that the mouse points at, in m. No effect unless the mouse moves the tool.
    void point (const Vec3&);

    /// Holds the workspace of the hand's device, or releases it: while it is held, it moves with the hand (docs/sessions.md). The force does not step.
    /// False if there is nothing to hold: the session binds no device to the role, or something else moves its tool.
    bool holdWorkspace (bool);

    /// The place of a role's device in the graph now, including what a clutch has moved. Empty if the session binds no device to the role, or if
    /// something else moves its tool.
    std::optional<Workspace> workspaceOf (const std::string& role) const;

    /// The tool of the hand, as its device measures it, and the force on it.
    struct Tool
    {
        Vec3 position = Vec3::Zero();   ///< in m
        Vec3 force = Vec3::Zero();      ///< on the tool, in N
    };
    std::string handRole() const { return handRoleOf (needed); }   ///< the role of that tool; empty if the graph has none
    std::vector<std::string> toolRoles() const;                    ///< the roles whose tool the hand can move
    std::optional<Tool> tool() const;                              ///< empty while nothing runs

    /// The values of the ports that are being watched.
    Traces& traces() noexcept { return probes; }

    /// The values of the ports on the canvas.
    PortFeed& portFeed() noexcept { return port_feed; }

    /// The feed of a picture of the scene.
    SceneFeed& scene() noexcept { return scene_feed; }

    /// The last seconds of the scene and of the hand's tool.
    FilmTape& film() noexcept { return film_tape; }

    /// The costs of the nodes measured so far, the most expensive first.
    std::vector<NodeCost> costs();

    /// Sets a parameter or control of the running graph until the next edit, or returns an error with the reason why not. Ids:
    /// run/stopped, and those of framework/run/turn.hpp.
    Result<> turn (const std::string& param, const Json& value);
    Result<> turnControl (const std::string& id, double value);

    /// Triggers a hit at an input, with a speed in m/s. Ids: those of turn().
    Result<> strike (const std::string& input, double speed);

    /// Captures a port around an edge of another one, replacing any earlier capture. Returns the names of the captured
    /// components, or an error. The capture ends with the run, or when an edit affects a port that it watches.
    Result<std::vector<std::string>> capture (const std::string& port, const std::string& watched, const Trigger&);
    const TriggeredCapture* captured() const noexcept { return session ? session->run().captured() : nullptr; }   ///< null until it has triggered
    bool isCapturing() const noexcept { return session && session->run().isCapturing(); }
    void endCapture();

    /// The next run to start is logged to this file, from its first tick to its end; `program` is this program and its version. A stop before that run
    /// has begun forgets the file.
    void logNextTo (std::filesystem::path file, std::string program);
    void stopLogging();                                                            ///< completes the log now; the run goes on
    bool isLogging() const noexcept { return isLogged() || ! log_next.empty(); }   ///< the log is wanted, or being written
    bool isLogged() const noexcept { return is_logged; }                           ///< the log is being written: the run before has ended

    /// Called before a run that is being logged restarts: call logNextTo() in it to log the next run, too. A stop is no restart, nor is startOther().
    std::function<void()> onRestart;

    /// From now on, replaces the plan that runs by compiled code (docs/fusion.md); empty: runs by the plan. The forces do not change.
    void fuse (std::optional<Fuser::Options>);

    /// The kind of code that runs: "plan", "plan, fusing" or "fused"; empty if fuse() is not wanted.
    std::string fusion() const;

    /// Frees what is no longer used, and collects new samples. Call this many times a second.
    void poll();

private:
    /// The first positions of a tool that the mouse holds, and of the hand that holds it, in m.
    struct HeldAt
    {
        Vec3 tool, hand;
    };

    void tell (LiveSession::Events);
    void documentChanged() override;
    void after (const Plan&, std::uint64_t tick, bool halts) noexcept override;

    bool isLive() const noexcept { return session && session->isLive(); }
    bool isLatched() const { return session && session->isLatched(); }
    void restart();
    void tellOfRestart();
    void beginSoon (bool by_start);
    void haltSoon() noexcept;
    void begin();
    void end();
    LiveSession::Options sessionOptions();
    Compiled check (const graph::Graph&);
    std::string handRoleOf (const std::vector<RoleNeeds>&) const;
    void setHandRole();
    bool hasPlace (const std::string& role) const;
    bool isSoundCard (const std::string& role) const;
    void takeOver();
    void showScene();
    audio::AudioSettings audioWanted (Messages&) const;
    void beginSound();
    void beginLog();
    void endLog();
    bool isBound (const std::string& role) const;
    WorkspaceDevice* workspaceDevice (const std::string& role) const;
    bool moveWorkspaces (const DeviceSession& now);
    bool lacksPluginDevice() const;
    void adopt (const std::string& role, Run::RoleDevice&, const Workspace&, Messages&);
    void adoptHand (Run::RoleDevice&, const Workspace&, Messages&);
    std::unique_ptr<Device> chosenHand (const SimulatedDevice* described, double& damping, Messages&);
    void note (const Plan&);

    Document& document;
    const Catalogue& catalogue;
    std::optional<std::uint64_t> version;   // of the document at its latest change
    FileAssets assets;
    Messages said;
    std::vector<std::string> refused;   // by the system, to the latest run
    Traces probes;
    SceneFeed scene_feed;
    FilmTape film_tape;
    PortFeed port_feed;
    Sound* sound;
    std::atomic<bool> mutes_sound = false;               // a role of this run limits a channel that the sound may share
    std::map<std::string, GuardLimits> kept_limits {};   // by role, what the graphs have asked for since the user started
    Hand moved_by;
    bool held = false;         // an emergency stop or another latched stop holds the forces at zero until rearm()
    bool began_held = false;   // when the run began
    bool ends_stops = false;   // START was pressed, so the run that begins next ends the latched stops of the one before
    StopSwitch own_stops;      // until obey()
    StopSwitch* stops = &own_stops;
    bool begins = false;                                     // starts once the previous run is over
    bool begins_again = false;                               // by itself, so that the tool may be inside of something
    std::optional<Tool> resting;                             // the tool when this run was asked to begin again, if it stays where it is
    std::optional<HeldAt> held_at;                           // where the next tool begins, if not above the origin
    bool wanted = false;                                     // started and not stopped: the run begins as soon as the graph compiles
    std::vector<std::pair<std::string, Json>> run_devices;   // the graph's devices at the start of the run
    const DeviceSetup* setup = nullptr;
    DeviceSession run_session;        // the session at the start of the run
    double graph_rate_hz = 0.0;       // the graph's rate at the start of the run
    const void* run_of = nullptr;     // identity of the graph at the start of the run
    std::string hand_role;            // of the run; written only while nothing runs
    std::string chosen_role;          // by moveTool(); may not be in the graph any more
    const void* hand_of;              // identity of the graph that these two belong to
    std::filesystem::path log_next;   // of the next run; empty: none
    std::string log_program;
    bool is_logged = false;      // this run writes a log
    double hand_damping = 0.0;   // damping of the hand role's device, as seen in the graph's workspace, in N s/m
    Messages lacking;            // of the run: why devices could not be opened
    double hand_delay = 0.0;     // of that device, in ticks
    std::vector<RoleNeeds> needed;
    std::optional<Fuser::Options> fuses;   // empty: runs by the plan
    std::optional<Delay> graph_delay;
    std::shared_ptr<PointerPath> pointer;
    std::shared_ptr<TransportPath> transported;
    Snapshot<std::array<double, 6>> seen;   // the tool's position and the force on it
    std::unique_ptr<audio::AudioRig> rig;   // declared before the session, because it drives some of the run's devices
    std::unique_ptr<LiveSession> session;   // declared last, because it ticks the other members
};

}   // namespace tactus::host
