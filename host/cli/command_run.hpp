// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hardware.hpp"
#include "run_options.hpp"

#include <host/assets/file_assets.hpp>
#include <host/sessions/binding.hpp>
#include <host/sessions/choose_clock.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/feed.hpp>
#include <tactus/run/port_probes.hpp>
#include <tactus/run/run.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <set>
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

    /// Reads and compiles the graph and opens the devices. Throws Stop if something is wrong.
    CommandRun (const RunOptions&, Pace);

    Run& run() noexcept { return *running; }
    Engine& engine() noexcept { return running->engine(); }
    double rate() const noexcept { return running->rate(); }   ///< Hz

    /// The role whose device ticks the run at its own rate; empty if no device does. Live only.
    const std::string& clockRole() const noexcept { return clock_role; }
    audio::AudioRig& audio() noexcept { return rig; }
    const audio::AudioRig& audio() const noexcept { return rig; }
    PortProbes& probes() noexcept { return port_probes; }

    /// The real devices of the run.
    std::vector<RealDevice> realDevices() const;

    /// The length of the run, in ticks; empty if no option, feed or device gives one.
    std::optional<std::size_t> ticks() const noexcept { return count; }
    std::size_t ticksOrFail() const;   ///< the command ends if the length is unknown

    /// Reads the graph file again and swaps it in; what both versions contain keeps running. If the file has errors,
    /// prints them and returns false, and the previous graph keeps running. Roles keep their devices; a new role gets
    /// the device described in the file.
    bool reload();

    Result<std::vector<std::string>> probe (const std::vector<std::string>& ports) { return port_probes.probe (*running, loaded.graph, ports); }
    Result<std::vector<std::string>> capture (const std::string& port, const std::string& watched, const Trigger& trigger)
    {
        return running->capture (loaded.graph, port, watched, trigger);
    }

    const graph::Graph& graph() const noexcept { return loaded.graph; }
    const std::string& name() const noexcept { return loaded.graph.name; }

    /// The graph file, and the files that it includes.
    std::vector<std::filesystem::path> files() const;

    /// Every file that the run reads: the graph, files used by nodes and devices, and the feed.
    std::vector<std::filesystem::path> inputs() const;

    /// Writes the log and frees what is no longer used; warns once if the log ends early. Call it many times a second.
    void attend();

    /// Prints why guards withheld forces, and how many async queries were late. Call this after the run.
    void reportRun() const;

private:
    void readDeviceSession();
    void chooseAudio();
    void decideClock();
    void readFeed();
    void load();
    void openDevices();
    void checkDeviceOptions();
    void decideLength (Pace);
    void startAudio();
    std::vector<Described> devicesByRole();
    Result<DeviceOption> optionOf (const std::string& text, Messages& notes);
    Run::RoleDevice open (const std::string& role, const graph::Graph&, const Plan&, Messages&);
    MadeDevice openByOption (const DeviceOption&, const Plan&);
    Run::RoleDevice openBySession (const std::string& role, RoleBinding, const Plan&, Messages&);
    Messages notTakenOver (const graph::Graph&) const;
    std::filesystem::path folder() const { return std::filesystem::path (options.graph).parent_path(); }

    RunOptions options;
    LoadedGraph loaded;
    LoadedSession device_session;   // empty if the run uses no session
    FileAssets assets;
    std::optional<Feed> feed;
    audio::AudioRig rig;   // declared before the run, because it drives some of the run's devices
    Hardware real;
    PortProbes port_probes;
    std::string clock_role;
    double asked_rate_hz = 0.0;   // rate from an option, a feed or the clock; 0: the graph's
    std::optional<std::size_t> count;
    std::vector<DeviceOption> device_options;
    std::set<std::string> described_by_graph;   // roles whose device comes from neither an option nor the session
    bool with_placeholders = false;
    std::unique_ptr<Run> running;   // declared last: it uses the other members
};

}   // namespace tactus::host
