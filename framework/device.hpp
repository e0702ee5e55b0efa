// SPDX-License-Identifier: MIT
#pragma once

#include "list.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

/// Numbers of the axes or signal channels of a device, in place. To make one and to copy it costs what is in it, and not
/// what there is room for.
class Channels
{
public:
    static constexpr int most = 32;

    Channels() noexcept {}
    Channels (const Channels& other) noexcept { *this = other; }
    Channels (std::initializer_list<double> all) noexcept
    {
        for (const double v : all)
            set (count, v);
    }

    Channels& operator= (const Channels& other) noexcept
    {
        count = other.count;
        std::copy_n (other.values, count, values);
        return *this;
    }

    int size() const noexcept { return count; }
    bool has (int i) const noexcept { return i >= 0 && i < count; }

    /// 0 for what is not there.
    double operator[] (int i) const noexcept { return has (i) ? values[i] : 0.0; }

    /// Those before it that were not there become 0. Where there is no room, nothing happens.
    void set (int i, double value) noexcept
    {
        if (i < 0 || i >= most) return;
        while (count <= i)
            values[count++] = 0.0;
        values[i] = value;
    }

    void clear() noexcept { count = 0; }

    const double* begin() const noexcept { return values; }
    const double* end() const noexcept { return values + count; }

private:
    int count = 0;
    double values[most];   // the first `count` of them
};

inline bool isFinite (const Channels& all) noexcept
{
    return std::all_of (all.begin(), all.end(), [] (double v)
                        { return isFinite (v); });
}

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
    Channels axes {};                    ///< as DeviceLayout::axes has them
    Channels signals {};                 ///< of the signal inputs, channel 1 first
};

/// What is asked of a device.
struct Effort
{
    Vec3 force = Vec3::Zero();    ///< N, on the tool
    Vec3 torque = Vec3::Zero();   ///< N m, on the tool
    Channels axes {};             ///< N or N m, as DeviceLayout::efforts has them
    Channels signals {};          ///< of the signal outputs, channel 1 first; N, m/s2 or 1, as they are calibrated
};

/// What a device has beside a tool that is moved and pushed: by these names nodes find their part of a Reading and an
/// Effort. At most Channels::most of each kind are heeded, and of buttons 32.
struct DeviceLayout
{
    std::vector<std::string> axes {};      ///< that are read: triggers, sticks, joints. Each in m, rad or 1
    std::vector<std::string> efforts {};   ///< axes that can be pushed
    std::vector<std::string> buttons {};   ///< by bit; "" for one without a name
    int signal_inputs = 0, signal_outputs = 0;

    bool operator== (const DeviceLayout&) const = default;
};

/// -1 if there is none of this name.
inline int indexOf (const std::vector<std::string>& names, std::string_view name) noexcept
{
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == name) return static_cast<int> (i);
    return -1;
}

/// One role as the nodes see it: the reading of this tick, and what the guard let through on the last one.
/// The engine owns it and it never moves; device nodes hold a pointer to it. Its layout is empty until the role has a
/// device, and then stays; it is only looked at when a node is bound.
struct DeviceState
{
    Reading reading;
    Effort applied;
    DeviceLayout layout {};
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

    /// What it has beside a tool. Asked when the role gets the device, and does not change then. [main thread]
    virtual DeviceLayout layout() const { return {}; }

    /// How long this device can drive a run, in s; 0 for one that goes on for ever (and so needs --duration).
    virtual double duration() const noexcept { return 0.0; }
};

}   // namespace tactus
