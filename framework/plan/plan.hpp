// SPDX-License-Identifier: MIT
#pragma once

#include "order.hpp"
#include "ramps.hpp"
#include "sum.hpp"
#include "takeover.hpp"

#include <framework/catalogue.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace tactus
{

/// One step of a tick: a function and the pointers it works on, all resolved.
struct Record
{
    void (*step) (void* self, const double* const* sources, void* outputs) noexcept;
    void* self;
    const double* const* sources;
    void* outputs;
};

/// One recorded component: its name, what it carries, and where it stands after each tick.
struct Tap
{
    std::string name;   ///< "motor.force.x"
    Quantity quantity = Quantity::any;
    std::string unit;   ///< SI symbol, "" if nothing says
    const double* value = nullptr;
    int per_tick = 1;                  ///< samples in a tick: more than one in a section that runs `times` a tick
    const double* samples = nullptr;   ///< all of the tick, if there are several; the last of them is the value

    /// The sample that stands at the end of the i-th of n equal parts of the tick.
    double sample (int i, int n) const noexcept { return samples ? samples[((i + 1) * per_tick + n - 1) / n - 1] : *value; }
};

/// What compiling a graph results in: contiguous records in running order, and the storage they point into. It never
/// changes shape; only the values of its nodes, wires and feeds move. One thread ticks it. A plan that was compiled to
/// follow another shares with it the nodes that go on, and from the moment it takes over only it may tick.
class Plan
{
public:
    /// A sink node and the role it acts on.
    struct SinkUse
    {
        Effort (*effort) (const void* node) noexcept;
        const void* node;
        std::size_t instance;   ///< its number
    };

    /// A role stays when its last node goes, so that what is on its device can be taken off.
    struct RoleUse
    {
        std::string name;
        std::shared_ptr<DeviceState> state;   ///< written by the engine before the tick; nodes of all plans point at it
        std::vector<SinkUse> sinks;
        bool untouched = false;   ///< the same sinks as in the plan before, and nothing that leads to them is changed
    };

    /// One component of a delayed wire.
    struct LineUse
    {
        int wire, component;
        std::shared_ptr<plan::Line> line;
    };

    /// One component of a wire where it enters or leaves a section; feeds are counted after the wires.
    struct PassageUse
    {
        int wire, component;
        int step;   ///< of its way through the sections
        plan::Way way;
        std::shared_ptr<plan::Passage> passage;
    };

    void tick() noexcept   // [tick thread]
    {
        for (const auto& r : records)
            r.step (r.self, r.sources, r.outputs);
        ++number;
    }

    /// Goes on where the plan it was compiled to follow stands now. Before the first tick. [tick thread]
    void takeOver (const Plan& before, Journal* journal = nullptr) noexcept
    {
        if (feeds.size() == before.feeds.size()) std::ranges::copy (before.feeds, feeds.begin());
        takeover.carryOut (instances, ramps, journal);
    }

    std::uint64_t serial = plan::newSerial();   ///< of this plan, in its process; a later one has a higher one

    double rate_hz = 0.0;       ///< of its ticks
    std::uint64_t number = 0;   ///< of the tick that comes next, counted through all plans; whoever steps the records one by one sets it before each tick
    std::vector<Record> records;
    std::vector<std::uint32_t> owners;     ///< by record: the node it works for, as flat.nodes; of a wire's, the node where it ends
    std::vector<std::uint64_t> rests;      ///< ticks from run to run of sections that do not run on each, rising
    std::vector<RoleUse> roles;            ///< sorted by name
    std::vector<Tap> taps;                 ///< what CompileOptions::records asked for, in order
    std::vector<double> feeds;             ///< one value per CompileOptions::feeds, set before each tick
    std::vector<plan::PathDelay> delays;   ///< between devices' sources and sinks
    std::shared_ptr<void> storage;         ///< outputs, wires, constants: what all pointers point into

    // For the plan that follows, and for those who turn knobs.
    plan::Flat flat;                                           ///< what it was built from
    std::vector<plan::Instance> instances;                     ///< as flat.nodes
    std::vector<LineUse> lines;                                ///< by wire, then component
    std::vector<PassageUse> passages;                          ///< by wire, then component, then step
    std::vector<std::vector<plan::PortRef>> fed;               ///< as feeds: what each drives
    std::map<std::string, std::vector<plan::PortRef>> shown;   ///< params and inputs by the names under which subgraphs show them
    plan::Ramps ramps;
    plan::Takeover takeover;
};

}   // namespace tactus
