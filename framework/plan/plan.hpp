// SPDX-License-Identifier: MIT
#pragma once

#include "order.hpp"
#include "sum.hpp"

#include <framework/catalogue.hpp>

#include <cstddef>
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
};

/// What compiling a graph results in: contiguous records in running order, and the storage they point into. It never
/// changes shape; only the values of its nodes, wires and feeds move. One thread ticks it.
class Plan
{
public:
    /// A sink node and the role it acts on.
    struct SinkUse
    {
        Effort (*effort) (const void* node) noexcept;
        const void* node;
    };

    struct RoleUse
    {
        std::string name;
        std::unique_ptr<DeviceState> state;   ///< written by the engine before the tick; nodes point at it
        std::vector<SinkUse> sinks;
    };

    void tick() noexcept   // [tick thread]
    {
        for (const auto& r : records)
            r.step (r.self, r.sources, r.outputs);
    }

    double rate_hz = 0.0;   ///< what the nodes were prepared for
    std::vector<Record> records;
    std::vector<RoleUse> roles;            ///< sorted by name
    std::vector<Tap> taps;                 ///< what CompileOptions::records asked for, in order
    std::vector<double> feeds;             ///< one value per CompileOptions::feeds, set before each tick
    std::vector<plan::PathDelay> delays;   ///< between devices' sources and sinks
    std::shared_ptr<void> storage;         ///< nodes, outputs, wires, constants: what all pointers point into
};

}   // namespace tactus
