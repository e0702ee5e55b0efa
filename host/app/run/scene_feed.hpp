// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/scene/scene.hpp>
#include <tactus/kit/threads/snapshot.hpp>
#include <tactus/run/probe_ring.hpp>
#include <tactus/run/run.hpp>

#include <atomic>
#include <functional>
#include <map>

namespace tactus::host
{

/// The part of a run that a picture of the scene shows: its bodies, its tools, and the values of their ports. Unwatched, it costs a run one test per
/// tick. [main thread]
class SceneFeed final : public RunListener
{
public:
    static constexpr std::size_t most_tools = 4;
    static constexpr double pictures_per_second = 120.0;   ///< how often values are taken, at most

    /// Starts or stops watching. Values arrive once the graph has been compiled again; see onWanted.
    void watch (bool);

    /// Takes the bodies from a plan that runs next, or from a plan that does not run; null: there are none. Does nothing while unwatched.
    void show (const Plan*);

    /// The bodies changed whenever this number did. No other feed in the process ever has the same number; 0: no bodies yet.
    std::uint64_t version() const noexcept { return shown; }
    const std::vector<scene::Body>& bodies() const noexcept { return all; }

    /// The tools and values of the latest tick; without tools if nothing has run since clear().
    scene::SceneState now();

    /// Nothing runs any more: forgets the values.
    void clear();

    std::function<bool (const std::string& role)> hasPlace;   ///< false for the role of a sound card, which is not shown; unset: all have one
    std::function<void()> onWatched;                          ///< called when watching begins, to show() the current plan
    std::function<void()> onWanted;                           ///< called when the watched ports have changed

    std::vector<std::string> ports() const override { return wanted; }
    void planComes (const Plan&) override;
    void after (const Plan&, std::uint64_t tick, bool halts) noexcept override;

private:
    /// The readings of the first roles of a plan; words of 8 bytes.
    struct Tools
    {
        std::uint64_t plan = 0, count = 0;
        std::array<std::array<double, 6>, most_tools> values {};   // position and force
    };

    void wantPorts();

    std::vector<scene::Body> all;
    std::uint64_t shown = 0;
    bool is_watched = false;
    std::vector<std::string> wanted;
    std::atomic<std::uint32_t> every = 0;   // ticks between two readings of the tools; 0: none
    ProbeRing ring;
    Snapshot<Tools> tools;

    std::uint32_t spacing = 0;                                 // ticks between two samples, as of the latest plan
    std::vector<std::size_t> taps;                             // by value in a frame
    std::vector<std::string> names;                            // of these taps
    std::vector<std::uint64_t> selected;                       // serial numbers of plans that all have these taps
    std::map<std::string, double> values;                      // the latest ones, by name of the component
    std::map<std::uint64_t, std::vector<std::string>> roles;   // of the latest plans, by serial number; empty: has no place
};

}   // namespace tactus::host
