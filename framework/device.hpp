// SPDX-License-Identifier: MIT
#pragma once

#include "list.hpp"

#include <cstdint>

namespace tactus
{

/// What a device tells at a tick. SI, right-handed: x right, y away from the person, z up.
struct Reading
{
    Vec3 position = Vec3::Zero();        ///< m, as measured: quantised
    Vec3 rotation = Vec3::Zero();        ///< rotation vector, rad
    double pressure = 0.0;               ///< N, where the device has it
    std::uint32_t buttons = 0;           ///< bit i: button i is down
    double age = 0.0;                    ///< s since the device took this reading
    bool valid = true;                   ///< false while the device has nothing to say
    Vec3 true_position = Vec3::Zero();   ///< m, only known to a simulated device
    Vec3 true_velocity = Vec3::Zero();   ///< m/s, only known to a simulated device
};

/// What is asked of a device: force on the tool (N) and torque on the tool (N m).
struct Effort
{
    Vec3 force = Vec3::Zero();
    Vec3 torque = Vec3::Zero();
};

/// One role as the nodes see it: the reading of this tick, and what the guard let through on the last one.
/// The engine owns it and it never moves; device nodes hold a pointer to it.
struct DeviceState
{
    Reading reading;
    Effort applied;
};

/// A driver. The engine calls read, runs the graph, and calls write, once each tick and in this order, on the tick
/// thread; neither may allocate, lock or wait.
class Device
{
public:
    virtual ~Device() = default;

    /// The sample period is known before the first tick. Drivers on a clock of their own resample to it.
    virtual void prepare (double dt_s) = 0;
    virtual Reading read() noexcept = 0;
    virtual void write (const Effort& guarded) noexcept = 0;

    /// How long this device can drive a run, in s; 0 for one that goes on for ever (and so needs --duration).
    virtual double duration() const noexcept { return 0.0; }
};

}   // namespace tactus
