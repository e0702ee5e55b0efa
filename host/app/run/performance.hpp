// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "pointer_path.hpp"
#include "sound.hpp"
#include "traces.hpp"
#include "transport_path.hpp"

#include <framework/answering_thread.hpp>
#include <framework/plan/compile.hpp>
#include <host/app/model/document.hpp>
#include <host/assets/file_assets.hpp>
#include <host/audio/open_audio.hpp>
#include <host/devices/make_device.hpp>
#include <host/devices/sim.hpp>
#include <host/runtime/runner.hpp>
#include <host/runtime/taps.hpp>
#include <host/sessions/choose_clock.hpp>
#include <host/sessions/device_health.hpp>
#include <host/sessions/device_session.hpp>
#include <host/sessions/needs.hpp>
#include <host/sessions/run_clock.hpp>

#include <memory>
#include <optional>
#include <variant>

namespace tactus::host
{

class DeviceDesk;

/// The graph of a document as it runs: on the devices it describes, or that its roles are bound to, in real time, and each edit is taken over between two
/// ticks. What does not compile is said, and the graph before goes on. [main thread]
class Performance final : private Document::Listener, private TickHooks
{
public:
    /// Who moves the tool of the first role.
    struct Hand
    {
        enum class Kind
        {
            described,   ///< what the session binds, or the graph says: a device, a gesture or a recording
            pointer,     ///< the mouse
            path         ///< a gesture or a recording of somebody's choice
        };

        Kind kind = Kind::described;
        std::string path {};   ///< name of a gesture, or a CSV file

        static Hand pointer() { return { Kind::pointer }; }
        bool operator== (const Hand&) const = default;
    };

    /// The force on the first role's tool is heard, if there is a sound, which outlives this.
    Performance (Document&, const Catalogue&, Sound* = nullptr);
    ~Performance() override;

    /// From now on roles are bound, ports are played and runs are ticked as this session says, which outlives this. A change of
    /// what a run uses starts it anew.
    void use (const DeviceDesk&);
    void deskChanged();

    /// How the sound of the run is doing; nothing if it plays and hears nothing.
    std::optional<audio::AudioStatus> audioStatus() const;

    void start (Hand);      ///< anew, if it runs, as soon as its forces are zero
    void stop() noexcept;   ///< the forces go to zero first; does not wait for that

    /// No force on any device, smoothly, while the graph goes on; what has stopped for good, as this, ends with rearm(), or
    /// when a person starts anew; no edit ends it.
    void emergencyStop() noexcept;
    void rearm() noexcept;
    bool isStoppedForGood() const;   ///< until rearm(), or another run

    /// Stops, waits until the forces are zero, and lets go of the devices.
    void letGo();

    bool isRunning() const noexcept { return runner != nullptr && ! runner->isOver(); }
    bool isWanted() const noexcept { return wanted; }   ///< started, and not stopped since; perhaps it does not compile
    const Hand& hand() const noexcept { return moved_by; }

    /// The gesture or recording that the first role follows; null if it follows none that can be stopped.
    const std::shared_ptr<TransportPath>& transport() const noexcept { return transported; }

    /// What is wrong with the graph as it is, and what is to be said of it.
    const Messages& messages() const noexcept { return said; }

    std::optional<RunStatus> status() const;

    /// What the graph needs of its roles, as it last compiled.
    const std::vector<RoleNeeds>& needs() const noexcept { return needed; }

    /// How the devices are doing that are really there, or awaited; empty while nothing runs.
    const std::vector<DeviceHealth>& health() const noexcept { return watch.health(); }

    const std::string& clockRole() const noexcept { return clock_role; }   ///< whose device ticks the run; empty: a timer does
    double rate() const noexcept { return rate_hz; }                       ///< Hz; of the run

    /// How late the latest answer of a sink to a source is on its shortest way, in ticks; nothing if none are joined.
    std::optional<std::int64_t> delay() const;

    /// How stiff a wall may be on the first device before it buzzes, K < 2b/((2d+1)T), in N/m; nothing where nobody says how
    /// much the device damps.
    std::optional<double> stiffnessLeft() const;

    /// The largest force that the guards let through, in N; nothing if they do not limit it.
    std::optional<double> mostForce() const;

    /// Where the mouse wants the tool, in m.
    void point (const Vec3&);

    /// The tool of the first role, as its device measures it, and the force on it.
    struct Tool
    {
        Vec3 position = Vec3::Zero();   ///< m
        Vec3 force = Vec3::Zero();      ///< N, on the tool
    };
    std::optional<Tool> tool() const;   ///< nothing while nothing runs

    /// What stands on the ports that somebody wants to see.
    Traces& traces() noexcept { return probes; }

    /// What the nodes cost, the costliest first; of those that were measured.
    std::vector<NodeCost> costs();

    /// Turns a parameter or a control of what runs, until the next edit; or why not. Ids: run/stopped, and those of
    /// framework/turn.hpp.
    std::optional<Message> turn (const std::string& param, const Json& value);
    std::optional<Message> turnControl (const std::string& id, double value);

    /// Strikes an input for hits, in m/s; or why not, likewise.
    std::optional<Message> strike (const std::string& input, double speed);

    /// Takes down what stands on a port around an edge of another one, in place of what was asked for before. Returns the
    /// names of its components, or why not. The end of the run ends it, and an edit that is about what it looks at.
    std::variant<std::vector<std::string>, Message> capture (const std::string& port, const std::string& watched, const Trigger&);
    const TriggeredCapture* captured() const noexcept { return slot.complete(); }   ///< null until it has triggered
    bool isCapturing() const noexcept { return ! captured_ports.empty(); }
    void endCapture();

    /// Frees what is used no more, and takes in what was seen. To be called many times a second.
    void attend();

private:
    struct Bound
    {
        std::string role;
        std::unique_ptr<Device> device;
        GuardLimits limits;
        double damping = 0.0;       // N s/m, of the device, as the graph's workspace has it
        Device* driver = nullptr;   // the same device, without a workspace around it
    };

    void documentChanged() override;
    void before (std::uint64_t) noexcept override;
    void after (std::uint64_t tick, bool halts) noexcept override;

    void beginAnew (bool stays_stopped);
    void begin();
    void end();
    std::string handRoleOf (const Plan&) const;
    const Bound* handDevice() const;
    void takeOver();
    Compiled compileAt (double rate, const Plan* before, const Plan* withdrawn);
    std::optional<Bound> open (const std::string& role);
    MadeDevice openOther (const std::string& role, const Json& description, const std::filesystem::path& folder);
    audio::AudioSettings audioWanted (Messages&) const;
    void beginSound();
    std::optional<Bound> openByDesk (const std::string& role);
    ClockChoice decideClock (const Plan&) const;
    std::unique_ptr<TickClock> makeClock();
    std::vector<RealDevice> realDevices() const;
    bool isMovedOtherwise (const std::string& role) const;
    std::unique_ptr<Device> chosenHand (const SimulatedDevice* described, double& damping);
    void noteDelay (const Plan&);

    Document& document;
    const Catalogue& catalogue;
    FileAssets assets;
    Messages said;
    Traces probes;
    CaptureSlot slot;
    std::vector<std::string> captured_ports;
    std::vector<std::size_t> captured_taps;
    Sound* sound;
    Hand moved_by;
    bool held = false;                                       // by an emergency stop, or what else has stopped for good, until rearm
    bool begins = false;                                     // once the run before is over
    bool wanted = false;                                     // started and not stopped: it begins as soon as the graph compiles
    std::vector<std::pair<std::string, Json>> run_devices;   // the devices, when the run began
    const DeviceDesk* desk = nullptr;
    DeviceSession run_desk;                      // likewise
    double graph_rate_hz = 0.0, rate_hz = 0.0;   // which differ where a device ticks
    std::string clock_role, hand_role;
    HealthWatch watch;
    std::vector<RoleNeeds> needed;
    int attended = 0;
    std::optional<std::int64_t> delay_ticks;
    const Plan* first_plan = nullptr;   // while the devices of a run are opened, before there is an engine
    std::shared_ptr<PointerPath> pointer;
    std::shared_ptr<TransportPath> transported;
    std::unique_ptr<audio::AudioRig> rig;   // before the devices, of which it has some
    std::vector<Bound> devices;
    Snapshot<std::array<double, 6>> seen;       // position and force
    std::unique_ptr<AnsweringThread> answers;   // before the engine, whose nodes ask it
    std::unique_ptr<Engine> engine;
    std::unique_ptr<TickClock> clock;   // where it is not the rig's
    std::unique_ptr<Runner> runner;     // last: it ticks the engine
};

}   // namespace tactus::host
