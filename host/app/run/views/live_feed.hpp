// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/canvas/canvas.hpp>
#include <host/app/run/limit_watch.hpp>
#include <host/app/run/live_run.hpp>

namespace tactus::host
{

/// Shows the run on a canvas: the states of nodes, what wires carry, hits as they travel along wires, the value of the port under the
/// pointer, problems, broken limits, and optionally what each node costs.
class LiveFeed
{
public:
    static constexpr int rests_for = 5;               ///< refreshes that the pointer rests on a port until its card appears
    static constexpr int numbers_every = 4;           ///< refreshes between two values in a card: digits that change faster cannot be read
    static constexpr std::size_t most_sources = 64;   ///< how many ports it watches for their wires, at most
    static constexpr std::size_t most_driven = 256;   ///< how many params it watches that wires set, at most

    LiveFeed (Canvas&, LiveRun&);
    ~LiveFeed();

    void refresh();   ///< call many times a second

    /// The value to which a wire sets a param of the patch, such as "drag.mu", in SI, by component. Empty unless it runs.
    std::vector<double> valuesOf (const std::string& param) const;

    bool shows_costs = false;
    const LimitWatch* limits = nullptr;   ///< whose list to show; null for none

private:
    /// The ports, nodes and wires of a scene that it watches.
    struct Watched
    {
        struct Item
        {
            graph::Id id = 0;       // of a node or a wire
            std::size_t port = 0;   // index in a list of ports
            bool is_hit = false;    // else the state of a node
        };
        std::uint64_t scene = 0;   // its number
        std::vector<std::string> ports {}, sources {};
        std::vector<Item> items {}, wires {};   // items at ports, wires at sources
    };

    const Watched& watched();
    void showStates (LiveState&);
    void showActivity (LiveState&);
    void showCard (LiveState&);
    void showDriven (LiveState&);
    const std::vector<std::string>& drivenParams (const graph::Patch&) const;
    bool isInput (const std::string& type, const std::string& port) const;
    std::vector<std::string> portsNow() const;
    void showCosts (LiveState&);
    void showProblems (LiveState&) const;
    void showLimits (LiveState&) const;
    const SceneNode* nodeOf (const std::string& path) const;

    static constexpr std::size_t most_ports = 12;   ///< how many ports this probes at most; the rest of the probe capacity is left for the scopes
    static constexpr double hit_travels_s = 0.25;
    static constexpr int refreshes_per_cost = 30;

    Canvas& canvas;
    LiveRun& live_run;
    Traces::Client probes;
    std::map<graph::Id, double> latest_costs;
    int since_costs = refreshes_per_cost;

    Watched of_scene;
    std::map<graph::Id, int> shown_levels;
    PointedPort pointed;     // since when: `rested`
    std::string asked_for;   // a port that had a card, and that no wire of the patch starts from
    int rested = 0;
    std::vector<std::string> shown_values;
    mutable std::optional<std::pair<std::uint64_t, SeenPatch>> driven_of;   // the version of the document and the patch of `driven_params`
    mutable std::vector<std::string> driven_params;
    std::map<std::string, PortFeed::Reading> driven_now;
    int since_driven = 0;
};

}   // namespace tactus::host
