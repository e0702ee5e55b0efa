// SPDX-License-Identifier: MIT
#pragma once

/// The device of a role, as a node in a plugin sees it.

#include "device_form.hpp"
#include "known.hpp"

#include <tactus/tactus_plugin.h>

#include <tactus/node/device.hpp>

#include <algorithm>
#include <atomic>
#include <memory>
#include <utility>
#include <vector>

namespace tactus::plugin
{

inline DeviceLayout readLayout (const tactus_plugin_layout& given)
{
    tactus_plugin_layout l;
    copyKnown (l, &given);   // an older host knows no brake
    return { .axes = { l.axes, l.axes + l.axis_count },
             .efforts = { l.efforts, l.efforts + l.effort_count },
             .buttons = { l.buttons, l.buttons + l.button_count },
             .signal_inputs = l.signal_inputs,
             .signal_outputs = l.signal_outputs,
             .mechanics = { l.mechanics->mass, l.mechanics->damping },
             .brake = l.brake };
}

/// True if the nodes of this plugin can read the DeviceState of this host in place. [main thread]
inline bool sharesDeviceState (const tactus_plugin_host* host)
{
    if (host == nullptr || host->extension == nullptr) return false;
    const auto* lent = static_cast<const tactus_plugin_device_state*> (host->extension (TACTUS_PLUGIN_DEVICE_STATE));
    const auto own = formOfDeviceState();
    return lent != nullptr && ! own.empty() && own == lent->form;
}

/// The DeviceState that a node in a plugin is bound to: the host's, or else a copy that is renewed before each tick.
class DeviceLink
{
public:
    /// True if all nodes of this plugin read the host's states in place, so that renew() has nothing to do. Constant while the plugin has
    /// nodes. [main thread]
    static inline bool in_place = false;

    /// Prepares a state with the layout of a new device. The node continues with its old one until bind(). [main thread]
    void announce (const tactus_plugin_device& device)
    {
        if (in_place)
        {
            lent.store (static_cast<const DeviceState*> (device.state), std::memory_order_release);
            return;
        }
        seen.push_back (std::make_unique<Seen> (device, readLayout (*device.layout)));   // the old ones stay: the tick thread may be using one
        newest.store (seen.back().get(), std::memory_order_release);
    }

    /// The state of the device that was announced last. [main or tick thread]
    const DeviceState& bind() noexcept
    {
        if (const auto* state = lent.load (std::memory_order_acquire)) return *state;
        bound = newest.load (std::memory_order_acquire);
        if (bound == nullptr) return no_device;
        renew();
        return bound->state;
    }

    /// Copies the reading of this tick, and the effort that was applied on the previous tick. Not needed if `in_place`. [tick thread]
    void renew() noexcept
    {
        if (bound == nullptr) return;
        const auto& from = bound->from;
        auto& reading = bound->state.reading;
        reading.position = vector (from.position);
        reading.rotation = vector (from.rotation);
        reading.pressure = *from.pressure;
        reading.buttons = *from.buttons;
        reading.fault = static_cast<ReadingFault> (*from.fault);
        reading.age = *from.age_s;
        reading.valid = *from.valid != 0;
        reading.true_position = vector (from.true_position);
        reading.true_velocity = vector (from.true_velocity);
        copy (bound->axes, reading.axes);
        copy (bound->signals, reading.signals);
        auto& applied = bound->state.applied;
        applied.force = vector (from.applied_force);
        applied.torque = vector (from.applied_torque);
        if (from.applied_brake != nullptr) applied.brake = *from.applied_brake;   // an older host has none
        copy (bound->applied_axes, applied.axes);
        copy (bound->applied_signals, applied.signals);
    }

private:
    struct Seen
    {
        Seen (const tactus_plugin_device& d, DeviceLayout layout)
            : from (known (d)), axes (*d.axes), signals (*d.signals), applied_axes (*d.applied_axes), applied_signals (*d.applied_signals)
        {
            state.layout = std::move (layout);
        }

        static tactus_plugin_device known (const tactus_plugin_device& d) noexcept
        {
            tactus_plugin_device all;
            copyKnown (all, &d);   // an older host gives fewer members
            return all;
        }

        tactus_plugin_device from;
        tactus_plugin_channels axes, signals, applied_axes, applied_signals;
        DeviceState state {};
    };

    static Vec3 vector (const double* p) noexcept { return { p[0], p[1], p[2] }; }

    static void copy (const tactus_plugin_channels& from, Channels& to) noexcept
    {
        to.clear();
        for (int i = 0; i < *from.count; ++i)
            to.set (i, from.values[i]);
    }

    std::atomic<const DeviceState*> lent = nullptr;   // the host's, to be read in place
    std::vector<std::unique_ptr<Seen>> seen;
    std::atomic<Seen*> newest = nullptr;
    Seen* bound = nullptr;
};

inline void copyChannels (const Channels& from, std::uint32_t& count, double* to) noexcept
{
    count = static_cast<std::uint32_t> (from.size());
    std::copy (from.begin(), from.end(), to);
}

inline void show (const Effort& from, tactus_plugin_effort& to) noexcept
{
    for (int i = 0; i < 3; ++i)
    {
        to.force[i] = from.force[i];
        to.torque[i] = from.torque[i];
    }
    copyChannels (from.axes, to.axis_count, to.axes);
    copyChannels (from.signals, to.signal_count, to.signals);
    if (to.size >= sizeof to) to.brake = from.brake;   // an older host has no room for it
}

}   // namespace tactus::plugin
