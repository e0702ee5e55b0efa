// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "run_options.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/devices/audio/open_audio.hpp>
#include <host/devices/live/live_session.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/feed.hpp>
#include <tactus/run/probe/port_probes.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// The run of a render or play command: its graph file, devices, sound and feed. Prints problems to stderr.
/// [main thread]
class CommandRun
{
public:
    enum class Pace
    {
        offline,   ///< each tick takes as long as necessary
        live       ///< in real time, with real devices and sound
    };

    /// Reads and compiles the graph and opens the devices. Throws Stop if something is wrong. A live run obeys the switch.
    CommandRun (const RunOptions&, Pace, StopSwitch* = nullptr);

    LiveSession& session() noexcept { return *playing; }
    Run& run() noexcept { return playing->run(); }
    const Run& run() const noexcept { return std::as_const (*playing).run(); }
    Engine& engine() noexcept { return playing->engine(); }
    double rate() const noexcept { return playing->rate(); }   ///< Hz
    audio::AudioRig& audio() noexcept { return rig; }
    PortProbes& probes() noexcept { return port_probes; }

    /// The length of the run, in ticks; empty if no option, feed or device gives one.
    std::optional<std::size_t> ticks() const noexcept { return count; }
    std::optional<double> seconds() const noexcept { return wall_s; }   ///< of wall time, in real time
    std::size_t ticksOrFail() const;                                    ///< the command ends if the length is unknown

    /// Reads the graph file again and swaps it in; what both versions contain keeps running. If the file has errors,
    /// prints them and returns false, and the previous graph keeps running. Roles keep their devices; a new role gets
    /// the device described in the file.
    bool reload();

    Result<std::vector<std::string>> probe (const std::vector<std::string>& ports) { return port_probes.probe (run(), graph(), ports); }
    Result<std::vector<std::string>> capture (const std::string& port, const std::string& watched, const Trigger& trigger)
    {
        return run().capture (graph(), port, watched, trigger);
    }

    const graph::Graph& graph() const noexcept { return playing->graph(); }
    const std::string& name() const noexcept { return graph().name; }

    /// The graph file, and the files that it includes.
    std::vector<std::filesystem::path> files() const;

    /// Every file that the run reads: the graph, files used by nodes and devices, and the feed.
    std::vector<std::filesystem::path> inputs() const;

    /// Prints why guards withheld forces, and how many async queries were late. Call this after the run.
    void reportRun() const;

private:
    void readFeed();
    LoadedSession readDeviceSession();
    void chooseAudio (const LoadedSession&);
    std::vector<DeviceOption> readDeviceOptions();
    LiveSession::Options sessionOptions (Pace, StopSwitch*);
    const hid::LoadedProfiles& profiles();
    void load();
    void checkRoles() const;
    void openDevices();
    void decideLength (Pace);
    void startAudio();
    int reportOn (const Messages&) const;
    std::filesystem::path folder() const { return std::filesystem::path (options.graph).parent_path(); }

    RunOptions options;
    LoadedGraph loaded;
    LoadedSession device_session;   // empty if the run uses no session
    std::vector<DeviceOption> device_options;
    FileAssets assets;
    std::optional<Feed> feed;
    audio::AudioRig rig;   // declared before the session, because it drives some of the run's devices
    std::optional<hid::LoadedProfiles> loaded_profiles;
    PortProbes port_probes;
    std::optional<std::size_t> count;
    std::optional<double> wall_s;
    std::unique_ptr<LiveSession> playing;   // declared last: it uses the other members
};

}   // namespace tactus::host
