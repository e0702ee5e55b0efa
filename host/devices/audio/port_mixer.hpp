// SPDX-License-Identifier: MIT
#pragma once

#include "high_pass.hpp"
#include <host/devices/sessions/audio_settings.hpp>

#include <tactus/plan/plan.hpp>

#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <vector>

namespace tactus::host::audio
{

/// Turns the ports of a plan into samples for the channels of a card. Ports are found by name, so routes survive edits; a
/// missing port is silent until it is back.
///
/// Routes do not pass through a guard, so they have their own gate. It shuts within 5 ms when the run halts, after an
/// emergency stop, or when a port outputs a value that is not a number. It reopens within 0.2 s.
class PortMixer
{
public:
    static constexpr double shut_s = 0.005, open_s = 0.2;
    static constexpr double most_sample = 8.0;      ///< in multiples of full scale; larger values would only make the filters that follow ring
    static constexpr std::size_t most_parts = 16;   ///< how many components of a port are summed at most

    /// `samples_per_tick` has one entry per route. [main thread]
    PortMixer (std::vector<Route>, const std::vector<int>& samples_per_tick, double tick_rate_hz);

    /// Call after each tick. [tick thread]
    void poll (const Plan&, bool shut) noexcept;

    /// Adds sample `i` of the tick, for all routes with `per_tick` samples, by channel. Call this for each `i` in order. [tick thread]
    void addTo (std::span<double> channels, int i, int per_tick) noexcept;

    std::uint64_t notNumbers() const noexcept { return broken.load (std::memory_order_relaxed); }   ///< samples that were not numbers [any thread]

    /// Samples per tick of a route's port: the largest of its parts. 0 if there is no such port. [main thread]
    static int samplesOf (const Plan&, const Route&);

private:
    struct RoutedPort
    {
        Route route;
        int per_tick;
        HighPass high_pass;
        std::array<std::uint32_t, most_parts> taps {};
        std::size_t parts = 0;
    };

    void find (const Plan&) noexcept;

    std::vector<RoutedPort> all;
    const double shuts, opens;   // change of the gate's gain per tick, while it shuts and while it opens
    std::atomic<std::uint64_t> broken = 0;

    // [tick thread]
    const Plan* plan = nullptr;   // the plan of this tick
    std::uint64_t serial = 0;
    bool knows = false;
    double gate = 0.0, gate_before = 0.0;
    bool has_broken = false;
};

}   // namespace tactus::host::audio
