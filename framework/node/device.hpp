// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/fine.hpp>
#include <tactus/node/reading_fault.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

class StateArchive;

/// The values of a device's axes or signal channels, stored in place. Constructing and copying costs only what is in use, not
/// the whole capacity.
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

    /// The value of a channel; 0 if it does not exist.
    double operator[] (int i) const noexcept { return has (i) ? values[i] : 0.0; }

    /// Missing channels before i become 0. Does nothing if there is no room.
    void set (int i, double value) noexcept
    {
        if (i < 0 || i >= most) return;
        while (count <= i)
            values[count++] = 0.0;
        values[i] = value;
    }

    void clear() noexcept { count = 0; }

    void serialize (auto& archive)
    {
        archive.index (count, static_cast<std::size_t> (most) + 1);
        for (int i = 0; i < count; ++i)
            archive (values[i]);
    }

    /// The address of the number of values in use. Plugins read it, and the values from begin(), in place.
    const int* used() const noexcept { return &count; }

    const double* begin() const noexcept { return values; }
    const double* end() const noexcept { return values + count; }

private:
    int count = 0;
    double values[most];   // only the first `count` are in use
};

inline bool isFinite (const Channels& all) noexcept
{
    return std::all_of (all.begin(), all.end(), [] (double v) { return isFinite (v); });
}

/// The reading of a device at a tick. SI, right-handed: x right, y away from the person, z up.
struct Reading
{
    static constexpr int most_buttons = 32;

    Position position = Position::Zero();        ///< as measured, so quantised; in m
    Vec3 rotation = Vec3::Zero();                ///< rotation vector, in rad
    double pressure = 0.0;                       ///< in N, if the device measures it
    std::uint32_t buttons = 0;                   ///< bit i: button i is down
    ReadingFault fault {};                       ///< why the reading is not valid, or why it gets old, if the driver knows
    double age = 0.0;                            ///< time since the device took this reading, in s
    bool valid = true;                           ///< false while the device has nothing to report
    Position true_position = Position::Zero();   ///< in m; known only for a simulated device
    Vec3 true_velocity = Vec3::Zero();           ///< in m/s; known only for a simulated device

    // The part of the last written effort that the limits of the motors removed.
    Vec3 unrendered_force = Vec3::Zero();    ///< written minus rendered, in N
    Vec3 unrendered_torque = Vec3::Zero();   ///< written minus rendered, in N m

    Channels axes {};      ///< in the order of DeviceLayout::axes
    Channels signals {};   ///< signal inputs, channel 1 first
};

/// The force, the torque and the other efforts that a device should apply.
struct Effort
{
    Vec3 force = Vec3::Zero();    ///< on the tool, in N
    Vec3 torque = Vec3::Zero();   ///< on the tool, in N m
    Channels axes {};             ///< in N or N m, in the order of DeviceLayout::efforts
    Channels signals {};          ///< signal outputs, channel 1 first; in N, m/s2 or 1, depending on calibration
    double brake = 0.0;           ///< damping of the brake on the tool, in N s/m; at least 0
};

/// The known mechanics of a device, at its tool.
struct DeviceMechanics
{
    double mass = 0.0;      ///< mass that the hand moves, in kg; 0: unknown
    double damping = 0.0;   ///< damping, in N s/m; 0: unknown

    bool operator== (const DeviceMechanics&) const = default;
};

/// The axes, buttons and signals that a device has in addition to a tool that moves and can be pushed, and the known mechanics of that tool. Nodes
/// find their part of a Reading and an Effort by these names. At most Channels::most axes and channels of each kind, and 32 buttons, are used; the
/// rest is ignored.
struct DeviceLayout
{
    std::vector<std::string> axes {};      ///< axes that can be read: triggers, sticks, joints. Each in m, rad or 1
    std::vector<std::string> efforts {};   ///< axes that can be pushed
    std::vector<std::string> buttons {};   ///< names by bit; "" for a button without a name
    int signal_inputs = 0, signal_outputs = 0;
    DeviceMechanics mechanics {};
    double brake = 0.0;   ///< the largest damping of its brake on the tool, in N s/m; 0: it has none

    bool operator== (const DeviceLayout&) const = default;
};

/// The index of a name, or -1 if it is not in the list.
inline int indexOf (const std::vector<std::string>& names, std::string_view name) noexcept
{
    for (std::size_t i = 0; i < names.size(); ++i)
        if (names[i] == name) return static_cast<int> (i);
    return -1;
}

/// One role as the nodes see it: the reading of this tick, and the effort on the device since the last tick, as the guard and the
/// limits of the motors let it through.
/// The engine owns it, and its address never changes; device nodes hold a pointer to it. The layout is empty until the role
/// has a device, and constant from then on. Nodes read it only when they are bound.
struct DeviceState
{
    Reading reading;
    Effort applied;
    DeviceLayout layout {};
};

/// The state that a device node is bound to before its role has one.
inline const DeviceState no_device { .reading = { .valid = false }, .applied = {} };

/// A driver. On each tick the engine calls read, runs the graph, and calls write, in this order, on the tick thread. Neither
/// may allocate, lock or wait.
class Device
{
public:
    virtual ~Device() = default;

    /// Gives the sample period before the first tick. Drivers with their own clock resample to it.
    virtual void prepare (double dt_s) = 0;
    virtual Reading read() noexcept = 0;
    virtual void write (const Effort& guarded) noexcept = 0;

    /// The final limits of the role's guard for signals, each without limit if infinite: `max` in the unit of the calibration, and
    /// `max_slew` per s. A driver that amplifies, filters or mixes signals after the guard must keep what reaches a channel within
    /// them. Called before prepare(), and again with tighter limits while the device is in use; what exceeds them then falls, without a step.
    /// [main thread]
    virtual void limitSignals (double /*max*/, double /*max_slew*/) {}

    /// The slew limits with which the role's guard begins, per s and without limit if infinite. A guard lets batches of reports catch up, so
    /// a driver that knows when an effort reaches the device must keep them by the wall clock. Called before prepare(). [main thread]
    virtual void limitSlews (double /*force*/, double /*torque*/, double /*axis*/) {}

    /// The parts that the device has in addition to a tool. Called when the role gets the device; the answer must not change afterwards.
    /// [main thread]
    virtual DeviceLayout layout() const { return {}; }

    /// The time that this device can drive a run, in s. 0: there is no limit, so the run needs --duration.
    virtual double duration() const noexcept { return 0.0; }

    /// The guard withholds efforts on this tick: called before write. A driver that sends what it derives from earlier efforts, such as
    /// the amplitude of a vibration, must forget them, so that the stop takes no longer than the guard's. [tick thread]
    virtual void withhold() noexcept {}

    /// Saves or restores its state, if it is a simulated one: what a reading or an effort of its own may depend on. False: it has no state that could
    /// be saved, as no real device has. [tick thread]
    virtual bool serialize (StateArchive&) { return false; }
};

}   // namespace tactus
