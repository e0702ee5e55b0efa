// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/sessions/needs.hpp>

#include <tactus/graph/graph.hpp>

#include <optional>

namespace tactus::host
{

/// A short, gentle pulse on the device of one role, to find out whether it works. The graph is silent until its parameter `level.value` is
/// set and `start.value` is 1; it then gives one pulse of length_s, and nothing after that.
struct DeviceTrial
{
    static constexpr double length_s = 0.3;
    static constexpr double share = 0.1;               ///< the pulse reaches at most this fraction of a limit of the guard
    static constexpr double most_force_N = 0.5;        ///< the largest force, for devices with high limits
    static constexpr double unguarded_signal = 0.05;   ///< fraction of full scale, if there is no limit on signals

    graph::Graph graph;
    bool is_force = true;   ///< false: a vibration

    /// Empty if the graph drives no force and no vibration of this role.
    static std::optional<DeviceTrial> of (const graph::Graph&, const RoleNeeds&);

    /// The strength of the pulse, from the limits of the guard. If there is no limit on forces, it is 0: no pulse.
    double level (std::optional<double> max_force_N, std::optional<double> max_signal) const noexcept;
};

}   // namespace tactus::host
