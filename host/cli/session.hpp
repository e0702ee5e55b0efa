// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "feed.hpp"
#include "hardware.hpp"

#include <framework/answering_thread.hpp>
#include <framework/engine.hpp>
#include <framework/file/graph_file.hpp>
#include <framework/plan/compile.hpp>
#include <host/assets/file_assets.hpp>
#include <host/devices/make_device.hpp>
#include <host/runlog/noted_assets.hpp>
#include <host/runlog/run_log.hpp>
#include <host/runtime/probe_ring.hpp>
#include <host/runtime/runner.hpp>
#include <host/runtime/triggered_capture.hpp>
#include <host/sessions/binding.hpp>
#include <host/sessions/choose_clock.hpp>

#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// What render and play are told on the command line.
struct SessionOptions
{
    std::string graph, feed;
    std::vector<std::string> records, outputs, sets, devices;
    std::string log;       ///< where what comes in is to be written down; "": nowhere
    std::string clock;     ///< the role whose device ticks the run, "timer" or "audio"; "": as the session has it, or the first that can
    std::string session;   ///< of a live run, which devices its roles are bound to: a file, or "off"; "": the user's
    bool strict = false;   ///< a device of the session that is not there ends it
    std::vector<std::string> routes;
    std::string card;      ///< the sound card: TYPE:NAME, TYPE or NAME; "": as the session has it, or any
    std::string capture;   ///< where what it is given is to be written; "": nowhere
    double rate_hz = 0.0, duration_s = 0.0;

    void addTo (CLI::App&);
};

/// NODE.PARAM=VALUE, as --set takes it.
plan::Override readSet (const std::string&);

/// A graph with its devices, compiled and ready to tick: by tick(), or by a Runner whose hooks it is.
class Session final : public TickHooks
{
public:
    enum class Pace
    {
        offline,   ///< each tick takes what it takes
        live       ///< slow questions are answered on a thread of their own
    };

    /// Reads, compiles, binds. Says all that is wrong on stderr and throws Stop if something is.
    Session (const SessionOptions&, Pace);

    Engine& engine() noexcept { return *running; }
    double rate() const noexcept { return rate_hz; }   ///< Hz

    /// The role whose device ticks the run, at its own rate; empty: none does. Only of a live session.
    const std::string& clockRole() const noexcept { return clock_role; }
    /// What the run plays and hears. [main thread]
    audio::AudioRig& audio() noexcept { return rig; }

    /// The taps that are recorded: there are others behind them. [main thread, before ticking]
    std::vector<Tap> recorded() const;

    /// The devices that are really there. [main thread]
    std::vector<RealDevice> realDevices() const;

    /// How long the run lasts; nothing if nobody said.
    std::optional<std::size_t> ticks() const noexcept { return count; }

    /// One sample. [tick thread]
    void tick() noexcept;

    void before (std::uint64_t tick) noexcept override;              // [tick thread]
    void after (std::uint64_t tick, bool halts) noexcept override;   // [tick thread]

    //==========================================================================
    // While it ticks. [main thread]

    /// Reads the graph file again and has it take over from the one that runs; what both have lives on. Says on stderr what
    /// is wrong with it, and then returns false: the graph before goes on. Roles keep the devices they have; one that is
    /// new gets the device that the file describes.
    bool reload();

    /// From now on these ports are looked at, some 1000 times a second, and no others; what ticks is not touched. Returns the
    /// names of their components, each once, or why not: then all is as it was. A graph that is reloaded is not looked at.
    std::variant<std::vector<std::string>, Message> probe (const std::vector<std::string>& ports);

    /// Takes down what stands on a port around the tick on which another one triggers, in place of what was asked for
    /// before. Returns the names of its components, or why not. A graph that is reloaded is not waited for.
    std::variant<std::vector<std::string>, Message> capture (const std::string& port, const std::string& watched, const Trigger&);
    const TriggeredCapture* captured() const noexcept { return slot.complete(); }   ///< null until it has triggered
    void endCapture();

    /// Hands on what was seen there since the last time: the tick, and the values by component.
    template <typename F>
    void drainProbes (F&& f)
    {
        const auto* newest = &running->newest();
        ring.drain ([&] (const ProbeRing::Frame& frame)
                    {
            if (frame.plan == newest) f (frame.tick, std::span (frame.values).first (frame.size)); });
    }

    /// Writes down what has come in. To be called many times a second, and finishLog once after the last tick.
    void drainLog();

    /// Why the log ends before the run did, if it does.
    std::optional<Error> finishLog();

    const graph::Graph& graph() const noexcept { return loaded.graph; }

    /// The graph file, and those that it includes.
    std::vector<std::filesystem::path> files() const;

    /// All files that are read: those, what nodes and devices take, and the feed.
    std::vector<std::filesystem::path> inputs() const;

    //==========================================================================
    /// Says on stderr why the guards withheld forces, if they did, and how many slow answers were late. [after the run]
    void reportRun() const;

    const std::string& name() const noexcept { return loaded.graph.name; }

private:
    struct Bound
    {
        std::string role;
        std::unique_ptr<Device> device;
        Device* driver = nullptr;   // the same, without a workspace around it
        GuardLimits limits;
        bool by_graph = true;   // not by an option or a session
    };

    SessionOptions told;
    LoadedGraph loaded;
    LoadedSession desk;   // empty if none is used
    FileAssets assets;
    NotedAssets noted { assets };
    std::optional<Feed> feed;
    audio::AudioRig rig;   // before the devices, of which it has some
    std::vector<Bound> devices;
    Hardware real;
    std::string clock_role;
    std::unique_ptr<AnsweringThread> answers;   // before the engine and the log, whose nodes ask it
    std::unique_ptr<RunLog> log;                // before the engine, which tells it
    std::unique_ptr<Engine> running;
    double rate_hz = 0.0;
    std::optional<std::size_t> count;
    std::uint64_t now = 0;

    bool with_placeholders = false, with_routes = false;
    bool log_broke = false;
    std::optional<Error> log_failure;
    ProbeRing ring;
    CaptureSlot slot;
    std::vector<std::string> probed, captured_ports;
    std::vector<std::string> records;   // the same for all plans, so that a recording goes on

    std::optional<Bound> open (const std::string& role, const graph::Graph&, const std::vector<DeviceOption>&, Messages&);
    std::vector<Bound> openNew (const Plan&, const graph::Graph&, Messages&);
    void forgetProbes();
    void readFeed();
    void readDesk();
    void chooseAudio();
    void decideClock();
    std::vector<Described> devicesByRole();
    std::shared_ptr<const Plan> compileGraph();
    void bindDevices();
    void startAudio();
    void decideLength();
    void startLog (std::shared_ptr<const Plan>);
    void submit (std::shared_ptr<Plan>, const graph::Graph&, std::span<const Engine::Joining> = {});
    Compiled compileNow (const graph::Graph&, const Plan* before, const Plan* withdrawn, const std::vector<std::string>& watched = {});
    Compiled compileWatched (const Plan* withdrawn);
    void selectProbes (const Plan&);
    Messages notTakenOver (const graph::Graph&) const;
};

}   // namespace tactus::host
